/* Worst-case errors, optimal weights and kernel interpolation against tests/reference, and against
 * each other. */
#include "harness_quadrature.h"
#include "harness_sphere.h"

#include "engines/host/host_direct.h"
#include "math/pi.h"
#include "math/sobolev.h"
#include "rules/optimal_weights.h"
#include "rules/worst_case_error.h"
#include "samplers/sampler.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of the reference's README. */
static const double KAPPA = 5e-13;
static const double SQUARED = 1e-14;

static const char *name_brdf(const cJSON *name, const cJSON *exponent, char text[64]) {
    const char *const word = name->valuestring;
    if (cJSON_IsNull(exponent)) {
        snprintf(text, 64, "%s", word);
    } else {
        snprintf(text, 64, "%s:n=%s", word, exponent->valuestring);
    }
    return text;
}

static double item(const cJSON *array, size_t i) {
    return test_number(cJSON_GetArrayItem(array, (int)i));
}

/* ---- representers -------------------------------------------------------------------------- */

static void kappa_0(void **state) {
    cJSON *json = test_read_reference("hemisphere_m18.json");
    const cJSON *row = NULL;
    (void)state;
    cJSON_ArrayForEach(row, cJSON_GetObjectItem(json, "kappa0")) {
        char text[64];
        name_brdf(cJSON_GetArrayItem(row, 0), cJSON_GetArrayItem(row, 1), text);
        ps_representer r = test_representer(text, item(row, 2), PS_REPRESENTER_TOLERANCE);
        const double off = fabs(r.kappa_0 - item(row, 3));
        print_message("%-14s s %.1f: L %5zu, kappa_0 off by %.2g (bracket %.2g)\n", text,
                      r.smoothness, r.max_degree, off, r.kappa_0_error);
        assert_true(off <= 1e-14 + r.kappa_0_error);
        assert_true(fabs(r.d_0 - item(row, 4)) <= 1e-14 + r.kappa_0_error);
        assert_true(r.kappa_0_error <= PS_REPRESENTER_TOLERANCE);
        ps_representer_destroy(&r);
    }
    cJSON_Delete(json);
}

/* The series of the diffuse lobe has the closed form, too. */
static void closed_form_is_the_series(void **state) {
    (void)state;
    for (double s = 1.1; s < 2; s += 0.2) {
        ps_representer r = test_representer("diffuse", s, 1e-13);
        double half_width = 0;
        const double rest = ps_representer_rest(&r, 0, &half_width);
        const double sum = r.a[0] * r.b[0] * r.b[0] + rest;
        assert_true(fabs(sum - r.kappa_0) <= 1e-14 + half_width);
        ps_representer_destroy(&r);
    }
}

/* D at the poles (docs/mathematics/quadrature.md#representer), and the ring form of the diffuse
 * lobe by the midpoint rule in between. */
static void diffuse_distance(void **state) {
    const double poles[6] = {0, 0, 1, 0, 0, -1};
    (void)state;
    for (double s = 1.1; s < 2; s += 0.4) {
        double kappa[2];
        ps_representer r = test_representer("diffuse", s, 1e-14);
        ps_representer_kappa(&r, 2, poles, kappa);
        const double up = exp2(s) / (s * (s + 1));
        const double down = exp2(s) * ((exp2(s + 1) - 1) / (s + 1) - (exp2(s) - 1) / s);
        assert_true(fabs(r.constant - kappa[0] - up) <= 2e-13);
        assert_true(fabs(r.constant - kappa[1] - down) <= 2e-13);
        ps_representer_destroy(&r);
    }
}

static double ring_distance(double s, double theta) {
    enum { STEPS = 200000 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double g = PS_PI * (i + 0.5) / STEPS;
        const double x = cos(theta) * cos(g);
        const double y = sin(theta) * sin(g);
        const double r = x >= y    ? x
                         : x <= -y ? 0
                                   : (x * acos(-x / y) + sqrt(y * y - x * x)) / PS_PI;
        sum += pow(2 * sin(g / 2), 2 * s - 2) * r * 2 * sin(g);
    }
    return sum * PS_PI / STEPS;
}

