/* The error formula of torus_nufft, term by term, with the constants of its page,
 * docs/engines/torus_nufft.md. Measured errors hold it from one side (test_tolerance_sweep.c): a
 * constant that is half of what it should be passes there wherever another term is larger. Choices
 * are made up, in numbers that can be worked out by hand. */
#include "harness.h"

#include "engines/torus/nufft/choice.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>

enum { K = 8 };
static const double modes = (2 * K + 1) * (2 * K + 1);

/* Terms of the page; roundings in units of u. */
typedef struct formula_case {
    const char *name;
    ps_nufft_choice choice;
    uint64_t num_points;
    double tolerance, power;
    double aliasing, polynomials, rounding, at_zero, given, coherent;
} formula_case;

/* n cells and windows of w; 2^30 cells are many for one point: next to nothing touches one. */
#define AXIS(cells, wide, ...)                                                                     \
    {                                                                                              \
        .axis = 1, .n = (cells), .window = {.width = (wide)}, .loss = { __VA_ARGS__ }              \
    }

static const formula_case cases[] = {
    {.name = "windows and phases, points",
     .choice = {.num_axes = 1, .span = 1, .axes = {AXIS(1 << 30, 1, .amplification = 1)}},
     .num_points = 1,
     .power = 1,
     .rounding = 7,
     .given = 2,
     .coherent = 0.45},
    {.name = "powers below that of white noise count as 1",
     .choice = {.num_axes = 1, .span = 1, .axes = {AXIS(1 << 30, 1, .amplification = 1)}},
     .num_points = 1,
     .power = 0.1,
     .rounding = 7,
     .given = 2,
     .coherent = 0.45},
    {.name = "power",
     .choice = {.num_axes = 1, .span = 1, .axes = {AXIS(1 << 30, 1, .amplification = 1)}},
     .num_points = 1,
     .power = 4,
     .rounding = 14,
     .given = 4,
     .coherent = 8 * 0.45},
    {.name = "amplification",
     .choice = {.num_axes = 1, .span = 1, .axes = {AXIS(1 << 30, 1, .amplification = 3)}},
     .num_points = 1,
     .power = 1,
     .rounding = 21,
     .given = 2,
     .coherent = 3 * 0.45},
    {.name = "amplification below 1, of coincident points all the same",
     .choice = {.num_axes = 1, .span = 1, .axes = {AXIS(1 << 30, 1, .amplification = 0.5)}},
     .num_points = 1,
     .power = 4,
     .rounding = 7,
     .given = 4,
     .coherent = 8 * 0.45},
    {.name = "passes, that of turns among them",
     .choice = {.num_axes = 1,
                .variant = &ps_nufft_whole,
                .axes = {{.n = 1 << 30,
                          .window = {.width = 1},
                          .loss = {.amplification = 1},
                          .passes = 4}}},
     .num_points = 1,
     .power = 1,
     .rounding = 7 + 4 + 2,
     .given = 2,
     .coherent = 0.45},
    {.name = "dense cells: 2^14 points touch one, 2^12 are in it",
     .choice = {.num_axes = 1, .span = 64, .axes = {AXIS(1 << 8, 4, .amplification = 1)}},
     .num_points = 1 << 20,
     .power = 1,
     .rounding = 128.191263352851, /* hypot(7, 2^7) */
     /* hypot(2 sqrt(2^12 2^14), .3 2^14 sqrt(2^12)) / sqrt(64) */
     .at_zero = 39374.897213326156,
     .given = 2,
     .coherent = 0.45},
    {.name = "wide windows, strides: 64 points touch a cell, 1 is in it",
     .choice =
         {.num_axes = 1, .span = 64, .stride = 64, .axes = {AXIS(1 << 20, 64, .amplification = 1)}},
     .num_points = 1 << 20,
     .power = 1,
     .rounding = 10.63014581273465,
     .at_zero = 2, /* 2 sqrt(64) / sqrt(64) */
     .given = 2,
     .coherent = 0.45},
    {.name = "a grid of both axes, in four chunks",
     .choice = {.num_axes = 2,
                .variant = &ps_nufft_large,
                .chunk = 1 << 18,
                .axes = {AXIS(1 << 8, 4, .amplification = 1), AXIS(1 << 8, 4, .amplification = 1)}},
     .num_points = 1 << 20,
     .power = 1,
     .rounding = 10.63014581273465, /* hypot(7, 2^3): 4 points in a cell, 64 touch it */
     .at_zero = 0.08 * 64 * 4 * 2,  /* touching sqrt(4 4) sqrt(4) */
     .given = 2,
     .coherent = 0.45},
    {.name = "aliases",
     .choice = {.num_axes = 1,
                .span = 1,
                .axes = {AXIS(1 << 30, 1, .aliasing = 0.09, .worst = 0.01, .amplification = 1)}},
     .num_points = 289, /* one for each mode: A + 2 W P + 4 W */
     .power = 5,
     .aliasing = 0.4795831523312719},
    {.name = "aliases, strides",
     .choice = {.num_axes = 2,
                .span = 1,
                .stride = 1,
                .axes = {AXIS(1 << 30, 1, .aliasing = 0.09, .amplification = 1),
                         AXIS(1 << 30, 1, .worst = 0.01, .amplification = 1)}},
     .num_points = 289,
     .power = 1,
     .aliasing = 0.3872983346207417},
    {.name = "lattices in space: 8 points touch a cell, two for a mode",
     .choice = {.num_axes = 3,
                .variant = &ps_nufft_large,
                .axes = {AXIS(68, 17, .amplification = 2, .edge = 3),
                         AXIS(578, 34, .amplification = 1, .edge = 2),
                         AXIS(34, 2, .amplification = 1, .edge = 1)}},
     .num_points = 2 * 17 * 17 * 17,
     .power = 1,
     .rounding = 2 * 7.582875444051551, /* hypot(7, sqrt(T)), T = 9826 / 4 / 17 / 17 = 8.5 */
     .at_zero = 11.99759975995199,      /* 0.28 * 6 * sqrt(6 T) */
     .given = 2,
     .coherent = 2 * 0.45},
    {.name = "polynomials",
     .choice = {.num_axes = 2,
                .span = 1,
                .axes = {AXIS(1 << 30, 1, .amplification = 1),
                         AXIS(1 << 30, 1, .amplification = 1)}},
     .num_points = 1,
     .tolerance = 0.5,
     .power = 2,
     .polynomials = 0.01},
};

