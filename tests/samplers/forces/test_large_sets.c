/* Sets so large that launches come in parts, with offsets: pairs of step blue noise beside plain
 * sums, sums of Gaussians beside those of the host, bit for bit. */
#include "harness.h"

#include <math.h>
#include <string.h>

#include "math/random/random.h"
#include "samplers/forces/gaussian.h"
#include "samplers/forces/step_pairs.h"

enum { NUM = 8200, AXES = 3, BINS = 300, EVERY = 97 };

static ps_device *device;

static double *fill(size_t num) {
    double *const x = calloc(num, sizeof *x);
    assert_non_null(x);
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    ps_random_fill_uniform(&random, x, num);
    return x;
}

static int count_calls(const ps_watch_report *report, void *payload) {
    unsigned *const calls = payload;
    assert_in_range(report->done, 1, report->total - 1);
    ++*calls;
    return 0;
}

/* ---- step blue noise ---- */

typedef struct pairs {
    uint64_t counts[BINS];
    double force[2 * NUM];
} pairs;

static void make_table(double *table) {
    for (int b = 0; b < BINS; b++) {
        table[b] = b % 3 == 0 ? -1.5 : 1 / (double)(b + 1);
    }
    table[BINS] = 0;
}

/* launch_pairs: 0 for as many as there are. Returns how often the watch heard of it. */
static unsigned find_pairs(const double *x, double launch_pairs, pairs *out) {
    double table[BINS + 1];
    ps_step_pairs p;
    unsigned calls = 0;
    const ps_watch watch = {count_calls, &calls};
    make_table(table);
    assert_ok(ps_step_pairs_create(&p, device, NUM, BINS, error));
    p.launch_pairs = launch_pairs > 0 ? launch_pairs : p.launch_pairs;
    assert_ok(ps_step_pairs_count(&p, x, out->counts, &watch, error));
    assert_ok(ps_step_pairs_force(&p, x, table, out->force, &watch, error));
    ps_step_pairs_destroy(&p);
    return calls;
}

/* All pairs are counted; forces are those on some points. */
static void compare_with_plain_sums(const double *x, const pairs *found) {
    static uint64_t counts[BINS];
    double table[BINS + 1];
    make_table(table);
    for (size_t i = 0; i < NUM; i++) {
        double force[2] = {0, 0};
        for (size_t j = i % EVERY == 0 ? 0 : i + 1; j < NUM; j++) {
            double dx = x[2 * i] - x[2 * j];
            double dy = x[2 * i + 1] - x[2 * j + 1];
            dx -= dx > 0.5 ? 1 : dx < -0.5 ? -1 : 0;
            dy -= dy > 0.5 ? 1 : dy < -0.5 ? -1 : 0;
            const double place = sqrt(dx * dx + dy * dy) * 2 * BINS;
            const size_t bin = place < BINS ? (size_t)place : BINS;
            force[0] += dx * table[bin];
            force[1] += dy * table[bin];
            if (bin < BINS) {
                counts[bin] += j > i;
            }
        }
        for (size_t k = 0; k < 2 && i % EVERY == 0; k++) {
            assert_true(fabs(force[k] - found->force[2 * i + k]) < 1e-11);
        }
    }
    assert_memory_equal(counts, found->counts, sizeof counts);
}

static void pairs_of_parts_are_those_of_plain_sums(void **state) {
    (void)state;
    static pairs whole, parts;
    double *const x = fill(2 * NUM);
    assert_int_equal(find_pairs(x, 1e9, &whole), 0);
    compare_with_plain_sums(x, &whole);
    find_pairs(x, 0, &parts); /* on CPUs two launches for counts, five for forces */
    assert_memory_equal(&whole, &parts, sizeof whole);
    assert_true(find_pairs(x, 3e6, &parts) > 8);
    assert_memory_equal(&whole, &parts, sizeof whole);
    free(x);
}

/* ---- Gaussian blue noise ---- */

static void sums_of_parts_are_those_of_the_host(void **state) {
    (void)state;
    static double host[AXES * NUM];
    static double there[AXES * NUM];
    for (unsigned d = 2; d <= AXES; d++) {
        double *const x = fill(d * NUM);
        double energies[2] = {0, 0};
        unsigned calls = 0;
        const ps_watch watch = {count_calls, &calls};
        ps_gaussian_sums sums;
        ps_gaussian_device on_device;
        assert_ok(ps_gaussian_sums_create(&sums, NUM, d, 0.5, error));
        assert_ok(ps_gaussian_device_create(&on_device, device, &sums, error));
        assert_ok(ps_gaussian_sums_find(&sums, x, NULL, &energies[0], host, error));
        memset(sums.sums, 0xFF, (1 + d) * sums.stride * sizeof *sums.sums);
        sums.device = &on_device;
        assert_ok(ps_gaussian_sums_find(&sums, x, &watch, &energies[1], there, error));
        assert_int_equal(calls, 1); /* 8192 points, then the others */
        assert_true(energies[0] > 0 && energies[0] == energies[1]);
        assert_memory_equal(host, there, d * NUM * sizeof(double));
        ps_gaussian_device_destroy(&on_device);
        ps_gaussian_sums_destroy(&sums);
        free(x);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_of_parts_are_those_of_plain_sums),
        cmocka_unit_test(sums_of_parts_are_those_of_the_host),
    };
    int failures = TEST_SKIPPED;
    device = test_open_device();
    if (ps_device_get_limits(device)->has_fp64) {
        failures = cmocka_run_group_tests_name("large_sets", tests, NULL, NULL);
    } else {
        print_message("skipped: the device has no double precision\n");
    }
    ps_device_close(device);
    return failures;
}
