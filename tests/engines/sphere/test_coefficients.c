/* Coefficients on the sphere through the public library, by the referee: closed forms, laws,
 * errors. Numbers against the reference are in test_sphere_reference.c.
 */
#include "harness_angular.h"

#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NUM_COEFFICIENTS = (TEST_MAX_DEGREE + 1) * (TEST_MAX_DEGREE + 2) };

/* |c_lm|^2 summed over all orders. */
static double sum_orders(const double *c, int l) {
    double sum = 0;
    for (int m = 0; m <= l; m++) {
        const double *z = c + m * (2 * TEST_MAX_DEGREE + 1 - m) + 2 * l;
        sum += (m > 0 ? 2 : 1) * (z[0] * z[0] + z[1] * z[1]);
    }
    return sum;
}

/* Weights as they are; powers follow; closed forms of low degrees. */
static void coefficients(void **state) {
    (void)state;
    pspec_context *context = pspec_context_create();
    double *vectors = test_make_vectors(TEST_NUM_POINTS, 5);
    double weights[TEST_NUM_POINTS];
    double c[NUM_COEFFICIENTS];
    double sum = 0;
    double dipole[3] = {0, 0, 0};
    for (size_t j = 0; j < TEST_NUM_POINTS; j++) {
        weights[j] = 1e200 * ((double)j - 4);
        sum += weights[j];
        for (size_t axis = 0; axis < 3; axis++) {
            dipole[axis] += weights[j] * vectors[3 * j + axis];
        }
    }
    const pspec_pattern pattern = {3, TEST_NUM_POINTS, vectors, weights};
    pspec_answer *answer = test_public_ask(context, TEST_ANGULAR " coefficients", &pattern, 1);
    memcpy(c, test_public_field(answer, "coefficients", PSPEC_C128)->data, sizeof c);
    test_assert_near(c[0] / sum, 1 / sqrt(PS_FOUR_PI), 1e-15);
    test_assert_near(c[2] / sum, sqrt(3 / PS_FOUR_PI) * dipole[2] / sum, 1e-15);
    const double *c_11 = c + 2 * TEST_MAX_DEGREE + 2; /* -sqrt(3 / (8 pi)) (x + iy) */
    test_assert_near(c_11[0] / sum, -sqrt(1.5 / PS_FOUR_PI) * dipole[0] / sum, 1e-15);
    test_assert_near(c_11[1] / sum, -sqrt(1.5 / PS_FOUR_PI) * dipole[1] / sum, 1e-15);
    for (int l = 1; l <= TEST_MAX_DEGREE; l++) {
        for (int i = 0; i < NUM_COEFFICIENTS && l == 1; i++) {
            c[i] /= sum; /* squares of 1e200 are none */
        }
        const double power = TEST_NUM_POINTS * PS_FOUR_PI / (2 * l + 1) * sum_orders(c, l);
        test_assert_near(test_public_numbers(answer, "power")[l - 1] / power, 1, 1e-13);
    }
    pspec_answer_destroy(answer);
    free(vectors);
    pspec_context_destroy(context);
}

#define HEMISPHERICAL TEST_ANGULAR " coefficients harmonics=hemispherical"

/* Of one point: the addition theorem, and the first degrees
 * (docs/mathematics/quadrature.md#hemispherical-harmonics). */
static void hemispherical_harmonics(void **state) {
    (void)state;
    static const double points[][3] = {
        {0.6, 0, 0.8}, {0, 0, 1}, {1, 0, 0}, {0.28, 0.96, 0}, {1e-9, -1e-9, 1}};
    pspec_context *context = pspec_context_create();
    for (size_t i = 0; i < sizeof points / sizeof points[0]; i++) {
        const pspec_pattern pattern = test_vectors(points[i], 1);
        pspec_answer *answer = test_public_ask(context, HEMISPHERICAL, &pattern, 1);
        const double *const c = test_public_field(answer, "coefficients", PSPEC_C128)->data;
        test_assert_near(c[0], 1 / sqrt(PS_TWO_PI), 1e-15);
        test_assert_near(c[2], sqrt(3 / PS_TWO_PI) * (2 * points[i][2] - 1), 1e-15);
        for (int l = 0; l <= TEST_MAX_DEGREE; l++) {
            test_assert_near(sum_orders(c, l) * PS_TWO_PI / (2 * l + 1), 1, 1e-14);
        }
        pspec_answer_destroy(answer);
    }
    static const double below[3] = {0.6, 0, -0.8};
    const pspec_pattern pattern = test_vectors(below, 1);
    pspec_question *const question = test_public_question(context, HEMISPHERICAL);
    test_public_add(question, &pattern, 1);
    test_public_refuse(context, question, PSPEC_ERROR_INPUT, "below the horizon");
    pspec_question_destroy(question);
    pspec_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coefficients),
        cmocka_unit_test(hemispherical_harmonics),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
