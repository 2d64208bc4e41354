/* Devices that are lent to the threads which make sets have the bits of one for each set. */
#include "harness.h"
#include "test_samplers.h"

#include "base/workers.h"
#include "device/lender.h"
#include "sets/sets.h"

enum { NUM = 1024, NUM_SETS = 12 };

static void compare(const char *text, uint64_t num_sets) {
    static double expected[2 * NUM];
    static double found[2 * NUM];
    const char *const selector = getenv("POINTSPEC_DEVICE");
    ps_sampler_request request = make_request(text, NUM, 2);
    const ps_sets_options options = {.device = selector};
    ps_sets *sets = NULL;
    size_t num_points = 0;
    assert_true(ps_sets_makers(&request, &options, num_sets) > 1 || ps_workers_most() == 1 ||
                num_sets == 1);
    assert_ok(ps_lender_create(&request.lender, selector, error)); /* sets have their own */
    assert_ok(ps_sets_create(&sets, &request, num_sets, &options, error));
    for (unsigned time = 0; time < 2; time++) {
        for (uint64_t r = 0; r < num_sets; r++) {
            assert_ok(ps_sets_next(sets, found, &num_points, NULL, error));
            assert_ok(ps_sampler_generate(&request, r, expected, NULL, NULL, error));
            assert_int_equal(num_points, NUM);
            assert_memory_equal(found, expected, sizeof expected);
        }
        ps_sets_rewind(sets); /* the devices stay */
    }
    ps_sets_destroy(sets);
    ps_lender_destroy(request.lender);
}

static void several_threads_have_the_bits_of_one(void **state) {
    (void)state;
    compare("step:rounds=2", 1);
    compare("step:rounds=2", NUM_SETS);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(several_threads_have_the_bits_of_one)};
    ps_device *const device = test_open_device();
    const bool can = ps_device_get_limits(device)->has_fp64;
    ps_device_close(device);
    if (!can) {
        print_message("skipped: the device has no double precision\n");
        return TEST_SKIPPED;
    }
    return cmocka_run_group_tests_name("set_devices", tests, NULL, NULL);
}
