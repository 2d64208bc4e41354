/* Arrays of spectra are used again: by size, only large ones, by whoever is left; and what was in
 * them shows in no spectrum.
 */
#include "harness_public.h"

#include "api/public_plan.h"
#include "spectra/spares.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { LARGE = 1 << 20, SMALL = 1000 }; /* doubles: 8 MB and less than is kept */

static double *take(ps_spares *spares, size_t num) {
    double *array = NULL;
    assert_ok(PS_TAKE(spares, &array, num, "an array", error));
    return array;
}

static void arrays_come_back_by_size(void **state) {
    (void)state;
    ps_spares *spares = NULL;
    assert_ok(ps_spares_create(&spares, UINT64_MAX, error));
    double *const first = take(spares, LARGE);
    double *const second = take(spares, 2 * (size_t)LARGE);
    first[LARGE - 1] = 7;
    second[LARGE] = 9;
    ps_spares_give(spares, first, LARGE * sizeof *first);
    ps_spares_give(spares, second, 2 * (size_t)LARGE * sizeof *second);
    assert_ptr_equal(take(spares, 2 * (size_t)LARGE), second);
    assert_ptr_equal(take(spares, LARGE), first);
    double *const third = take(spares, LARGE); /* both are gone: a new one, all 0 */
    assert_true(third != first && third[LARGE - 1] == 0);
    free(first);
    free(second);
    free(third);
    ps_spares_leave(spares);
}

/* More than are kept, and small ones, are freed: the sanitizers' business. */
static void the_rest_is_freed(void **state) {
    (void)state;
    enum { MANY = 9 };
    double *arrays[MANY];
    ps_spares *spares = NULL;
    assert_ok(ps_spares_create(&spares, UINT64_MAX, error));
    ps_spares *const other = ps_spares_share(spares);
    for (size_t i = 0; i < MANY; i++) {
        arrays[i] = take(spares, i == 0 ? SMALL : LARGE);
    }
    for (size_t i = 0; i < MANY; i++) {
        ps_spares_give(spares, arrays[i], (i == 0 ? SMALL : LARGE) * sizeof(double));
    }
    ps_spares_leave(spares);
    double *const kept = take(other, LARGE);
    ps_spares_give(other, kept, LARGE * sizeof *kept);
    ps_spares_leave(other);
    ps_spares_give(NULL, take(NULL, LARGE), LARGE * sizeof(double));
    ps_spares_leave(ps_spares_share(NULL));
}

static void no_more_than_is_allowed(void **state) {
    (void)state;
    enum { HALF = LARGE / 2 };
    const uint64_t bytes = LARGE * sizeof(double);
    ps_spares *spares = NULL;
    assert_ok(ps_spares_create(&spares, 2 * bytes - 1, error));
    ps_spares *const other = ps_spares_share(spares);
    double *const arrays[] = {take(NULL, LARGE), take(NULL, LARGE), take(NULL, HALF)};
    ps_spares_give(spares, arrays[0], bytes);
    assert_int_equal(ps_spares_bytes(spares), bytes);
    ps_spares_give(spares, arrays[1], bytes);
    assert_int_equal(ps_spares_bytes(spares), bytes); /* two are a byte too much */
    ps_spares_give(spares, arrays[2], bytes / 2);
    assert_int_equal(ps_spares_bytes(spares), bytes + bytes / 2);
    double *const taken = take(spares, LARGE);
    assert_ptr_equal(taken, arrays[0]);
    assert_int_equal(ps_spares_bytes(spares), bytes / 2);
    ps_spares_close(spares);
    assert_int_equal(ps_spares_bytes(other), 0);
    ps_spares_give(other, taken, bytes);
    assert_int_equal(ps_spares_bytes(other), 0);
    ps_spares_leave(other);
}

/* As large as arrays must be to be kept. */
static pspec_power_request large_request(void) {
    enum { LARGE_K = 600 };
    pspec_power_request request = test_host_request();
    request.engine = "torus_nufft";
    request.precision = "single";
    request.max_frequency = LARGE_K;
    request.tolerance = 1e-2;
    return request;
}

static pspec_spectrum *spectrum_of(pspec_plan *plan, const pspec_pattern *patterns, size_t num) {
    pspec_spectrum *spectrum = NULL;
    assert_int_equal(pspec_plan_reset(plan), PSPEC_OK);
    assert_int_equal(pspec_plan_run(plan, patterns, num), PSPEC_OK);
    assert_int_equal(pspec_spectrum_create(&spectrum, plan), PSPEC_OK);
    return spectrum;
}

