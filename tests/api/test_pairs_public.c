/* Pair sums through the public library: a normalization of angular spectra. */
#include "harness_angular.h"

static void sums(void **state) {
    (void)state;
    static const double pair[] = {0.36, 0.48, 0.8, -0.36, -0.48, -0.8};
    static const double weights[] = {3, -1};
    pspec_context *context = pspec_context_create();
    pspec_angular_request request = test_angular_request();
    request.normalization = PSPEC_NORMALIZATION_PAIRS;
    const pspec_pattern patterns[] = {{3, 2, pair, NULL}, {3, 2, pair, weights}};
    const double even[] = {1, 4}, odd[] = {0, 16};
    for (size_t i = 0; i < 2; i++) {
        pspec_spectrum *spectrum = test_estimate_angular(context, &request, &patterns[i], 1);
        size_t num = 0;
        const pspec_bin *bins = pspec_spectrum_bins(spectrum, &num);
        assert_int_equal(num, TEST_MAX_DEGREE);
        for (size_t b = 0; b < num; b++) {
            test_assert_near(bins[b].power, bins[b].bin % 2 == 0 ? even[i] : odd[i], 1e-14);
        }
        pspec_spectrum_destroy(spectrum);
    }
    pspec_context_destroy(context);
}

static void only_on_the_sphere(void **state) {
    (void)state;
    pspec_context *context = pspec_context_create();
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    pspec_plan *plan = NULL;
    request.max_frequency = 2;
    request.engine = "host_direct";
    request.normalization = PSPEC_NORMALIZATION_PAIRS;
    assert_int_equal(pspec_plan_create(&plan, context, &request), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_null(plan);
    pspec_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(sums),
                                       cmocka_unit_test(only_on_the_sphere)};
    return cmocka_run_group_tests_name("pairs_public", tests, NULL, NULL);
}
