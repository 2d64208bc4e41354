/* Estimates of integrals: the device against the host, exact hits, and closed forms. */
#include "file_kinds.h"
#include "harness.h"

#include "math/pi.h"
#include "trials/trials.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;
static uint64_t seed = 11;

/* ---- sets ------------------------------------------------------------------------------------ */

enum { MOST_SETS = 8, MOST_POINTS = 2500, MOST_TRIALS = 5 };

/* Sets of different sizes and their moves. */
typedef struct sets {
    unsigned dimension;
    size_t num, num_trials, numbers;
    pspec_pattern patterns[MOST_SETS];
    double *points[MOST_SETS], *weights[MOST_SETS];
    double moves[MOST_SETS * MOST_TRIALS * PS_MAX_DIMENSION];
} sets;

/* grid 0: any coordinates; else multiples of 1/grid. */
static double coordinate(double grid) {
    const double x = test_uniform(&seed);
    return grid > 0 ? floor(x * grid) / grid : x;
}

/* Every other set has weights, whole numbers whose sum is not 0. */
static sets make_sets(unsigned dimension, double grid) {
    static const size_t sizes[] = {1, 3, 1024, 1025, MOST_POINTS, 17};
    sets made = {.dimension = dimension,
                 .num = sizeof sizes / sizeof sizes[0],
                 .num_trials = 3,
                 .numbers = dimension};
    for (size_t r = 0; r < made.num; r++) {
        const size_t num = sizes[r];
        made.points[r] = calloc(num * dimension, sizeof(double));
        made.weights[r] = calloc(num, sizeof(double));
        for (size_t i = 0; i < num * dimension; i++) {
            made.points[r][i] = i < dimension ? 0 : coordinate(grid);
        }
        for (size_t j = 0; j < num; j++) {
            made.weights[r][j] = j % 4 == 3 ? -1 : (double)(1 + j % 5);
        }
        made.patterns[r] =
            (pspec_pattern){dimension, num, made.points[r], r % 2 == 1 ? made.weights[r] : NULL};
    }
    for (size_t i = 0; i < made.num * made.num_trials * dimension; i++) {
        made.moves[i] = coordinate(grid);
    }
    return made;
}

static void free_sets(sets *given) {
    for (size_t r = 0; r < given->num; r++) {
        free(given->points[r]);
        free(given->weights[r]);
    }
}

static ps_integrand *parse(const char *text, unsigned dimension) {
    ps_integrand *integrand = NULL;
    assert_ok(ps_integrand_parse(&integrand, text,
                                 (ps_integrand_place){PS_SAMPLES_TORUS, dimension}, error));
    return integrand;
}

/* Estimates of all sets and trials; where NULL: on the host. */
static void estimate(const ps_integrand *integrand, ps_device *where, ps_precision precision,
                     size_t batch, const sets *given, const double *moves, double *estimates) {
    const ps_trials_options options = {precision, batch, MOST_POINTS, given->num_trials, false};
    ps_trials *trials = NULL;
    assert_ok(ps_trials_create(&trials, integrand, &options, where, error));
    assert_true(ps_trials_is_on_device(trials) == (where != NULL));
    assert_ok(ps_trials_run(trials,
                            &(ps_batch){.num_patterns = given->num, .patterns = given->patterns},
                            moves, estimates, error));
    ps_trials_destroy(trials);
}

static bool has_double(void) {
    return ps_device_get_limits(device)->has_fp64;
}

/* ---- kernels --------------------------------------------------------------------------------- */

static void every_integrand_of_the_torus_has_a_kernel(void **state) {
    const ps_trials_options options = {PS_SINGLE, 1, 1, 1, false};
    (void)state;
    for (size_t i = 0; ps_integrand_kinds[i] != NULL; i++) {
        const ps_integrand_kind *const kind = ps_integrand_kinds[i];
        if ((kind->domains & PS_INTEGRAND_ON(PS_SAMPLES_TORUS)) != 0 && !is_of_file(kind)) {
            ps_integrand *integrand = parse(kind->name, kind->least);
            ps_trials *trials = NULL;
            assert_ok(ps_trials_create(&trials, integrand, &options, device, error));
            assert_true(ps_trials_is_on_device(trials));
            ps_trials_destroy(trials);
            ps_integrand_destroy(integrand);
        }
    }
}

/* Whole weights at points of a grid whose squared distances are exact: the same hits, so the same
 * numbers, in either precision. */
