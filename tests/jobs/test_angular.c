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
    const pspec_pattern patterns[] = {test_vectors(one, 1), test_vectors(pair, 2),
                                      test_vectors(poles, 2)};
    for (size_t i = 0; i < 3; i++) {
        pspec_answer *spectrum = test_public_ask(context, TEST_ANGULAR, &patterns[i], 1);
        const pspec_field *const degrees = test_public_field(spectrum, "degree", PSPEC_I64);
        const double *const normalized = test_public_numbers(spectrum, "normalized_degree");
        assert_int_equal(degrees->num, TEST_MAX_DEGREE);
        for (size_t b = 0; b < degrees->num; b++) {
            const int64_t degree = ((const int64_t *)degrees->data)[b];
            const double of_pair = degree % 2 == 0 ? 2 : 0;
            test_assert_near(test_public_numbers(spectrum, "power")[b], i == 0 ? 1 : of_pair,
                             1e-15);
            assert_int_equal(degree, b + 1);
            test_assert_near(normalized[b], (double)(b + 1) / sqrt((double)patterns[i].num_points),
                             1e-15);
            assert_true(isnan(test_public_numbers(spectrum, "standard_error")[b]));
        }
        pspec_answer_destroy(spectrum);
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
    pspec_pattern patterns[REALIZATIONS];
    double *vectors[REALIZATIONS];
    for (unsigned r = 0; r < REALIZATIONS; r++) {
        vectors[r] = test_make_vectors(TEST_NUM_POINTS, r + 1);
        patterns[r] = test_vectors(vectors[r], TEST_NUM_POINTS);
    }
    pspec_answer *spectrum = test_public_ask(context, TEST_ANGULAR, patterns, REALIZATIONS);
    for (size_t b = 0; b < TEST_MAX_DEGREE; b++) {
        double sum = 0;
        double squares = 0;
        for (int r = 0; r < REALIZATIONS; r++) {
            const double power = pair_sum(vectors[r], TEST_NUM_POINTS, (int)b + 1);
            sum += power;
            squares += power * power;
        }
        const double mean = sum / REALIZATIONS;
        const double variance = (squares - sum * mean) / (REALIZATIONS - 1);
        test_assert_near(test_public_numbers(spectrum, "power")[b], mean, 1e-12);
        test_assert_near(test_public_numbers(spectrum, "standard_error")[b],
                         sqrt(variance / REALIZATIONS), 1e-12);
    }
    pspec_answer_destroy(spectrum);
    for (int r = 0; r < REALIZATIONS; r++) {
        free(vectors[r]);
    }
    pspec_context_destroy(context);
}

/* The even degrees of the sphere; the points may as well be mirrored. */
static void hemisphere(void **state) {
    (void)state;
    pspec_context *context = pspec_context_create();
    double *vectors = test_make_vectors(TEST_NUM_POINTS, 7);
    const pspec_pattern pattern = test_vectors(vectors, TEST_NUM_POINTS);
    pspec_answer *sphere = test_public_ask(context, TEST_ANGULAR, &pattern, 1);
    for (size_t i = 0; i < TEST_NUM_POINTS; i++) {
        for (int axis = 0; axis < 3 && vectors[3 * i + 2] < 0; axis++) {
            vectors[3 * i + (size_t)axis] *= -1;
        }
    }
    /* an odd degree: the last even one counts */
    pspec_answer *half = test_public_ask(
        context, "angular max-degree=13 hemisphere engine=host_direct", &pattern, 1);
    const pspec_field *const degrees = test_public_field(half, "degree", PSPEC_I64);
    assert_int_equal(degrees->num, TEST_MAX_DEGREE / 2);
    for (size_t b = 0; b < degrees->num; b++) {
        assert_int_equal(((const int64_t *)degrees->data)[b], 2 * (b + 1));
        test_assert_near(test_public_numbers(half, "power")[b],
                         test_public_numbers(sphere, "power")[2 * b + 1], 1e-15);
    }
    pspec_answer_destroy(half);
    pspec_answer_destroy(sphere);
    free(vectors);
    pspec_context_destroy(context);
}

/* Vectors stand for their directions. */
static void lengths(void **state) {
    (void)state;
    pspec_context *context = pspec_context_create();
    double *vectors = test_make_vectors(TEST_NUM_POINTS, 11);
    const pspec_pattern pattern = test_vectors(vectors, TEST_NUM_POINTS);
    pspec_answer *before = test_public_ask(context, TEST_ANGULAR, &pattern, 1);
    for (size_t i = 0; i < 3 * TEST_NUM_POINTS; i++) {
        vectors[i] *= i / 3 % 2 == 0 ? 1 + 9e-7 : 1 - 9e-7;
    }
    pspec_answer *after = test_public_ask(context, TEST_ANGULAR, &pattern, 1);
    for (size_t i = 0; i < TEST_MAX_DEGREE; i++) {
        test_assert_near(test_public_numbers(after, "power")[i],
                         test_public_numbers(before, "power")[i], 1e-13);
    }
    pspec_answer_destroy(after);
    pspec_answer_destroy(before);
    free(vectors);
    pspec_context_destroy(context);
}

static void refuse(pspec_context *context, const pspec_pattern *pattern, const char *piece) {
    pspec_question *const question = test_public_question(context, TEST_ANGULAR);
    test_public_add(question, pattern, 1);
    test_public_refuse(context, question, PSPEC_ERROR_INPUT, piece);
    pspec_question_destroy(question);
}

static void refused_points(void **state) {
    (void)state;
    pspec_context *context = pspec_context_create();
    static const double bad[][3] = {{0, 0, 0},           {1e300, 0, 0},
                                    {0, 0, 1 + 1.1e-6},  {0, 1 - 1.1e-6, 0},
                                    {(double)NAN, 0, 1}, {0, 0, (double)INFINITY}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        double *vectors = test_make_vectors(TEST_NUM_POINTS, 3);
        const pspec_pattern pattern = test_vectors(vectors, TEST_NUM_POINTS);
        memcpy(vectors + 12, bad[i], sizeof bad[i]);
        refuse(context, &pattern, "set 1, row 5: ");
        free(vectors);
    }
    const double plane[] = {0.5, 0.25};
    const pspec_pattern flat = {2, 1, plane, NULL};
    refuse(context, &flat, "2");
    pspec_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_forms),   cmocka_unit_test(averages_and_standard_errors),
        cmocka_unit_test(hemisphere),     cmocka_unit_test(lengths),
        cmocka_unit_test(refused_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
