/* Weighted sums of powers against plain loops in long double: rows on the host and on the device,
 * strides, lanes, batches, both precisions.
 */
#include "harness_rows.h"

#include <math.h>
#include <stdlib.h>

static ps_device *device;

static void find(const rows_fixture *what, const rows_layout *how, ps_mean *means) {
    uint32_t *slots = rows_make_slots(what, how);
    ps_accumulator *accumulator = rows_make_accumulator(what, how, slots, false);
    rows_add_all(accumulator, what, how, slots, ROWS_M);
    assert_ok(ps_accumulator_settle(accumulator, error));
    ps_accumulator_weighted(accumulator, means);
    ps_accumulator_destroy(accumulator);
    free(slots);
}

/* ---- against loops ----------------------------------------------------------------------- */

/* What a weight is as a number of float times a power of two of the largest one. */
static double rounded(double weight, double largest) {
    int exponent = 0;
    frexp(largest, &exponent);
    return ldexp((float)ldexp(weight, -exponent), exponent);
}

static long double weigh(const rows_fixture *what, const rows_layout *how, size_t w, size_t r) {
    const size_t num = what->set.num;
    const double *weights = what->weights + w * num;
    double largest = 0;
    long double sum = 0;
    for (size_t i = 0; i < num; i++) {
        largest = fmax(largest, weights[i]);
    }
    for (size_t i = 0; i < num; i++) {
        const bool is_single = how->is_on_device && how->precision == PS_SINGLE;
        sum += (long double)(is_single ? rounded(weights[i], largest) : weights[i]) *
               what->powers[r * num + i];
    }
    return sum;
}

/* Mean and standard error in two passes. */
static void check_layout(const rows_fixture *what, const rows_layout *how) {
    ps_mean found[ROWS_WEIGHTED];
    find(what, how, found);
    for (size_t w = 0; w < ROWS_WEIGHTED; w++) {
        long double mean = 0;
        long double squares = 0;
        for (size_t r = 0; r < ROWS_M; r++) {
            mean += weigh(what, how, w, r) / ROWS_M;
        }
        for (size_t r = 0; r < ROWS_M; r++) {
            const long double off = weigh(what, how, w, r) - mean;
            squares += off * off;
        }
        const long double scatter = sqrtl(squares / (ROWS_M - 1) / ROWS_M);
        assert_true(fabsl(found[w].mean / mean - 1) < 1e-13);
        assert_true(fabsl(found[w].standard_error / scatter - 1) < 1e-12);
    }
}

static void sums_of_rows(void **state) {
    (void)state;
    rows_for_all_layouts(device, check_layout);
}

/* ---- bits -------------------------------------------------------------------------------- */

/* Neither batches nor lanes, where rows have room for them, nor work-group sizes matter. */
static void check_bits(const rows_fixture *what, const rows_layout *how) {
    static const size_t batches[] = {1, 2, 7, ROWS_M, 64};
    static const size_t group_sizes[] = {1, 3, 64};
    ps_mean first[ROWS_WEIGHTED];
    find(what, how, first);
    for (size_t i = 0; i < sizeof batches / sizeof batches[0]; i++) {
        for (unsigned lanes = 1; lanes <= how->lanes; lanes *= 2) {
            rows_layout other = *how;
            ps_mean again[ROWS_WEIGHTED];
            other.batch = batches[i];
            other.lanes = lanes;
            ps_device_set_group_size(device, group_sizes[i % 3]);
            find(what, &other, again);
            assert_memory_equal(first, again, sizeof first);
        }
    }
    ps_device_set_group_size(device, 0);
}

static void same_bits_for_every_batch(void **state) {
    (void)state;
    rows_for_all_layouts(device, check_bits);
}

/* ---- bins and frequencies ---------------------------------------------------------------- */

/* The sum over a ring is its mean times its members, and so is its standard error. */
static void check_ring(const rows_fixture *what, const rows_layout *how) {
    uint32_t *slots = rows_make_slots(what, how);
    ps_mean *bins = calloc(what->bins.num, sizeof *bins);
    ps_mean found[ROWS_WEIGHTED];
    const double count = (double)(what->bins.bins[6].end - what->bins.bins[6].begin);
    ps_accumulator *accumulator = rows_make_accumulator(what, how, slots, false);
    rows_add_all(accumulator, what, how, slots, ROWS_M);
    assert_ok(ps_accumulator_bins(accumulator, bins, error));
    ps_accumulator_weighted(accumulator, found);
    assert_true(fabs(found[3].mean / (count * bins[6].mean) - 1) < 1e-13);
    assert_true(fabs(found[3].standard_error / (count * bins[6].standard_error) - 1) < 1e-12);
    ps_accumulator_destroy(accumulator);
    free(bins);
    free(slots);
}

static void rings(void **state) {
    (void)state;
    rows_for_all_layouts(device, check_ring);
}

