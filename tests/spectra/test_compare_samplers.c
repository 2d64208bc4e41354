/* pspec_spectrum_compare on spectra of samplers: how often it raises a false alarm, what it finds,
 * what it refuses. */
#include "harness_public.h"

#include "answers/check/check_sides.h"
#include "test_samplers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { N = 64, K = 8, SAVED = 32, CHECKS = 300 };

static const double rate = 0.05;

static pspec_plan *make_plan(pspec_context *context) {
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    pspec_plan *plan = NULL;
    request.num_points = N;
    request.max_frequency = K;
    request.rings_only = 1;
    request.no_self_check = 1;
    pspec_context_set_device(context, getenv("POINTSPEC_DEVICE"));
    const pspec_status status = pspec_plan_create(&plan, context, &request);
    if (status == PSPEC_ERROR_NO_DEVICE) {
        printf("%s\n", pspec_context_message(context));
        exit(TEST_SKIPPED);
    }
    if (status != PSPEC_OK) {
        fail_msg("%s", pspec_context_message(context));
    }
    return plan;
}

/* Of realizations first, first + 1, .. of a sampler. */
static pspec_spectrum *measure(pspec_context *context, pspec_plan *plan, const char *sampler,
                               uint64_t first, unsigned num) {
    const ps_sampler_request request = make_request(sampler, N, 2);
    pspec_spectrum *spectrum = NULL;
    double points[2 * N];
    const pspec_pattern pattern = {2, N, points, NULL};
    pspec_status status = pspec_plan_reset(plan);
    for (unsigned r = 0; r < num && status == PSPEC_OK; r++) {
        generate_into(&request, first + r, points);
        status = pspec_plan_run(plan, &pattern, 1);
    }
    if (status != PSPEC_OK || pspec_spectrum_create(&spectrum, plan) != PSPEC_OK) {
        fail_msg("%s", pspec_context_message(context));
    }
    return spectrum;
}

typedef struct experiment {
    const char *saved, *measured;
    unsigned num_measured;
    double least, most; /* share of checks that fail */
} experiment;

/* Every check has realizations of its own on both sides. */
static double share_of_failures(pspec_context *context, pspec_plan *plan, const experiment *what,
                                unsigned num_checks) {
    unsigned failed = 0;
    for (unsigned i = 0; i < num_checks; i++) {
        const uint64_t first = (uint64_t)i * (SAVED + what->num_measured);
        pspec_spectrum *saved = measure(context, plan, what->saved, first, SAVED);
        pspec_spectrum *measured =
            measure(context, plan, what->measured, first + SAVED, what->num_measured);
        size_t num_different = 0;
        if (pspec_spectrum_compare(saved, measured, context, rate, NULL, &num_different) !=
            PSPEC_OK) {
            fail_msg("%s", pspec_context_message(context));
        }
        failed += num_different > 0;
        pspec_spectrum_destroy(saved);
        pspec_spectrum_destroy(measured);
    }
    return (double)failed / num_checks;
}

/* The rate with a margin of 4 standard deviations of the count. */
static void rates(void **state) {
    (void)state;
    static const double at_most = 0.05 + 0.05;
    const experiment experiments[] = {
        {"white", "white", 4, 0.005, at_most},
        {"jittered", "jittered", 4, 0.005, at_most},
        {"jittered", "jittered", 1, 0.005, at_most},
        {"latin-hypercube", "latin-hypercube", 16, 0.005, at_most},
        {"sobol:scramble=owen", "sobol:scramble=owen", 4, 0, at_most},
        {"jittered", "white", 2, 1, 1},
        {"jittered", "latin-hypercube", 4, 1, 1},
        {"sobol:scramble=owen", "jittered", 4, 0.6, 1},
    };
    pspec_context *context = pspec_context_create();
    pspec_plan *plan = make_plan(context);
    for (size_t i = 0; i < sizeof experiments / sizeof experiments[0]; i++) {
        const experiment *const what = &experiments[i];
        const bool is_same = strcmp(what->saved, what->measured) == 0;
        const double share = share_of_failures(context, plan, what, is_same ? CHECKS : CHECKS / 10);
        print_message("%d sets of %s saved, %u of %s checked: %.3f fail\n", SAVED, what->saved,
                      what->num_measured, what->measured, share);
        assert_true(share >= what->least && share <= what->most);
    }
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
}