static void check(const formula_case *one, ps_precision precision) {
    static const double units[2] = {0x1p-24, 0x1p-53};
    const double u = units[precision];
    const unsigned dimension = one->choice.num_axes > 2 ? one->choice.num_axes : 2;
    const ps_frequencies box = {
        .kind = PS_FREQUENCIES_BOX, .dimension = dimension, .max_frequency = K};
    const ps_problem problem = {
        .frequencies = &box, .num_points = one->num_points, .tolerance = one->tolerance};
    const double rounding = hypot(hypot(one->rounding, one->at_zero), one->given);
    const double expected =
        hypot(hypot(one->aliasing, one->polynomials), u * rounding) + u * one->coherent;
    ps_nufft_choice choice = one->choice;
    choice.variant = choice.variant != NULL ? choice.variant : &ps_nufft_tiles;
    const double found = ps_nufft_error(&choice, &problem, precision, one->power);
    /* Where there is more than rounding, rounding is what may be left away, and touching cells. */
    const double most = one->rounding > 0 ? 1e-6 : 1e-5;
    if (!(fabs(found / expected - 1) <= most)) {
        fail_msg("%s, %s: %.10g, expected %.10g", one->name, ps_precision_name(precision), found,
                 expected);
    }
}

static void terms(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        check(&cases[i], PS_SINGLE);
        check(&cases[i], PS_DOUBLE);
    }
}

static void frequencies_of_both_signs(void **state) {
    (void)state;
    const ps_frequencies plane = {.kind = PS_FREQUENCIES_BOX, .dimension = 2, .max_frequency = K};
    assert_true(ps_nufft_modes(&(ps_problem){.frequencies = &plane}) == modes);
}

/* The worst of 24 frequencies and K, though few of them are looked at closely. */
static void worst_frequency(void **state) {
    (void)state;
    const int32_t largest = 100;
    for (unsigned width = PS_NUFFT_MIN_WIDTH; width <= PS_NUFFT_MAX_WIDTH; width++) {
        for (uint32_t n = 240; n <= 800; n += 56) {
            const ps_nufft_window window = ps_nufft_window_make(width, largest, n);
            double worst = ps_nufft_window_aliases(&window, (double)largest / n, 3).in_step;
            for (int i = 0; i < 24; i++) {
                const double at = (i + 0.5) / 24;
                const double f = (1 - at * at) * largest / n;
                worst = fmax(worst, ps_nufft_window_aliases(&window, f, 3).in_step);
            }
            assert_true(ps_nufft_window_loss(&window, largest, n).worst == worst);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(terms),
        cmocka_unit_test(frequencies_of_both_signs),
        cmocka_unit_test(worst_frequency),
    };
    return cmocka_run_group_tests_name("nufft_formula", tests, NULL, NULL);
}
