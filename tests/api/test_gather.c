/* Plans of the public library: calls of any size give the same bits, failures have a number and a
 * way out, callbacks are called.
 */
#include "harness_public.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NUM_POINTS = 20, REALIZATIONS = 37, K = 5 };

typedef struct engine_case {
    const char *engine, *precision;
} engine_case;

static const engine_case cases[] = {
    {"torus_direct", "single"}, {"torus_direct", "double"}, {"host_direct", "extended"}};

static bool has_fp64;

static pspec_context *make_context(void) {
    pspec_context *context = pspec_context_create();
    assert_int_equal(pspec_context_set_device(context, getenv("POINTSPEC_DEVICE")), PSPEC_OK);
    return context;
}

/* Batches of `batch` on a device: the number of realizations that is expected bounds them. */
static pspec_plan *make_plan(pspec_context *context, const engine_case *which, uint64_t batch) {
    pspec_plan *plan = NULL;
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    request.num_points = NUM_POINTS;
    request.num_realizations = batch;
    request.max_frequency = K;
    request.engine = which->engine;
    request.precision = which->precision;
    if (pspec_plan_create(&plan, context, &request) != PSPEC_OK) {
        fail_msg("%s", pspec_context_message(context));
    }
    return plan;
}

static void run(pspec_context *context, pspec_plan *plan, const pspec_pattern *patterns,
                size_t num) {
    if (pspec_plan_run(plan, patterns, num) != PSPEC_OK) {
        fail_msg("%s", pspec_context_message(context));
    }
}

static pspec_spectrum *take(pspec_context *context, pspec_plan *plan) {
    pspec_spectrum *spectrum = NULL;
    if (pspec_spectrum_create(&spectrum, plan) != PSPEC_OK) {
        fail_msg("%s", pspec_context_message(context));
    }
    return spectrum;
}

static void assert_same_bits(const pspec_spectrum *a, const pspec_spectrum *b) {
    size_t num = 0;
    size_t num_b = 0;
    const pspec_bin *bins = pspec_spectrum_bins(a, &num);
    const pspec_bin *bins_b = pspec_spectrum_bins(b, &num_b);
    assert_int_equal(num, num_b);
    assert_memory_equal(bins, bins_b, num * sizeof *bins);
    pspec_spectrum_frequencies(a, &num);
    pspec_spectrum_frequencies(b, &num_b);
    assert_int_equal(num, num_b);
    assert_memory_equal(pspec_spectrum_powers(a), pspec_spectrum_powers(b), num * sizeof(double));
    assert_memory_equal(pspec_spectrum_standard_errors(a), pspec_spectrum_standard_errors(b),
                        num * sizeof(double));
    assert_int_equal(pspec_spectrum_num_realizations(a), pspec_spectrum_num_realizations(b));
}

/* A third of the patterns are larger than the plan expects, half of them have weights. */
static test_sample make_patterns(void) {
    test_sample what = test_make_sample(REALIZATIONS, 2, NUM_POINTS, 0, true);
    test_sample large = test_make_sample(REALIZATIONS, 2, 3 * NUM_POINTS, 1, false);
    for (size_t r = 0; r < REALIZATIONS; r += 2) {
        const pspec_pattern kept = what.patterns[r];
        const bool swap = r % 3 == 0;
        what.patterns[r] = swap ? large.patterns[r] : kept;
        large.patterns[r] = swap ? kept : large.patterns[r];
    }
    test_free_sample(&large);
    return what;
}

static void check_calls(const engine_case *which) {
    static const size_t batches[] = {1, 3, 8, REALIZATIONS, 0};
    static const size_t sizes[] = {1, 2, 5, 8, 20, REALIZATIONS};
    test_sample what = make_patterns();
    pspec_context *context = make_context();
    pspec_spectrum *first = NULL;
    for (size_t b = 0; b < sizeof batches / sizeof batches[0]; b++) {
        pspec_plan *plan = make_plan(context, which, batches[b]);
        for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
            assert_int_equal(pspec_plan_reset(plan), PSPEC_OK);
            for (size_t r = 0; r < REALIZATIONS; r += sizes[i]) {
                const size_t rest = REALIZATIONS - r;
                run(context, plan, what.patterns + r, rest < sizes[i] ? rest : sizes[i]);
            }
            pspec_spectrum *again = take(context, plan);
            first = first != NULL ? first : again;
            assert_same_bits(first, again);
            if (again != first) {
                pspec_spectrum_destroy(again);
            }
        }
        pspec_plan_destroy(plan);
    }
    pspec_spectrum_destroy(first);
    pspec_context_destroy(context);
    test_free_sample(&what);
}