static void diffuse_rings(void **state) {
    (void)state;
    for (double theta = 0.3; theta < 3; theta += 0.6) {
        double kappa = 0;
        const double u[3] = {sin(theta), 0, cos(theta)};
        ps_representer r = test_representer("diffuse", 1.3, 1e-13);
        ps_representer_kappa(&r, 1, u, &kappa);
        assert_true(fabs(r.constant - kappa - ring_distance(1.3, theta)) <= 1e-9);
        ps_representer_destroy(&r);
    }
}

/* Every lobe's kappa integrates against its own density to kappa_0. */
static void kappa_is_consistent(void **state) {
    static const char *const lobes[] = {"diffuse", "glossy:n=2", "glossy:n=100", "phong:n=3.5",
                                        "glossy:n=4,cut=none"};
    enum { STEPS = 20000 };
    double *points = calloc(3 * STEPS, sizeof *points);
    double *kappa = calloc(STEPS, sizeof *kappa);
    (void)state;
    for (size_t i = 0; i < sizeof lobes / sizeof lobes[0]; i++) {
        ps_brdf *brdf = NULL;
        ps_representer r = test_representer(lobes[i], 1.7, 1e-12);
        double sum = 0;
        assert_ok(ps_brdf_parse(&brdf, lobes[i], error));
        for (int j = 0; j < STEPS; j++) {
            const double z = -1 + 2 * (j + 0.5) / STEPS;
            points[3 * j] = sqrt(1 - z * z);
            points[3 * j + 2] = z;
        }
        ps_representer_kappa(&r, STEPS, points, kappa);
        for (int j = 0; j < STEPS; j++) {
            sum += kappa[j] * ps_brdf_density(brdf, points[3 * j + 2]) * PS_FOUR_PI / STEPS;
        }
        assert_true(fabs(sum - r.kappa_0) <= 2e-5);
        ps_representer_destroy(&r);
        ps_brdf_destroy(brdf);
    }
    free(points);
    free(kappa);
}

/* ---- pairs of many blocks ------------------------------------------------------------------- */

static double sum_all_pairs(const ps_rule *rule, double smoothness) {
    long double sum = 0;
    for (size_t i = 0; i < rule->num_points; i++) {
        for (size_t j = 0; j < rule->num_points; j++) {
            const double w = rule->weights != NULL ? rule->weights[i] * rule->weights[j] : 1;
            sum += w * ps_sobolev_distance(smoothness, rule->points + 3 * i, rule->points + 3 * j);
        }
    }
    return (double)sum;
}

/* The sets of the reference are of one block. Pairs within a block and of two blocks are all there,
 * and count as often as in the plain double sum. */
static void pairs_of_blocks(void **state) {
    enum { MOST = 2 * PS_SOBOLEV_CHUNK + 5 };
    static const size_t nums[] = {1, PS_SOBOLEV_CHUNK, PS_SOBOLEV_CHUNK + 1, MOST};
    double points[3 * MOST];
    double weights[MOST];
    uint64_t random = 21;
    (void)state;
    for (size_t j = 0; j < MOST; j++) {
        const double z = 2 * test_uniform(&random) - 1;
        const double azimuth = PS_TWO_PI * test_uniform(&random);
        points[3 * j] = sqrt(1 - z * z) * cos(azimuth);
        points[3 * j + 1] = sqrt(1 - z * z) * sin(azimuth);
        points[3 * j + 2] = z;
        weights[j] = test_uniform(&random) - 0.25;
    }
    for (size_t i = 0; i < sizeof nums / sizeof nums[0]; i++) {
        const double num = (double)nums[i];
        const ps_rule plain = {nums[i], points, NULL};
        const ps_rule weighted = {nums[i], points, weights};
        double sum = 0;
        assert_ok(ps_rule_distance(&plain, 1.5, NULL, &sum, error));
        assert_true(fabs(sum - sum_all_pairs(&plain, 1.5) / num / num) <= 1e-14);
        assert_ok(ps_rule_distance(&weighted, 1.3, NULL, &sum, error));
        assert_true(fabs(sum - sum_all_pairs(&weighted, 1.3)) <= 1e-14 * num * num);
    }
}

/* ---- the sets of the reference ------------------------------------------------------------- */

typedef struct worst {
    double kappa, squared, partial, weights;
} worst;

