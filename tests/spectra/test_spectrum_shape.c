/* What is said of the low end of a spectrum: closed forms, and errors of what has noise as
 * realizations have it.
 */
#include "harness.h"

#include "harness_angular.h"
#include "harness_rings.h"
#include "math/gsl/regression.h"
#include "spectra/shape/low_end.h"

#include <math.h>
#include <string.h>

/* ---- closed forms --- */

static double square(double nu) {
    return 3 * nu * nu;
}

static double linear(double nu) {
    return 0.7 * nu;
}

/* ---- regression --------------------------------------------------------------------------- */

static void regression(void **state) {
    (void)state;
    ps_regression line;
    ps_error error = {0};
    const double ones[] = {1, 1, 1};
    const double y[] = {1, 2, 6};
    const double weights[] = {1, 2, 1};
    assert_int_equal(ps_regress(&line, 3, 1, ones, y, weights, &error), PSPEC_OK);
    test_assert_near(line.coefficients[0], 2.75, 1e-14);
    test_assert_near(line.errors[0], 0.5, 1e-14); /* 1 / sqrt(1 + 2 + 1) */
    test_assert_near(line.chi2, 1.75 * 1.75 + 2 * 0.75 * 0.75 + 3.25 * 3.25, 1e-13);
    const double lines[] = {1, 0, 1, 1, 1, 2};
    const double on_line[] = {3, 5, 7};
    assert_int_equal(ps_regress(&line, 3, 2, lines, on_line, ones, &error), PSPEC_OK);
    test_assert_near(line.coefficients[0], 3, 1e-13);
    test_assert_near(line.coefficients[1], 2, 1e-13);
    test_assert_near(line.errors[1], sqrt(0.5), 1e-13); /* 1 / sqrt(sum (x - 1)^2) */
}

/* ---- the low end -------------------------------------------------------------------------- */

static ps_low_end fit(const test_rings *rings) {
    ps_low_end low;
    ps_error error = {0};
    if (ps_low_end_fit(&low, &rings->spectrum, &error) != PSPEC_OK) {
        fail_msg("%s", error.message);
    }
    return low;
}

static void closed_forms_are_found(void **state) {
    (void)state;
    test_rings memory;
    const uint64_t many = 1000000000; /* the bias of logarithms is no matter */
    static const struct {
        test_power_at *power;
        double exponent, factor;
    } laws[] = {{square, 2, 3}, {linear, 1, 0.7}, {test_power_fourth, 4, 1}};
    for (size_t i = 0; i < sizeof laws / sizeof laws[0]; i++) {
        test_rings_make(&memory, 100, 32, many, laws[i].power, 1e-6);
        const ps_low_end found = fit(&memory);
        assert_int_equal(found.shape, PS_LOW_POWER_LAW);
        assert_int_equal(found.num_bins, 8);
        test_assert_near(found.reach, 0.25, 0);
        test_assert_near(found.exponent, laws[i].exponent, 1e-8);
        test_assert_near(found.factor / laws[i].factor, 1, 1e-8);
        test_assert_near(found.curvature, 0, 1e-6);
        assert_true(found.law_chi2 < 0.01 && found.degrees_of_freedom == 5);
        test_assert_near(ps_low_end_power(&found, &memory.spectrum, &memory.bins[2]),
                         laws[i].power(3.0 / 32), 1e-8);
    }
    test_rings_make(&memory, 100, 32, many, test_power_raised, 1e-6);
    const ps_low_end found = fit(&memory);
    assert_int_equal(found.shape, PS_LOW_PLATEAU);
    test_assert_near(found.plateau, 0.006935, 1e-11);
    test_assert_near(found.square, 0.006935 * 12, 1e-9);
    assert_true(found.plateau_error > 0 && found.plateau_error < 1e-7);
    test_assert_near(ps_low_end_power(&found, &memory.spectrum, &memory.bins[2]),
                     test_power_raised(3.0 / 32), 1e-11);
}

