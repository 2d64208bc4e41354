/* Spectra of spectra: parts that are merged are the whole, what does not belong together is
 * refused. */
#include "harness_public.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { REALIZATIONS = 9 };

static bool has_fp64;

/* Every way to cut the realizations into three parts, one of them possibly merged before. */
static void check_merges(pspec_context *context, const pspec_power_request *request,
                         const test_sample *what, bool with_powers) {
    pspec_spectrum *whole = test_public_spectrum(context, request, what->patterns, what->num);
    for (size_t cut = 1; cut + 1 < what->num; cut += 2) {
        pspec_spectrum *parts[3] = {
            test_public_spectrum(context, request, what->patterns, cut),
            test_public_spectrum(context, request, what->patterns + cut, 1),
            test_public_spectrum(context, request, what->patterns + cut + 1, what->num - cut - 1)};
        const pspec_spectrum *const three[] = {parts[0], parts[1], parts[2]};
        pspec_spectrum *merged = NULL;
        pspec_spectrum *pair = NULL;
        pspec_spectrum *twice = NULL;
        assert_int_equal(pspec_spectrum_merge(&merged, context, three, 3), PSPEC_OK);
        assert_true(test_is_same_spectrum(whole, merged, with_powers));
        assert_int_equal(pspec_spectrum_merge(&pair, context, three + 1, 2), PSPEC_OK);
        const pspec_spectrum *const two[] = {parts[0], pair};
        assert_int_equal(pspec_spectrum_merge(&twice, context, two, 2), PSPEC_OK);
        assert_true(test_is_same_spectrum(whole, twice, with_powers));
        for (size_t i = 0; i < 3; i++) {
            pspec_spectrum_destroy(parts[i]);
        }
        pspec_spectrum_destroy(merged);
        pspec_spectrum_destroy(pair);
        pspec_spectrum_destroy(twice);
    }
    pspec_spectrum_destroy(whole);
}

static void merged_parts_are_the_whole(void **state) {
    (void)state;
    pspec_context *context = pspec_context_create();
    pspec_context_set_device(context, getenv("POINTSPEC_DEVICE"));
    for (int weighted = 0; weighted < 2; weighted++) {
        test_sample what = test_make_sample(REALIZATIONS, 2, TEST_NUM_POINTS, 0, weighted != 0);
        pspec_power_request request = test_host_request();
        check_merges(context, &request, &what, true);
        request.bins = "shells";
        request.normalization = PSPEC_NORMALIZATION_EFFECTIVE;
        check_merges(context, &request, &what, true);
        request = test_host_request();
        request.engine = "torus_direct";
        request.precision = "single";
        check_merges(context, &request, &what, false);
        if (has_fp64) {
            request.precision = "double";
            check_merges(context, &request, &what, true);
        }
        test_free_sample(&what);
    }
    pspec_context_destroy(context);
}

/* Parts whose plans expected other numbers of points have sums in other units, where they are for
 * integrals. */
static void check_other_numbers(pspec_normalization normalization) {
    pspec_context *context = pspec_context_create();
    test_sample what = test_make_sample(REALIZATIONS, 2, TEST_NUM_POINTS, 7, true);
    pspec_power_request request = test_host_request();
    request.normalization = normalization;
    pspec_spectrum *whole = test_public_spectrum(context, &request, what.patterns, REALIZATIONS);
    pspec_spectrum *first = test_public_spectrum(context, &request, what.patterns, 4);
    request.num_points = 77;
    pspec_spectrum *second =
        test_public_spectrum(context, &request, what.patterns + 4, REALIZATIONS - 4);
    const pspec_spectrum *const parts[] = {first, second};
    pspec_spectrum *merged = NULL;
    size_t num = 0;
    assert_int_equal(pspec_spectrum_merge(&merged, context, parts, 2), PSPEC_OK);
    pspec_spectrum_frequencies(whole, &num);
    for (size_t i = 0; i < num; i++) {
        const double power = pspec_spectrum_powers(whole)[i];
        const double error = pspec_spectrum_standard_errors(whole)[i];
        assert_true(fabs(pspec_spectrum_powers(merged)[i] / power - 1) < 1e-15);
        assert_true(fabs(pspec_spectrum_standard_errors(merged)[i] / error - 1) < 1e-14);
    }
    assert_true(pspec_spectrum_mean_points(merged) == pspec_spectrum_mean_points(whole));
    pspec_spectrum_destroy(whole);
    pspec_spectrum_destroy(first);
    pspec_spectrum_destroy(second);
    pspec_spectrum_destroy(merged);
    test_free_sample(&what);
    pspec_context_destroy(context);
}

