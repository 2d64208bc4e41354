/* Rows of optimised samplers: parameters reach the algorithms, what cannot be made is refused
 * before any work, seconds follow the parameters. */
#include "test_samplers.h"

#include <string.h>

#include "samplers/optimized/bnot.h"
#include "samplers/optimized/fpo.h"

enum { NUM = 128 };

static void assert_refused(const char *text, size_t num, unsigned dimension, const char *why) {
    const ps_sampler_request request = parse_request(text, num, dimension);
    ps_error error = {0};
    assert_int_equal(ps_sampler_check(&request, &error), PSPEC_ERROR_INVALID_ARGUMENT);
    if (strstr(error.message, why) == NULL) {
        fail_msg("%s: %s", text, error.message);
    }
}

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

static double seconds_of(const char *text, size_t num) {
    const ps_sampler_request request = make_request(text, num, 2);
    return ps_sampler_seconds(&request);
}

/* Against what bench_cells measured, to a factor of 2: a core of an EPYC. */
static void seconds_are_those_that_were_measured(void **state) {
    (void)state;
    static const struct {
        const char *text;
        size_t num;
        double seconds;
    } measured[] = {{"bnot", 1024, 0.031},
                    {"bnot", 4096, 0.15},
                    {"bnot", 16384, 0.8},
                    {"bnot:eps=0.2", 1024, 0.1},
                    {"bnot:eps=0.05", 1024, 0.34},
                    {"bnot:eps=10", 1024, 0.011},
                    {"fpo", 1024, 0.27},
                    {"fpo", 4096, 2.1},
                    {"fpo", 16384, 25},
                    {"fpo:distance=0.9", 1024, 0.06},
                    {"fpo:distance=0.9", 4096, 0.29},
                    {"fpo:distance=0.5", 1024, 0.01}};
    for (unsigned i = 0; i < sizeof measured / sizeof measured[0]; i++) {
        const double ratio = seconds_of(measured[i].text, measured[i].num) / measured[i].seconds;
        if (!(ratio >= 0.5 && ratio <= 2)) {
            fail_msg("%s, N = %zu: %g times what was measured", measured[i].text, measured[i].num,
                     ratio);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_cannot_be_made_is_refused),
        cmocka_unit_test(parameters_reach_the_algorithms),
        cmocka_unit_test(seconds_are_those_that_were_measured),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
