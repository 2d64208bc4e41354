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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arrays_come_back_by_size),
        cmocka_unit_test(the_rest_is_freed),
        cmocka_unit_test(no_more_than_is_allowed),
    };
    return cmocka_run_group_tests_name("spares", tests, NULL, NULL);
}
