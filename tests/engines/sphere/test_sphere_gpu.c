/* Realizations of a batch on GPUs, whose sums work-groups of some of them share
 * (kernels/sphere/nufft/degrees.cl): each has the bits that it has alone, in batches that groups
 * divide, and do not, and the powers that it has on CPUs. The layout is that of a GPU on whatever
 * device there is. */
#include "harness_sphere.h"
#include "harness_sphere_shapes.h"

#include "engines/sphere/nufft/shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of L = 135 orders have up to five runs of degrees, and rings come in two blocks. */
enum { NUM_SETS = 11, NUM_POINTS = 23, LOW = 20, HIGH = 135 };

static ps_device *device;

static bool *is_gpu(void) {
    return &((ps_device_limits *)ps_device_get_limits(device))->has_dedicated_local_memory;
}

/* Powers of sets whose expected power is 1 are off by twice the tolerance where both errors are. */
static void check_powers(const ps_problem *problem, ps_precision precision,
                         const pspec_pattern *patterns, size_t num_sets, const double *found) {
    const size_t num = problem->frequencies->num;
    *is_gpu() = false;
    double *expected = test_run_problem(&ps_sphere_nufft, problem, precision, device, patterns,
                                        num_sets, num_sets);
    *is_gpu() = true;
    for (size_t i = 0; i < num_sets * num; i++) {
        assert_true(fabs(found[i] - expected[i]) <=
                    4 * problem->tolerance * sqrt(fmax(expected[i], 1) * (double)num));
    }
    free(expected);
}

static void check(ps_precision precision, int32_t degree, bool only_even,
                  const pspec_pattern *patterns) {
    static const size_t batches[] = {NUM_SETS, 8}; /* which is a group */
    ps_frequencies set = {0};
    assert_ok(ps_frequencies_degrees(&set, degree, only_even, error));
    assert_ok(ps_frequencies_enumerate(&set, error));
    ps_problem problem = {.frequencies = &set,
                          .num_points = NUM_POINTS,
                          .num_realizations = NUM_SETS,
                          .has_weights = true,
                          .tolerance = 1e-5};
    const ps_sphere_shape shape =
        ps_sphere_shape_make(&problem, ps_device_get_limits(device), precision, PS_SPHERE_ON_GPU);
    assert_int_equal(shape.at_once, NUM_SETS);
    double *alone =
        test_run_problem(&ps_sphere_nufft, &problem, precision, device, patterns, NUM_SETS, 1);
    for (size_t b = 0; b < sizeof batches / sizeof *batches; b++) {
        double *found = test_run_problem(&ps_sphere_nufft, &problem, precision, device, patterns,
                                         NUM_SETS, batches[b]);
        assert_memory_equal(found, alone, NUM_SETS * set.num * sizeof *found);
        free(found);
    }
    check_powers(&problem, precision, patterns, NUM_SETS, alone);
    problem.num_realizations = 1; /* expected: work-groups have one set each */
    double *only = test_run_problem(&ps_sphere_nufft, &problem, precision, device, patterns, 1, 1);
    assert_memory_equal(only, alone, set.num * sizeof *only);
    free(only);
    free(alone);
    ps_frequencies_free(&set);
}

static void sets_have_the_bits_that_they_have_alone(void **state) {
    pspec_pattern patterns[NUM_SETS];
    (void)state;
    if (!ps_device_get_limits(device)->has_fp64) {
        return;
    }
    for (unsigned i = 0; i < NUM_SETS; i++) {
        patterns[i] = test_make_sphere_pattern(&test_sphere_shapes[i % 2], NUM_POINTS, i);
    }
    for (int precision = PS_SINGLE; precision <= PS_DOUBLE; precision++) {
        check((ps_precision)precision, HIGH, false, patterns);
        check((ps_precision)precision, LOW, true, patterns);
    }
    for (unsigned i = 0; i < NUM_SETS; i++) {
        test_free_sphere_pattern(&patterns[i]);
    }
}

/* The last chunk is short. */
static void large_sets_come_in_chunks(void **state) {
    enum { MANY_POINTS = (1 << 21) + 77, FEW_DEGREES = 5 };
    ps_frequencies set = {0};
    (void)state;
    if (!ps_device_get_limits(device)->has_fp64) {
        return;
    }
    assert_ok(ps_frequencies_degrees(&set, FEW_DEGREES, false, error));
    assert_ok(ps_frequencies_enumerate(&set, error));
    const ps_problem problem = {
        .frequencies = &set, .num_points = MANY_POINTS, .num_realizations = 1, .tolerance = 1e-6};
    pspec_pattern pattern =
        test_make_sphere_pattern(&test_sphere_shapes[TEST_SPHERE_WHITE], MANY_POINTS, 4);
    double *found = test_run_problem(&ps_sphere_nufft, &problem, PS_DOUBLE, device, &pattern, 1, 1);
    check_powers(&problem, PS_DOUBLE, &pattern, 1, found);
    test_free_sphere_pattern(&pattern);
    ps_frequencies_free(&set);
    free(found);
}

/* Of degrees that the grid has no room for. */
static void high_degrees_are_refused(void **state) {
    static const int32_t degrees[] = {4000, 8192, 9000, 11519, 20000, 32768};
    (void)state;
    for (size_t i = 0; i < sizeof degrees / sizeof *degrees; i++) {
        for (int precision = PS_SINGLE; precision <= PS_DOUBLE; precision++) {
            ps_frequencies set = {0};
            assert_ok(ps_frequencies_degrees(&set, degrees[i], false, error));
            const ps_problem problem = {.frequencies = &set,
                                        .num_points = 5000000,
                                        .num_realizations = 1,
                                        .tolerance = 1e-6};
            const ps_survey survey = ps_sphere_nufft.survey(&problem, ps_device_get_limits(device),
                                                            (ps_precision)precision);
            assert_true(survey.why_not != NULL || survey.work.fixed_bytes > 0);
            assert_true(survey.why_not != NULL || degrees[i] < 20000);
            ps_frequencies_free(&set);
        }
    }
}

/* The variant is that of the points that were planned: bits do not change with a longer set. */
static void growth_keeps_the_variant(void **state) {
    ps_frequencies set = {0};
    (void)state;
    assert_ok(ps_frequencies_degrees(&set, LOW, false, error));
    ps_problem problem = {.frequencies = &set,
                          .num_points = 1 << 21,
                          .planned_points = 1 << 21,
                          .num_realizations = 2,
                          .tolerance = 1e-6};
    const ps_device_limits *const limits = ps_device_get_limits(device);
    const ps_sphere_shape planned =
        ps_sphere_shape_make(&problem, limits, PS_DOUBLE, PS_SPHERE_ON_GPU);
    problem.num_points = (1 << 21) + 5;
    const ps_sphere_shape grown =
        ps_sphere_shape_make(&problem, limits, PS_DOUBLE, PS_SPHERE_ON_GPU);
    assert_ptr_equal(planned.plane.choice.variant, grown.plane.choice.variant);
    assert_int_equal(planned.axis.n, grown.axis.n);
    assert_true(grown.plane.part_points >= problem.num_points);
    ps_frequencies_free(&set);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(high_degrees_are_refused),
        cmocka_unit_test(growth_keeps_the_variant),
        cmocka_unit_test(large_sets_come_in_chunks),
        cmocka_unit_test(sets_have_the_bits_that_they_have_alone),
    };
    device = test_open_device();
    *is_gpu() = true;
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    ps_device_close(device);
    return failed;
}
