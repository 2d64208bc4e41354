/* Step blue noise: curves, the same bits for ever, what is refused. */
#include "harness.h"
#include "set_distances.h"
#include "stop_at_the_third.h"
#include "test_samplers.h"

#include <string.h>

#include "device/lender.h"
#include "files/digest.h"
#include "samplers/forces/loan.h"
#include "samplers/forces/step.h"
#include "samplers/forces/step_pairs.h"

enum { NUM = 256 };

static const ps_step_options whole = {PS_STEP_MOST_ROUNDS, {8, false}};
static ps_device *device;
static ps_lender *lender; /* of the same */

static ps_step_outcome make(size_t num, uint64_t realization, double *x) {
    ps_step_outcome outcome = {0};
    ps_error error = {0};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, realization);
    if (ps_step_make(num, whole, &random, device, NULL, x, &outcome, &error) != PSPEC_OK) {
        fail_msg("%s", error.message);
    }
    for (size_t k = 0; k < 2 * num; k++) {
        assert_true(x[k] >= 0 && x[k] < 1);
    }
    return outcome;
}

/* ---- curves ---- */

static void the_bessel_function_is_right(void **state) {
    (void)state;
    const double two_pi = 2 * acos(-1);
    assert_true(fabs(ps_step_bessel(0) - 0.5) < 1e-15);
    for (double turns = 1e-3; turns < 80; turns += 0.0701) {
        const double t = two_pi * turns;
        if (!(fabs(ps_step_bessel(turns) - j1(t) / t) < 1e-15 * (1 + turns))) {
            fail_msg("J1(%g)/%g = %.17g, not %.17g", t, t, ps_step_bessel(turns), j1(t) / t);
        }
    }
}

/* As many pairs as the target asks for, or twice as many, and none. */
static void curves_are_those_of_counts(void **state) {
    (void)state;
    enum { BINS = 400 };
    const double pi = acos(-1);
    uint64_t counts[BINS];
    double table[BINS + 1];
    ps_step_curves c;
    ps_error error = {0};
    assert_int_equal(ps_step_curves_create(&c, 1U << 16, BINS, PS_STEP_SMOOTHING, &error),
                     PSPEC_OK);
    const double pairs = 65536.0 * 65535 / 2;
    double off = 0;
    for (int b = 0; b < BINS; b++) {
        const double area = pi * (2 * b + 1) / (4.0 * BINS * BINS);
        counts[b] = (uint64_t)(pairs * area + 0.5);
        off += (1 - c.target[b]) * (1 - c.target[b]) / (2 * BINS);
    }
    assert_true(fabs(ps_step_curves_measure(&c, counts) - sqrt(off)) < 1e-4);
    assert_true(fabs(c.found[100] - 1) < 1e-5);
    ps_step_curves_force(&c, table);
    assert_true(table[0] > 0); /* points that are too near go apart */
    assert_true(table[BINS - 1] == 0 && table[BINS] == 0);
    memset(counts, 0, sizeof counts);
    assert_true(ps_step_curves_measure(&c, counts) > 0.5);
    ps_step_curves_force(&c, table);
    assert_true(table[BINS / 2] < 0);
    ps_step_curves_destroy(&c);
}

/* What has the target's pairs is nearer to the smoothed target than to the target itself. */
static void smoothing_may_be_of_both_curves(void **state) {
    (void)state;
    enum { BINS = 400 };
    const double pi = acos(-1);
    uint64_t counts[BINS];
    double off[2];
    ps_step_curves c[2];
    for (int k = 0; k < 2; k++) {
        const ps_step_smoothing smoothing = {8, k == 1};
        assert_ok(ps_step_curves_create(&c[k], 1U << 16, BINS, smoothing, error));
    }
    for (int b = 0; b < BINS; b++) {
        const double ring = 65536.0 * 65535 / 2 * pi * (2 * b + 1) / (4.0 * BINS * BINS);
        counts[b] = (uint64_t)(ring * c[0].target[b] + 0.5);
    }
    for (int k = 0; k < 2; k++) {
        off[k] = ps_step_curves_measure(&c[k], counts);
        ps_step_curves_destroy(&c[k]);
    }
    assert_true(off[0] > 1e-2 && off[1] < 1e-4);
}

/* ---- sets ---- */

static void forces_come_to_rest(void **state) {
    (void)state;
    double x[2 * NUM];
    const ps_step_outcome outcome = make(NUM, 0, x);
    assert_true(outcome.first > 0.1);
    assert_true(outcome.last < 0.025);
    assert_in_range(outcome.rounds, 150, 600);
}

/* As sets of others have it (0.645 to 0.66); of 256 points it is 0.70. */
static void points_are_about_so_far_apart(void **state) {
    (void)state;
    enum { MANY = 1024 };
    double x[2 * MANY];
    const ps_step_outcome outcome = make(MANY, 0, x);
    const double mean = measure_distances(MANY, x).mean;
    assert_true(outcome.last < 0.005);
    assert_true(mean > 0.63 && mean < 0.67);
}

/* Relative power of a Gaussian with sigma = 1/16 at |k|^2. */
static double gaussian_power(int kx, int ky) {
    const double turns = acos(-1) / 8;
    return exp(-turns * turns * (kx * kx + ky * ky));
}

/* What is left below the step keeps the variance of a smooth function far above that of a spectrum
 * which is 0 there, k0 = sqrt(N / pi) = 9. */