static ps_rule rule_of(const test_set *set) {
    return (ps_rule){set->num_points, set->points, set->weights};
}

static void check_kernel_form(const test_set *set, const cJSON *one, const ps_representer *r,
                              worst *seen) {
    const cJSON *exact = cJSON_GetObjectItem(one, "kappa_j");
    const ps_rule rule = rule_of(set);
    double *kappa = calloc(set->num_points, sizeof *kappa);
    ps_kernel_error e;
    ps_representer_kappa(r, set->num_points, set->points, kappa);
    for (size_t j = 0; j < set->num_points; j++) {
        const double off = fabs(kappa[j] - item(exact, j));
        seen->kappa = fmax(seen->kappa, off);
        assert_true(off <= KAPPA);
    }
    assert_ok(ps_kernel_error_of(r, &rule, NULL, NULL, NULL, &e, error));
    const double size = ps_rule_weight_sums(&rule).size;
    const double off = fabs(e.squared - test_field(one, "E2"));
    seen->squared = fmax(seen->squared, off);
    assert_true(off <= SQUARED + 2 * size * KAPPA);
    assert_true(off <= e.bound);
    const double c = r->constant;
    const double sum = ps_rule_weight_sums(&rule).sum;
    assert_true(fabs(c * sum * sum - e.distance - test_field(one, "T1")) <= 1e-14);
    assert_true(fabs(2 * e.kappa - test_field(one, "T2")) <= 2 * KAPPA);
    free(kappa);
}

static void check_spectral_form(const test_set *set, const cJSON *one, const ps_representer *r,
                                worst *seen) {
    enum { LAST = 32 };
    const cJSON *rows = cJSON_GetObjectItem(set->json, "l");
    const ps_rule rule = rule_of(set);
    double c_l0[LAST + 1];
    double c2[LAST + 1];
    ps_spectral_error e;
    ps_degree_error degrees[LAST + 1];
    for (size_t l = 0; l <= LAST; l++) {
        const cJSON *row = cJSON_GetArrayItem(rows, (int)l);
        c_l0[l] = item(row, 1);
        c2[l] = item(row, 2);
    }
    const ps_weight_sums weights = ps_rule_weight_sums(&rule);
    assert_ok(ps_spectral_error_of(r, LAST, c_l0, c2, &weights, degrees, &e, error));
    const double partial = e.zonal + e.anisotropic;
    const double off = fabs(partial - test_field(one, "E2_partial_l<=32"));
    double sum = 0;
    seen->partial = fmax(seen->partial, off);
    assert_true(off <= 1e-14);
    for (size_t l = 0; l <= LAST; l++) {
        sum += degrees[l].e2;
        assert_true(degrees[l].e2 == degrees[l].a * (degrees[l].d2 + degrees[l].c2));
    }
    assert_true(fabs(sum - partial) <= 1e-14);
    const double rest = test_field(one, "E2") - partial;
    assert_true(rest >= -1e-14 && rest <= e.tail_bound);
    assert_true(e.tail_model <= e.tail_bound);
}

static void check_weights(const test_set *set, const cJSON *one, const ps_representer *r,
                          worst *seen) {
    const cJSON *exact = cJSON_GetObjectItem(one, "osw_w");
    double *weights = calloc(set->num_points, sizeof *weights);
    ps_optimal_weights found;
    assert_ok(ps_optimal_weights_find(r, set->num_points, set->points, NULL, false, NULL, weights,
                                      &found, error));
    double largest = 0;
    double off = 0;
    for (size_t j = 0; j < set->num_points; j++) {
        largest = fmax(largest, fabs(item(exact, j)));
        off = fmax(off, fabs(weights[j] - item(exact, j)));
    }
    /* kappa is off, too: its error goes through the inverse */
    const double limit =
        4 * DBL_EPSILON * found.facts.condition * largest + found.facts.condition * 2e-14;
    seen->weights = fmax(seen->weights, off / limit);
    assert_true(off <= limit);
    double size = 0;
    for (size_t j = 0; j < set->num_points; j++) {
        size += fabs(weights[j]);
    }
    assert_true(fabs(found.squared - test_field(one, "osw_E2")) <= SQUARED + 2 * size * KAPPA);
    assert_true(found.facts.is_dense && found.facts.num_distinct == set->num_points);
    free(weights);
}

