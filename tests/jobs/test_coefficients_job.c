/* Coefficients beside a spectrum: of the same sums, to the bit; stopped like it; within the memory
 * that was planned. What the numbers are is tested in test_coefficients.c and
 * test_sphere_reference.c.
 */
#include "harness_estimator.h"
#include "harness_sphere_shapes.h"

#include "engines/host/host_direct.h"
#include "engines/engine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NUM_POINTS = 700, MAX_DEGREE = 40 };

typedef struct job_case {
    const ps_engine *engine;
    ps_precision precision;
    bool only_even;
    ps_harmonics harmonics;
} job_case;

static const job_case cases[] = {
    {&ps_host_direct, PS_EXTENDED, false, PS_SPHERICAL_HARMONICS},
    {&ps_host_direct, PS_EXTENDED, true, PS_SPHERICAL_HARMONICS},
    {&ps_sphere_direct, PS_SINGLE, false, PS_SPHERICAL_HARMONICS},
    {&ps_sphere_direct, PS_DOUBLE, true, PS_SPHERICAL_HARMONICS},
    {&ps_sphere_direct, PS_DOUBLE, false, PS_HEMISPHERICAL_HARMONICS},
    {&ps_sphere_nufft, PS_SINGLE, false, PS_SPHERICAL_HARMONICS},
    {&ps_sphere_grid, PS_DOUBLE, false, PS_SPHERICAL_HARMONICS},
    {&ps_sphere_grid, PS_SINGLE, true, PS_SPHERICAL_HARMONICS},
    {&ps_sphere_nufft, PS_DOUBLE, true, PS_SPHERICAL_HARMONICS},
    {&ps_sphere_nufft, PS_DOUBLE, false, PS_HEMISPHERICAL_HARMONICS},
};
enum { NUM_CASES = sizeof cases / sizeof cases[0] };

static ps_device *device;

static ps_frequencies make_degrees(const job_case *what) {
    ps_frequencies degrees = {0};
    assert_ok(ps_frequencies_degrees(&degrees, MAX_DEGREE, what->only_even, error));
    assert_ok(ps_frequencies_enumerate(&degrees, error));
    return degrees;
}

/* On the upper half; weights of any size and sign. */
static pspec_pattern make_pattern(void) {
    pspec_pattern pattern =
        test_make_sphere_pattern(&test_sphere_shapes[TEST_SPHERE_WHITE], NUM_POINTS, 3);
    double *points = (double *)pattern.points;
    double *weights = calloc(NUM_POINTS, sizeof *weights);
    assert_non_null(weights);
    for (size_t j = 0; j < NUM_POINTS; j++) {
        points[3 * j + 2] = points[3 * j + 2] < 0 ? -points[3 * j + 2] : points[3 * j + 2];
        weights[j] = 1e100 * ((double)(j % 17) - 5);
    }
    free((double *)pattern.weights);
    pattern.dimension = PS_SPHERE_DIMENSION;
    pattern.weights = weights;
    return pattern;
}

static void free_pattern(pspec_pattern *pattern) {
    free((double *)pattern->weights); /* which are a block of their own here */
    test_free_sphere_pattern(pattern);
}

static ps_estimator *make_estimator(const job_case *what, const ps_frequencies *degrees,
                                    double *coefficients, bool (*should_stop)(void *)) {
    ps_estimator *estimator = NULL;
    ps_estimator_options options =
        test_make_options(degrees, what->engine, what->precision, NUM_POINTS, 1);
    options.problem.has_weights = true;
    options.problem.harmonics = coefficients != NULL ? what->harmonics : PS_NO_HARMONICS;
    options.coefficients = coefficients;
    options.should_stop = should_stop;
    assert_ok(ps_estimator_create(&estimator, &options, device, error));
    return estimator;
}

static ps_spectrum take_spectrum(ps_estimator *estimator, const pspec_pattern *pattern) {
    ps_spectrum spectrum;
    assert_ok(ps_estimator_add(estimator, pattern, 1, error));
    assert_ok(ps_estimator_spectrum(estimator, &spectrum, error));
    return spectrum;
}

/* With or without the other, each has the same bits. */
static void one_go(void **state) {
    (void)state;
    const size_t num = ps_num_coefficients(MAX_DEGREE);
    pspec_pattern pattern = make_pattern();
    for (size_t i = 0; i < NUM_CASES; i++) {
        ps_frequencies degrees = make_degrees(&cases[i]);
        double *beside = calloc(num, sizeof *beside);
        double *alone = calloc(num, sizeof *alone);
        ps_estimator *plain = make_estimator(&cases[i], &degrees, NULL, NULL);
        ps_estimator *both = make_estimator(&cases[i], &degrees, beside, NULL);
        ps_spectrum expected = take_spectrum(plain, &pattern);
        ps_spectrum found = take_spectrum(both, &pattern);
        assert_true(test_is_same_bits(&expected, &found));
        assert_ok(ps_estimator_coefficients(plain, &pattern, cases[i].harmonics, alone, error));
        assert_memory_equal(alone, beside, num * sizeof *alone);
        assert_true(beside[0] > 1e100); /* the sum of the weights, as they are */
        ps_spectrum_free(&expected);
        ps_spectrum_free(&found);
        ps_estimator_destroy(plain);
        ps_estimator_destroy(both);
        ps_frequencies_free(&degrees);
        free(beside);
        free(alone);
    }
    free_pattern(&pattern);
}

