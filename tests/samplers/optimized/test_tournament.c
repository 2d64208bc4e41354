/* The winner of a tournament is the largest number, the first of equal ones, whatever changes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "math/random/random.h"
#include "samplers/optimized/fpo_mesh.h"

static void the_winner_is_the_first_of_the_largest(void **state) {
    (void)state;
    static const size_t nums[] = {1, 2, 3, 16, 17, 100};
    for (unsigned n = 0; n < sizeof nums / sizeof nums[0]; n++) {
        const size_t num = nums[n];
        double keys[100] = {0};
        ps_tournament tournament;
        ps_error error = {0};
        ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, num);
        assert_int_equal(ps_tournament_create(&tournament, num, &error), PSPEC_OK);
        assert_int_equal(ps_tournament_winner(&tournament), 0);
        for (int step = 0; step < 2000; step++) {
            const uint32_t i = (uint32_t)ps_random_below(&random, num);
            size_t largest = 0;
            keys[i] = (double)ps_random_below(&random, 12); /* equal ones are frequent */
            ps_tournament_set(&tournament, i, keys[i]);
            for (size_t k = 0; k < num; k++) {
                largest = keys[k] > keys[largest] ? k : largest;
            }
            assert_int_equal(ps_tournament_winner(&tournament), largest);
        }
        ps_tournament_destroy(&tournament);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_winner_is_the_first_of_the_largest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
