/* Worst-case errors of samplers: golden values, means of random sets, and the two forms beside each other. */
#include "harness_quadrature.h"
#include "harness_sphere.h"

#include "analysis/truncation.h"
#include "analysis/worst_case_error.h"
#include "engines/host_direct.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What samplers-and-experiments.md section 4 has of spherical Fibonacci sets, four digits. */
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
        ps_frequencies degrees = test_degrees(LAST, false);
        double *c = test_coefficients(&ps_host_direct, PS_EXTENDED, NULL, &degrees, &pattern);
        double c_l0[LAST + 1];
        double c2[LAST + 1];
        for (int32_t l = 0; l <= LAST; l++) {
            c_l0[l] = c[2 * test_coefficient(LAST, l, 0)] / NUM;
            c2[l] = 0;
            for (int32_t m = 1; m <= l; m++) {
                const double *one = c + 2 * test_coefficient(LAST, l, m);
                c2[l] += 2 * (one[0] * one[0] + one[1] * one[1]) / NUM / NUM;
            }
        }
        for (double s = 1.1; s < 2; s += 0.4) {
            ps_representer r = test_representer("diffuse", s, 1e-12);
            const ps_rule rule = {NUM, points, NULL};
            ps_spectral_error e;
            assert_ok(ps_spectral_error_of(&r, LAST, c_l0, c2, 1, ps_rule_weight_square(&rule),
                                           NULL, &e, error));
            const double rest = test_squared_error(&r, NUM, points, NULL) - e.zonal - e.anisotropic;
            print_message("%-40s s %.1f rest %.4g, model %.4g, bound %.4g\n", samplers[i], s, rest,
                          e.tail_model, e.tail_bound);
            assert_true(rest >= -1e-13 && rest <= e.tail_bound);
            assert_true(rest > e.tail_model / 3 && rest < 3 * e.tail_model);
            ps_representer_destroy(&r);
        }
        free(c);
        ps_frequencies_free(&degrees);
        free(points);
    }
}

/* Degrees that a representer does not have are refused, not read. */
static void too_many_degrees(void **state) {
    (void)state;
    ps_representer r = test_representer("diffuse", 1.5, 1e-3);
    const size_t last = r.max_degree + 1;
    double *numbers = calloc(2 * (last + 1), sizeof *numbers);
    ps_spectral_error e;
    ps_error failure = {0};
    assert_int_equal(ps_spectral_error_of(&r, last, numbers, numbers, 1, 1, NULL, &e, &failure),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(failure.message, "whose coefficients end at"));
    assert_ok(ps_spectral_error_of(&r, last - 1, numbers, numbers, 1, 1, NULL, &e, error));
    assert_int_equal(ps_truncation_spherical(&r, last, numbers, numbers + last + 1, &failure),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    free(numbers);
    ps_representer_destroy(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(golden_values),
                                       cmocka_unit_test(random_sets), cmocka_unit_test(two_forms),
                                       cmocka_unit_test(too_many_degrees)};
    return cmocka_run_group_tests_name("worst_case_samplers", tests, NULL, NULL);
}
