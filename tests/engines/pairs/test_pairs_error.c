/* The error formulas of pair sums hold, by every route: point sets of every kind against long
 * double sums over pairs, degree by degree.
 */
#include "harness_pairs.h"
#include "harness_sphere_shapes.h"

#include "engines/error_units.h"
#include "engines/engine.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

static ps_device *device;

static void near_pole(double *u, uint64_t *state) {
    test_sphere_point(u, 0.02 * sqrt(test_uniform(state)), PS_TWO_PI * test_uniform(state), 1);
}

/* So near that P_l is near 1 for all degrees, or for most. */
static void very_near(double *u, uint64_t *state) {
    test_sphere_point(u, 1 + 1e-5 * test_uniform(state), 2 + 1e-5 * test_uniform(state), 1);
}

static void rather_near(double *u, uint64_t *state) {
    test_sphere_point(u, 1 + 1e-4 * test_uniform(state), 2 + 1e-4 * test_uniform(state), 1);
}

/* On one line through the centre, but for roundings. */
static void antipodes(double *u, uint64_t *state) {
    test_sphere_point(u, 1.234, 3.456, 1);
    const double side = test_uniform(state) < 0.5 ? -1 : 1;
    for (int axis = 0; axis < PS_SPHERE_DIMENSION; axis++) {
        u[axis] *= side;
    }
}

/* All pairs at right angles or on a line. */
static void axes(double *u, uint64_t *state) {
    const double choice = 6 * test_uniform(state);
    u[0] = u[1] = u[2] = 0;
    u[(int)choice % 3] = choice < 3 ? 1 : -1;
}

static double sign(uint64_t *state) {
    return test_uniform(state) < 0.5 ? -1 : 1;
}

/* Sums of it are rounded. */
static double one_weight(uint64_t *state) {
    (void)state;
    return 0.7;
}

static const test_point_shape shapes[] = {
    {"white", test_sphere_white, NULL},
    {"near pole", near_pole, NULL},
    {"clustered", test_sphere_clustered, NULL},
    {"antipodes", antipodes, NULL},
    {"axes", axes, NULL},
    {"wild weights", test_sphere_white, test_wild_weight},
    {"signs", test_sphere_white, sign},
    {"within 1e-5", very_near, NULL},
    {"within 1e-4", rather_near, NULL},
    {"one weight", antipodes, one_weight},
    {"one distance", axes, one_weight},
};

/* Engines that work as exactly as asked twice: as usual, and as exactly as they can. */
static const struct {
    const ps_engine *engine;
    double tolerance[2]; /* by precision */
} routes[] = {{&ps_pairs_direct, {1e-4, 1e-11}},    {&ps_pairs_histogram, {1e-4, 1e-11}},
              {&ps_pairs_histogram, {1e-8, 1e-17}}, {&ps_sphere_direct, {1e-4, 1e-11}},
              {&ps_sphere_nufft, {1e-4, 1e-11}},    {&ps_sphere_grid, {1e-4, 1e-11}}};

static double formula_of(const ps_engine *engine, ps_precision precision, double tolerance,
                         const pspec_pattern *pattern, int32_t max_degree, double power,
                         double share) {
    ps_frequencies degrees = test_degrees(max_degree, false);
    const ps_problem asked = {.frequencies = &degrees,
                              .num_points = pattern->num_points,
                              .num_realizations = 1,
                              .has_weights = true,
                              .measure = PS_OF_PAIR_SUMS,
                              .weight_share = share,
                              .tolerance = tolerance};
    const ps_problem own = ps_engine_problem(engine, &asked);
    const double error = ps_engine_error_in(
        engine, &asked, test_engine_error(engine, &own, precision, device, power));
    ps_frequencies_free(&degrees);
    return error;
}

/* Mean of Q(l) / V over all degrees and orders. */
static double mean_power(const pspec_pattern *pattern, int32_t max_degree, double squares) {
    long double *exact = test_pair_sums(pattern, max_degree);
    double sum = 0;
    for (int32_t l = 1; l <= max_degree; l++) {
        sum += (2 * l + 1) * (double)exact[l] / squares;
    }
    free(exact);
    return sum / ((double)max_degree * (max_degree + 2.0));
}

/* sphere_grid has no room for a table of many degrees. */
static bool is_possible(const ps_engine *engine, ps_precision precision, double tolerance,
                        size_t num, int32_t max_degree) {
    ps_frequencies degrees = test_degrees(max_degree, false);
    const ps_problem asked = {.frequencies = &degrees,
                              .num_points = num,
                              .num_realizations = 1,
                              .measure = PS_OF_PAIR_SUMS,
                              .tolerance = tolerance};
    const ps_problem own = ps_engine_problem(engine, &asked);
    const bool result =
        engine->survey(&own, ps_device_get_limits(device), precision).why_not == NULL;
    ps_frequencies_free(&degrees);
    return result || engine != &ps_sphere_grid;
}

static void check(const ps_engine *engine, ps_precision precision, double tolerance,
                  const test_point_shape *shape, size_t num, int32_t max_degree) {
    double squares = 0;
    if (!is_possible(engine, precision, tolerance, num, max_degree)) {
        return;
    }
    pspec_pattern pattern = test_draw_sphere_pattern(shape, num, 7 + num, &squares);
    const double sizes = test_weight_sizes(&pattern);
    const double error =
        test_pairs_error(engine, precision, tolerance, device, max_degree, &pattern);
    const double formula =
        formula_of(engine, precision, tolerance, &pattern, max_degree,
                   mean_power(&pattern, max_degree, squares), squares / (sizes * sizes));
    print_message("%-15s %-7s %-12s N %4zu L %5d error %9.3g formula %9.3g slack %7.2f\n",
                  engine->name, ps_precision_name(precision), shape->name, num, max_degree, error,
                  formula, formula / error);
    assert_true(error <= formula);
    test_free_sphere_pattern(&pattern);
}

static void sweep(ps_precision precision) {
    static const struct {
        size_t num;
        int32_t max_degree;
    } sizes[] = {{2, 1}, {2, 300}, {3, 2000}, {17, 64}, {80, 500}, {200, 40}};
    test_need_precision(device, precision);
    for (size_t e = 0; e < sizeof routes / sizeof routes[0]; e++) {
        for (size_t s = 0; s < sizeof shapes / sizeof shapes[0]; s++) {
            for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
                check(routes[e].engine, precision, routes[e].tolerance[precision], &shapes[s],
                      sizes[i].num, sizes[i].max_degree);
            }
        }
    }
}

static void single(void **state) {
    (void)state;
    sweep(PS_SINGLE);
}

static void double_precision(void **state) {
    (void)state;
    sweep(PS_DOUBLE);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(single),
                                       cmocka_unit_test(double_precision)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("pairs_error", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