/* Strata of the sphere have power in proportion to l(l+1), not to l^2. */
static void degrees_count_by_their_products(void **state) {
    (void)state;
    test_rings memory;
    test_rings_make(&memory, 100, 32, 1000000000, test_power_one, 0);
    memory.spectrum.frequencies.kind = PS_FREQUENCIES_DEGREES;
    for (size_t b = 0; b < memory.spectrum.num_bins; b++) {
        const double degree = memory.bins[b].frequency;
        memory.bins[b].power = degree * (degree + 1) / 1024;
        memory.bins[b].standard_error = 1e-6 * memory.bins[b].power;
    }
    const ps_low_end found = fit(&memory);
    assert_int_equal(found.num_bins, 14); /* up to sqrt(pi) / 4 */
    test_assert_near(found.exponent, 2, 1e-8);
    test_assert_near(found.factor, 1, 1e-8);
    test_assert_near(ps_low_end_power(&found, &memory.spectrum, &memory.bins[2]), 12.0 / 1024,
                     1e-9);
}

static double low_step(double nu) {
    return nu < 0.11 ? 1e-4 : 1e-2;
}

static void make_step(test_rings *rings, double relative_error) {
    test_rings_make(rings, 100, 32, 100, low_step, relative_error);
}

/* The error is that of the normal equations: of the exponent alone it is the least for given
 * relative errors, and grows by the root of (M-1)/(M-4). */
static void errors_follow_realizations(void **state) {
    (void)state;
    test_rings memory;
    test_rings_make(&memory, 100, 32, 1000000, square, 0.1);
    const double many = fit(&memory).exponent_error;
    test_rings_make(&memory, 100, 32, 1000000, square, 0.2);
    test_assert_near(fit(&memory).exponent_error / many, 2, 1e-9);
    test_rings_make(&memory, 100, 32, 10, square, 0.1);
    test_assert_near(fit(&memory).exponent_error / many, sqrt(1.5), 1e-5);
}

/* The logarithm of a mean of M count/2 exponential powers is 1/(M count) too small on average. */
static void logarithms_are_not_biased(void **state) {
    (void)state;
    test_rings memory;
    test_rings_make(&memory, 100, 32, 10, square, 1e-6);
    for (size_t b = 0; b < memory.spectrum.num_bins; b++) {
        memory.bins[b].num_computed = 10;
    }
    test_assert_near(fit(&memory).factor, 3 * exp(0.01), 1e-8);
}

/* A step among the low rings, as step noise has it, is told from both models by its chi^2, unless
 * the errors are as large as the step. */
static void a_step_is_neither(void **state) {
    (void)state;
    test_rings memory;
    make_step(&memory, 0.05);
    assert_int_equal(fit(&memory).shape, PS_LOW_NEITHER);
    make_step(&memory, 3);
    assert_int_equal(fit(&memory).shape, PS_LOW_UNDECIDED);
}

/* Exact expected powers of jittered points, with errors of 100 and of 10000 realizations: nearer to
 * 2 than a standard error. */
static void jittered_points_have_two(void **state) {
    (void)state;
    test_rings memory;
    for (uint64_t num = 100; num <= 10000; num *= 100) {
        test_rings_make(&memory, 100, 32, num, test_power_jittered, 0);
        for (size_t b = 0; b < memory.spectrum.num_bins; b++) {
            memory.bins[b].standard_error =
                memory.bins[b].power / sqrt((double)(num * memory.bins[b].count) / 2);
        }
        const ps_low_end found = fit(&memory);
        assert_int_equal(found.shape, PS_LOW_POWER_LAW);
        test_assert_near(found.exponent, 2, found.exponent_error);
        test_assert_near(found.plateau, 0, found.plateau_error);
    }
}

typedef struct coverage {
    size_t within;       /* a standard error */
    double sum, squares; /* of standard scores */
    double law_chi2;     /* over its degrees of freedom */
    size_t shapes[PS_LOW_NEITHER + 1];
} coverage;

enum { NUM_JOBS = 1000 };

/* Of many jobs: how far is the exponent, or the plateau, from what it is? */
static coverage repeat(test_power_at *power, double side, uint64_t num_realizations,
                       double exponent, double plateau) {
    coverage out = {0};
    test_rings memory;
    uint64_t state = 42;
    const size_t num_bins = 16;
    for (int job = 0; job < NUM_JOBS; job++) {
        test_rings_make(&memory, num_bins, side, num_realizations, power, 0);
        test_rings_add_noise(&memory, &state);
        const ps_low_end found = fit(&memory);
        const double score = plateau > 0 ? (found.plateau - plateau) / found.plateau_error
                                         : (found.exponent - exponent) / found.exponent_error;
        out.within += fabs(score) < 1;
        out.sum += score;
        out.squares += score * score;
        out.law_chi2 += found.law_chi2 / (double)found.degrees_of_freedom;
        out.shapes[found.shape]++;
    }
    print_message("%.3f within an error, mean score %.3f, mean square %.3f; law %zu, plateau %zu, "
                  "undecided %zu, neither %zu\n",
                  (double)out.within / NUM_JOBS, out.sum / NUM_JOBS, out.squares / NUM_JOBS,
                  out.shapes[PS_LOW_POWER_LAW], out.shapes[PS_LOW_PLATEAU],
                  out.shapes[PS_LOW_UNDECIDED], out.shapes[PS_LOW_NEITHER]);
    return out;
}