static void hits_are_counted_exactly(void **state) {
    static const struct {
        const char *text;
        unsigned dimension;
    } cases[] = {{"disk:radius=0.25", 1},
                 {"disk:radius=0.25", 2},
                 {"disk:radius=0.5,centre=0.25x0.5x0.75", 3},
                 {"disk:radius=0.5", 6},
                 {"box", 2},
                 {"box", 6},
                 {"half-plane:angle=0,offset=0.5", 2},
                 {"constant", 3}};
    enum { GRID = 1024 };
    (void)state;
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        ps_integrand *integrand = parse(cases[c].text, cases[c].dimension);
        sets of = make_sets(cases[c].dimension, GRID);
        double expected[MOST_SETS * MOST_TRIALS];
        double found[MOST_SETS * MOST_TRIALS];
        estimate(integrand, NULL, PS_DOUBLE, 1, &of, of.moves, expected);
        for (ps_precision p = PS_SINGLE; p <= (has_double() ? PS_DOUBLE : PS_SINGLE); p++) {
            estimate(integrand, device, p, 4, &of, of.moves, found);
            for (size_t i = 0; i < of.num * of.num_trials; i++) {
                assert_true(found[i] == expected[i]);
            }
        }
        free_sets(&of);
        ps_integrand_destroy(integrand);
    }
}

/* Largest difference of device and host. */
static double farthest(const ps_integrand *integrand, ps_precision precision, const sets *given) {
    double expected[MOST_SETS * MOST_TRIALS];
    double found[MOST_SETS * MOST_TRIALS];
    double largest = 0;
    estimate(integrand, NULL, PS_DOUBLE, 1, given, given->moves, expected);
    estimate(integrand, device, precision, 4, given, given->moves, found);
    for (size_t i = 0; i < given->num * given->num_trials; i++) {
        assert_true(isfinite(found[i]));
        largest = fmax(largest, fabs(found[i] - expected[i]));
    }
    return largest;
}

/* Values have heights of 1 at most, and weights of either sign of which the sizes add up to less
 * than 2.1 W (but for one set of three points with 1, 2 and 3): 2.1 times the error of a value. In
 * single precision a coordinate is off by 2^-25 of rounding, the shift too, their sum by 2^-25, the
 * difference to the centre by no more; slope is the sum of |dF/dx_i|. */
static void smooth_values_are_those_of_the_host(void **state) {
    static const struct {
        const char *text;
        unsigned dimension;
        double slope;
    } cases[] = {{"gaussian:sigma=0.0625", 1, 10},
                 {"gaussian:sigma=0.05", 2, 25},
                 {"gaussian:sigma=0.0625", 2, 20},
                 {"gaussian:sigma=0.3,centre=0.1", 3, 12},
                 {"gaussian:sigma=0.3", 6, 30},
                 {"gaussian:cut=yes", 3, 30},
                 {"wave:k=3", 1, 19},
                 {"wave:k=2x-5,phase=0.2", 2, 44},
                 {"wave:k=1x2x3x4x5x6", 6, 132.0}};
    const double weighted = 2.1;
    const double of_value = 4e-7; /* an exponential of three units in the last place, each axis */
    (void)state;
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        ps_integrand *integrand = parse(cases[c].text, cases[c].dimension);
        sets of = make_sets(cases[c].dimension, 0);
        const double single =
            weighted * (cases[c].slope * 4 * 0x1p-25 + cases[c].dimension * of_value);
        assert_true(farthest(integrand, PS_SINGLE, &of) < single);
        if (has_double()) {
            assert_true(farthest(integrand, PS_DOUBLE, &of) < single * 0x1p-29);
        }
        free_sets(&of);
        ps_integrand_destroy(integrand);
    }
}

