/* The profiles about a spectrum, and what is said of it in a line. */
#include "harness.h"

#include "harness_angular.h"
#include "harness_rings.h"
#include "math/pi.h"
#include "spectra/shape/bound.h"
#include "spectra/shape/shape.h"

#include <math.h>
#include <string.h>

static double step(double nu) {
    return nu < 0.8 ? 1e-9 : 1;
}

static double bent(double nu) {
    return nu < 0.5 ? 4 * nu * nu : 1;
}

/* ---- profiles ----------------------------------------------------------------------------- */

static void profiles_of_a_closed_form(void **state) {
    (void)state;
    ps_bound bound;
    ps_error error = {0};
    test_rings memory;
    test_rings_make(&memory, 200, 64, 100, bent, 0);
    assert_int_equal(ps_bound_above(&bound, &memory.spectrum, 2, &error), PSPEC_OK);
    test_assert_near(bound.gamma, 1, 0);
    test_assert_near(bound.alpha, 0.5, 1e-14);
    assert_int_equal(ps_bound_below(&bound, &memory.spectrum, 2, &error), PSPEC_OK);
    test_assert_near(bound.gamma, 1, 0);
    test_assert_near(bound.alpha, 0.5, 1e-14);
    test_assert_near(ps_bound_power(&bound, 0.25), 0.25, 1e-14);
    test_assert_near(ps_bound_power(&bound, 0.75), 1, 0);
    test_rings_make(&memory, 200, 64, 100, test_power_raised, 0);
    assert_int_equal(ps_bound_below(&bound, &memory.spectrum, 0, &error), PSPEC_OK);
    test_assert_near(bound.gamma, test_power_raised(1.0 / 64), 0);
    assert_true(bound.alpha == 0 && ps_bound_power(&bound, 0) == bound.gamma);
}

/* By many frequencies: the first is above the second somewhere, or nowhere. */
static void profiles_that_cross_are_found(void **state) {
    (void)state;
    static const ps_bound some[] = {
        {0.5, 0, 0},         {1, 0, 0},   {1, 0.5, 2}, {0.5, 0.5, 2},
        {2, 1, 2},           {1, 2, 0.5}, {1, 1, 4},   {0.25, 0.25, 4},
        {1, 0.25, INFINITY}, {0, 0, 0},   {1, 3, 2},   {0.9, 3, INFINITY},
        {0.4, 0.774597, 2},  {1, 0.2, 2}, {3, 1, 4},   {0.3, 3.5, 4}};
    enum { NUM = sizeof some / sizeof some[0] };
    for (size_t i = 0; i < NUM * (size_t)NUM; i++) {
        const ps_bounds_spec spec = {true, true, some[i / NUM], some[i % NUM]};
        bool is_above = false;
        for (double nu = 1e-6; nu < 10; nu *= 1.01) {
            is_above = is_above || ps_bound_power(&spec.below, nu) >
                                       ps_bound_power(&spec.above, nu) * (1 + 1e-9);
        }
        const double crossed = ps_bounds_find_crossed(&spec);
        assert_int_equal(is_above, crossed >= 0);
        assert_true(crossed < 0 ||
                    ps_bound_power(&spec.below, crossed) > ps_bound_power(&spec.above, crossed));
    }
}

/* The table of docs/mathematics/torus.md, Rates. */
static void rates(void **state) {
    (void)state;
    static const struct {
        double exponent;
        unsigned dimension;
        double smooth, jump;
    } known[] = {{0, 2, 1, 1},   {0.5, 2, 1.25, 1.25},         {1, 2, 1.5, 1.5}, {2, 2, 2, 1.5},
                 {4, 2, 3, 1.5}, {INFINITY, 2, INFINITY, 1.5}, {2, 1, 3, 2},     {2, 4, 1.5, 1.25}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const ps_bound bound = {1, 0.5, known[i].exponent};
        const ps_bound_rates found = ps_bound_find_rates(&bound, known[i].dimension);
        assert_true(found.smooth == known[i].smooth && found.jump == known[i].jump);
    }
}

