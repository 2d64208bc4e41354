/* Variances of single sets of the sphere and the hemisphere under random rotations: pair sums
 * (S1'), (H1') and brackets of (S1), (H1) against tests/reference. */
#include "harness_integrands.h"
#include "harness_sphere.h"

#include "math/pi.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the reference is met within: relatively, and of the integral of F^2. */
static const double RELATIVE = 1e-6;
static const double OF_SQUARES = 1e-13;

enum { LAST = 400 };

static double pairwise(const ps_integrand *self, const test_set *set) {
    double variance = 0;
    assert_ok(
        ps_integrand_pairwise(self, set->points, set->weights, set->num_points, &variance, error));
    return variance;
}

static double weight(const test_set *set, size_t i) {
    return set->weights != NULL ? set->weights[i] : 1;
}

/* Q(l)/W^2 by the recurrence in chords (docs/mathematics/numerics.md#legendre-sums). */
static void sum_powers(const test_set *set, double *p) {
    double sum = 0;
    memset(p, 0, (LAST + 1) * sizeof *p);
    for (size_t i = 0; i < set->num_points; i++) {
        sum += weight(set, i);
        for (size_t j = 0; j < set->num_points; j++) {
            double near2 = 0;
            double far2 = 0;
            for (size_t k = 0; k < 3; k++) {
                const double a = set->points[3 * i + k];
                const double b = set->points[3 * j + k];
                near2 += (a - b) * (a - b);
                far2 += (a + b) * (a + b);
            }
            const double t = fmin(near2, far2) / 2;
            double value = weight(set, i) * weight(set, j);
            double step = 0;
            for (size_t l = 0; l <= LAST; l++) {
                const double d = (double)l;
                p[l] += far2 < near2 && l % 2 == 1 ? -value : value;
                step = (d * step - (2 * d + 1) * t * value) / (d + 1);
                value += step;
            }
        }
    }
    for (size_t l = 0; l <= LAST; l++) {
        p[l] /= sum * sum;
    }
}

/* factor sum_l p(l) |F_l|^2 .. and the rest of the energy with the largest power there can be. */
static void check_bracket(const ps_integrand *self, const test_set *set, double variance) {
    double p[LAST + 1];
    double f[LAST + 1];
    double sizes = 0;
    double sum = 0;
    double lower = 0;
    sum_powers(set, p);
    assert_ok(ps_integrand_degrees(self, LAST, f, error));
    double rest = ps_integrand_energy(self);
    for (size_t i = 0; i < set->num_points; i++) {
        sizes += fabs(weight(set, i));
        sum += weight(set, i);
    }
    for (size_t l = 1; l <= LAST; l++) {
        lower += p[l] * f[l];
        rest -= f[l];
    }
    const double factor = ps_integrand_factor(self);
    const double rounding = 1e-13 * factor * ps_integrand_energy(self) * pow(sizes / sum, 2);
    const double upper = lower + pow(sizes / sum, 2) * fmax(rest, 0);
    print_message("  %-30s %-9s %.6g in [%.6g, %.6g]\n", set->name, self->kind->name, variance,
                  factor * lower, factor * upper);
    assert_true(variance >= factor * lower - rounding && variance <= factor * upper + rounding);
}

/* ---- sphere ---------------------------------------------------------------------------------- */

static double squares(const ps_integrand *self) {
    const double one[3] = {1, 0, 0};
    return self->kind->correlation(self, one);
}

static void check_one(const test_set *set, const cJSON *row) {
    char text[64] = "harmonic:axis=1x-2x3"; /* no axis changes anything */
    const double exact = test_field(row, "var_random_rotation");
    if (strcmp(cJSON_GetStringValue(cJSON_GetObjectItem(row, "integrand")), "cap") == 0) {
        snprintf(text, sizeof text, "cap:angle=%.17g", test_field(row, "theta0"));
    }
    ps_integrand *self = test_integrand(text, TEST_SPHERE);
    const double whole = ps_integrand_integral(self);
    const double value = pairwise(self, set);
    const double off = fabs(value - exact);
    assert_true(fabs(whole - test_field(row, "integral")) <= 1e-14 * squares(self));
    if (!(off <= RELATIVE * fabs(exact) + OF_SQUARES * squares(self))) {
        fail_msg("%s, %s: %.17g is not %.17g", set->name, text, value, exact);
    }
    check_bracket(self, set, exact);
    ps_integrand_destroy(self);
}

