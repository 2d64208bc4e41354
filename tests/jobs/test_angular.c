/* Angular spectra through the public library and through files: closed forms, every way of saying
 * the same, errors with sentences. Numbers against the reference are in test_sphere_reference.c.
 */
#include "harness_angular.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* docs/mathematics/sphere.md#coefficients-and-power */
static void closed_forms(void **state) {
    (void)state;
    static const double one[] = {0.6, 0, 0.8};
    static const double pair[] = {0.36, 0.48, 0.8, -0.36, -0.48, -0.8};
    static const double poles[] = {0, 0, 1, 0, 0, -1};
    pspec_context *context = pspec_context_create();
    const pspec_angular_request request = test_angular_request();
    const pspec_pattern patterns[] = {test_vectors(one, 1), test_vectors(pair, 2),
                                      test_vectors(poles, 2)};
    for (size_t i = 0; i < 3; i++) {
        pspec_spectrum *spectrum = test_estimate_angular(context, &request, &patterns[i], 1);
        size_t num = 0;
        const pspec_bin *bins = pspec_spectrum_bins(spectrum, &num);
        assert_int_equal(num, TEST_MAX_DEGREE);
        for (size_t b = 0; b < num; b++) {
            const double of_pair = bins[b].bin % 2 == 0 ? 2 : 0;
            test_assert_near(bins[b].power, i == 0 ? 1 : of_pair, 1e-15);
            assert_int_equal(bins[b].bin, b + 1);
            assert_int_equal(bins[b].count, 2 * (b + 1) + 1);
            test_assert_near(bins[b].normalized_frequency,
                             (double)(b + 1) / sqrt((double)patterns[i].num_points), 1e-15);
            assert_true(isnan(bins[b].standard_error) && isnan(bins[b].anisotropy_db));
        }
        pspec_spectrum_destroy(spectrum);
    }
    pspec_context_destroy(context);
}

/* Pairwise sums of Legendre polynomials, another algorithm altogether. */
static double pair_sum(const double *vectors, size_t num, int degree) {
    double sum = 0;
    for (size_t i = 0; i < num; i++) {
        for (size_t j = 0; j < num; j++) {
            const double *u = vectors + 3 * i;
            const double *v = vectors + 3 * j;
            const double x = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
            double before = 1;
            double here = x;
            for (int l = 1; l < degree; l++) {
                const double next = ((2 * l + 1) * x * here - l * before) / (l + 1);
                before = here;
                here = next;
            }
            sum += here;
        }
    }
    return sum / (double)num;
}

static void averages_and_standard_errors(void **state) {
    (void)state;
    enum { REALIZATIONS = 5 };
    pspec_context *context = pspec_context_create();
    const pspec_angular_request request = test_angular_request();
    pspec_pattern patterns[REALIZATIONS];
    double *vectors[REALIZATIONS];
    for (unsigned r = 0; r < REALIZATIONS; r++) {
        vectors[r] = test_make_vectors(TEST_NUM_POINTS, r + 1);
        patterns[r] = test_vectors(vectors[r], TEST_NUM_POINTS);
    }
    pspec_spectrum *spectrum = test_estimate_angular(context, &request, patterns, REALIZATIONS);
    size_t num = 0;
    const pspec_bin *bins = pspec_spectrum_bins(spectrum, &num);
    for (size_t b = 0; b < num; b++) {
        double sum = 0;
        double squares = 0;
        for (int r = 0; r < REALIZATIONS; r++) {
            const double power = pair_sum(vectors[r], TEST_NUM_POINTS, (int)bins[b].bin);
            sum += power;
            squares += power * power;
        }
        const double mean = sum / REALIZATIONS;
        const double variance = (squares - sum * mean) / (REALIZATIONS - 1);
        test_assert_near(bins[b].power, mean, 1e-12);
        test_assert_near(bins[b].standard_error, sqrt(variance / REALIZATIONS), 1e-12);
        assert_true(pspec_spectrum_powers(spectrum)[b] == bins[b].power);
    }
    pspec_spectrum_destroy(spectrum);
    for (int r = 0; r < REALIZATIONS; r++) {
        free(vectors[r]);
    }
    pspec_context_destroy(context);
}

