/* Rates of variances that follow from the low end of a spectrum, and those that do not. */
#include "harness.h"

#include "harness_angular.h"
#include "harness_rings.h"
#include "spectra/shape/shape.h"

#include <math.h>

/* A law, with as good a fit as one has on average. */
static ps_low_end make_law(double exponent, double exponent_error) {
    return (ps_low_end){.shape = PS_LOW_POWER_LAW,
                        .exponent = exponent,
                        .exponent_error = exponent_error,
                        .plateau = -0.001,
                        .plateau_error = 0.002,
                        .law_chi2 = 10,
                        .plateau_chi2 = 1000,
                        .degrees_of_freedom = 10};
}

static ps_convergence find(const ps_low_end *low, unsigned dimension) {
    test_rings rings;
    test_rings_make(&rings, 10, 32, 100, test_power_one, 0.1);
    rings.spectrum.frequencies.dimension = dimension;
    return ps_convergence_find(low, &rings.spectrum);
}

static void laws_have_the_rates_of_their_exponents(void **state) {
    (void)state;
    static const struct {
        double exponent;
        unsigned dimension;
        double smooth, jump;
        bool is_known; /* the jump: whatever the exponent is within its error */
    } laws[] = {{2, 2, 2, 1.5, true},       {2, 1, 3, 2, true},      {2, 3, 5. / 3, 4. / 3, true},
                {4, 2, 3, 1.5, true},       {1, 2, 1.5, 1.5, false}, {0.5, 2, 1.25, 1.25, false},
                {1.08, 2, 1.54, 1.5, false}};
    for (size_t i = 0; i < sizeof laws / sizeof laws[0]; i++) {
        const ps_low_end low = make_law(laws[i].exponent, 0.03);
        const ps_convergence found = find(&low, laws[i].dimension);
        assert_int_equal(found.kind, PS_CONVERGENCE_FAST);
        test_assert_near(found.smooth, laws[i].smooth, 1e-15);
        test_assert_near(found.smooth_error, 0.03 / laws[i].dimension, 1e-15);
        test_assert_near(found.jump, laws[i].jump, 1e-15);
        test_assert_near(found.jump_error, laws[i].is_known ? 0 : 0.03 / laws[i].dimension, 1e-15);
        test_assert_near(found.most_plateau, 0.006, 1e-15);
    }
}

static void powers_that_rise_converge_slowly(void **state) {
    (void)state;
    const ps_low_end low = make_law(-1, 0.1);
    const ps_convergence found = find(&low, 2);
    assert_int_equal(found.kind, PS_CONVERGENCE_SLOW);
    test_assert_near(found.smooth, 0.5, 1e-15);
    test_assert_near(found.jump, 0.5, 1e-15);
}

static void plateaus_are_like_white_noise(void **state) {
    (void)state;
    ps_low_end low = make_law(0.1, 0.1);
    low.shape = PS_LOW_PLATEAU;
    low.plateau_chi2 = 10;
    low.plateau = 0.25; /* the first ring has 1 */
    const ps_convergence found = find(&low, 2);
    assert_int_equal(found.kind, PS_CONVERGENCE_WHITE);
    assert_true(found.smooth == 1 && found.jump == 1 && found.jump_error == 0);
    low.plateau = 0.249;
    assert_int_equal(find(&low, 2).kind, PS_CONVERGENCE_FAINT);
    assert_true(isnan(find(&low, 2).smooth));
}

static void what_is_not_known_has_no_number(void **state) {
    (void)state;
    ps_low_end low = make_law(2, 0.1);
    low.law_chi2 = 33; /* 10 + 5 sqrt 20 = 32.4 */
    ps_convergence found = find(&low, 2);
    assert_int_equal(found.kind, PS_CONVERGENCE_UNFIT);
    assert_true(isnan(found.smooth) && isnan(found.jump) && isnan(found.jump_error));
    low.law_chi2 = 32;
    assert_int_equal(find(&low, 2).kind, PS_CONVERGENCE_FAST);
    low.shape = PS_LOW_PLATEAU;
    assert_int_equal(find(&low, 2).kind, PS_CONVERGENCE_UNFIT);
    low.shape = PS_LOW_UNDECIDED;
    found = find(&low, 2);
    assert_int_equal(found.kind, PS_CONVERGENCE_UNKNOWN);
    assert_true(isnan(found.smooth) && isnan(found.most_plateau));
}

/* The error of s^2/P^2 is (1/M) sqrt((2 + 6/M) / n), n half of the frequencies. */
static void what_depends_on_the_direction_is_not_told(void **state) {
    (void)state;
    ps_low_end low = make_law(0.5, 0.07);
    test_rings rings;
    low.num_bins = 7;
    test_rings_make(&rings, 10, 32, 40, test_power_one, 0.1);
    double num = 0;
    for (size_t b = 1; b < 7; b++) {
        num += (double)rings.bins[b].count / 2;
    }
    const double most = 0.1 + 1. / 40 + 3. / 40 * sqrt((2 + 6. / 40) / num);
    for (int i = 0; i < 2; i++) {
        for (size_t b = 0; b < 10; b++) {
            const double own = b == 0 || b >= 7 ? 5 : most + (i == 0 ? -1e-4 : 1e-4);
            rings.bins[b].anisotropy_db = 10 * log10(own);
        }
        const ps_convergence found = ps_convergence_find(&low, &rings.spectrum);
        assert_int_equal(found.kind, i == 0 ? PS_CONVERGENCE_FAST : PS_CONVERGENCE_MIXED);
        assert_true(isnan(found.smooth) == (i == 1));
        test_assert_near(found.anisotropy, most - 1. / 40, 2e-4);
    }
    assert_true(isnan(find(&low, 2).anisotropy)); /* the rings have none */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(laws_have_the_rates_of_their_exponents),
        cmocka_unit_test(powers_that_rise_converge_slowly),
        cmocka_unit_test(plateaus_are_like_white_noise),
        cmocka_unit_test(what_is_not_known_has_no_number),
        cmocka_unit_test(what_depends_on_the_direction_is_not_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