static void other_numbers_of_points(void **state) {
    (void)state;
    check_other_numbers(PSPEC_NORMALIZATION_POWER);
    check_other_numbers(PSPEC_NORMALIZATION_INTEGRAL);
}

static void check_refused(pspec_context *context, const pspec_spectrum *a,
                          const pspec_power_request *request, const test_sample *what,
                          const char *part) {
    pspec_spectrum *b = test_public_spectrum(context, request, what->patterns, 1);
    const pspec_spectrum *const both[] = {a, a, b};
    pspec_spectrum *merged = NULL;
    assert_int_equal(pspec_spectrum_merge(&merged, context, both, 3), PSPEC_ERROR_INPUT);
    assert_null(merged);
    assert_non_null(strstr(pspec_context_message(context), "spectrum 3 of those to merge"));
    if (strstr(pspec_context_message(context), part) == NULL) {
        fail_msg("\"%s\" is not in \"%s\"", part, pspec_context_message(context));
    }
    pspec_spectrum_destroy(b);
}

static void what_differs_is_not_merged(void **state) {
    (void)state;
    static const int32_t list[] = {1, 2, 3, 4};
    static const int32_t other_list[] = {1, 2, 3, 5};
    pspec_context *context = pspec_context_create();
    test_sample what = test_make_sample(1, 2, TEST_NUM_POINTS, 0, false);
    test_sample solid = test_make_sample(1, 3, TEST_NUM_POINTS, 0, false);
    pspec_power_request request = test_host_request();
    pspec_spectrum *merged = NULL;
    assert_int_equal(pspec_spectrum_merge(&merged, context, NULL, 0), PSPEC_ERROR_INVALID_ARGUMENT);
    pspec_spectrum *a = test_public_spectrum(context, &request, what.patterns, 1);
    request.dimension = 3;
    check_refused(context, a, &request, &solid, "dimension 3 instead of 2");
    request = test_host_request();
    request.max_frequency = 5;
    check_refused(context, a, &request, &what, "max frequency 5 instead of 4");
    request = test_host_request();
    request.rings_only = 1;
    check_refused(context, a, &request, &what, "of rings instead of the frequencies of a box");
    request = test_host_request();
    request.bins = "shells";
    check_refused(context, a, &request, &what, "bins by shells instead of round");
    request.bins = "floor";
    check_refused(context, a, &request, &what, "bins by floor instead of round");
    request = test_host_request();
    request.normalization = PSPEC_NORMALIZATION_EFFECTIVE;
    check_refused(context, a, &request, &what, "effective instead of power");
    request = test_host_request();
    request.frequencies = list;
    request.num_frequencies = 2;
    check_refused(context, a, &request, &what, "a list of frequencies instead of");
    pspec_spectrum *b = test_public_spectrum(context, &request, what.patterns, 1);
    request.frequencies = other_list;
    check_refused(context, b, &request, &what, "another frequency 2");
    request.num_frequencies = 1;
    check_refused(context, b, &request, &what, "1 frequencies instead of 2");
    pspec_spectrum_destroy(a);
    pspec_spectrum_destroy(b);
    test_free_sample(&what);
    test_free_sample(&solid);
    pspec_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(merged_parts_are_the_whole),
        cmocka_unit_test(other_numbers_of_points),
        cmocka_unit_test(what_differs_is_not_merged),
        cmocka_unit_test(test_gsl_is_left_alone),
    };
    test_watch_gsl();
    ps_device *device = test_open_device(); /* ends as skipped when there is none */
    has_fp64 = ps_device_get_limits(device)->has_fp64;
    ps_device_close(device);
    return cmocka_run_group_tests_name("spectrum_merge", tests, NULL, NULL);
}