/* The share of a normal distribution is 0.683; of 1000 jobs it scatters by 0.015. */
static void assert_calibrated(const coverage *found) {
    const double share = (double)found->within / NUM_JOBS;
    assert_true(share > 0.64 && share < 0.73);
    test_assert_near(found->sum / NUM_JOBS, 0, 0.15);
    test_assert_near(found->squares / NUM_JOBS, 1, 0.2);
    test_assert_near(found->law_chi2 / NUM_JOBS, 1, 0.1);
}

static void errors_are_right(void **state) {
    (void)state;
    static const uint64_t nums[] = {10, 40};
    for (size_t i = 0; i < sizeof nums / sizeof nums[0]; i++) {
        coverage found = repeat(square, 32, nums[i], 2, 0);
        assert_calibrated(&found);
        assert_true(found.shapes[PS_LOW_POWER_LAW] > NUM_JOBS - NUM_JOBS / 100);
        found = repeat(test_power_jittered, 32, nums[i], 2, 0);
        assert_calibrated(&found);
        assert_true(found.shapes[PS_LOW_POWER_LAW] > NUM_JOBS - NUM_JOBS / 100);
        found = repeat(test_power_raised, 32, nums[i], 0, 0.006935);
        assert_calibrated(&found);
        assert_true(found.shapes[PS_LOW_PLATEAU] > NUM_JOBS - NUM_JOBS / 100);
        found = repeat(test_power_one, 32, nums[i], 0, 1);
        assert_calibrated(&found);
        assert_true(found.shapes[PS_LOW_PLATEAU] > NUM_JOBS - NUM_JOBS / 100);
        found = repeat(linear, 32, nums[i], 1, 0);
        assert_calibrated(&found);
    }
}

/* ---- nonsense ----------------------------------------------------------------------------- */

static void assert_refused(const test_rings *rings, const char *sentence) {
    ps_low_end low;
    ps_error error = {0};
    assert_int_equal(ps_low_end_fit(&low, &rings->spectrum, &error), PSPEC_ERROR_INPUT);
    if (strstr(error.message, sentence) == NULL) {
        fail_msg("\"%s\" instead of \"%s\"", error.message, sentence);
    }
}

static void nonsense_is_refused(void **state) {
    (void)state;
    test_rings memory;
    test_rings_make(&memory, 1, 32, 100, test_power_one, 0.1);
    assert_refused(&memory, "1 ring up to 0.5 of the normalized frequency is fewer than the 6");
    test_rings_make(&memory, 100, 10, 100, test_power_one, 0.1);
    assert_refused(&memory, "5 rings up to 0.5");
    test_rings_make(&memory, 100, 32, 1, test_power_one, NAN);
    assert_refused(&memory, "the standard errors of 1 realization do not carry a fit; it needs 8");
    test_rings_make(&memory, 100, 32, 100, test_power_one, 0);
    assert_refused(&memory, "ring 1 has no standard error above 0");
    memory.bins[0].standard_error = NAN;
    assert_refused(&memory, "ring 1 has no standard error above 0");
    test_rings_make(&memory, 100, 32, 100, test_power_one, 0.1);
    memory.bins[4].power = 0;
    assert_refused(&memory, "the power of ring 5 is 0, of which there is no logarithm");
    memory.spectrum.frequencies.kind = PS_FREQUENCIES_DEGREES;
    assert_refused(&memory, "the power of degree 5 is 0");
    memory.bins[4].power = NAN;
    assert_refused(&memory, "the power of degree 5");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(regression),
        cmocka_unit_test(closed_forms_are_found),
        cmocka_unit_test(degrees_count_by_their_products),
        cmocka_unit_test(errors_follow_realizations),
        cmocka_unit_test(logarithms_are_not_biased),
        cmocka_unit_test(a_step_is_neither),
        cmocka_unit_test(jittered_points_have_two),
        cmocka_unit_test(errors_are_right),
        cmocka_unit_test(nonsense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
