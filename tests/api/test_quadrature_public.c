/* Quadrature, truncation and C_l^2 through the public library, against closed forms, the job behind
 * the program, and themselves. */
#include "harness_angular.h"
#include "harness_quadrature.h"

#include "math/pi.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static pspec_quadrature_request make_request(void) {
    pspec_quadrature_request request = PSPEC_QUADRATURE_REQUEST_INIT;
    request.engine = "host_direct"; /* needs no device and has every digit */
    return request;
}

static pspec_quadrature *analyse(pspec_context *context, const pspec_quadrature_request *request,
                                 const pspec_pattern *patterns, size_t num) {
    pspec_quadrature *out = NULL;
    if (pspec_quadrature_create(&out, context, request, patterns, num) != PSPEC_OK) {
        fail_msg("%s", pspec_context_message(context));
    }
    return out;
}

/* One point at the pole: c_l0 = Y_l0(pole), C_l = 0, and E of
 * docs/mathematics/quadrature.md#worst-case-error in closed form. */
static void one_point(void **state) {
    (void)state;
    static const double pole[] = {0, 0, 1};
    pspec_context *context = pspec_context_create();
    pspec_quadrature_request request = make_request();
    request.max_degree = 10;
    const pspec_pattern pattern = {3, 1, pole, NULL};
    pspec_quadrature *q = analyse(context, &request, &pattern, 1);
    const pspec_worst_case_error *e = pspec_quadrature_error(q);
    /* 2 D(pole) - D_0, D(pole) = 2^s / (s (s + 1)) */
    const double squared = 2 * pow(2, 1.5) / (1.5 * 2.5) - 0.965775773191709;
    test_assert_near(e->squared.mean, squared, 1e-12);
    test_assert_near(e->squared.mean, e->zonal.mean + e->anisotropic.mean + e->tail.mean, 1e-14);
    assert_true(e->tail.mean > 0 && e->tail.mean <= e->tail_bound);
    assert_true(isnan(e->squared.standard_error) && isnan(e->condition));
    assert_true(e->num_realizations == 1 && e->weight_sum.mean == 1 && e->num_dropped == 0);
    size_t num = 0;
    const pspec_quadrature_degree *degrees = pspec_quadrature_degrees(q, &num);
    assert_int_equal(num, 11);
    double b[11];
    assert_int_equal(pspec_brdf_coefficients(context, "diffuse", 0, 10, b), PSPEC_OK);
    for (int l = 0; l <= 10; l++) {
        const double d = b[l] - sqrt((2 * l + 1) / PS_FOUR_PI);
        assert_int_equal(degrees[l].degree, l);
        assert_true(degrees[l].b == b[l]);
        test_assert_near(degrees[l].d2.mean, d * d, 1e-14);
        test_assert_near(degrees[l].c2.mean, 0, 1e-30);
        test_assert_near(degrees[l].e2.mean, degrees[l].a * d * d, 1e-13);
    }
    assert_non_null(strstr(pspec_quadrature_text(q), "host_direct"));
    pspec_quadrature_destroy(q);
    pspec_context_destroy(context);
}

/* Means over realizations are means of the single ones, and weights 1/N those without weights. */
static void realizations(void **state) {
    enum { SETS = 3, NUM = 20 };
    (void)state;
    pspec_context *context = pspec_context_create();
    pspec_quadrature_request request = make_request();
    request.brdf = "glossy:n=5,cut=none";
    request.max_degree = 8;
    double *vectors = test_make_vectors(SETS * NUM, 5);
    double weights[NUM];
    pspec_pattern patterns[SETS];
    double squared = 0;
    double c2 = 0;
    for (size_t j = 0; j < NUM; j++) {
        weights[j] = 1.0 / NUM;
    }
    for (size_t i = 0; i < SETS; i++) {
        patterns[i] = (pspec_pattern){3, NUM, vectors + 3 * NUM * i, i == 1 ? weights : NULL};
        pspec_quadrature *one = analyse(context, &request, &patterns[i], 1);
        size_t num = 0;
        squared += pspec_quadrature_error(one)->squared.mean / SETS;
        c2 += pspec_quadrature_degrees(one, &num)[8].c2.mean / SETS;
        pspec_quadrature_destroy(one);
    }
    pspec_quadrature *all = analyse(context, &request, patterns, SETS);
    size_t num = 0;
    test_assert_near(pspec_quadrature_error(all)->squared.mean, squared, 1e-14);
    test_assert_near(pspec_quadrature_degrees(all, &num)[8].c2.mean, c2, 1e-13);
    assert_true(pspec_quadrature_error(all)->squared.standard_error > 0);
    assert_true(pspec_quadrature_error(all)->num_realizations == SETS);
    pspec_quadrature_destroy(all);
    free(vectors);
    pspec_context_destroy(context);
}