static void spectra_are_those_of_fresh_memory(void **state) {
    (void)state;
    enum { SETS = 3, POINTS = TEST_NUM_POINTS };
    double points[SETS][2 * POINTS];
    pspec_pattern patterns[SETS];
    uint64_t random = 4;
    for (size_t r = 0; r < SETS; r++) {
        for (size_t i = 0; i < 2 * (size_t)POINTS; i++) {
            points[r][i] = test_uniform(&random);
        }
        patterns[r] = (pspec_pattern){2, POINTS, points[r], NULL};
    }
    pspec_context *const context = test_public_context();
    const pspec_power_request request = large_request();
    pspec_plan *plan = NULL;
    assert_int_equal(pspec_plan_create(&plan, context, &request), PSPEC_OK);
    pspec_spectrum_destroy(spectrum_of(plan, patterns, 2)); /* standard errors are there */
    pspec_spectrum *const again = spectrum_of(plan, &patterns[2], 1);
    const double *const powers = pspec_spectrum_powers(again);
    pspec_spectrum *const beside = spectrum_of(plan, patterns, 2);
    assert_ptr_not_equal(pspec_spectrum_powers(beside), powers);
    pspec_plan_destroy(plan);
    pspec_spectrum *const fresh = test_public_spectrum(context, &request, &patterns[2], 1);
    assert_true(test_is_same_spectrum(again, fresh, true));
    pspec_spectrum_destroy(fresh);
    pspec_spectrum_destroy(again); /* both outlive the plan */
    pspec_spectrum_destroy(beside);
    pspec_context_destroy(context);
}

/* Bytes that a plan under a limit keeps of a spectrum that was destroyed; nothing of it stays
 * without the plan, though another spectrum of it does. *rest: of the limit, beside the plan. */
static uint64_t kept_under_limit(uint64_t limit, uint64_t *rest) {
    double points[2 * TEST_NUM_POINTS];
    uint64_t random = 5;
    for (size_t i = 0; i < 2 * (size_t)TEST_NUM_POINTS; i++) {
        points[i] = test_uniform(&random);
    }
    const pspec_pattern pattern = {2, TEST_NUM_POINTS, points, NULL};
    pspec_context *const context = test_public_context();
    pspec_power_request request = large_request();
    request.num_realizations = 1; /* so no limit changes the plan or the patterns that it keeps */
    pspec_plan *plan = NULL;
    pspec_context_set_memory_limit(context, limit);
    assert_int_equal(pspec_plan_create(&plan, context, &request), PSPEC_OK);
    const uint64_t taken =
        (uint64_t)plan->choice.chosen->bytes + ps_kept_patterns_bytes(&plan->kept);
    *rest = limit > taken ? limit - taken : 0;
    pspec_spectrum *const last = spectrum_of(plan, &pattern, 1);
    ps_spares *const spares = ps_public_sums(last)->spares;
    pspec_spectrum_destroy(spectrum_of(plan, &pattern, 1));
    const uint64_t kept = ps_spares_bytes(spares);
    pspec_plan_destroy(plan);
    assert_int_equal(ps_spares_bytes(spares), 0);
    pspec_spectrum_destroy(last);
    pspec_context_destroy(context);
    return kept;
}

static void a_limit_holds_for_what_is_kept(void **state) {
    (void)state;
    const uint64_t plenty = (uint64_t)4 << 30;
    uint64_t rest = 0;
    const uint64_t all = kept_under_limit(0, &rest);
    assert_true(all >= (uint64_t)4 * LARGE && kept_under_limit(plenty, &rest) == all);
    const uint64_t plan = plenty - rest;
    assert_true(kept_under_limit(plan + all, &rest) == all && rest == all);
    const uint64_t some = kept_under_limit(plan + all - 1, &rest);
    assert_true(some > 0 && some < all && some <= rest);
    assert_int_equal(kept_under_limit(plan, &rest), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arrays_come_back_by_size),
        cmocka_unit_test(the_rest_is_freed),
        cmocka_unit_test(no_more_than_is_allowed),
        cmocka_unit_test(spectra_are_those_of_fresh_memory),
        cmocka_unit_test(a_limit_holds_for_what_is_kept),
    };
    return cmocka_run_group_tests_name("spares", tests, NULL, NULL);
}
