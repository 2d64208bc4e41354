/* The engine torus_nufft against the referee: the tolerance contract for sets of every kind, what batches
 * and partners in a pair must not change, white noise.
 *
 * As in test_tolerance.c, sqrt(2) times the root mean square of | |S| - |S_ref| | stands for |dS|.
 */
#include "harness.h"

#include "engines/host_direct.h"
#include "engines/torus_nufft.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;
static unsigned dimension = 2;

typedef struct shape {
    const char *name;
    double (*coordinate)(size_t point, size_t num_points, unsigned axis, uint64_t *state);
    double (*weight)(size_t point, uint64_t *state); /* NULL: unit weights */
} shape;

static double white(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    (void)point;
    (void)num_points;
    (void)axis;
    return test_uniform(state);
}

static double jittered(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    const size_t cells = (size_t)ceil(sqrt((double)num_points));
    const size_t cell = axis % 2 == 0 ? point / cells : point % cells;
    return ((double)cell + test_uniform(state)) / (double)cells;
}

static double lattice(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    (void)state;
    return fmod((double)point * (axis == 0 ? 1 : axis == 1 ? 17 : 113) / (double)num_points, 1.0);
}

static double one_place(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    (void)point;
    (void)num_points;
    (void)state;
    return axis % 2 == 0 ? 0.3183098861837907 : 0.7071067811865476;
}

static double near_zero(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    (void)point;
    (void)num_points;
    (void)axis;
    return test_uniform(state) * 0x1p-20;
}

/* Pairs of equal points. */
static double duplicates(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    uint64_t own = point / 2 * 2 + axis;
    (void)num_points;
    (void)state;
    return test_uniform(&own);
}

/* The first and the last coordinate there are, and cell boundaries. */
static double boundaries(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    static const double places[] = {0, 1 - 0x1p-32, 0.5, 0.25, 1 - 0x1p-53, 0x1p-64, 0.125};
    (void)num_points;
    (void)axis;
    (void)point;
    return places[(size_t)(test_uniform(state) * 7)];
}

static double signed_weight(size_t point, uint64_t *state) {
    (void)point;
    return 2 * test_uniform(state) - 0.9;
}

/* Of either sign, over twelve decades. */
static double wild_weight(size_t point, uint64_t *state) {
    const double decades = 12;
    return (point % 2 == 0 ? 1 : -1) * pow(10, decades * (test_uniform(state) - 0.5));
}

static const shape shapes[] = {
    {"white", white, NULL},
    {"jittered", jittered, NULL},
    {"lattice", lattice, NULL},
    {"one place", one_place, NULL},
    {"near zero", near_zero, NULL},
    {"duplicates", duplicates, NULL},
    {"boundaries", boundaries, NULL},
    {"signed weights", white, signed_weight},
    {"wild weights", white, wild_weight},
};
enum { NUM_SHAPES = sizeof shapes / sizeof shapes[0] };

static pspec_pattern make_pattern(const shape *what, size_t num_points, uint64_t seed) {
    double *points = calloc(num_points * dimension, sizeof(double));
    double *weights = what->weight != NULL ? calloc(num_points, sizeof(double)) : NULL;
    for (size_t j = 0; j < num_points; j++) {
        for (unsigned axis = 0; axis < dimension; axis++) {
            points[j * dimension + axis] = what->coordinate(j, num_points, axis, &seed);
        }
        if (weights != NULL) {
            weights[j] = what->weight(j, &seed);
        }
    }
    return (pspec_pattern){dimension, num_points, points, weights};
}

static void free_pattern(pspec_pattern *pattern) {
    free((void *)pattern->points);
    free((void *)pattern->weights);
}

static double sum_of_squares(const pspec_pattern *pattern) {
    double sum = 0;
    for (size_t j = 0; j < pattern->num_points; j++) {
        const double weight = pattern->weights != NULL ? pattern->weights[j] : 1;
        sum += weight * weight;
    }
    return sum;
}

static ps_frequencies make_grid(int32_t k) {
    ps_frequencies grid = {0};
    assert_ok(ps_frequencies_lattice(&grid, dimension, k, false, error));
    assert_ok(ps_frequencies_enumerate(&grid, error));
    return grid;
}

/* ---- tolerance --------------------------------------------------------------------------- */

