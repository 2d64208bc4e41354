/* Kernel interpolation through the public library: laws of reproducing kernels, either way of
 * solving, and nonsense. */
#include "harness_public.h"

#include "math/pi.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NUM = 60, TESTS = 40 };
static uint64_t seed = 9;

static double kernel(double s, const double *u, const double *v) {
    const double x = u[0] - v[0], y = u[1] - v[1], z = u[2] - v[2];
    return pow(2, 2 * s - 1) / s - pow(x * x + y * y + z * z, s - 1);
}

static void make_points(size_t num, double *points) {
    for (size_t j = 0; j < num; j++) {
        const double z = 2 * test_uniform(&seed) - 1, phi = PS_TWO_PI * test_uniform(&seed);
        points[3 * j] = sqrt(1 - z * z) * cos(phi);
        points[3 * j + 1] = sqrt(1 - z * z) * sin(phi);
        points[3 * j + 2] = z;
    }
}

/* f = 3 K(., a) - 2 K(., b): with a and b among the points f^ is f, and |f|^2 = 9 c - 12 K(a, b) +
 * 4 c. */
static void known_functions(void **state) {
    static const uint64_t limits[] = {0, 1}; /* of memory: Cholesky, conjugate gradients */
    double points[3 * NUM], at[3 * TESTS], values[NUM];
    (void)state;
    make_points(NUM, points);
    make_points(TESTS, at);
    const double *const a = points, *const b = points + 3;
    for (double s = 1.1; s < 2; s += 0.4) {
        for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
            pspec_context *context = pspec_context_create();
            pspec_answer *answer = NULL;
            pspec_context_set_memory_limit(context, limits[i]);
            for (size_t j = 0; j < NUM; j++) {
                values[j] = 3 * kernel(s, points + 3 * j, a) - 2 * kernel(s, points + 3 * j, b);
            }
            memcpy(at, b, 3 * sizeof *at); /* at a point there is no error */
            assert_int_equal(
                pspec_interpolate(&answer, context, NUM, points, values, s, TESTS, at, 1),
                PSPEC_OK);
            const double *const found = test_public_numbers(answer, "value");
            const double *const bounds = test_public_numbers(answer, "bound");
            const double c = kernel(s, a, a);
            for (size_t j = 0; j < TESTS; j++) {
                const double f = 3 * kernel(s, at + 3 * j, a) - 2 * kernel(s, at + 3 * j, b);
                assert_true(fabs(found[j] - f) <= 1e-11);
                assert_true(j == 0 ? bounds[j] <= 1e-5 : bounds[j] > 1e-3 && bounds[j] < sqrt(c));
            }
            const double norm = sqrt(13 * c - 12 * kernel(s, a, b));
            assert_true(fabs(*test_public_numbers(answer, "norm") - norm) <= 1e-9);
            assert_true(*test_public_numbers(answer, "condition") > 1);
            pspec_answer_destroy(answer);
            pspec_context_destroy(context);
        }
    }
}

/* Other values: met at the points, and a function of H^s, K(., v) with v not among them, is within
 * its bound. */
static void bounds_hold(void **state) {
    double points[3 * NUM], at[3 * TESTS], values[NUM];
    const double s = 1.5, v[3] = {0.6, 0, 0.8};
    pspec_context *context = pspec_context_create();
    pspec_answer *answer = NULL;
    double worst = 0;
    (void)state;
    make_points(NUM, points);
    make_points(TESTS, at);
    memcpy(points + 3 * (NUM - 1), points, 3 * sizeof *points); /* a duplicate */
    for (size_t j = 0; j < NUM; j++) {
        values[j] = kernel(s, points + 3 * j, v);
    }
    assert_int_equal(pspec_interpolate(&answer, context, NUM, points, values, s, NUM, points, 0),
                     PSPEC_OK);
    for (size_t j = 0; j < NUM; j++) {
        assert_true(fabs(test_public_numbers(answer, "value")[j] - values[j]) <= 1e-12);
    }
    assert_null(pspec_answer_find(answer, "bound"));
    pspec_answer_destroy(answer);
    assert_int_equal(pspec_interpolate(&answer, context, NUM, points, values, s, TESTS, at, 1),
                     PSPEC_OK);
    const double norm = sqrt(kernel(s, v, v));
    assert_true(*test_public_numbers(answer, "norm") < norm);
    for (size_t j = 0; j < TESTS; j++) {
        const double error =
            fabs(test_public_numbers(answer, "value")[j] - kernel(s, at + 3 * j, v));
        worst = fmax(worst, error / (test_public_numbers(answer, "bound")[j] * norm));
    }
    print_message("errors are at most %.2g of their bounds\n", worst);
    assert_true(worst <= 1 && worst > 1e-3);
    pspec_answer_destroy(answer);
    pspec_context_destroy(context);
}

static int stop(const pspec_progress_report *report, void *payload) {
    (void)report, (void)payload;
    return 1;
}

static void nonsense(void **state) {
    const double near[6] = {0, 0, 1, 1e-9, 0, 1}, values[2] = {1, 2}, bad[2] = {1, NAN};
    const double length[3] = {0, 0, 2};
    const struct {
        size_t num;
        const double *points, *values;
        double s;
        pspec_status status;
        const char *says;
    } cases[] = {
        {2, near, values, 1.9, PSPEC_ERROR_INPUT, "1e-09 from each other"},
        {2, near, bad, 1.5, PSPEC_ERROR_INPUT, "value 2 is nan"},
        {1, length, values, 1.5, PSPEC_ERROR_INPUT, "point 1"},
        {0, near, values, 1.5, PSPEC_ERROR_INVALID_ARGUMENT, "at least one point"},
        {2, near, values, 2, PSPEC_ERROR_INVALID_ARGUMENT, "is not between 1 and 2"},
    };
    pspec_context *context = pspec_context_create();
    pspec_answer *answer = NULL;
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        test_public_refused(context,
                            pspec_interpolate(&answer, context, cases[i].num, cases[i].points,
                                              cases[i].values, cases[i].s, 1, near, 0),
                            cases[i].status, cases[i].says);
        assert_null(answer);
    }
    pspec_context_set_memory_limit(context, 1);
    pspec_context_set_progress(context, stop, NULL);
    assert_int_equal(pspec_interpolate(&answer, context, 2, near, values, 1.1, 1, near, 0),
                     PSPEC_ERROR_CANCELLED);
    pspec_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(known_functions),
                                       cmocka_unit_test(bounds_hold), cmocka_unit_test(nonsense)};
    return cmocka_run_group_tests_name("interpolant", tests, NULL, NULL);
}