/* The mean of a Gaussian over a grid is its integral, to the waves that the grid takes for 0. */
static void a_grid_gives_the_integral(void **state) {
    enum { SIDE = 48 };
    const ps_trials_options options = {PS_DOUBLE, 1, SIDE * SIDE, 1, false};
    const double shift[] = {0.123, 0.77};
    ps_integrand *integrand = parse("gaussian:sigma=0.0625", 2);
    double *points = calloc((size_t)2 * SIDE * SIDE, sizeof *points);
    const pspec_pattern grid = {2, (size_t)SIDE * SIDE, points, NULL};
    (void)state;
    for (size_t i = 0; i < grid.num_points; i++) {
        points[2 * i] = (double)(i % SIDE) / SIDE;
        points[2 * i + 1] = (double)(i / SIDE) / SIDE;
    }
    for (int on_device = 0; on_device <= has_double(); on_device++) {
        ps_trials *trials = NULL;
        double found = 0;
        assert_ok(ps_trials_create(&trials, integrand, &options, on_device ? device : NULL, error));
        assert_ok(ps_trials_run(trials, &(ps_batch){.num_patterns = 1, .patterns = &grid}, shift,
                                &found, error));
        assert_true(fabs(found - PS_TWO_PI * 0.0625 * 0.0625) < 1e-15);
        ps_trials_destroy(trials);
    }
    free(points);
    ps_integrand_destroy(integrand);
}

/* ---- the same bits --------------------------------------------------------------------------- */

/* Every trial by itself. */
static void estimate_apart(const ps_integrand *integrand, const sets *given, ps_precision precision,
                           double *estimates) {
    const ps_trials_options options = {precision, 1, MOST_POINTS, 1, false};
    ps_trials *trials = NULL;
    assert_ok(ps_trials_create(&trials, integrand, &options, device, error));
    for (size_t i = 0; i < given->num * given->num_trials; i++) {
        assert_ok(ps_trials_run(
            trials,
            &(ps_batch){.num_patterns = 1, .patterns = &given->patterns[i / given->num_trials]},
            given->moves + i * given->numbers, &estimates[i], error));
    }
    ps_trials_destroy(trials);
}

static void shapes_of_a_launch_do_not_matter(void **state) {
    static const size_t groups[] = {0, 1, 7, 64};
    const ps_precision last = has_double() ? PS_DOUBLE : PS_SINGLE;
    ps_integrand *integrand = parse("gaussian:sigma=0.1", 2);
    sets of = make_sets(2, 0);
    double expected[MOST_SETS * MOST_TRIALS];
    double found[MOST_SETS * MOST_TRIALS];
    const size_t bytes = of.num * of.num_trials * sizeof expected[0];
    (void)state;
    for (ps_precision p = PS_SINGLE; p <= last; p++) {
        estimate_apart(integrand, &of, p, expected);
        for (size_t g = 0; g < sizeof groups / sizeof groups[0]; g++) {
            for (size_t batch = 1; batch <= MOST_SETS; batch += 3) {
                ps_device_set_group_size(device, groups[g]);
                ps_device_set_unified_memory(device, batch % 2 == 0);
                estimate(integrand, device, p, batch, &of, of.moves, found);
                assert_memory_equal(found, expected, bytes);
            }
        }
    }
    ps_device_set_group_size(device, 0);
    ps_device_set_unified_memory(device, true);
    free_sets(&of);
    ps_integrand_destroy(integrand);
}

/* ---- moves ----------------------------------------------------------------------------------- */

/* The shifted coordinate is in [0,1) whatever rounds: a half-plane tells 0 from 1, which is not in
 * the cell. */
static void shifts_wrap(void **state) {
    static const struct {
        double x, shift;
        double single, exact; /* below 1/2? */
    } cases[] = {
        {0, 0, 1, 1},
        {0.25, 0.25, 0, 0},
        {0.75, 0.25, 1, 1},
        {0.75, 0.75, 0, 0},
        {1 - 0x1p-24, 0x1p-24, 1, 1},
        {1 - 0x1p-24, 1 - 0x1p-24, 0, 0},
        {1 - 0x1p-53, 0, 1, 0}, /* rounds to 1, which is 0 */
        {1 - 0x1p-53, 1 - 0x1p-53, 1, 0},
        {0, 1 - 0x1p-53, 1, 0},
    };
    const ps_trials_options options = {PS_SINGLE, 1, 1, 1, false};
    ps_integrand *integrand = parse("half-plane:angle=0,offset=0.5", 2);
    (void)state;
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        const double point[] = {cases[c].x, 0};
        const double shift[] = {cases[c].shift, 0};
        const pspec_pattern one = {2, 1, point, NULL};
        for (int on_device = 0; on_device <= 1; on_device++) {
            ps_trials *trials = NULL;
            double found = 0;
            assert_ok(
                ps_trials_create(&trials, integrand, &options, on_device ? device : NULL, error));
            assert_ok(ps_trials_run(trials, &(ps_batch){.num_patterns = 1, .patterns = &one}, shift,
                                    &found, error));
            assert_true(found == (on_device ? cases[c].single : cases[c].exact));
            ps_trials_destroy(trials);
        }
    }
    ps_integrand_destroy(integrand);
}