/* The even degrees of the sphere; the points may as well be mirrored. */
static void hemisphere(void **state) {
    (void)state;
    pspec_context *context = pspec_context_create();
    pspec_angular_request request = test_angular_request();
    double *vectors = test_make_vectors(TEST_NUM_POINTS, 7);
    const pspec_pattern pattern = test_vectors(vectors, TEST_NUM_POINTS);
    pspec_spectrum *sphere = test_estimate_angular(context, &request, &pattern, 1);
    request.hemisphere = 1;
    request.max_degree = TEST_MAX_DEGREE + 1; /* odd: the last even one counts */
    for (size_t i = 0; i < TEST_NUM_POINTS; i++) {
        for (int axis = 0; axis < 3 && vectors[3 * i + 2] < 0; axis++) {
            vectors[3 * i + (size_t)axis] *= -1;
        }
    }
    pspec_spectrum *half = test_estimate_angular(context, &request, &pattern, 1);
    size_t num_all = 0;
    size_t num = 0;
    const pspec_bin *all = pspec_spectrum_bins(sphere, &num_all);
    const pspec_bin *bins = pspec_spectrum_bins(half, &num);
    assert_int_equal(num, TEST_MAX_DEGREE / 2);
    for (size_t b = 0; b < num; b++) {
        assert_int_equal(bins[b].bin, 2 * (b + 1));
        test_assert_near(bins[b].power, all[2 * b + 1].power, 1e-15);
    }
    pspec_spectrum_destroy(half);
    pspec_spectrum_destroy(sphere);
    free(vectors);
    pspec_context_destroy(context);
}

/* Vectors stand for their directions. */
static void lengths(void **state) {
    (void)state;
    pspec_context *context = pspec_context_create();
    const pspec_angular_request request = test_angular_request();
    double *vectors = test_make_vectors(TEST_NUM_POINTS, 11);
    const pspec_pattern pattern = test_vectors(vectors, TEST_NUM_POINTS);
    pspec_spectrum *before = test_estimate_angular(context, &request, &pattern, 1);
    for (size_t i = 0; i < 3 * TEST_NUM_POINTS; i++) {
        vectors[i] *= i / 3 % 2 == 0 ? 1 + 9e-7 : 1 - 9e-7;
    }
    pspec_spectrum *after = test_estimate_angular(context, &request, &pattern, 1);
    size_t num = 0;
    const pspec_bin *a = pspec_spectrum_bins(before, &num);
    const pspec_bin *b = pspec_spectrum_bins(after, &num);
    for (size_t i = 0; i < num; i++) {
        test_assert_near(b[i].power, a[i].power, 1e-13);
    }
    pspec_spectrum_destroy(after);
    pspec_spectrum_destroy(before);
    free(vectors);
    pspec_context_destroy(context);
}

static void saved_and_merged(void **state) {
    (void)state;
    static const char path[] = "test_angular.spectrum";
    pspec_context *context = pspec_context_create();
    double *first = test_make_vectors(TEST_NUM_POINTS, 1);
    double *second = test_make_vectors(TEST_NUM_POINTS, 2);
    const pspec_pattern patterns[] = {test_vectors(first, TEST_NUM_POINTS),
                                      test_vectors(second, TEST_NUM_POINTS)};
    for (int on_hemisphere = 0; on_hemisphere <= 1; on_hemisphere++) {
        pspec_angular_request request = test_angular_request();
        pspec_spectrum *parts[2] = {NULL};
        pspec_spectrum *merged = NULL;
        request.hemisphere = on_hemisphere;
        pspec_spectrum *whole = test_estimate_angular(context, &request, patterns, 2);
        pspec_spectrum *part = test_estimate_angular(context, &request, &patterns[0], 1);
        assert_int_equal(pspec_spectrum_save(part, context, path), PSPEC_OK);
        assert_int_equal(pspec_spectrum_load(&parts[0], context, path), PSPEC_OK);
        assert_true(test_is_same_spectrum(part, parts[0], true));
        parts[1] = test_estimate_angular(context, &request, &patterns[1], 1);
        const pspec_spectrum *both[] = {parts[0], parts[1]};
        assert_int_equal(pspec_spectrum_merge(&merged, context, both, 2), PSPEC_OK);
        assert_true(test_is_same_spectrum(merged, whole, false));
        pspec_spectrum_destroy(merged);
        merged = NULL;
        request.hemisphere = !on_hemisphere;
        pspec_spectrum *other = test_estimate_angular(context, &request, &patterns[1], 1);
        both[1] = other;
        assert_int_equal(pspec_spectrum_merge(&merged, context, both, 2), PSPEC_ERROR_INPUT);
        assert_non_null(strstr(pspec_context_message(context), "even degrees"));
        pspec_spectrum_destroy(other);
        pspec_spectrum_destroy(parts[0]);
        pspec_spectrum_destroy(parts[1]);
        pspec_spectrum_destroy(part);
        pspec_spectrum_destroy(whole);
    }
    remove(path);
    free(second);
    free(first);
    pspec_context_destroy(context);
}