static const double rounding_floor[2] = {4e-7, 1e-15}; /* below it the formula exceeds tolerances */

typedef struct sweep {
    const shape *what;
    const ps_frequencies *grid;
    const pspec_pattern *pattern;
    const double *expected;
    double squares, power; /* sum w^2, mean effective power */
} sweep;

static double measured_error(const sweep *at, ps_precision precision, double tolerance) {
    double *found = test_run_engine_to(&ps_torus_nufft, precision, tolerance, device, at->grid,
                                       at->pattern, 1, 1);
    double error = 0;
    for (size_t i = 0; i < at->grid->num; i++) {
        error += pow(sqrt(found[i]) - sqrt(at->expected[i]), 2) / (double)at->grid->num;
    }
    free(found);
    return sqrt(2 * error / at->squares);
}

/* Fails only when all of a sweep is printed. */
static bool check_tolerance(const sweep *at, ps_precision precision, double tolerance,
                            double *smallest) {
    const ps_problem problem = {
        .frequencies = at->grid, .num_points = at->pattern->num_points, .tolerance = tolerance};
    const double formula = ps_torus_nufft.error(&problem, precision, at->power);
    const double at_one = ps_torus_nufft.error(&problem, precision, 1);
    const double error = measured_error(at, precision, tolerance);
    const double likely_power = 1.05; /* white sets, up to chance */
    const bool is_kept =
        error <= formula && (at_one > tolerance || at->power > likely_power || error <= tolerance);
    *smallest = fmin(*smallest, formula / error);
    if (!is_kept) {
        print_message(
            "%s %s N=%zu K=%d tolerance %.2e: error %.2e formula %.2e (%.2e) power %.2g\n",
            at->what->name, ps_precision_name(precision), at->pattern->num_points,
            (int)at->grid->max_frequency, tolerance, error, formula, at_one, at->power);
    }
    return is_kept;
}

static bool sweep_tolerances(const shape *what, int32_t k, size_t num_points,
                             ps_precision precision, double steps_per_decade) {
    ps_frequencies grid = make_grid(k);
    pspec_pattern pattern = make_pattern(what, num_points, 7);
    double *expected = test_run_engine(&ps_host_direct, PS_EXTENDED, NULL, &grid, &pattern, 1, 1);
    sweep at = {what, &grid, &pattern, expected, sum_of_squares(&pattern), 0};
    double smallest = HUGE_VAL;
    bool is_kept = true;
    for (size_t i = 0; i < grid.num; i++) {
        at.power += expected[i] / at.squares / (double)grid.num;
    }
    for (double tolerance = 1e-2; tolerance > rounding_floor[precision];
         tolerance /= pow(10, 1 / steps_per_decade)) {
        is_kept = check_tolerance(&at, precision, tolerance, &smallest) && is_kept;
    }
    print_message("%-15s %-6s d=%u N=%-5zu K=%-3d power %8.2e smallest slack %.2f\n", what->name,
                  ps_precision_name(precision), dimension, num_points, (int)k, at.power, smallest);
    free(expected);
    free_pattern(&pattern);
    ps_frequencies_free(&grid);
    return is_kept;
}

static bool sweep_shapes(ps_precision precision) {
    bool is_kept = true;
    if (precision == PS_DOUBLE && !ps_device_get_limits(device)->has_fp64) {
        skip();
    }
    static const struct {
        unsigned dimension;
        int32_t k;
        size_t num_points;
        double steps_per_decade;
    } cases[] = {{1, 100, 150, 8}, {1, 600, 60, 2}, {2, 12, 500, 8},
                 {2, 40, 100, 2},  {3, 5, 300, 8},  {3, 9, 80, 2}};
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        dimension = cases[c].dimension;
        for (size_t i = 0; i < NUM_SHAPES; i++) {
            is_kept = sweep_tolerances(&shapes[i], cases[c].k, cases[c].num_points, precision,
                                       cases[c].steps_per_decade) &&
                      is_kept;
        }
    }
    dimension = 2;
    return is_kept;
}

static void single_precision(void **state) {
    (void)state;
    assert_true(sweep_shapes(PS_SINGLE));
}

static void double_precision(void **state) {
    (void)state;
    assert_true(sweep_shapes(PS_DOUBLE));
}