/* With noise: three errors away everywhere, and touching at gamma and at alpha. */
static void profiles_hold_everywhere(void **state) {
    (void)state;
    ps_bound above;
    ps_bound below;
    ps_error error = {0};
    test_rings memory;
    uint64_t seed = 7;
    test_rings_make(&memory, 100, 32, 100, test_power_jittered, 0);
    test_rings_add_noise(&memory, &seed);
    assert_int_equal(ps_bound_above(&above, &memory.spectrum, 2, &error), PSPEC_OK);
    assert_int_equal(ps_bound_below(&below, &memory.spectrum, 2, &error), PSPEC_OK);
    double least = INFINITY;
    double most = 0;
    for (size_t b = 0; b < memory.spectrum.num_bins; b++) {
        const ps_spectrum_bin *const bin = &memory.bins[b];
        const double margin = 3 * bin->standard_error;
        least =
            fmin(least, ps_bound_power(&above, bin->normalized_frequency) / (bin->power + margin));
        most =
            fmax(most, ps_bound_power(&below, bin->normalized_frequency) / (bin->power - margin));
    }
    test_assert_near(least, 1, 1e-12);
    test_assert_near(most, 1, 1e-12);
    /* P15's upper bound of jittered points is gamma = 1, alpha = sqrt(3) / pi. */
    assert_true(above.gamma > 1 && above.gamma < 1.1);
    test_assert_near(above.alpha, sqrt(3) / PS_PI, 0.06);
}

static void profiles_that_there_are_not(void **state) {
    (void)state;
    ps_bound bound;
    ps_error error = {0};
    test_rings memory;
    test_rings_make(&memory, 100, 32, 100, test_power_one, 0.5);
    assert_int_equal(ps_bound_below(&bound, &memory.spectrum, 0, &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "ring 1, 1, is no more than three standard errors"));
    assert_non_null(strstr(error.message, "more realizations"));
    test_rings_make(&memory, 100, 32, 1, test_power_one, NAN);
    assert_int_equal(ps_bound_above(&bound, &memory.spectrum, 2, &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "has no standard error"));
    test_rings_make(&memory, 10, 32, 100, test_power_one, 0.01);
    assert_int_equal(ps_bound_below(&bound, &memory.spectrum, 2, &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "normalized frequency of 0.6 or above"));
    test_rings_make(&memory, 10, 32, 100, test_power_one, 0);
    for (size_t b = 0; b < 10; b++) {
        memory.bins[b].power = 0;
    }
    assert_int_equal(ps_bound_above(&bound, &memory.spectrum, 2, &error), PSPEC_ERROR_INPUT);
    assert_string_equal(error.message, "all powers are 0");
}

/* ---- features ----------------------------------------------------------------------------- */

static void features(void **state) {
    (void)state;
    test_rings memory;
    test_rings_make(&memory, 200, 64, 100, step, 0.1);
    memory.bins[99].power = 3; /* at 100 / 64 */
    memory.bins[0].anisotropy_db = -10;
    memory.bins[0].count = 6;
    memory.bins[1].anisotropy_db = -20;
    memory.bins[1].count = 3;
    const ps_features found = ps_features_find(&memory.spectrum);
    test_assert_near(found.peak, 3, 0);
    test_assert_near(found.peak_error, 0.1, 1e-15);
    test_assert_near(found.peak_frequency, 100.0 / 64, 0);
    test_assert_near(found.anisotropy_db, 10 * log10((6 * 0.1 + 3 * 0.01) / 9), 1e-12);
    /* 1 - (0.8 / nu)^2 = 0.1 */
    test_assert_near(found.effective_nyquist, 0.8 / sqrt(0.9) / 2, 0.005);
    test_rings_make(&memory, 200, 64, 100, test_power_one, 0.1);
    test_assert_near(ps_features_find(&memory.spectrum).effective_nyquist, 0, 0);
    assert_true(isnan(ps_features_find(&memory.spectrum).anisotropy_db));
    test_rings_make(&memory, 200, 64, 100, test_power_fourth, 0.1);
    memory.spectrum.num_bins = 32; /* it ends before the mean is 0.5 */
    assert_true(isnan(ps_features_find(&memory.spectrum).effective_nyquist));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(profiles_of_a_closed_form),
        cmocka_unit_test(profiles_that_cross_are_found),
        cmocka_unit_test(rates),
        cmocka_unit_test(profiles_hold_everywhere),
        cmocka_unit_test(profiles_that_there_are_not),
        cmocka_unit_test(features),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