static bool stop_at_once(void *payload) {
    (void)payload;
    return true;
}

static void stop(void **state) {
    (void)state;
    double *out = calloc(ps_num_coefficients(MAX_DEGREE), sizeof *out);
    pspec_pattern pattern = make_pattern();
    for (size_t i = 0; i < NUM_CASES; i++) {
        ps_error error = {0};
        ps_frequencies degrees = make_degrees(&cases[i]);
        ps_estimator *estimator = make_estimator(&cases[i], &degrees, NULL, stop_at_once);
        assert_int_equal(
            ps_estimator_coefficients(estimator, &pattern, cases[i].harmonics, out, &error),
            PSPEC_ERROR_CANCELLED);
        ps_estimator_destroy(estimator);
        ps_frequencies_free(&degrees);
    }
    free_pattern(&pattern);
    free(out);
}

/* ---- memory ------------------------------------------------------------------------------ */

static void make_plan(ps_plan *plan, const ps_frequencies *degrees, const char *engine,
                      ps_harmonics harmonics, uint64_t memory_limit) {
    const ps_plan_constraints constraints = {
        .engine = engine, .precision = -1, .memory_limit = memory_limit};
    const ps_problem problem = {.frequencies = degrees,
                                .num_points = NUM_POINTS,
                                .num_realizations = 1,
                                .tolerance = 1e-6,
                                .harmonics = harmonics};
    assert_ok(ps_plan_make(plan, &problem, ps_device_get_limits(device), &constraints, error));
    if (plan->chosen == NULL) {
        ps_error error = {0};
        char expected[64];
        assert_int_equal(ps_plan_require(plan, &problem, &error), PSPEC_ERROR_MEMORY);
        snprintf(expected, sizeof expected,
                 "the largest degree that fits, with coefficients, is %d",
                 (int)plan->largest_degree);
        assert_non_null(strstr(error.message, expected));
    }
}

/* Degree that is said to fit does, and the next one does not. */
static void refusal(void **state) {
    (void)state;
    enum { LARGE = 3000 };
    const uint64_t limit = 40000000;
    static const char *const engines[] = {NULL, "sphere_direct"};
    for (size_t i = 0; i < sizeof engines / sizeof engines[0]; i++) {
        ps_frequencies degrees = {0};
        ps_plan plan;
        assert_ok(ps_frequencies_degrees(&degrees, LARGE, false, error));
        make_plan(&plan, &degrees, engines[i], PS_SPHERICAL_HARMONICS, limit);
        assert_null(plan.chosen);
        const int32_t largest = plan.largest_degree;
        assert_true(largest > 100 && largest < LARGE);
        for (int32_t more = 0; more < 2; more++) {
            assert_ok(ps_frequencies_degrees(&degrees, largest + more, false, error));
            make_plan(&plan, &degrees, engines[i], PS_SPHERICAL_HARMONICS, limit);
            assert_true((plan.chosen != NULL) == (more == 0));
        }
        if (engines[i] == NULL) { /* alone, the spectrum fits */
            assert_ok(ps_frequencies_degrees(&degrees, LARGE, false, error));
            make_plan(&plan, &degrees, NULL, PS_NO_HARMONICS, limit);
            assert_non_null(plan.chosen);
        }
    }
}

/* Buffers of the device that coefficients add are announced. */
static void memory_is_announced(void **state) {
    (void)state;
    enum { DEGREE = 400 };
    static const char *const engines[] = {"sphere_direct", "sphere_nufft"};
    double *out = calloc(ps_num_coefficients(DEGREE), sizeof *out);
    pspec_pattern pattern = make_pattern();
    ps_frequencies degrees = {0};
    assert_ok(ps_frequencies_degrees(&degrees, DEGREE, false, error));
    assert_ok(ps_frequencies_enumerate(&degrees, error));
    for (size_t i = 0; i < sizeof engines / sizeof engines[0]; i++) {
        ps_device *own = test_open_device();
        ps_estimator *estimator = NULL;
        ps_plan plan;
        make_plan(&plan, &degrees, engines[i], PS_SPHERICAL_HARMONICS, 0);
        ps_estimator_options options = test_make_options(
            &degrees, plan.chosen->engine, plan.chosen->precision, NUM_POINTS, plan.chosen->batch);
        options.problem.tolerance = 1e-6;
        options.problem.harmonics = PS_SPHERICAL_HARMONICS;
        options.coefficients = out;
        options.self_check = false;
        assert_ok(ps_estimator_create(&estimator, &options, own, error));
        assert_ok(ps_estimator_add(estimator, &pattern, 1, error));
        ps_estimator_destroy(estimator);
        const double there = (double)ps_device_most_buffer_bytes(own);
        print_message("%s: %.3g bytes announced, %.3g there\n", engines[i],
                      plan.chosen->device_bytes, there);
        assert_true(plan.chosen->device_bytes > 0.9 * there);
        assert_true(plan.chosen->device_bytes < 1.1 * there);
        ps_device_close(own);
    }
    ps_frequencies_free(&degrees);
    free_pattern(&pattern);
    free(out);
}

int main(void) {
    device = test_open_device();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_go),
        cmocka_unit_test(stop),
        cmocka_unit_test(refusal),
        cmocka_unit_test(memory_is_announced),
    };
    const int failed = cmocka_run_group_tests_name("coefficients of a job", tests, NULL, NULL);
    ps_device_close(device);
    return failed;
}
