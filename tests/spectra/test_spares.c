/* Arrays of spectra are used again: by size, only large ones, by whoever is left; and what was in
 * them shows in no spectrum.
 */
#include "harness_public.h"

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
    assert_ok(ps_spares_create(&spares, error));
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
    assert_ok(ps_spares_create(&spares, error));
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arrays_come_back_by_size),
        cmocka_unit_test(the_rest_is_freed),
        cmocka_unit_test(spectra_are_those_of_fresh_memory),
    };
    return cmocka_run_group_tests_name("spares", tests, NULL, NULL);
}