/* Optimal weights make E smaller; two equal points are one; the rest below the horizon is left out
 * on demand. */
static void weights(void **state) {
    (void)state;
    static const double points[] = {0, 0, 1, 0, 0, 1, 0.6, 0, 0.8, 0, -0.8, 0.6, 0, 0.6, -0.8};
    pspec_context *context = pspec_context_create();
    pspec_quadrature_request request = make_request();
    request.max_degree = 4;
    request.drop_below_horizon = 1;
    const pspec_pattern pattern = {3, 5, points, NULL};
    pspec_quadrature *equal = analyse(context, &request, &pattern, 1);
    request.optimal_weights = 1;
    pspec_quadrature *best = analyse(context, &request, &pattern, 1);
    const pspec_worst_case_error *e = pspec_quadrature_error(best);
    assert_true(e->squared.mean < pspec_quadrature_error(equal)->squared.mean);
    assert_true(e->num_dropped == 1 && e->num_duplicates == 1 && e->condition > 1);
    assert_false(e->is_ill_conditioned);
    pspec_quadrature_destroy(equal);
    pspec_quadrature_destroy(best);
    pspec_context_destroy(context);
}

/* Weights that were kept are those of the answer: given back with their points they make the same E
 * and the same sum, with 0 for the point below the horizon. Of all with sum 1 none makes E smaller:
 * divided by their sum, the best ones do not. */
static void kept_weights(void **state) {
    (void)state;
    static const double points[] = {0, 0, 1, 0.6, 0, 0.8, 0, 0.6, -0.8, 0, -0.8, 0.6};
    enum { NUM = 4, BELOW = 2 };
    double scaled[NUM];
    size_t num = 0;
    pspec_context *context = pspec_context_create();
    pspec_quadrature_request request = make_request();
    request.drop_below_horizon = 1;
    const pspec_pattern pattern = {3, NUM, points, NULL};
    request.optimal_weights = 1;
    pspec_quadrature *none = analyse(context, &request, &pattern, 1);
    assert_null(pspec_quadrature_weights(none, &num));
    assert_int_equal(num, 0);
    request.keep_weights = 1;
    pspec_quadrature *best = analyse(context, &request, &pattern, 1);
    const double *const weights = pspec_quadrature_weights(best, &num);
    assert_int_equal(num, NUM);
    assert_true(weights[BELOW] == 0 && weights[0] != 0 && weights[3] != 0);
    const double sum = pspec_quadrature_error(best)->weight_sum.mean;
    test_assert_near(weights[0] + weights[1] + weights[3], sum, 1e-15);
    for (size_t j = 0; j < NUM; j++) {
        scaled[j] = weights[j] / sum;
    }
    request.weight_sum_one = 1;
    pspec_quadrature *one = analyse(context, &request, &pattern, 1);
    request.weight_sum_one = request.optimal_weights = 0;
    const pspec_pattern given = {3, NUM, points, weights};
    const pspec_pattern divided = {3, NUM, points, scaled};
    pspec_quadrature *again = analyse(context, &request, &given, 1);
    pspec_quadrature *other = analyse(context, &request, &divided, 1);
    const double e = pspec_quadrature_error(best)->squared.mean;
    const double e_one = pspec_quadrature_error(one)->squared.mean;
    test_assert_near(pspec_quadrature_error(again)->squared.mean, e, 1e-15);
    test_assert_near(pspec_quadrature_error(one)->weight_sum.mean, 1, 1e-14);
    assert_true(e < e_one && e_one < pspec_quadrature_error(other)->squared.mean);
    pspec_quadrature *const all[] = {none, best, one, again, other};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        pspec_quadrature_destroy(all[i]);
    }
    pspec_context_destroy(context);
}

static void refuses(pspec_context *context, const pspec_quadrature_request *request,
                    const pspec_pattern *pattern, size_t num, pspec_status status,
                    const char *says) {
    pspec_quadrature *q = (pspec_quadrature *)&q;
    assert_int_equal(pspec_quadrature_create(&q, context, request, pattern, num), status);
    assert_null(q);
    if (strstr(pspec_context_message(context), says) == NULL) {
        fail_msg("\"%s\" lacks \"%s\"", pspec_context_message(context), says);
    }
}

