/* Kernels of step blue noise beside plain sums of pairs, with counts of each work-item's own and
 * with shared ones, at once and in many launches; none of it changes a bit. */
#include "harness_kernels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "math/random/random.h"
#include "samplers/forces/step_pairs.h"

enum { MOST = 200, AXES = 2, MOST_BINS = 200 };

static ps_device *device;

typedef struct found {
    uint64_t counts[MOST_BINS];
    double force[AXES * MOST];
} found;

static void fill(size_t num, double *x) {
    ps_random random = ps_random_init(3, PS_STREAM_COORDINATES, num);
    ps_random_fill_uniform(&random, x, AXES * num);
}

static void make_table(size_t num_bins, double *table) {
    for (size_t b = 0; b < num_bins; b++) {
        table[b] = b % 3 == 0 ? -1.5 : 1 / (double)(b + 1);
    }
    table[num_bins] = 0;
}

static int count_calls(const ps_watch_report *report, void *payload) {
    unsigned *const calls = payload;
    assert_true(report->done < report->total);
    ++*calls;
    return 0;
}

/* Forces are those of the points that are given, whichever were counted last. launch_pairs: 0 for
 * as many as there are. */
static void run(size_t num, size_t num_bins, double launch_pairs, found *out) {
    double x[AXES * MOST];
    double others[AXES * MOST];
    uint64_t counts[MOST_BINS];
    double table[MOST_BINS + 1];
    ps_step_pairs pairs;
    unsigned calls = 0;
    const ps_watch watch = {count_calls, &calls};
    memset(out, 0, sizeof *out);
    fill(num, x);
    make_table(num_bins, table);
    assert_ok(ps_step_pairs_create(&pairs, device, num, num_bins, error));
    pairs.launch_pairs = launch_pairs > 0 ? launch_pairs : pairs.launch_pairs;
    assert_ok(ps_step_pairs_count(&pairs, x, out->counts, &watch, error));
    assert_int_equal(calls > 0, launch_pairs > 0);
    for (size_t k = 0; k < AXES * num; k++) {
        others[k] = x[k] / 2;
    }
    assert_ok(ps_step_pairs_count(&pairs, others, counts, NULL, error));
    calls = 0;
    assert_ok(ps_step_pairs_force(&pairs, x, table, out->force, &watch, error));
    assert_int_equal(calls > 0, launch_pairs > 0);
    ps_step_pairs_destroy(&pairs);
}

/* Pairs as near to the edge of a bin as this may be in either: there are none. */
static void compare(size_t num, size_t num_bins, const found *got) {
    double x[AXES * MOST];
    double table[MOST_BINS + 1];
    found plain;
    memset(&plain, 0, sizeof plain);
    fill(num, x);
    make_table(num_bins, table);
    for (size_t i = 0; i < num; i++) {
        for (size_t j = 0; j < num; j++) {
            double dx = x[AXES * i] - x[AXES * j];
            double dy = x[AXES * i + 1] - x[AXES * j + 1];
            dx -= rint(dx);
            dy -= rint(dy);
            const double place = sqrt(dx * dx + dy * dy) * 2 * (double)num_bins;
            if (i != j && place < (double)num_bins) {
                const size_t bin = (size_t)place;
                plain.counts[bin] += j > i;
                plain.force[AXES * i] += dx * table[bin];
                plain.force[AXES * i + 1] += dy * table[bin];
            }
        }
    }
    assert_memory_equal(plain.counts, got->counts, num_bins * sizeof plain.counts[0]);
    for (size_t k = 0; k < AXES * num; k++) {
        if (!(fabs(plain.force[k] - got->force[k]) <= 1e-12)) {
            fail_msg("N = %zu: force %g, not %g", num, got->force[k], plain.force[k]);
        }
    }
}

/* One block, a part of one, several with a part. */
static void counts_and_forces_are_those_of_plain_sums(void **state) {
    (void)state;
    static const size_t nums[] = {1, 7, 64, 65, 129, MOST};
    for (size_t n = 0; n < sizeof nums / sizeof nums[0]; n++) {
        found alone, shared;
        run(nums[n], MOST_BINS, 0, &alone);
        compare(nums[n], MOST_BINS, &alone);
        ps_device_set_group_size(device, 4);
        run(nums[n], MOST_BINS, 0, &shared);
        ps_device_set_group_size(device, 0);
        assert_memory_equal(&alone, &shared, sizeof alone);
    }
}

/* Some points of all blocks at a time, the last fewer; some rows of tiles, or one. */
static void many_launches_have_the_bits_of_one(void **state) {
    (void)state;
    static const double launch_pairs[] = {1500, 10000, 30000};
    found whole, parts;
    run(MOST, MOST_BINS, 0, &whole);
    for (size_t k = 0; k < sizeof launch_pairs / sizeof launch_pairs[0]; k++) {
        for (size_t group = 0; group <= 4; group += 4) {
            ps_device_set_group_size(device, group);
            run(MOST, MOST_BINS, launch_pairs[k], &parts);
            ps_device_set_group_size(device, 0);
            assert_memory_equal(&whole, &parts, sizeof whole);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(counts_and_forces_are_those_of_plain_sums),
                                       cmocka_unit_test(many_launches_have_the_bits_of_one)};
    device = test_open_device();
    int failures = 0;
    if (test_has_precision(device, 64)) {
        failures = cmocka_run_group_tests_name("kernels_step", tests, NULL, NULL);
    }
    ps_device_close(device);
    return failures;
}