static void no_moves_are_moves_of_nothing(void **state) {
    ps_integrand *integrand = parse("wave:k=1x2", 2);
    sets of = make_sets(2, 0);
    double expected[MOST_SETS * MOST_TRIALS];
    double found[MOST_SETS * MOST_TRIALS];
    ps_device *const places[] = {NULL, device};
    (void)state;
    memset(of.moves, 0, sizeof of.moves);
    for (size_t i = 0; i < 2; i++) {
        estimate(integrand, places[i], PS_SINGLE, 4, &of, of.moves, expected);
        estimate(integrand, places[i], PS_SINGLE, 4, &of, NULL, found);
        assert_memory_equal(found, expected, of.num * of.num_trials * sizeof found[0]);
    }
    free_sets(&of);
    ps_integrand_destroy(integrand);
}

/* ---- weights and errors ---------------------------------------------------------------------- */

static void sizes_of_weights_do_not_matter(void **state) {
    const double factors[] = {0x1p-300, 0x1p300};
    ps_integrand *integrand = parse("gaussian", 2);
    sets of = make_sets(2, 0);
    double expected[MOST_SETS * MOST_TRIALS];
    double found[MOST_SETS * MOST_TRIALS];
    (void)state;
    estimate(integrand, device, PS_SINGLE, 4, &of, of.moves, expected);
    for (size_t f = 0; f < 2; f++) {
        sets scaled = of;
        double weights[MOST_POINTS];
        for (size_t j = 0; j < of.patterns[3].num_points; j++) {
            weights[j] = of.weights[3][j] * factors[f];
        }
        scaled.patterns[3].weights = weights;
        estimate(integrand, device, PS_SINGLE, 4, &scaled, of.moves, found);
        assert_memory_equal(found, expected, of.num * of.num_trials * sizeof found[0]);
    }
    free_sets(&of);
    ps_integrand_destroy(integrand);
}

static void assert_refused(ps_trials *trials, pspec_pattern pattern, const char *words) {
    double estimate_of_one = 0;
    ps_error error = {0};
    assert_int_equal(ps_trials_run(trials, &(ps_batch){.num_patterns = 1, .patterns = &pattern},
                                   NULL, &estimate_of_one, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, words));
}

static void what_is_refused(void **state) {
    const double points[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
    const double weights[] = {1, -1};
    ps_trials_options options = {PS_SINGLE, 1, 2, 1, false};
    ps_integrand *integrand = parse("disk", 2);
    ps_trials *trials = NULL;
    ps_error error = {0};
    (void)state;
    assert_ok(ps_trials_create(&trials, integrand, &options, device, error));
    assert_refused(trials, (pspec_pattern){3, 2, points, NULL}, "set 1 has 3 numbers per point");
    assert_refused(trials, (pspec_pattern){2, 3, points, NULL}, "set 1 has 3 points, and");
    assert_refused(trials, (pspec_pattern){2, 0, points, NULL}, "set 1 has 0 points, and");
    assert_refused(trials, (pspec_pattern){2, 2, points, weights}, "weights whose sum is 0");
    ps_trials_destroy(trials);
    options.num_trials = 0;
    assert_int_equal(ps_trials_create(&trials, integrand, &options, device, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_null(trials);
    options = (ps_trials_options){PS_SINGLE, SIZE_MAX / 2, 1000, 3, false};
    assert_int_equal(ps_trials_create(&trials, integrand, &options, device, &error),
                     PSPEC_ERROR_MEMORY);
    ps_integrand_destroy(integrand);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_integrand_of_the_torus_has_a_kernel),
        cmocka_unit_test(hits_are_counted_exactly),
        cmocka_unit_test(smooth_values_are_those_of_the_host),
        cmocka_unit_test(a_grid_gives_the_integral),
        cmocka_unit_test(shapes_of_a_launch_do_not_matter),
        cmocka_unit_test(shifts_wrap),
        cmocka_unit_test(no_moves_are_moves_of_nothing),
        cmocka_unit_test(sizes_of_weights_do_not_matter),
        cmocka_unit_test(what_is_refused),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("trials", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