static void nonsense(void **state) {
    (void)state;
    static const double below[] = {0, 0, 1, 0.6, 0, -0.8}, off[] = {0, 0, 2},
                        nan_at[] = {0, NAN, 1};
    static const double zeros[] = {0, 0}, one[] = {0, 0, 1}, two[] = {0, 0, 1, 0.6, 0, 0.8};
    pspec_context *context = pspec_context_create();
    pspec_quadrature_request request = make_request();
    const pspec_pattern good = {3, 1, one, NULL};
    const pspec_pattern bad[] = {{3, 2, below, NULL}, {3, 1, off, NULL}, {3, 1, nan_at, NULL},
                                 {3, 2, two, zeros},  {2, 1, one, NULL}, {3, 0, one, NULL},
                                 {3, 1, NULL, NULL}};
    static const char *const says[] = {
        "point 2 of set 1, z = -0.8", "has the length 2",         "set 1, point 1",
        "all weights are 0",          "dimension 2 instead of 3", "set 1 has no points",
        "set 1 has no points"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        refuses(context, &request, &bad[i], 1, PSPEC_ERROR_INPUT, says[i]);
    }
    refuses(context, &request, &good, 0, PSPEC_ERROR_INVALID_ARGUMENT, "no pattern");
    refuses(context, NULL, &good, 1, PSPEC_ERROR_INVALID_ARGUMENT, "no request");
    const struct {
        const char *brdf;
        double smoothness, tolerance;
        int32_t max_degree;
        const char *engine, *says;
    } cases[] = {{"glosy", 1.5, 1e-10, 4, "host_direct", "glosy"},
                 {"glossy:n=0", 1.5, 1e-10, 4, "host_direct", "n"},
                 {NULL, 1.5, 1e-10, 4, "host_direct", "BRDF"},
                 {"diffuse", 2, 1e-10, 4, "host_direct", "is not between 1 and 2"},
                 {"diffuse", NAN, 1e-10, 4, "host_direct", "is not between 1 and 2"},
                 {"diffuse", 1.5, 0, 4, "host_direct", "tolerance 0"},
                 {"diffuse", 1.5, 1e-10, -1, "host_direct", "max_degree -1"},
                 {"diffuse", 1.5, 1e-10, 4, "torus_direct", "torus_direct"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        request.brdf = cases[i].brdf;
        request.smoothness = cases[i].smoothness;
        request.tolerance = cases[i].tolerance;
        request.max_degree = cases[i].max_degree;
        request.engine = cases[i].engine;
        refuses(context, &request, &good, 1, PSPEC_ERROR_INVALID_ARGUMENT, cases[i].says);
    }
    request = make_request();
    request.struct_size--;
    refuses(context, &request, &good, 1, PSPEC_ERROR_INVALID_ARGUMENT, "struct_size");
    pspec_quadrature *q = NULL;
    assert_int_equal(pspec_quadrature_create(&q, NULL, &request, &good, 1),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    pspec_quadrature_destroy(NULL);
    pspec_context_destroy(context);
}

static int stop(const pspec_progress_report *report, void *payload) {
    return report->done >= *(const uint64_t *)payload;
}

static void cancelled(void **state) {
    (void)state;
    static const double one[] = {0, 0, 1};
    uint64_t enough = 1;
    double errors[9], bounds[9], points[9];
    const pspec_pattern good = {3, 1, one, NULL};
    pspec_quadrature *q = NULL;
    pspec_context *context = pspec_context_create();
    pspec_quadrature_request request = make_request();
    pspec_context_set_progress(context, stop, &enough);
    assert_int_equal(pspec_quadrature_create(&q, context, &request, &good, 1),
                     PSPEC_ERROR_CANCELLED);
    assert_int_equal(pspec_truncation(context, "diffuse", 1.5, 0, 8, errors, bounds, points),
                     PSPEC_ERROR_CANCELLED);
    pspec_context_destroy(context);
}

/* Table 1 of M18, and what has no answer. */
static void truncation(void **state) {
    (void)state;
    double errors[15], bounds[15], points[15];
    pspec_context *context = pspec_context_create();
    assert_int_equal(pspec_truncation(context, "diffuse", 1.5, 0, 4, errors, bounds, points),
                     PSPEC_OK);
    test_assert_near(errors[4], 2.656e-3, 5e-7);
    assert_true(bounds[4] < 1e-9 && fabs(points[4] / 1843 - 1) < 0.01);
    assert_int_equal(pspec_truncation(context, "glossy:n=30", 1.5, 1, 9, errors, bounds, NULL),
                     PSPEC_OK);
    test_assert_near(errors[9], 2.035e-3, 5e-7);
    assert_int_equal(pspec_truncation(context, "diffuse", 1.5, 1, 1, errors, bounds, points),
                     PSPEC_OK);
    assert_true(errors[1] == 0 && isnan(points[1]));
    assert_int_equal(pspec_truncation(context, "diffuse", 1.5, 0, -1, errors, bounds, NULL),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(pspec_truncation(context, "diffuse", 1, 0, 4, errors, bounds, NULL),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(pspec_truncation(context, NULL, 1.5, 0, 4, errors, bounds, NULL),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(pspec_brdf_coefficients(context, "glossy:n=2,cut=none", 1, 4, errors),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    /* b~ of the diffuse lobe */
    assert_int_equal(pspec_brdf_coefficients(context, "diffuse", 1, 4, errors), PSPEC_OK);
    test_assert_near(errors[0], 0.3989422804014327, 1e-15);
    test_assert_near(errors[1], 0.2303294329808903, 1e-15);
    assert_true(errors[2] == 0 && errors[3] == 0 && errors[4] == 0);
    pspec_context_destroy(context);
}

/* C_l^2 of pair sums is that of the coefficients. */
static void azimuthal_sums(void **state) {
    enum { NUM = 30, SETS = 2 };
    (void)state;
    pspec_context *context = pspec_context_create();
    pspec_angular_request request = test_angular_request();
    double *vectors = test_make_vectors(SETS * NUM, 3);
    const pspec_pattern patterns[SETS] = {test_vectors(vectors, NUM),
                                          test_vectors(vectors + 3 * NUM, NUM)};
    double c[(TEST_MAX_DEGREE + 1) * (TEST_MAX_DEGREE + 2)];
    double expected[TEST_MAX_DEGREE + 1] = {0};
    pspec_mean c2[TEST_MAX_DEGREE];
    pspec_plan *plan = NULL;
    request.want_c2 = 1;
    assert_int_equal(pspec_plan_create_angular(&plan, context, &request),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    request.normalization = PSPEC_NORMALIZATION_PAIRS;
    assert_int_equal(pspec_plan_create_angular(&plan, context, &request), PSPEC_OK);
    assert_int_equal(pspec_plan_c2(plan, c2), PSPEC_ERROR_INPUT);
    assert_int_equal(pspec_plan_run(plan, patterns, SETS), PSPEC_OK);
    assert_int_equal(pspec_plan_c2(plan, c2), PSPEC_OK);
    for (int i = 0; i < SETS; i++) {
        assert_int_equal(pspec_plan_coefficients(plan, &patterns[i], 0, c), PSPEC_OK);
        for (int l = 1; l <= TEST_MAX_DEGREE; l++) {
            for (int m = 1; m <= l; m++) {
                const double *one = c + 2 * (m * (2 * TEST_MAX_DEGREE + 1 - m) / 2 + l);
                expected[l] += 2 * (one[0] * one[0] + one[1] * one[1]) / NUM / NUM / SETS;
            }
        }
    }
    for (int l = 1; l <= TEST_MAX_DEGREE; l++) {
        test_assert_near(c2[l - 1].mean, expected[l], 1e-14);
        assert_true(c2[l - 1].standard_error > 0);
    }
    assert_int_equal(pspec_plan_c2(plan, NULL), PSPEC_ERROR_INVALID_ARGUMENT);
    pspec_plan_destroy(plan);
    request.want_c2 = 0;
    assert_int_equal(pspec_plan_create_angular(&plan, context, &request), PSPEC_OK);
    assert_int_equal(pspec_plan_c2(plan, c2), PSPEC_ERROR_INVALID_ARGUMENT);
    pspec_plan_destroy(plan);
    free(vectors);
    pspec_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_point),  cmocka_unit_test(realizations),
        cmocka_unit_test(weights),    cmocka_unit_test(kept_weights),
        cmocka_unit_test(nonsense),   cmocka_unit_test(cancelled),
        cmocka_unit_test(truncation), cmocka_unit_test(azimuthal_sums)};
    return cmocka_run_group_tests_name("quadrature_public", tests, NULL, NULL);
}