/* Weight 1/4 of one frequency: a quarter of its mean and standard error. */
static void check_frequency(const rows_fixture *given, const rows_layout *how) {
    rows_fixture what = *given;
    uint32_t *slots = rows_make_slots(&what, how);
    ps_mean *powers = calloc(what.set.num, sizeof *powers);
    ps_mean found[ROWS_WEIGHTED];
    const size_t chosen[ROWS_WEIGHTED] = {0, 1, 511, what.set.num - 1};
    what.weights = calloc(ROWS_WEIGHTED * what.set.num, sizeof *what.weights);
    for (size_t w = 0; w < ROWS_WEIGHTED; w++) {
        what.weights[w * what.set.num + chosen[w]] = 0.25;
    }
    ps_accumulator *accumulator = rows_make_accumulator(&what, how, slots, false);
    rows_add_all(accumulator, &what, how, slots, ROWS_M);
    assert_ok(ps_accumulator_frequencies(accumulator, powers, error));
    ps_accumulator_weighted(accumulator, found);
    for (size_t w = 0; w < ROWS_WEIGHTED; w++) {
        const ps_mean *power = &powers[chosen[w]];
        assert_true(fabs(4 * found[w].mean / power->mean - 1) < 1e-13);
        assert_true(fabs(4 * found[w].standard_error / power->standard_error - 1) < 1e-12);
    }
    ps_accumulator_destroy(accumulator);
    free(what.weights);
    free(powers);
    free(slots);
}

static void frequencies(void **state) {
    (void)state;
    rows_for_all_layouts(device, check_frequency);
}

/* ---- correlations ------------------------------------------------------------------------ */

/* Every frequency has the power x of its realization, or 2 - x: equal powers have the relative
 * standard error of x, however many they are; opposite ones have none. */
static void check_correlations(const rows_fixture *given, const rows_layout *how) {
    rows_fixture what = *given;
    const size_t num = what.set.num;
    ps_mean found[ROWS_WEIGHTED];
    ps_sums sums = {0};
    double mean = 0;
    double scatter = 0;
    uint64_t seed = 31;
    what.powers = calloc(ROWS_M * num, sizeof *what.powers);
    what.weights = calloc(ROWS_WEIGHTED * num, sizeof *what.weights);
    for (size_t r = 0; r < ROWS_M; r++) {
        const double x = 0.5 + rint(1024 * test_uniform(&seed)) / 1024;
        for (size_t i = 0; i < num; i++) {
            what.powers[r * num + i] = i % 2 == 0 ? x : 2 - x; /* exact */
        }
        ps_sums_add(&sums, x);
    }
    for (size_t i = 0; i < num; i++) {
        what.weights[i] = i % 2 == 0 ? 0.5 : 0;
        what.weights[num + i] = 0.5; /* num is even */
    }
    ps_sums_finish(&sums, ROWS_M, &mean, &scatter);
    find(&what, how, found);
    assert_true(fabs(found[0].mean / (0.25 * (double)num * mean) - 1) < 1e-13);
    assert_true(fabs(found[0].standard_error / (0.25 * (double)num * scatter) - 1) < 1e-12);
    assert_true(found[1].mean == 0.5 * (double)num);
    assert_true(found[1].standard_error == 0);
    assert_true(found[2].mean == 0 && found[2].standard_error == 0); /* no weight at all */
    free(what.powers);
    free(what.weights);
}

static void correlations(void **state) {
    (void)state;
    rows_for_all_layouts(device, check_correlations);
}

/* ---- the rest ---------------------------------------------------------------------------- */

/* Means alone have the bits of those with standard errors; a reset forgets all. */
static void check_means_and_reset(const rows_fixture *what, const rows_layout *how) {
    uint32_t *slots = rows_make_slots(what, how);
    ps_mean expected[ROWS_WEIGHTED];
    ps_mean found[ROWS_WEIGHTED];
    find(what, how, expected);
    ps_accumulator *accumulator = rows_make_accumulator(what, how, slots, true);
    for (size_t round = 0; round < 2; round++) {
        rows_add_all(accumulator, what, how, slots, ROWS_M);
        assert_ok(ps_accumulator_settle(accumulator, error));
        ps_accumulator_weighted(accumulator, found);
        for (size_t w = 0; w < ROWS_WEIGHTED; w++) {
            assert_true(found[w].mean == expected[w].mean && expected[w].standard_error > 0);
            assert_true(isnan(found[w].standard_error));
        }
        ps_accumulator_reset(accumulator);
    }
    ps_accumulator_destroy(accumulator);
    free(slots);
}

static void means_and_reset(void **state) {
    (void)state;
    rows_for_all_layouts(device, check_means_and_reset);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_of_rows), cmocka_unit_test(same_bits_for_every_batch),
        cmocka_unit_test(rings),        cmocka_unit_test(frequencies),
        cmocka_unit_test(correlations), cmocka_unit_test(means_and_reset),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("weighted", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
