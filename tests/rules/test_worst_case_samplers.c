/* Worst-case errors of samplers: golden values, means of random sets, and the two forms beside each
 * other. */
#include "harness_quadrature.h"
#include "harness_sphere.h"

#include "engines/host/host_direct.h"
#include "rules/truncation.h"
#include "rules/worst_case_error.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What docs/mathematics/quadrature.md#reference-errors has of spherical Fibonacci sets, four
 * digits. */
static void golden_values(void **state) {
    static const double golden[2][6] = {{.03451, .0202, .0119, .007017, .004144, .002452},
                                        {.02133, .01253, .00739, .004364, .002578, .001526}};
    static const char *const lobes[2][2] = {
        {"diffuse", "fibonacci-hemisphere:morph=diffuse"},
        {"glossy:n=30", "fibonacci-hemisphere:morph=glossy,n=30"}};
    (void)state;
    for (int i = 0; i < 2; i++) {
        ps_representer r = test_representer(lobes[i][0], 1.5, 1e-13);
        for (int k = 0; k < 6; k++) {
            const size_t num = (size_t)64 << k;
            double *points = test_rule_points(lobes[i][1], num, 0);
            const double e = sqrt(test_squared_error(&r, num, points, NULL));
            assert_true(fabs(e / golden[i][k] - 1) <= 6e-4); /* their last digit */
            free(points);
        }
        ps_representer_destroy(&r);
    }
}

/* <E^2> = D_0/N: .98274/sqrt N and .56708/sqrt N. */
static void random_sets(void **state) {
    enum { NUM = 100, SETS = 400 };
    static const struct {
        const char *lobe, *sampler;
        double constant;
    } cases[] = {{"diffuse", "white-hemisphere:morph=diffuse", .98274},
                 {"glossy:n=30", "white-hemisphere:morph=glossy,n=30", .56708}};
    (void)state;
    for (int i = 0; i < 2; i++) {
        ps_representer r = test_representer(cases[i].lobe, 1.5, 1e-12);
        double sum = 0;
        double square = 0;
        assert_true(fabs(sqrt(r.d_0) - cases[i].constant) <= 1e-5);
        for (uint64_t k = 0; k < SETS; k++) {
            double *points = test_rule_points(cases[i].sampler, NUM, k);
            const double e = test_squared_error(&r, NUM, points, NULL);
            sum += e / SETS;
            square += e * e / SETS;
            free(points);
        }
        const double deviation = sqrt((square - sum * sum) / SETS);
        assert_true(fabs(sum - r.d_0 / NUM) <= 4 * deviation);
        ps_representer_destroy(&r);
    }
}

/* c_l0 and C_l^2 of one set, whose weights are 1/N where it has none, by the referee. */
static void spectrum_of(const pspec_pattern *pattern, int32_t last, double *c_l0, double *c2) {
    ps_frequencies degrees = test_degrees(last, false);
    double *c = test_coefficients(&ps_host_direct, PS_EXTENDED, NULL, &degrees, pattern);
    const double unit = pattern->weights != NULL ? 1 : 1 / (double)pattern->num_points;
    for (int32_t l = 0; l <= last; l++) {
        c_l0[l] = c[2 * test_coefficient(last, l, 0)] * unit;
        c2[l] = 0;
        for (int32_t m = 1; m <= l; m++) {
            const double *one = c + 2 * test_coefficient(last, l, m);
            c2[l] += 2 * (one[0] * one[0] + one[1] * one[1]) * unit * unit;
        }
    }
    free(c);
    ps_frequencies_free(&degrees);
}

/* The spectral form's partial sum and the kernel form agree within the bracket. */
static void two_forms(void **state) {
    enum { NUM = 256, LAST = 100 };
    static const char *const samplers[] = {"fibonacci-hemisphere:morph=diffuse",
                                           "white-hemisphere:morph=diffuse",
                                           "larcher-pillichshammer:lift=hemisphere"};
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        double *points = test_rule_points(samplers[i], NUM, 0);
        const pspec_pattern pattern = {.dimension = 3, .num_points = NUM, .points = points};
        double c_l0[LAST + 1];
        double c2[LAST + 1];
        spectrum_of(&pattern, LAST, c_l0, c2);
        for (double s = 1.1; s < 2; s += 0.4) {
            ps_representer r = test_representer("diffuse", s, 1e-12);
            const ps_rule rule = {NUM, points, NULL};
            ps_spectral_error e;
            const ps_weight_sums weights = ps_rule_weight_sums(&rule);
            assert_ok(ps_spectral_error_of(&r, LAST, c_l0, c2, &weights, NULL, &e, error));
            const double rest = test_squared_error(&r, NUM, points, NULL) - e.zonal - e.anisotropic;
            print_message("%-40s s %.1f rest %.4g, model %.4g, bound %.4g\n", samplers[i], s, rest,
                          e.tail_model, e.tail_bound);
            assert_true(rest >= -1e-13 && rest <= e.tail_bound);
            assert_true(rest > e.tail_model / 3 && rest < 3 * e.tail_model);
            ps_representer_destroy(&r);
        }
        free(points);
    }
}

