/* Scores and probabilities against GSL's distributions, and laws that hold at any size. */
#include "harness_public.h"

#include "math/random/distributions.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

static void assert_near(double found, double expected, double tolerance) {
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("%.17g instead of %.17g", found, expected);
    }
}

/* Both tails of the F distribution, as long as GSL has digits. */
static void scores_of_gamma_ratios(void **state) {
    (void)state;
    static const double shapes[] = {1, 1.5, 4, 10, 100, 3000};
    enum { NUM_SHAPES = sizeof shapes / sizeof shapes[0] };
    for (int i = 0; i < NUM_SHAPES * NUM_SHAPES; i++) {
        const double a = shapes[i / NUM_SHAPES];
        const double b = shapes[i % NUM_SHAPES];
        const double tolerance = fmin(a, b) < 10 ? 0.1 : 0.01;
        for (double ratio = 1e-3; ratio < 1e3; ratio *= 1.7) {
            const double score = ps_gamma_ratio_score(ratio, a, 1, b);
            const double below = gsl_cdf_fdist_P(ratio, 2 * a, 2 * b);
            const double above = gsl_cdf_fdist_Q(ratio, 2 * a, 2 * b);
            const double expected = fmin(below, above);
            const double found =
                below < above ? gsl_cdf_ugaussian_P(score) : gsl_cdf_ugaussian_Q(score);
            if (expected > 1e-280 && fabs(found / expected - 1) > tolerance) {
                fail_msg("a = %g, b = %g, ratio %g: %g instead of %g", a, b, ratio, found,
                         expected);
            }
        }
    }
}

static void laws_of_scores(void **state) {
    (void)state;
    assert_true(ps_gamma_ratio_score(0.3, 2, 0.3, 7) == 0);
    assert_true(ps_gamma_ratio_score(0, 2, 1, 3) == -HUGE_VAL);
    assert_true(ps_gamma_ratio_score(1, 2, 0, 3) == HUGE_VAL);
    /* the other way round; units do not matter */
    assert_near(ps_gamma_ratio_score(2, 5, 3, 8), -ps_gamma_ratio_score(3, 8, 2, 5), 1e-13);
    assert_near(ps_gamma_ratio_score(2, 5, 3, 8), ps_gamma_ratio_score(2e-9, 5, 3e-9, 8), 1e-13);
    /* where nothing scatters but rounding: (x - y) / sqrt(1 / a + 1 / b), without cancellation */
    assert_near(ps_gamma_ratio_score(1 + 1e-9, 2e18, 1, 2e18), 1, 1e-6);
    assert_true(ps_gamma_ratio_score(1 + 1e-12, 1e30, 1, 1e30) > 100);
}

static void probabilities_of_student(void **state) {
    (void)state;
    /* one degree of freedom is Cauchy's, two have a closed form */
    assert_near(ps_normal_score(0.05), 1.959963984540054, 1e-13);
    assert_near(ps_normal_score(1), 0, 0);
    assert_near(ps_normal_score(0), ps_normal_score(1e-300), 0);
    assert_near(ps_student_two_sided(1, 1), 0.5, 1e-14);
    assert_near(ps_student_two_sided(-3, 2), 1 - 3 / sqrt(11), 1e-14);
    assert_near(ps_student_two_sided(1.959963984540054, 1e9), 0.05, 1e-9);
    assert_true(ps_student_two_sided(HUGE_VAL, 0.5) == 0);
    for (double freedom = 0.3; freedom < 1e4; freedom *= 3) {
        for (double p = 1e-7; p < 1; p *= 6) {
            const double score = ps_student_score(p, freedom);
            if (score < 1e6) {
                assert_near(ps_student_two_sided(score, freedom) / p, 1, 1e-5);
            }
        }
    }
}

/* Anything that a spectrum may lead to: probabilities that fall with the score, and no call of
 * GSL's error handler (the last test). */
static void extreme_arguments(void **state) {
    (void)state;
    static const double freedoms[] = {0,  1e-300, 1e-6, 1e-3, 0.5,   1,
                                      29, 31,     1e6,  1e18, 1e300, HUGE_VAL};
    for (size_t i = 0; i < sizeof freedoms / sizeof freedoms[0]; i++) {
        double before = 1;
        for (double score = 1e-300; score < 1e300; score *= 1e3) {
            const double p = ps_student_two_sided(score, freedoms[i]);
            if (!(p >= 0 && p <= before * (1 + 1e-9))) {
                fail_msg("score %g, %g degrees of freedom: %g after %g", score, freedoms[i], p,
                         before);
            }
            before = p;
        }
        assert_true(ps_student_score(1e-9, freedoms[i]) <= 1e6);
    }
    assert_true(isnan(ps_student_two_sided(NAN, 3)) && isnan(ps_student_two_sided(3, NAN)));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scores_of_gamma_ratios),   cmocka_unit_test(laws_of_scores),
        cmocka_unit_test(probabilities_of_student), cmocka_unit_test(extreme_arguments),
        cmocka_unit_test(test_gsl_is_left_alone),
    };
    test_watch_gsl();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