static void same_bits_for_every_call_size(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        if (has_fp64 || strcmp(cases[i].precision, "double") != 0) {
            check_calls(&cases[i]);
        }
    }
}

/* The caller's arrays may be used for something else after every call. */
static void nothing_is_borrowed(void **state) {
    (void)state;
    test_sample what = test_make_sample(REALIZATIONS, 2, NUM_POINTS, 0, true);
    pspec_context *context = make_context();
    pspec_plan *plan = make_plan(context, &cases[0], 0);
    run(context, plan, what.patterns, REALIZATIONS);
    pspec_spectrum *expected = take(context, plan);
    assert_int_equal(pspec_plan_reset(plan), PSPEC_OK);
    for (size_t r = 0; r < REALIZATIONS; r++) {
        double points[2 * NUM_POINTS];
        double weights[NUM_POINTS];
        memcpy(points, what.patterns[r].points, sizeof points);
        memcpy(weights, what.patterns[r].weights, sizeof weights);
        const pspec_pattern pattern = {2, NUM_POINTS, points, weights};
        run(context, plan, &pattern, 1);
        memset(points, 0xff, sizeof points);
        memset(weights, 0xff, sizeof weights);
    }
    pspec_spectrum *found = take(context, plan);
    assert_same_bits(expected, found);
    pspec_spectrum_destroy(expected);
    pspec_spectrum_destroy(found);
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
    test_free_sample(&what);
}

/* A spectrum in between changes nothing of what follows. */
static void snapshots_do_not_disturb(void **state) {
    (void)state;
    test_sample what = test_make_sample(REALIZATIONS, 2, NUM_POINTS, 0, false);
    pspec_context *context = make_context();
    pspec_plan *plan = make_plan(context, &cases[0], 8);
    run(context, plan, what.patterns, REALIZATIONS);
    pspec_spectrum *expected = take(context, plan);
    assert_int_equal(pspec_plan_reset(plan), PSPEC_OK);
    for (size_t r = 0; r < REALIZATIONS; r++) {
        run(context, plan, &what.patterns[r], 1);
        pspec_spectrum *snapshot = take(context, plan);
        assert_int_equal(pspec_spectrum_num_realizations(snapshot), r + 1);
        if (r + 1 == REALIZATIONS) {
            assert_same_bits(expected, snapshot);
        }
        pspec_spectrum_destroy(snapshot);
    }
    pspec_spectrum_destroy(expected);
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
    test_free_sample(&what);
}

/* ---- failures ---------------------------------------------------------------------------- */

static void assert_says(const pspec_context *context, const char *part) {
    if (strstr(pspec_context_message(context), part) == NULL) {
        fail_msg("\"%s\" is not in \"%s\"", part, pspec_context_message(context));
    }
}

static void errors_name_the_realization(void **state) {
    (void)state;
    static const size_t sizes[] = {1, 2, 5, 30};
    test_sample what = test_make_sample(30, 2, NUM_POINTS, 0, false);
    pspec_context *context = make_context();
    pspec_plan *plan = make_plan(context, &cases[0], 4);
    pspec_spectrum *spectrum = NULL;
    ((double *)what.patterns[17].points)[7] = NAN;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        pspec_status status = PSPEC_OK;
        for (size_t r = 0; r < 30 && status == PSPEC_OK; r += sizes[i]) {
            const size_t rest = 30 - r;
            status = pspec_plan_run(plan, what.patterns + r, rest < sizes[i] ? rest : sizes[i]);
        }
        assert_int_equal(status, PSPEC_ERROR_INPUT);
        assert_says(context, "set 18, point 4: coordinate nan");
        assert_int_equal(pspec_plan_run(plan, what.patterns, 1), PSPEC_ERROR_INVALID_ARGUMENT);
        assert_says(context, "pspec_plan_reset");
        assert_int_equal(pspec_spectrum_create(&spectrum, plan), PSPEC_ERROR_INVALID_ARGUMENT);
        assert_null(spectrum);
        assert_int_equal(pspec_plan_reset(plan), PSPEC_OK);
        assert_int_equal(pspec_spectrum_create(&spectrum, plan), PSPEC_ERROR_INPUT); /* empty */
    }
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
    test_free_sample(&what);
}

