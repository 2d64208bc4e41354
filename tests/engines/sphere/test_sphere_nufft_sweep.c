/* The error of sphere_nufft and of sphere_grid over all tolerances, eight to a decade, against what
 * it announces: sets of every kind, and circles of points made for the grid that is chosen. Prints
 * the smallest slack of each.
 */
#include "harness_sphere_shapes.h"

#include "engines/sphere/nufft/shape.h"
#include "engines/engine.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

static ps_device *device;
static const ps_engine *engine; /* of the test */

typedef struct sweep {
    ps_precision precision;
    int32_t max_degree;
    size_t num_points;
    double least_tolerance;
} sweep;

static const sweep sweeps[] = {
    {PS_SINGLE, 5, 100, 1e-6},   {PS_SINGLE, 24, 150, 1e-7},  {PS_SINGLE, 16, 5000, 1e-6},
    {PS_SINGLE, 250, 300, 1e-6}, {PS_DOUBLE, 20, 150, 1e-14}, {PS_DOUBLE, 33, 2000, 1e-13},
};

enum { NUM_SWEEPS = sizeof sweeps / sizeof sweeps[0], STEPS_PER_DECADE = 8 };

static ps_frequencies degrees_of(int32_t max_degree) {
    ps_frequencies set;
    assert_ok(ps_frequencies_degrees(&set, max_degree, false, error));
    assert_ok(ps_frequencies_enumerate(&set, error));
    return set;
}

/* What is announced over what is found, for the patterns of a problem. */
static void measure(const ps_problem *problem, ps_precision precision, size_t num,
                    const pspec_pattern *patterns, double *const *expected, double *slack) {
    const size_t L = (size_t)problem->frequencies->max_frequency;
    double *found = calloc((L + 1) * (L + 2), sizeof(double));
    void *state = NULL;
    assert_ok(ps_engine_create(engine, &state, problem, precision, 1, device, error));
    for (size_t i = 0; i < num; i++) {
        double power = 0;
        assert_ok(engine->coefficients(
            state, &(ps_batch){.num_patterns = 1, .patterns = &patterns[i]}, NULL, found, error));
        const double error =
            test_sphere_error(found, expected[i], (int32_t)L, 1, &patterns[i], &power);
        slack[i] = fmin(slack[i], engine->error_of_state(state, power, 0) / error);
    }
    ps_engine_destroy(engine, state);
    free(found);
}

static void sweep_shapes(const sweep *what, double *slack) {
    ps_frequencies set = degrees_of(what->max_degree);
    pspec_pattern patterns[TEST_SPHERE_SHAPES];
    double *expected[TEST_SPHERE_SHAPES];
    for (size_t s = 0; s < TEST_SPHERE_SHAPES; s++) {
        patterns[s] = test_make_sphere_pattern(&test_sphere_shapes[s], what->num_points, 11);
        expected[s] = test_sphere_coefficients(&patterns[s], what->max_degree, 1);
    }
    for (int i = 0; pow(10, -2 - i / (double)STEPS_PER_DECADE) > what->least_tolerance; i++) {
        const ps_problem problem = {.frequencies = &set,
                                    .num_points = what->num_points,
                                    .num_realizations = 1 + (uint64_t)i % 2, /* two kernels */
                                    .has_weights = true,
                                    .tolerance = pow(10, -2 - i / (double)STEPS_PER_DECADE)};
        measure(&problem, what->precision, TEST_SPHERE_SHAPES, patterns, expected, slack);
    }
    for (size_t s = 0; s < TEST_SPHERE_SHAPES; s++) {
        free(expected[s]);
        test_free_sphere_pattern(&patterns[s]);
    }
    ps_frequencies_free(&set);
}

static void every_tolerance(void **state) {
    engine = *state;
    for (size_t i = 0; i < NUM_SWEEPS; i++) {
        double slack[TEST_SPHERE_SHAPES];
        for (size_t s = 0; s < TEST_SPHERE_SHAPES; s++) {
            slack[s] = HUGE_VAL;
        }
        sweep_shapes(&sweeps[i], slack);
        print_message("%s %s L=%d N=%zu:\n", engine->name, ps_precision_name(sweeps[i].precision),
                      (int)sweeps[i].max_degree, sweeps[i].num_points);
        for (size_t s = 0; s < TEST_SPHERE_SHAPES; s++) {
            print_message("  %-15s %.3g\n", test_sphere_shapes[s].name, slack[s]);
            assert_true(slack[s] >= 1);
        }
    }
}

/* Circles of latitude of `around` points, at random or as far from each other as these. */
static pspec_pattern make_circles(size_t circles, size_t around, bool at_random) {
    double *points = calloc(circles * around, 3 * sizeof(double));
    uint64_t state = 5;
    double theta = 0;
    for (size_t i = 0; i < circles * around; i++) {
        const size_t circle = i / around;
        if (i % around == 0) {
            theta = at_random ? 2 * asin(sqrt(test_uniform(&state)))
                              : PS_TWO_PI * (double)circle / (double)around;
        }
        const double phi = PS_TWO_PI * (double)(i % around) / (double)around;
        points[3 * i] = sin(theta) * cos(phi);
        points[3 * i + 1] = sin(theta) * sin(phi);
        points[3 * i + 2] = cos(theta);
    }
    return (pspec_pattern){.num_points = circles * around, .points = points};
}

/* D = n - m points on a circle: all that they have at order 0 comes back at order m. */
static void circles_made_for_the_grid(void **state) {
    engine = *state;
    const ps_sphere_route route =
        engine == &ps_sphere_nufft ? PS_SPHERE_BY_RINGS : PS_SPHERE_BY_CELLS;
    enum { MAX_DEGREE = 24, CIRCLES = 5 };
    static const double tolerances[] = {1e-2, 1e-3, 1e-5};
    ps_frequencies set = degrees_of(MAX_DEGREE);
    double least = HUGE_VAL;
    for (size_t i = 0; i < 3 * (size_t)MAX_DEGREE; i++) {
        ps_problem problem = {.frequencies = &set,
                              .num_points = CIRCLES * 2 * MAX_DEGREE,
                              .num_realizations = 1,
                              .tolerance = tolerances[i % 3]};
        const ps_sphere_shape shape =
            ps_sphere_shape_make(&problem, ps_device_get_limits(device), PS_SINGLE, route);
        const size_t around = shape.axis.n - MAX_DEGREE + i / 3;
        const bool at_random = i / 3 % 2 == 0;
        pspec_pattern pattern = make_circles(at_random ? CIRCLES : around / 2, around, at_random);
        double *expected = test_sphere_coefficients(&pattern, MAX_DEGREE, 1);
        problem.num_points = pattern.num_points;
        measure(&problem, PS_SINGLE, 1, &pattern, &expected, &least);
        free(expected);
        test_free_sphere_pattern(&pattern);
    }
    print_message("%s circles: smallest slack %.3g\n", engine->name, least);
    assert_true(least >= 1);
    ps_frequencies_free(&set);
}

int main(void) {
    void *const nufft = (void *)(uintptr_t)&ps_sphere_nufft; /* cmocka's states are not constant */
    void *const grid = (void *)(uintptr_t)&ps_sphere_grid;
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(every_tolerance, nufft),
                                       cmocka_unit_test_prestate(circles_made_for_the_grid, nufft),
                                       cmocka_unit_test_prestate(every_tolerance, grid),
                                       cmocka_unit_test_prestate(circles_made_for_the_grid, grid)};
    device = test_open_device();
    if (!ps_device_get_limits(device)->has_fp64) {
        return TEST_SKIPPED;
    }
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    ps_device_close(device);
    return failed;
}