static void reference_sets(void **state) {
    cJSON *json = test_read_reference("hemisphere_m18.json");
    const cJSON *set_json = NULL;
    worst seen = {0, 0, 0, 0};
    (void)state;
    cJSON_ArrayForEach(set_json, cJSON_GetObjectItem(json, "sets")) {
        test_set set = test_read_sphere_set(set_json);
        const cJSON *one = NULL;
        cJSON_ArrayForEach(one, cJSON_GetObjectItem(set_json, "error")) {
            char text[64];
            name_brdf(cJSON_GetObjectItem(one, "brdf"), cJSON_GetObjectItem(one, "n"), text);
            ps_representer r =
                test_representer(text, test_field(one, "s"), PS_REPRESENTER_TOLERANCE);
            check_kernel_form(&set, one, &r, &seen);
            check_spectral_form(&set, one, &r, &seen);
            check_weights(&set, one, &r, &seen);
            ps_representer_destroy(&r);
        }
        test_free_set(&set);
    }
    print_message("kappa %.2g, E^2 %.2g, partial sums %.2g, weights %.2g of the limit\n",
                  seen.kappa, seen.squared, seen.partial, seen.weights);
    cJSON_Delete(json);
}

static double *read_vectors(const cJSON *rows, size_t *num) {
    *num = (size_t)cJSON_GetArraySize(rows);
    double *vectors = calloc(3 * *num, sizeof *vectors);
    for (size_t i = 0; i < 3 * *num; i++) {
        vectors[i] = item(cJSON_GetArrayItem(rows, (int)(i / 3)), i % 3);
    }
    return vectors;
}

static void interpolation(void **state) {
    cJSON *json = test_read_reference("hemisphere_m18.json");
    const cJSON *given = cJSON_GetObjectItem(json, "interpolation");
    const cJSON *one = NULL;
    size_t num = 0;
    size_t num_tests = 0;
    double *points = read_vectors(cJSON_GetObjectItem(given, "xyz"), &num);
    double *tests = read_vectors(cJSON_GetObjectItem(given, "test_xyz"), &num_tests);
    double *f = calloc(num, sizeof *f);
    double *alpha = calloc(num, sizeof *alpha);
    double *values = calloc(num_tests, sizeof *values);
    (void)state;
    for (size_t i = 0; i < num; i++) {
        f[i] = item(cJSON_GetObjectItem(given, "f"), i);
    }
    cJSON_ArrayForEach(one, cJSON_GetObjectItem(given, "results")) {
        const double s = test_field(one, "s");
        ps_kernel_system *system = NULL;
        double norm = 0;
        assert_ok(ps_kernel_system_create(&system, num, points, s, NULL, error));
        assert_ok(ps_kernel_system_solve(system, f, alpha, NULL, error));
        const double limit = 1e-15 * ps_kernel_system_facts(system).condition;
        for (size_t i = 0; i < num; i++) {
            norm += f[i] * alpha[i];
            assert_true(fabs(alpha[i] - item(cJSON_GetObjectItem(one, "alpha"), i)) <= limit);
        }
        assert_true(fabs(norm - test_field(one, "norm2")) <= limit * fabs(norm));
        ps_kernel_interpolate(num, points, s, 1, alpha, num_tests, tests, values);
        for (size_t i = 0; i < num_tests; i++) {
            assert_true(fabs(values[i] - item(cJSON_GetObjectItem(one, "f_at_test"), i)) <= 1e-12);
        }
        ps_kernel_system_destroy(system);
    }
    free(points);
    free(tests);
    free(f);
    free(alpha);
    free(values);
    cJSON_Delete(json);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(kappa_0),
                                       cmocka_unit_test(closed_form_is_the_series),
                                       cmocka_unit_test(diffuse_distance),
                                       cmocka_unit_test(diffuse_rings),
                                       cmocka_unit_test(kappa_is_consistent),
                                       cmocka_unit_test(pairs_of_blocks),
                                       cmocka_unit_test(reference_sets),
                                       cmocka_unit_test(interpolation)};
    return cmocka_run_group_tests_name("worst_case", tests, NULL, NULL);
}
