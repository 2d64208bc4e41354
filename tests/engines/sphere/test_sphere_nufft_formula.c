/* The error formula of sphere_nufft and sphere_grid, term by term, with the constants of
 * docs/engines/sphere_nufft.md: as in tests/engines/torus/test_nufft_formula.c, in numbers that can
 * be worked out by hand. */
#include "harness.h"

#include "engines/sphere/nufft/shape.h"

#include <math.h>

/* Terms of the page; roundings in units of u, angles as they are. */
typedef struct formula_case {
    const char *name;
    ps_sphere_route route;
    ps_nufft_axis axis;
    uint64_t num_points;
    double tolerance, power;
    double aliasing, polynomials, rounding, rings, given, coherent;
} formula_case;

/* L + 1 = 2^15 and one point: P' is P but for 1e-9, P L is 2^15 but for 3e-5. */
enum { L = (1 << 15) - 1 };
#define AXIS(cells, wide, ...)                                                                     \
    {                                                                                              \
        .max_frequency = L, .n = (cells), .window = {.width = (wide)}, .loss = { __VA_ARGS__ }     \
    }

static const formula_case cases[] = {
    {.name = "windows and passes, by rings",
     .route = PS_SPHERE_BY_RINGS,
     .axis = {.max_frequency = L,
              .n = 1 << 16,
              .window = {.width = 1},
              .loss = {.amplification = 1},
              .passes = 5},
     .num_points = 1,
     .power = 1,
     .rounding = 4 + 1.2 * 5,
     .rings = 54.30497214804552, /* .3 sqrt(L) */
     .given = 2,
     .coherent = 0.3},
    {.name = "windows and passes, by cells; amplification",
     .route = PS_SPHERE_BY_CELLS,
     .axis = {.max_frequency = L,
              .n = 1 << 16,
              .window = {.width = 1},
              .loss = {.amplification = 3},
              .passes = 5},
     .num_points = 1,
     .power = 1,
     .rounding = 9 * (3.5 + 0.4 * 5),
     .rings = 54.30497214804552,
     .given = 2,
     .coherent = 0.3},
    {.name = "power",
     .axis = AXIS(1 << 16, 1, .amplification = 1),
     .num_points = 1,
     .power = 4,
     .rounding = 8,
     .rings = 108.60994429609104,
     .given = 4,
     .coherent = 8 * 0.3},
    {.name = "dense cells: 2^14 points touch one",
     .axis = AXIS(1 << 10, 4, .amplification = 1),
     .num_points = 1 << 29,
     .power = 0.5,                  /* P' = 1 + 2^29 / 2^30 */
     .rounding = 313.5729580177474, /* sqrt(3 / 2) hypot(4, 2 2^7) */
     .rings = 66.50973612938184,
     .given = 2,
     .coherent = 0.3},
    {.name = "polynomials",
     .axis = AXIS(1 << 16, 1, .amplification = 1),
     .num_points = 1,
     .tolerance = 0.5,
     .power = 2,
     .polynomials = 0.01},
    {.name = "aliases",
     .axis = AXIS(1 << 16, 1, .aliasing = 0.09, .worst = 0.04, .amplification = 1),
     .num_points = (1ULL << 32) - (1 << 17) + 1, /* (2 L + 1)^2: A + W P + 4 W */
     .power = 3,
     .aliasing = 0.6082762530298219},
};

static void check(const formula_case *one, ps_precision precision) {
    static const double units[2] = {0x1p-24, 0x1p-53};
    const double u = units[precision];
    const double angles = 1.5 * L * 0x1p-53 * sqrt(fmax(one->power, 1));
    const ps_problem problem = {.num_points = one->num_points, .tolerance = one->tolerance};
    const double rounding = hypot(u * hypot(hypot(one->rounding, one->rings), one->given), angles);
    const double expected =
        hypot(hypot(one->aliasing, one->polynomials), rounding) + u * one->coherent;
    const double found =
        ps_sphere_nufft_error(&one->axis, &problem, precision, one->power, one->route);
    const double most = one->rounding > 0 ? 1e-7 : 1e-4; /* what L and 2 L + 1 are rounded by */
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(terms),
    };
    return cmocka_run_group_tests_name("sphere_nufft_formula", tests, NULL, NULL);
}
