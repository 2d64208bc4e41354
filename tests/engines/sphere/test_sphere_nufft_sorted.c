/* sphere_nufft on sets so large that points are sorted, spread in bands of longitudes and come in
 * chunks: copies of a small set, whose coefficients are known, in turn.
 */
#include "harness_sphere.h"
#include "harness_sphere_shapes.h"

#include "engines/sphere/nufft/shape.h"
#include "engines/engine.h"

#include <stdlib.h>
#include <string.h>

static ps_device *device;

/* More than a chunk, and a part that is not full. */
enum { DISTINCT = 330, COPIES = 3300, NUM_POINTS = DISTINCT * COPIES, DEGREE = 192 };

static ps_problem problem_of(const ps_frequencies *set, size_t num_points, double tolerance) {
    return (ps_problem){.frequencies = set,
                        .num_points = num_points,
                        .num_realizations = 2,
                        .has_weights = true,
                        .tolerance = tolerance};
}

static double *coefficients_of(const ps_problem *problem, ps_precision precision,
                               const pspec_pattern *pattern) {
    double *found = calloc((DEGREE + 1) * (DEGREE + 2), sizeof(double));
    void *state = NULL;
    assert_ok(ps_engine_create(&ps_sphere_nufft, &state, problem, precision, 1, device, error));
    assert_ok(ps_sphere_nufft.coefficients(
        state, &(ps_batch){.num_patterns = 1, .patterns = pattern}, NULL, found, error));
    ps_engine_destroy(&ps_sphere_nufft, state);
    return found;
}

/* Point i is point i modulo DISTINCT. Weights of copies are a half and one and a half in turn, if
 * there are any. */
static pspec_pattern make_copies(const pspec_pattern *small, bool has_weights) {
    double *points = malloc(sizeof(double) * 3 * NUM_POINTS);
    double *weights = has_weights ? malloc(sizeof(double) * NUM_POINTS) : NULL;
    for (size_t i = 0; i < NUM_POINTS; i++) {
        const size_t from = i % DISTINCT;
        memcpy(points + 3 * i, small->points + 3 * from, 3 * sizeof(double));
        if (has_weights) {
            weights[i] = (small->weights != NULL ? small->weights[from] : 1) *
                         (i / DISTINCT % 2 == 0 ? 0.5 : 1.5);
        }
    }
    return (pspec_pattern){
        .dimension = 3, .num_points = NUM_POINTS, .points = points, .weights = weights};
}

static void check(const test_sphere_shape *shape, ps_precision precision, double tolerance,
                  bool has_weights, ps_frequencies *set) {
    const ps_device_limits *limits = ps_device_get_limits(device);
    pspec_pattern small = test_make_sphere_pattern(shape, DISTINCT, 5);
    pspec_pattern large = make_copies(&small, has_weights || small.weights != NULL);
    const ps_problem of_small = problem_of(set, DISTINCT, 1e-13);
    const ps_problem of_large = problem_of(set, NUM_POINTS, tolerance);
    const ps_sphere_shape sizes =
        ps_sphere_shape_make(&of_large, limits, precision, PS_SPHERE_BY_RINGS);
    assert_true(sizes.is_sorted);
    assert_true(sizes.bands > 1);
    assert_true(sizes.most_points < NUM_POINTS);
    double *expected = coefficients_of(&of_small, PS_DOUBLE, &small);
    double *found = coefficients_of(&of_large, precision, &large);
    double power = 0;
    for (size_t i = 0; i < (DEGREE + 1) * (DEGREE + 2); i++) {
        expected[i] *= COPIES;
    }
    const double off = test_sphere_error(found, expected, DEGREE, 1, &large, &power);
    const double bound = test_engine_error(&ps_sphere_nufft, &of_large, precision, device, power);
    if (!(off <= bound)) {
        fail_msg("%s %s: error %.2e, bound %.2e", shape->name, ps_precision_name(precision), off,
                 bound);
    }
    free(found);
    free(expected);
    free((void *)large.points);
    free((void *)large.weights);
    test_free_sphere_pattern(&small);
}

static void copies_add_up(void **state) {
    (void)state;
    ps_frequencies set = {0};
    if (!ps_device_get_limits(device)->has_fp64) {
        return;
    }
    assert_ok(ps_frequencies_degrees(&set, DEGREE, false, error));
    assert_ok(ps_frequencies_enumerate(&set, error));
    for (size_t s = 0; s < TEST_SPHERE_SHAPES; s++) {
        check(&test_sphere_shapes[s], s % 2 == 0 ? PS_DOUBLE : PS_SINGLE, s % 2 == 0 ? 1e-10 : 1e-4,
              s % 3 == 0, &set);
    }
    ps_frequencies_free(&set);
}

/* Alone, in a batch, and by work-groups of several items, whether one is expected or several. */
static void check_bits(uint64_t num_expected) {
    enum { NUM = 100000 };
    static const size_t ways[][2] = {{2, 0}, {2, 32}};
    ps_frequencies set = {0};
    if (!ps_device_get_limits(device)->has_fp64) {
        return;
    }
    assert_ok(ps_frequencies_degrees(&set, DEGREE, false, error));
    assert_ok(ps_frequencies_enumerate(&set, error));
    pspec_pattern patterns[2] = {test_make_sphere_pattern(&test_sphere_shapes[0], NUM, 1),
                                 test_make_sphere_pattern(&test_sphere_shapes[1], NUM - 7, 2)};
    ps_problem problem = problem_of(&set, NUM, 1e-5);
    problem.num_realizations = num_expected;
    double *expected =
        test_run_problem(&ps_sphere_nufft, &problem, PS_SINGLE, device, patterns, 2, 1);
    for (size_t way = 0; way < sizeof ways / sizeof ways[0]; way++) {
        ps_device_set_group_size(device, ways[way][1]);
        double *found = test_run_problem(&ps_sphere_nufft, &problem, PS_SINGLE, device, patterns, 2,
                                         ways[way][0]);
        ps_device_set_group_size(device, 0);
        assert_memory_equal(found, expected, 2 * set.num * sizeof(double));
        free(found);
    }
    free(expected);
    test_free_sphere_pattern(&patterns[0]);
    test_free_sphere_pattern(&patterns[1]);
    ps_frequencies_free(&set);
}

static void same_bits(void **state) {
    (void)state;
    check_bits(2);
    check_bits(1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(copies_add_up),
        cmocka_unit_test(same_bits),
    };
    device = test_open_device();
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    ps_device_close(device);
    return failed;
}