static void refused_requests(void **state) {
    (void)state;
    pspec_context *context = pspec_context_create();
    pspec_plan *plan = NULL;
    static const struct {
        int32_t max_degree;
        int hemisphere;
        const char *sentence;
    } cases[] = {{0, 0, "leaves none"},
                 {-3, 0, "leaves none"},
                 {1, 1, "odd degrees vanish"},
                 {32769, 0, "above 32768"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        pspec_angular_request request = test_angular_request();
        request.max_degree = cases[i].max_degree;
        request.hemisphere = cases[i].hemisphere;
        assert_int_equal(pspec_plan_create_angular(&plan, context, &request),
                         PSPEC_ERROR_INVALID_ARGUMENT);
        assert_null(plan);
        assert_non_null(strstr(pspec_context_message(context), cases[i].sentence));
    }
    pspec_angular_request request = test_angular_request();
    request.struct_size--;
    assert_int_equal(pspec_plan_create_angular(&plan, context, &request),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(pspec_context_message(context), "PSPEC_ANGULAR_REQUEST_INIT"));
    assert_int_equal(pspec_plan_create_angular(&plan, context, NULL), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(pspec_plan_create_angular(&plan, NULL, &request),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    request = test_angular_request();
    request.engine = "torus_direct"; /* not of the sphere */
    assert_int_equal(pspec_plan_create_angular(&plan, context, &request),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    pspec_context_destroy(context);
}

static void refused_points(void **state) {
    (void)state;
    pspec_context *context = pspec_context_create();
    const pspec_angular_request request = test_angular_request();
    static const double bad[][3] = {{0, 0, 0},           {1e300, 0, 0},
                                    {0, 0, 1 + 1.1e-6},  {0, 1 - 1.1e-6, 0},
                                    {(double)NAN, 0, 1}, {0, 0, (double)INFINITY}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        double *vectors = test_make_vectors(TEST_NUM_POINTS, 3);
        const pspec_pattern pattern = test_vectors(vectors, TEST_NUM_POINTS);
        pspec_spectrum *spectrum = NULL;
        memcpy(vectors + 12, bad[i], sizeof bad[i]);
        assert_int_equal(test_try_angular(context, &request, &pattern, 1, &spectrum),
                         PSPEC_ERROR_INPUT);
        assert_non_null(strstr(pspec_context_message(context), "set 1, point 5: the vector"));
        free(vectors);
    }
    const double plane[] = {0.5, 0.25};
    const pspec_pattern flat = {2, 1, plane, NULL};
    pspec_spectrum *spectrum = NULL;
    assert_int_equal(test_try_angular(context, &request, &flat, 1, &spectrum), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(pspec_context_message(context), "dimension 2 instead of 3"));
    pspec_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_forms),     cmocka_unit_test(averages_and_standard_errors),
        cmocka_unit_test(hemisphere),       cmocka_unit_test(lengths),
        cmocka_unit_test(saved_and_merged), cmocka_unit_test(refused_requests),
        cmocka_unit_test(refused_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