/* ---- by the referee ------------------------------------------------------------------------- */

static pspec_spectrum *measure_on_host(pspec_context *context, const pspec_power_request *request,
                                       const char *sampler, size_t num_points, unsigned num) {
    enum { MOST = 4 };
    pspec_pattern patterns[MOST];
    ps_sampler_request points = make_request(sampler, num_points, 2);
    for (unsigned r = 0; r < num; r++) {
        patterns[r] = (pspec_pattern){2, num_points, generate_points(&points, r), NULL};
    }
    pspec_spectrum *spectrum = test_public_spectrum(context, request, patterns, num);
    for (unsigned r = 0; r < num; r++) {
        free((double *)(uintptr_t)patterns[r].points);
    }
    return spectrum;
}

/* Compares, and destroys what was measured. */
static void compare_to(pspec_context *context, pspec_status expected, const char *part,
                       const pspec_spectrum *saved, pspec_spectrum *measured) {
    pspec_bin_comparison bins[64];
    const pspec_status status = pspec_spectrum_compare(saved, measured, context, rate, bins, NULL);
    assert_int_equal(status, expected);
    if (strstr(pspec_context_message(context), part) == NULL) {
        fail_msg("not \"%s\": %s", part, pspec_context_message(context));
    }
    pspec_spectrum_destroy(measured);
}