static void sphere(void **state) {
    cJSON *json = test_read_reference("sphere.json");
    const cJSON *one = NULL;
    size_t num_rows = 0;
    (void)state;
    cJSON_ArrayForEach(one, cJSON_GetObjectItem(json, "sets")) {
        test_set set = test_read_sphere_set(one);
        const cJSON *row = NULL;
        cJSON_ArrayForEach(row, cJSON_GetObjectItem(one, "variance")) {
            check_one(&set, row);
            num_rows++;
        }
        test_free_set(&set);
    }
    assert_int_equal(num_rows, 24);
    cJSON_Delete(json);
}

/* ---- hemisphere ------------------------------------------------------------------------------ */

static double power_of_2(const cJSON *set) {
    const cJSON *row = NULL;
    cJSON_ArrayForEach(row, cJSON_GetObjectItem(set, "projective_P_even_l")) {
        if (test_number(cJSON_GetArrayItem(row, 0)) == 2) {
            return test_number(cJSON_GetArrayItem(row, 1));
        }
    }
    return NAN;
}

/* Var = (16 pi^2/45) P_H(2)/N of (u.e)^2, and pair sums of others inside of their brackets. */
static void hemisphere(void **state) {
    static const char *const texts[] = {"square",         "cap",      "cap:angle=0.2",
                                        "cap:angle=1.55", "harmonic", "harmonic:degree=12",
                                        "diffuse",        "constant"};
    cJSON *json = test_read_reference("hemisphere_m18.json");
    const cJSON *one = NULL;
    (void)state;
    cJSON_ArrayForEach(one, cJSON_GetObjectItem(json, "sets")) {
        test_set set = test_read_sphere_set(one);
        for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
            ps_integrand *self = test_integrand(texts[i], TEST_HEMISPHERE);
            const double value = pairwise(self, &set);
            check_bracket(self, &set, i + 1 < sizeof texts / sizeof *texts ? value : 0);
            if (i == 0) {
                const double exact = test_field(one, "projective_var_z2");
                const double rounding = OF_SQUARES * squares(self) / 2;
                const double closed =
                    16 * PS_PI * PS_PI / 45 * power_of_2(one) / (double)set.num_points;
                assert_true(fabs(closed - exact) <= 1e-13 * exact);
                assert_true(fabs(value - exact) <= RELATIVE * exact + rounding);
            }
            ps_integrand_destroy(self);
        }
        test_free_set(&set);
    }
    cJSON_Delete(json);
}

/* ---- without a closed form ------------------------------------------------------------------- */

static void no_closed_form(void **state) {
    static const struct {
        const char *text;
        ps_integrand_place place;
    } cases[] = {{"lobe", {PS_SAMPLES_HEMISPHERE, 3}},
                 {"glossy:n=3", {PS_SAMPLES_SPHERE, 3}},
                 {"glossy:n=3", {PS_SAMPLES_HEMISPHERE, 3}},
                 {"phong:n=3", {PS_SAMPLES_SPHERE, 3}}};
    const double point[3] = {0, 0, 1};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ps_integrand *self = test_integrand(cases[i].text, cases[i].place);
        ps_error error = {0};
        double variance = 0;
        assert_false(ps_integrand_has_pairs(self));
        assert_int_equal(ps_integrand_pairwise(self, point, NULL, 1, &variance, &error),
                         PSPEC_ERROR_INVALID_ARGUMENT);
        assert_non_null(strstr(error.message, "no closed form for pairs of points"));
        ps_integrand_destroy(self);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(sphere), cmocka_unit_test(hemisphere),
                                       cmocka_unit_test(no_closed_form)};
    return cmocka_run_group_tests_name("sphere pairs", tests, NULL, NULL);
}
