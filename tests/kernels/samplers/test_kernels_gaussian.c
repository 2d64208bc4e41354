/* Sums of Gaussians on the device are those of the host, bit for bit, in groups of any size. */
#include "harness_kernels.h"

#include <stdlib.h>
#include <string.h>

#include "math/random/random.h"
#include "samplers/forces/gaussian.h"

enum { MOST = 150, AXES = 3 };

static ps_device *device;

typedef struct found {
    double energy;
    double force[AXES * MOST];
} found;

static void find(ps_gaussian_sums *sums, const double *x, found *out) {
    memset(out, 0, sizeof *out);
    assert_ok(ps_gaussian_sums_find(sums, x, NULL, &out->energy, out->force, error));
}

static void compare(size_t num, unsigned dimension, double sigma) {
    double x[AXES * MOST];
    found host, there;
    ps_gaussian_sums sums;
    ps_gaussian_device on_device;
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, num);
    ps_random_fill_uniform(&random, x, num * dimension);
    assert_ok(ps_gaussian_sums_create(&sums, num, dimension, sigma, error));
    assert_ok(ps_gaussian_device_create(&on_device, device, &sums, error));
    find(&sums, x, &host);
    assert_true(host.energy > 0);
    sums.device = &on_device;
    for (size_t g = 0; g < sizeof TEST_GROUP_SIZES / sizeof TEST_GROUP_SIZES[0]; g++) {
        ps_device_set_group_size(device, TEST_GROUP_SIZES[g]);
        memset(sums.sums, 0xFF, (1 + dimension) * sums.stride * sizeof *sums.sums);
        find(&sums, x, &there);
        if (memcmp(&host, &there, sizeof host) != 0) {
            fail_msg("N = %zu, d = %u, sigma = %g: energies %.17g and %.17g", num, dimension, sigma,
                     host.energy, there.energy);
        }
    }
    ps_device_set_group_size(device, 0);
    ps_gaussian_device_destroy(&on_device);
    ps_gaussian_sums_destroy(&sums);
}

/* Few points have one cell, and many images; more have several, and runs across the edge. */
static void the_device_has_the_bits_of_the_host(void **state) {
    (void)state;
    compare(1, 2, 1);
    compare(7, 2, 1);
    compare(MOST, 2, 1);
    compare(MOST, 2, 0.5);
    compare(30, 2, 2);
    compare(5, 3, 0.5);
    compare(MOST, 3, 0.5);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_device_has_the_bits_of_the_host)};
    device = test_open_device();
    int failures = 0;
    if (test_has_precision(device, 64)) {
        failures = cmocka_run_group_tests_name("kernels_gaussian", tests, NULL, NULL);
    }
    ps_device_close(device);
    return failures;
}
