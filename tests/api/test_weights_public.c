/* Weights at the ends of the range of doubles through the public library: results that are numbers,
 * or PSPEC_ERROR_INPUT and a sentence with the limit. */
#include "harness_angular.h"
#include "harness_public.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { NUM = 3, DEGREES = 3, NUM_COEFFICIENTS = (DEGREES + 1) * (DEGREES + 2) };

static const double plane[] = {0.1, 0.35, 0.4, 0.6, 0.85, 0.3};
static const double sphere[] = {0.6, 0, 0.8, 0, 0, 1, -0.48, 0.64, 0.6};

static pspec_angular_request angular(pspec_normalization normalization) {
    pspec_angular_request request = PSPEC_ANGULAR_REQUEST_INIT;
    request.max_degree = DEGREES;
    request.engine = "host_direct";
    request.normalization = normalization;
    return request;
}

static void says(const pspec_context *context, const char *part) {
    if (strstr(pspec_context_message(context), part) == NULL) {
        fail_msg("\"%s\" is not in \"%s\"", part, pspec_context_message(context));
    }
}

static void check_finite(const pspec_spectrum *spectrum) {
    size_t num = 0;
    const pspec_bin *const bins = pspec_spectrum_bins(spectrum, &num);
    assert_true(num > 0);
    for (size_t b = 0; b < num; b++) {
        assert_true(isfinite(bins[b].power));
    }
}

/* Runs the plan, which is then gone. part: of the sentence, NULL where there is a result. */
static void check_plan(pspec_context *context, pspec_plan *plan, const pspec_pattern *pattern,
                       const char *part) {
    const pspec_status status = pspec_plan_run(plan, pattern, 1);
    assert_int_equal(status, part == NULL ? PSPEC_OK : PSPEC_ERROR_INPUT);
    if (part != NULL) {
        says(context, part);
    } else {
        pspec_spectrum *spectrum = NULL;
        assert_int_equal(pspec_spectrum_create(&spectrum, plan), PSPEC_OK);
        check_finite(spectrum);
        pspec_spectrum_destroy(spectrum);
    }
    pspec_plan_destroy(plan);
}

static void check_power(pspec_context *context, const double *weights,
                        pspec_normalization normalization, const char *part) {
    pspec_plan *plan = NULL;
    pspec_power_request request = test_host_request();
    const pspec_angular_request on_sphere = angular(normalization);
    const pspec_pattern points = {2, NUM, plane, weights}, vectors = {3, NUM, sphere, weights};
    request.normalization = normalization;
    assert_int_equal(pspec_plan_create(&plan, context, &request), PSPEC_OK);
    check_plan(context, plan, &points, part);
    assert_int_equal(pspec_plan_create_angular(&plan, context, &on_sphere), PSPEC_OK);
    check_plan(context, plan, &vectors, part);
}

static void check_pairs(pspec_context *context, const double *weights, const char *part) {
    pspec_plan *plan = NULL;
    pspec_quadrature *rule = NULL;
    const pspec_angular_request request = angular(PSPEC_NORMALIZATION_PAIRS);
    const pspec_pattern pattern = {3, NUM, sphere, weights};
    pspec_quadrature_request question = PSPEC_QUADRATURE_REQUEST_INIT;
    question.engine = "host_direct";
    question.max_degree = DEGREES;
    assert_int_equal(pspec_plan_create_angular(&plan, context, &request), PSPEC_OK);
    check_plan(context, plan, &pattern, part);
    assert_int_equal(pspec_quadrature_create(&rule, context, &question, &pattern, 1),
                     part == NULL ? PSPEC_OK : PSPEC_ERROR_INPUT);
    if (part != NULL) {
        says(context, part);
    } else {
        assert_true(isfinite(pspec_quadrature_error(rule)->squared.mean));
    }
    pspec_quadrature_destroy(rule);
}

static void results_or_sentences(void **state) {
    (void)state;
    static const char sum[] = "sum to more than 1e+290";
    static const char size[] = "is not between 1e-60 and 1e+60";
    static const char zero[] = "the weights sum to 0";
    static const char rounded[] = "the weights sum to 0 within rounding";
    static const char none[] = "all weights are 0";
    static const struct {
        double weights[NUM];
        const char *power, *effective, *pairs; /* NULL: a result */
    } cases[] = {{{1e160, 1e160, 2e160}, NULL, NULL, size},
                 {{1e-170, 1e-170, 2e-170}, NULL, NULL, size},
                 {{1e308, 1e308, 1.5e308}, sum, sum, size},
                 {{DBL_MAX, -DBL_MAX, DBL_MAX}, sum, sum, size},
                 {{DBL_TRUE_MIN, 2 * DBL_TRUE_MIN, 0}, NULL, NULL, size},
                 {{1e60, 1e-60, 1}, NULL, NULL, NULL},
                 {{1e-60, 1e-60, 1e-100}, NULL, NULL, NULL},
                 {{1, 1e-100, 0.5}, NULL, NULL, NULL},
                 {{1, -1, 0}, zero, NULL, NULL},
                 {{0.1, 0.2, -0.3}, rounded, NULL, NULL},
                 {{1, -1, 1e-10}, NULL, NULL, NULL},
                 {{0, 0, 0}, none, none, none},
                 {{1, INFINITY, 1}, "is not finite", "is not finite", "is not finite"}};
    pspec_context *const context = pspec_context_create();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        print_message("weights %g %g %g\n", cases[i].weights[0], cases[i].weights[1],
                      cases[i].weights[2]);
        check_power(context, cases[i].weights, PSPEC_NORMALIZATION_POWER, cases[i].power);
        check_power(context, cases[i].weights, PSPEC_NORMALIZATION_EFFECTIVE, cases[i].effective);
        check_pairs(context, cases[i].weights, cases[i].pairs);
    }
    pspec_context_destroy(context);
}

/* Weights as they are: the largest that are allowed make numbers, others a sentence. */
static void coefficients(void **state) {
    (void)state;
    static const double most[] = {3e289, -3e289, 3e289}, more[] = {1e308, 1e308, -1e308};
    const pspec_pattern good = {3, NUM, sphere, most}, bad = {3, NUM, sphere, more};
    const pspec_angular_request request = angular(PSPEC_NORMALIZATION_POWER);
    pspec_context *const context = pspec_context_create();
    pspec_plan *plan = NULL;
    double c[NUM_COEFFICIENTS];
    assert_int_equal(pspec_plan_create_angular(&plan, context, &request), PSPEC_OK);
    assert_int_equal(pspec_plan_coefficients(plan, &good, 0, c), PSPEC_OK);
    for (size_t i = 0; i < NUM_COEFFICIENTS; i++) {
        assert_true(isfinite(c[i]));
    }
    assert_int_equal(pspec_plan_coefficients(plan, &bad, 0, c), PSPEC_ERROR_INPUT);
    says(context, "sum to more than 1e+290");
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(results_or_sentences),
                                       cmocka_unit_test(coefficients)};
    return cmocka_run_group_tests_name("weights_public", tests, NULL, NULL);
}