/* The mean of the rest beyond degree `last`, over independent points of the lobe's density, is the
 * model's, also where the lobe itself has most of its spectrum beyond, and with weights whose sum
 * is not 1. */
static void mean_rest(const char *sampler, const ps_representer *r, const double *weights,
                      int32_t last) {
    enum { NUM = 32, SETS = 300, LAST = 8 };
    double c_l0[LAST + 1];
    double c2[LAST + 1];
    ps_spectral_error e;
    double sum = 0;
    double square = 0;
    for (uint64_t k = 0; k < SETS; k++) {
        double *points = test_rule_points(sampler, NUM, k);
        const pspec_pattern pattern = {
            .dimension = 3, .num_points = NUM, .points = points, .weights = weights};
        const ps_rule rule = {NUM, points, weights};
        const ps_weight_sums sums = ps_rule_weight_sums(&rule);
        spectrum_of(&pattern, last, c_l0, c2);
        assert_ok(ps_spectral_error_of(r, (size_t)last, c_l0, c2, &sums, NULL, &e, error));
        const double rest = test_squared_error(r, NUM, points, weights) - e.zonal - e.anisotropic;
        sum += rest / SETS;
        square += rest * rest / SETS;
        free(points);
    }
    const double deviation = sqrt((square - sum * sum) / SETS);
    print_message("%s, beyond %d: %.4g, standard error %.2g; model %.4g\n", sampler, (int)last, sum,
                  deviation, e.tail_model);
    assert_true(fabs(sum - e.tail_model) <= 4 * deviation);
    assert_true(deviation <= 0.1 * e.tail_model);
}

static void model_of_rest(void **state) {
    static const char *const lobes[2][2] = {{"diffuse", "white-hemisphere:morph=diffuse"},
                                            {"glossy:n=30", "white-hemisphere:morph=glossy,n=30"}};
    double weights[32]; /* 0.5/N and 1.1/N in turn: their sum is 0.8 */
    (void)state;
    for (size_t j = 0; j < 32; j++) {
        weights[j] = (j % 2 == 0 ? 0.5 : 1.1) / 32;
    }
    for (int i = 0; i < 2; i++) {
        ps_representer r = test_representer(lobes[i][0], 1.5, 1e-12);
        for (int32_t last = 1; last <= 8; last = 2 * last + 1) {
            mean_rest(lobes[i][1], &r, NULL, last);
            mean_rest(lobes[i][1], &r, weights, last);
        }
        ps_representer_destroy(&r);
    }
}

/* Degrees that a representer does not have are refused, not read. */
static void too_many_degrees(void **state) {
    (void)state;
    ps_representer r = test_representer("diffuse", 1.5, 1e-3);
    const ps_weight_sums one = {1, 1, 1};
    const size_t last = r.max_degree + 1;
    double *numbers = calloc(2 * (last + 1), sizeof *numbers);
    ps_spectral_error e;
    ps_error failure = {0};
    assert_int_equal(ps_spectral_error_of(&r, last, numbers, numbers, &one, NULL, &e, &failure),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(failure.message, "whose coefficients end at"));
    assert_ok(ps_spectral_error_of(&r, last - 1, numbers, numbers, &one, NULL, &e, error));
    assert_int_equal(ps_truncation_spherical(&r, last, numbers, numbers + last + 1, &failure),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    free(numbers);
    ps_representer_destroy(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(golden_values), cmocka_unit_test(random_sets), cmocka_unit_test(two_forms),
        cmocka_unit_test(model_of_rest), cmocka_unit_test(too_many_degrees)};
    return cmocka_run_group_tests_name("worst_case_samplers", tests, NULL, NULL);
}