static void variances_are_far_above_those_of_a_step(void **state) {
    (void)state;
    enum { MOST = 20 };
    double x[2 * NUM];
    double found = 0;
    double of_step = 0;
    make(NUM, 0, x);
    for (int kx = -MOST; kx <= MOST; kx++) {
        for (int ky = -MOST; ky <= MOST; ky++) {
            const bool is_zero = kx == 0 && ky == 0;
            found += is_zero ? 0 : power_at(NUM, x, kx, ky) * gaussian_power(kx, ky);
            of_step += hypot(kx, ky) > sqrt(NUM / acos(-1)) ? gaussian_power(kx, ky) : 0;
        }
    }
    if (!(found > 10 * of_step)) {
        fail_msg("variance %g of the step's", found / of_step);
    }
}

/* Recorded: the bits of a set stay the same, with any compiler and on any device. */
static void the_bits_of_sets_are_these(void **state) {
    (void)state;
    double x[2 * 100];
    char digest[PS_DIGEST_BYTES];
    make(100, 0, x);
    ps_digest_bytes(x, sizeof x, digest);
    assert_string_equal(digest, "ba2bbbf5aa71f1eafe3189a3d2f87f89");
}

/* ---- what cannot be made ---- */

static void what_cannot_be_made_is_refused(void **state) {
    (void)state;
    double x[2];
    ps_error error = {0};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    assert_refused("step", 63, 2, "64 and more");
    assert_refused("step", 65537, 2, "65536");
    assert_refused("step", 64, 3, "dimension 3");
    assert_refused("step:rounds=0", 64, 2, "rounds");
    assert_refused("step:rounds=many", 64, 2, "rounds");
    assert_int_equal(ps_step_make(63, whole, &random, device, NULL, x, NULL, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, "from 64"));
}

static void a_device_without_double_precision_is_refused(void **state) {
    (void)state;
    ps_device_limits limits = {.name = "small GPU"};
    ps_error error = {0};
    assert_int_equal(ps_forces_need_doubles(&limits, "step", &error), PSPEC_ERROR_DEVICE);
    assert_non_null(strstr(error.message, "small GPU"));
    assert_non_null(strstr(error.message, "--device cpu"));
    limits.has_fp64 = true;
    assert_int_equal(ps_forces_need_doubles(&limits, "step", &error), PSPEC_OK);
}

/* What the tests' device makes. */
static ps_sampler_request ask(const char *text, size_t num) {
    ps_sampler_request request = make_request(text, num, 2);
    request.lender = lender;
    return request;
}

static void the_row_makes_the_same(void **state) {
    (void)state;
    double expected[2 * 64];
    const ps_sampler_request request = ask("step-blue-noise", 64);
    double *const points = generate_points(&request, 7);
    make(64, 7, expected);
    assert_memory_equal(points, expected, sizeof expected);
    free(points);
}

/* Before any work, and where sets are made. */
static void a_device_that_is_not_there_is_told(void **state) {
    (void)state;
    double x[2 * 64];
    ps_lender *none = NULL;
    ps_error error = {0};
    ps_sampler_request request = make_request("step", 64, 2);
    assert_int_equal(ps_sampler_check_device(&request, getenv("POINTSPEC_DEVICE"), &error),
                     PSPEC_OK);
    assert_int_equal(ps_sampler_check_device(&request, "no such device", &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, "no such device"));
    assert_int_equal(ps_lender_create(&none, "no such device", &error), PSPEC_OK);
    request.lender = none;
    assert_int_equal(ps_sampler_generate(&request, 7, x, NULL, NULL, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    ps_lender_destroy(none);
}

/* The first round has the points that it began with. */
static void rounds_may_be_few(void **state) {
    (void)state;
    double start[2 * 64];
    const ps_sampler_request one = ask("step:rounds=1", 64);
    const ps_sampler_request some = ask("step:rounds=20", 64);
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 7);
    ps_random_fill_uniform(&random, start, 2 * 64);
    double *points = generate_points(&one, 7);
    assert_memory_equal(points, start, sizeof start);
    free(points);
    points = generate_points(&some, 7);
    assert_memory_not_equal(points, start, sizeof start);
    free(points);
    assert_true(ps_sampler_seconds(&one) < ps_sampler_seconds(&some));
}

static void whoever_watches_may_stop_it(void **state) {
    (void)state;
    double x[2 * NUM];
    unsigned calls = 0;
    const ps_watch watch = {stop_at_the_third, &calls};
    ps_error error = {0};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    assert_int_equal(ps_step_make(NUM, whole, &random, device, &watch, x, NULL, &error),
                     PSPEC_ERROR_CANCELLED);
    assert_int_equal(calls, 3);
}

/* Those that want a device want one with double precision. */
static int test_sets(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_come_to_rest),
        cmocka_unit_test(points_are_about_so_far_apart),
        cmocka_unit_test(variances_are_far_above_those_of_a_step),
        cmocka_unit_test(the_bits_of_sets_are_these),
        cmocka_unit_test(what_cannot_be_made_is_refused),
        cmocka_unit_test(a_device_that_is_not_there_is_told),
        cmocka_unit_test(the_row_makes_the_same),
        cmocka_unit_test(rounds_may_be_few),
        cmocka_unit_test(whoever_watches_may_stop_it),
    };
    device = test_open_device();
    if (!ps_device_get_limits(device)->has_fp64) {
        print_message("skipped: the device has no double precision\n");
        ps_device_close(device);
        return TEST_SKIPPED;
    }
    assert_ok(ps_lender_create(&lender, getenv("POINTSPEC_DEVICE"), error));
    const int failures = cmocka_run_group_tests_name("sets", tests, NULL, NULL);
    ps_lender_destroy(lender);
    ps_device_close(device);
    return failures;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_bessel_function_is_right),
        cmocka_unit_test(curves_are_those_of_counts),
        cmocka_unit_test(smoothing_may_be_of_both_curves),
        cmocka_unit_test(a_device_without_double_precision_is_refused),
    };
    const int failures = cmocka_run_group_tests_name("curves", tests, NULL, NULL);
    return failures > 0 ? failures : test_sets();
}