static void null_arguments_are_refused(void **state) {
    (void)state;
    const pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    pspec_plan *plan = NULL;
    pspec_spectrum *spectrum = NULL;
    assert_int_equal(pspec_plan_create(&plan, NULL, &request), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(pspec_plan_run(NULL, NULL, 0), PSPEC_ERROR_INVALID_ARGUMENT);
    pspec_context *context = make_context();
    assert_int_equal(pspec_plan_create(&plan, context, NULL), PSPEC_ERROR_INVALID_ARGUMENT);
    plan = make_plan(context, &cases[2], 1);
    assert_int_equal(pspec_plan_run(plan, NULL, 0), PSPEC_OK);
    assert_int_equal(pspec_plan_run(plan, NULL, 2), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_says(context, "2 patterns at the address NULL");
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
    assert_int_equal(pspec_plan_reset(NULL), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(pspec_spectrum_create(&spectrum, NULL), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(pspec_spectrum_load(&spectrum, NULL, "x"), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(pspec_context_message(NULL), "no context"));
}

/* ---- callbacks and limits ---------------------------------------------------------------- */

typedef struct watcher {
    uint64_t calls, last, total, stop_at;
} watcher;

static int watch(const pspec_progress_report *report, void *payload) {
    const uint64_t done = report->done;
    watcher *seen = payload;
    assert_true(done >= seen->last);
    seen->calls++;
    seen->last = done;
    seen->total = report->total;
    assert_string_equal(report->phase, "realizations");
    return seen->stop_at > 0 && done >= seen->stop_at;
}

static void progress_counts_and_cancels(void **state) {
    (void)state;
    test_sample what = test_make_sample(REALIZATIONS, 2, NUM_POINTS, 0, false);
    pspec_context *context = make_context();
    pspec_plan *plan = make_plan(context, &cases[0], 8);
    watcher seen = {0};
    pspec_spectrum *spectrum = NULL;
    pspec_context_set_progress(context, watch, &seen);
    run(context, plan, what.patterns, REALIZATIONS);
    pspec_spectrum *expected = take(context, plan);
    assert_true(seen.calls >= REALIZATIONS / 8 && seen.last == REALIZATIONS && seen.total == 8);
    assert_int_equal(pspec_plan_reset(plan), PSPEC_OK);
    seen = (watcher){.stop_at = 20};
    assert_int_equal(pspec_plan_run(plan, what.patterns, REALIZATIONS), PSPEC_ERROR_CANCELLED);
    assert_says(context, "cancelled by the progress callback after 24 realizations");
    assert_int_equal(pspec_spectrum_create(&spectrum, plan), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(pspec_plan_reset(plan), PSPEC_OK);
    pspec_context_set_progress(context, NULL, NULL);
    run(context, plan, what.patterns, REALIZATIONS);
    pspec_spectrum *again = take(context, plan);
    assert_same_bits(expected, again);
    pspec_spectrum_destroy(expected);
    pspec_spectrum_destroy(again);
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
    test_free_sample(&what);
}

static int stop_at_once(const pspec_progress_report *report, void *payload) {
    (void)report;
    (void)payload;
    return 1;
}

/* The referee takes a second for this one pattern; a cancel inside it must come through. */
static void one_long_batch_is_cancelled(void **state) {
    (void)state;
    test_sample what = test_make_sample(1, 2, 100000, 0, false);
    pspec_context *context = make_context();
    pspec_plan *plan = make_plan(context, &cases[2], 1);
    watcher seen = {0};
    pspec_context_set_progress(context, watch, &seen);
    run(context, plan, what.patterns, 1);
    assert_true(seen.calls >= 2); /* inside, and at the end */
    assert_int_equal(pspec_plan_reset(plan), PSPEC_OK);
    pspec_context_set_progress(context, stop_at_once, NULL);
    assert_int_equal(pspec_plan_run(plan, what.patterns, 1), PSPEC_ERROR_CANCELLED);
    assert_says(context, "after 0 realizations");
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
    test_free_sample(&what);
}

typedef struct listener {
    size_t num;
    char text[8192];
} listener;

static void listen_to(const char *sentence, void *payload) {
    listener *heard = payload;
    const size_t length = strlen(heard->text);
    heard->num++;
    assert_null(strchr(sentence, '\n'));
    snprintf(heard->text + length, sizeof heard->text - length, "%s\n", sentence);
}

static void the_log_says_what_is_done(void **state) {
    (void)state;
    test_sample what = test_make_sample(1, 2, 3 * NUM_POINTS, 0, false);
    pspec_context *context = make_context();
    listener heard = {0};
    pspec_context_set_log(context, listen_to, &heard);
    pspec_plan *plan = make_plan(context, &cases[0], 8);
    assert_non_null(strstr(heard.text, "opened the device"));
    assert_non_null(strstr(heard.text, "torus_direct in single precision, chosen"));
    assert_non_null(strstr(heard.text, pspec_plan_text(plan)));
    run(context, plan, what.patterns, 1);
    pspec_spectrum_destroy(take(context, plan));
    assert_non_null(strstr(heard.text, "60 points, more than 20"));
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
    test_free_sample(&what);
}

/* Down to the limit that nothing fits, batches get smaller and bits stay. */
static void memory_limits_are_obeyed(void **state) {
    (void)state;
    test_sample what = test_make_sample(REALIZATIONS, 2, NUM_POINTS, 0, false);
    pspec_context *context = make_context();
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    listener heard = {0};
    size_t num_smaller = 0;
    pspec_spectrum *expected = NULL;
    pspec_plan *plan = NULL;
    request.num_points = NUM_POINTS;
    request.num_realizations = REALIZATIONS;
    request.max_frequency = K;
    request.engine = "torus_direct";
    request.precision = "single";
    pspec_context_set_log(context, listen_to, &heard);
    for (uint64_t limit = (uint64_t)1 << 24; limit > 0; limit -= limit / 8) {
        heard = (listener){0};
        pspec_context_set_memory_limit(context, limit);
        if (pspec_plan_create(&plan, context, &request) != PSPEC_OK) {
            break;
        }
        num_smaller += strstr(heard.text, " 37 realizations at a time") == NULL;
        run(context, plan, what.patterns, REALIZATIONS);
        pspec_spectrum *found = take(context, plan);
        expected = expected != NULL ? expected : found;
        assert_same_bits(expected, found);
        if (found != expected) {
            pspec_spectrum_destroy(found);
        }
        pspec_plan_destroy(plan);
    }
    assert_null(plan);
    assert_true(num_smaller > 0);
    assert_says(context, "above the limit of");
    assert_int_equal(pspec_plan_create(&plan, context, &request), PSPEC_ERROR_MEMORY);
    pspec_spectrum_destroy(expected);
    pspec_context_destroy(context);
    test_free_sample(&what);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_bits_for_every_call_size),
        cmocka_unit_test(nothing_is_borrowed),
        cmocka_unit_test(snapshots_do_not_disturb),
        cmocka_unit_test(errors_name_the_realization),
        cmocka_unit_test(null_arguments_are_refused),
        cmocka_unit_test(progress_counts_and_cancels),
        cmocka_unit_test(one_long_batch_is_cancelled),
        cmocka_unit_test(the_log_says_what_is_done),
        cmocka_unit_test(memory_limits_are_obeyed),
        cmocka_unit_test(test_gsl_is_left_alone),
    };
    test_watch_gsl();
    ps_device *device = test_open_device(); /* ends as skipped when there is none */
    has_fp64 = ps_device_get_limits(device)->has_fp64;
    ps_device_close(device);
    return cmocka_run_group_tests_name("gather", tests, NULL, NULL);
}
