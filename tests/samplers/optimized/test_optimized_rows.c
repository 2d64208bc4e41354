/* Rows of optimised samplers: parameters reach the algorithms, what cannot be made is refused
 * before any work. */
#include "test_samplers.h"

#include <string.h>

#include "samplers/optimized/bnot.h"
#include "samplers/optimized/fpo.h"

enum { NUM = 128 };

static void what_cannot_be_made_is_refused(void **state) {
    (void)state;
    static const char *const names[] = {"bnot", "fpo"};
    for (unsigned i = 0; i < 2; i++) {
        assert_refused(names[i], 15, 2, "16 and more");
        assert_refused(names[i], 1, 2, "16 and more");
        assert_refused(names[i], 64, 3, "dimension 3");
        assert_refused(names[i], ((size_t)1 << 28) + 1, 2, "268435456");
    }
    assert_refused("bnot:eps=0", 64, 2, "eps");
    assert_refused("bnot:eps=11", 64, 2, "eps");
    assert_refused("fpo:distance=0.94", 64, 2, "distance");
    assert_refused("fpo:distance=far", 64, 2, "distance");
}

static void parameters_reach_the_algorithms(void **state) {
    (void)state;
    const ps_sampler_request bnot = make_request("optimal-transport:eps=2", NUM, 2);
    const ps_sampler_request fpo = make_request("farthest-point:distance=.9", NUM, 2);
    double expected[2 * NUM];
    ps_error error = {0};
    double *points = generate_points(&bnot, 7);
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 7);
    assert_int_equal(ps_bnot_make(NUM, 2, &random, NULL, expected, &error), PSPEC_OK);
    assert_memory_equal(points, expected, sizeof expected);
    free(points);
    points = generate_points(&fpo, 7);
    random = ps_random_init(1, PS_STREAM_COORDINATES, 7);
    assert_int_equal(ps_fpo_make(NUM, 0.9, &random, NULL, expected, &error), PSPEC_OK);
    assert_memory_equal(points, expected, sizeof expected);
    free(points);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_cannot_be_made_is_refused),
        cmocka_unit_test(parameters_reach_the_algorithms),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