static void refusals(void **state) {
    (void)state;
    pspec_context *context = pspec_context_create();
    pspec_power_request request = test_host_request();
    pspec_spectrum *saved = measure_on_host(context, &request, "white", 16, 4);
    compare_to(context, PSPEC_ERROR_INPUT, "sets of 15 to 15 points", saved,
               measure_on_host(context, &request, "white", 15, 4));
    request.max_frequency++;
    compare_to(context, PSPEC_ERROR_INPUT, "max frequency 5 instead of 4", saved,
               measure_on_host(context, &request, "white", 16, 4));
    request.max_frequency--;
    request.normalization = PSPEC_NORMALIZATION_EFFECTIVE;
    compare_to(context, PSPEC_ERROR_INPUT, "normalization effective instead of power", saved,
               measure_on_host(context, &request, "white", 16, 4));
    request.normalization = PSPEC_NORMALIZATION_POWER;
    compare_to(context, PSPEC_ERROR_INVALID_ARGUMENT, "no two spectra", saved, NULL);
    assert_int_equal(pspec_spectrum_compare(saved, saved, NULL, rate, NULL, NULL),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(pspec_spectrum_compare(saved, saved, context, 1, NULL, NULL),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    pspec_spectrum *one = measure_on_host(context, &request, "white", 16, 1);
    compare_to(context, PSPEC_ERROR_INPUT, "save at least 2 realizations", one,
               measure_on_host(context, &request, "jittered", 16, 1));
    pspec_spectrum_destroy(one);
    pspec_spectrum_destroy(saved);
    pspec_context_destroy(context);
}

/* A set twice has standard error 0: another one differs in the ring where it does, however little.
 */
static void deterministic_sets(void **state) {
    (void)state;
    enum { POINTS = 9 };
    pspec_context *context = pspec_context_create();
    pspec_power_request request = test_host_request();
    pspec_bin_comparison bins[4];
    size_t num_different = 99;
    double points[2 * POINTS];
    const ps_sampler_request sampler = make_request("halton", POINTS, 2);
    generate_into(&sampler, 0, points);
    const pspec_pattern patterns[2] = {{2, POINTS, points, NULL}, {2, POINTS, points, NULL}};
    pspec_spectrum *saved = test_public_spectrum(context, &request, patterns, 2);
    pspec_spectrum *same = test_public_spectrum(context, &request, patterns, 1);
    points[5] += 1e-6;
    pspec_spectrum *other = test_public_spectrum(context, &request, patterns, 1);
    assert_int_equal(pspec_spectrum_compare(saved, same, context, rate, bins, &num_different), 0);
    assert_true(num_different == 0 && bins[0].p_value == 1 && bins[3].z_score == 0);
    assert_int_equal(pspec_spectrum_compare(saved, other, context, rate, bins, &num_different), 0);
    assert_true(num_different == 4 && bins[2].differs && isinf(bins[2].z_score));
    pspec_spectrum_destroy(saved);
    pspec_spectrum_destroy(same);
    pspec_spectrum_destroy(other);
    pspec_context_destroy(context);
}

/* ---- files of the library, as the program reads them ---------------------------------------- */

/* Two files of the library, one of which is the other with 100 times the power in one shell. */
static void compare_with_itself(ps_saved_spectrum *saved, const char *path) {
    enum { MOST_BINS = 64, LOUD = 2 };
    ps_comparison rows[MOST_BINS];
    ps_saved_bin bins[MOST_BINS];
    ps_saved_spectrum louder = *saved;
    const ps_check_side first = {saved, path};
    const ps_check_side second = {&louder, path};
    ps_error error;
    bool is_one = false;
    assert_int_equal(ps_saved_spectrum_find(&is_one, path, &error), PSPEC_OK);
    assert_true(is_one && saved->num_bins <= MOST_BINS);
    assert_true(saved->modes == 80 && saved->sample_size == 16);
    memcpy(bins, saved->bins, saved->num_bins * sizeof *bins);
    louder.bins = bins;
    bins[LOUD].power *= 100;
    assert_int_equal(ps_check_same_kind(&first, &second, &error), PSPEC_OK);
    assert_int_equal(ps_check_compare(rows, &first, &second, rate, &error), PSPEC_OK);
    for (size_t b = 0; b < saved->num_bins; b++) {
        assert_true(saved->bins[b].num_computed == saved->bins[b].count);
        assert_int_equal(rows[b].differs, b == LOUD);
        assert_true(b == LOUD ? rows[b].score > 3 : rows[b].p_value == 1);
    }
    bins[LOUD].frequency += 1;
    assert_int_equal(ps_check_compare(rows, &first, &second, rate, &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "the first that differs is number 3"));
    louder.max_frequency++;
    assert_int_equal(ps_check_same_kind(&first, &second, &error), PSPEC_ERROR_INPUT);
}

static void saved_files(void **state) {
    (void)state;
    char path[] = "/tmp/pointspec-test-XXXXXX";
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    close(descriptor);
    pspec_context *context = pspec_context_create();
    pspec_power_request request = test_host_request();
    request.bins = "shells";
    request.normalization = PSPEC_NORMALIZATION_EFFECTIVE;
    pspec_spectrum *spectrum = measure_on_host(context, &request, "white", 16, 3);
    ps_saved_spectrum saved;
    size_t num = 0;
    const pspec_bin *bins = pspec_spectrum_bins(spectrum, &num);
    assert_int_equal(pspec_spectrum_save(spectrum, context, path), PSPEC_OK);
    assert_ok(ps_saved_spectrum_read(&saved, path, error));
    assert_true(!saved.on_sphere && saved.dimension == 2 && saved.max_frequency == 4);
    assert_true(saved.bin_rule.kind == PS_BINS_SHELLS &&
                saved.normalization == PSPEC_NORMALIZATION_EFFECTIVE);
    assert_true(saved.num_realizations == 3 && saved.smallest_points == 16 && !saved.has_seed);
    assert_true(saved.error == pspec_spectrum_error(spectrum) && saved.num_bins == num);
    for (size_t b = 0; b < num; b++) {
        assert_true(saved.bins[b].key == bins[b].bin && saved.bins[b].power == bins[b].power);
        assert_true(saved.bins[b].standard_error == bins[b].standard_error);
    }
    compare_with_itself(&saved, path);
    ps_saved_spectrum_free(&saved);
    pspec_spectrum_destroy(spectrum);
    static const int32_t list[] = {1, 0, 2, 1};
    request.frequencies = list;
    request.num_frequencies = 2;
    request.bins = NULL;
    spectrum = measure_on_host(context, &request, "white", 16, 2);
    ps_error error = {0};
    assert_int_equal(pspec_spectrum_save(spectrum, context, path), PSPEC_OK);
    assert_int_equal(ps_saved_spectrum_read(&saved, path, &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "a list of frequencies"));
    assert_int_equal(pspec_spectrum_compare(spectrum, spectrum, context, rate, NULL, NULL),
                     PSPEC_ERROR_INPUT);
    pspec_spectrum_destroy(spectrum);
    pspec_context_destroy(context);
    unlink(path);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rates),
        cmocka_unit_test(refusals),
        cmocka_unit_test(deterministic_sets),
        cmocka_unit_test(saved_files),
        cmocka_unit_test(test_gsl_is_left_alone),
    };
    test_watch_gsl();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