/* One point and few, dense cells, the smallest grids. */
static void sizes(void **state) {
    (void)state;
    static const struct {
        int32_t k;
        size_t num_points;
    } cases[] = {{1, 1}, {1, 2}, {2, 3}, {3, 1}, {5, 7}, {7, 3000}, {10, 20000}, {60, 50}};
    bool is_kept = true;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (size_t s = 0; s < 2; s++) {
            is_kept = sweep_tolerances(&shapes[s * (NUM_SHAPES - 1)], cases[i].k,
                                       cases[i].num_points, PS_SINGLE, 1) &&
                      is_kept;
            is_kept = !ps_device_get_limits(device)->has_fp64 ||
                      (sweep_tolerances(&shapes[s * (NUM_SHAPES - 1)], cases[i].k,
                                        cases[i].num_points, PS_DOUBLE, 1) &&
                       is_kept);
        }
    }
    assert_true(is_kept);
}

/* ---- batches ----------------------------------------------------------------------------- */

/* More than two groups of pairs; odd. Sizes differ. */
enum { REALIZATIONS = 67 };

static void check_batches(ps_precision precision, bool has_weights) {
    static const size_t batches[] = {2, 4, 32, 34, 64, REALIZATIONS + 1};
    const shape *what = has_weights ? &shapes[NUM_SHAPES - 2] : &shapes[0];
    ps_frequencies grid = make_grid(9);
    pspec_pattern patterns[REALIZATIONS];
    for (size_t r = 0; r < REALIZATIONS; r++) {
        patterns[r] = make_pattern(what, 1 + r * 7 % 50, 100 + r);
    }
    double *expected = test_run_engine_to(&ps_torus_nufft, precision, 1e-5, device, &grid, patterns,
                                          REALIZATIONS, REALIZATIONS);
    for (size_t i = 0; i < sizeof batches / sizeof batches[0]; i++) {
        double *found = test_run_engine_to(&ps_torus_nufft, precision, 1e-5, device, &grid,
                                           patterns, REALIZATIONS, batches[i]);
        assert_memory_equal(found, expected, REALIZATIONS * grid.num * sizeof(double));
        free(found);
    }
    double *referee =
        test_run_engine(&ps_host_direct, PS_EXTENDED, NULL, &grid, patterns, REALIZATIONS, 1);
    for (size_t i = 0; i < REALIZATIONS * grid.num; i++) {
        const double allowed = 1e-4 * sqrt(sum_of_squares(&patterns[i / grid.num]));
        assert_true(fabs(sqrt(expected[i]) - sqrt(referee[i])) < allowed);
    }
    free(referee);
    free(expected);
    for (size_t r = 0; r < REALIZATIONS; r++) {
        free_pattern(&patterns[r]);
    }
    ps_frequencies_free(&grid);
}

static void batches_change_nothing(void **state) {
    (void)state;
    check_batches(PS_SINGLE, false);
    check_batches(PS_SINGLE, true);
    if (ps_device_get_limits(device)->has_fp64) {
        check_batches(PS_DOUBLE, true);
    }
}

/* White noise has mean power 1; the variance of one power is (N - 1) / N (mathematics.md 1.2). */
static void white_noise(void **state) {
    (void)state;
    enum { MANY = 64, POINTS = 64 };
    ps_frequencies grid = make_grid(16);
    pspec_pattern patterns[MANY];
    double sum = 0;
    for (size_t r = 0; r < MANY; r++) {
        patterns[r] = make_pattern(&shapes[0], POINTS, 1000 + r);
    }
    double *found =
        test_run_engine_to(&ps_torus_nufft, PS_SINGLE, 1e-4, device, &grid, patterns, MANY, MANY);
    for (size_t i = 0; i < MANY * grid.num; i++) {
        sum += found[i] / POINTS / (double)(MANY * grid.num);
    }
    const double deviation = 1 / sqrt((double)(MANY * grid.num));
    assert_true(fabs(sum - 1) < 4 * deviation);
    for (size_t r = 0; r < MANY; r++) {
        free_pattern(&patterns[r]);
    }
    free(found);
    ps_frequencies_free(&grid);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(white_noise),
        cmocka_unit_test(batches_change_nothing),
        cmocka_unit_test(single_precision),
        cmocka_unit_test(double_precision),
        cmocka_unit_test(sizes),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("torus_nufft", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
