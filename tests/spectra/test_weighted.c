/* Weighted sums of powers against plain loops in long double: rows on the host and on the device,
 * strides, lanes, batches, both precisions. Rows are made here; what has no frequency is NaN.
 */
#include "harness.h"

#include "accumulate/blocks.h"
#include "device/reals.h"
#include "spectra/accumulate/accumulate.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;

enum { M = 21, WEIGHTED = 4 };

/* Where the rows are, and how they are laid out. */
typedef struct layout {
    bool is_on_device;
    ps_precision precision;
    unsigned lanes;
    size_t stride, step; /* slots: step i mod stride; no common divisor */
    size_t batch;
} layout;

typedef struct fixture {
    ps_frequencies set;
    ps_bins bins;
    double *powers;  /* [M][set.num], numbers of single precision */
    double *weights; /* [WEIGHTED][set.num] */
} fixture;

/* Exponential powers with a part that all frequencies of a realization share, so that they are
 * correlated. Weights: equal; over 40 decades; the same, far outside the range of float; one ring.
 */
static fixture make_fixture(void) {
    fixture made = {0};
    uint64_t seed = 9;
    assert_ok(ps_frequencies_lattice(&made.set, 2, 20, false, error));
    assert_ok(ps_frequencies_enumerate(&made.set, error));
    assert_ok(ps_bins_create(&made.bins, &made.set, error));
    const size_t num = made.set.num;
    made.powers = calloc(M * num, sizeof(double));
    made.weights = calloc(WEIGHTED * num, sizeof(double));
    for (size_t r = 0; r < M; r++) {
        const double common = test_uniform(&seed);
        for (size_t i = 0; i < num; i++) {
            made.powers[r * num + i] = (float)(common - log1p(-test_uniform(&seed)));
        }
    }
    for (size_t i = 0; i < num; i++) {
        made.weights[i] = 1 / (double)num;
        made.weights[num + i] = pow(10, -40 * test_uniform(&seed));
        made.weights[2 * num + i] = 3e-60 * made.weights[num + i];
    }
    const ps_bin *ring = &made.bins.bins[6];
    for (size_t i = ring->begin; i < ring->end; i++) {
        made.weights[3 * num + made.bins.members[i]] = 1;
    }
    return made;
}

static void free_fixture(fixture *made) {
    ps_frequencies_free(&made->set);
    ps_bins_free(&made->bins);
    free(made->powers);
    free(made->weights);
}

static uint32_t *make_slots(const fixture *what, const layout *how) {
    uint32_t *slots = calloc(what->set.num, sizeof *slots);
    for (size_t i = 0; i < what->set.num; i++) {
        slots[i] = (uint32_t)(i * how->step % how->stride);
    }
    return slots;
}

/* Rows of some realizations, which are freed with release. */
static ps_rows make_rows(const fixture *what, const layout *how, const uint32_t *slots,
                         size_t first, size_t num) {
    double *places = calloc(num * how->stride, sizeof *places);
    ps_rows rows = {num, how->stride, how->precision, places, {0}};
    for (size_t i = 0; i < num * how->stride; i++) {
        places[i] = NAN;
    }
    for (size_t i = 0; i < num * what->set.num; i++) {
        places[i / what->set.num * how->stride + slots[i % what->set.num]] =
            what->powers[first * what->set.num + i];
    }
    if (how->is_on_device) {
        assert_ok(ps_reals_upload(device, &rows.device, how->precision, places, num * how->stride,
                                  "a test", error));
    }
    return rows;
}

static void release(ps_rows *rows) {
    free((void *)rows->host);
    ps_buffer_release(&rows->device);
}

static ps_accumulator *make_accumulator(const fixture *what, const layout *how,
                                        const uint32_t *slots, bool mean_only) {
    ps_accumulator *made = NULL;
    const ps_accumulator_options options = {
        .bins = &what->bins,
        .num_frequencies = what->set.num,
        .slots = slots,
        .stride = how->stride,
        .batch = how->batch,
        .is_on_device = how->is_on_device,
        .precision = how->precision,
        .lanes = how->lanes,
        .want_frequencies = true,
        .mean_only = mean_only,
        .weights = what->weights,
        .num_weighted = WEIGHTED,
    };
    assert_ok(ps_accumulator_create(&made, &options, device, error));
    return made;
}

/* More than M realizations are the same ones again. */
static void add_all(ps_accumulator *accumulator, const fixture *what, const layout *how,
                    const uint32_t *slots, size_t num) {
    for (size_t r = 0, taken = 0; r < num; r += taken) {
        const size_t most = M - r % M < num - r ? M - r % M : num - r;
        taken = most < how->batch ? most : how->batch;
        ps_rows rows = make_rows(what, how, slots, r % M, taken);
        assert_ok(ps_accumulator_add(accumulator, &rows, NULL, error));
        release(&rows);
    }
}

static void find(const fixture *what, const layout *how, ps_mean *means) {
    uint32_t *slots = make_slots(what, how);
    ps_accumulator *accumulator = make_accumulator(what, how, slots, false);
    add_all(accumulator, what, how, slots, M);
    assert_ok(ps_accumulator_settle(accumulator, error));
    ps_accumulator_weighted(accumulator, means);
    ps_accumulator_destroy(accumulator);
    free(slots);
}

static const layout layouts[] = {
    {false, PS_DOUBLE, 1, 840, 1, 4},    {false, PS_DOUBLE, 1, 1000, 7, 1},
    {true, PS_SINGLE, 16, 848, 1, M},    {true, PS_SINGLE, 16, 1040, 77, 5},
    {true, PS_SINGLE, 4, 3000, 1111, 7}, {true, PS_SINGLE, 1, 841, 3, 16},
    {true, PS_SINGLE, 2, 1024, 3, 1},    {true, PS_DOUBLE, 8, 4096, 1235, 3},
    {true, PS_DOUBLE, 4, 1028, 5, 30},   {true, PS_DOUBLE, 16, 2000, 77, M},
};
enum { LAYOUTS = sizeof layouts / sizeof layouts[0], FIRST_SINGLE = 2, FIRST_DOUBLE = 7 };

static void for_all_layouts(void (*check)(const fixture *, const layout *)) {
    fixture what = make_fixture();
    for (size_t i = 0; i < LAYOUTS; i++) {
        const bool has_fp64 = ps_device_get_limits(device)->has_fp64;
        if (!layouts[i].is_on_device || layouts[i].precision == PS_SINGLE || has_fp64) {
            check(&what, &layouts[i]);
        }
    }
    free_fixture(&what);
}

/* ---- against loops ----------------------------------------------------------------------- */

/* What a weight is as a number of float times a power of two of the largest one. */
static double rounded(double weight, double largest) {
    int exponent = 0;
    frexp(largest, &exponent);
    return ldexp((float)ldexp(weight, -exponent), exponent);
}

static long double weigh(const fixture *what, const layout *how, size_t w, size_t r) {
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
static void check_layout(const fixture *what, const layout *how) {
    ps_mean found[WEIGHTED];
    find(what, how, found);
    for (size_t w = 0; w < WEIGHTED; w++) {
        long double mean = 0;
        long double squares = 0;
        for (size_t r = 0; r < M; r++) {
            mean += weigh(what, how, w, r) / M;
        }
        for (size_t r = 0; r < M; r++) {
            const long double off = weigh(what, how, w, r) - mean;
            squares += off * off;
        }
        const long double scatter = sqrtl(squares / (M - 1) / M);
        assert_true(fabsl(found[w].mean / mean - 1) < 1e-13);
        assert_true(fabsl(found[w].standard_error / scatter - 1) < 1e-12);
    }
}

static void sums_of_rows(void **state) {
    (void)state;
    for_all_layouts(check_layout);
}

/* ---- bits -------------------------------------------------------------------------------- */

/* Neither batches nor lanes, where rows have room for them, nor work-group sizes matter. */
static void check_bits(const fixture *what, const layout *how) {
    static const size_t batches[] = {1, 2, 7, M, 64};
    static const size_t group_sizes[] = {1, 3, 64};
    ps_mean first[WEIGHTED];
    find(what, how, first);
    for (size_t i = 0; i < sizeof batches / sizeof batches[0]; i++) {
        for (unsigned lanes = 1; lanes <= how->lanes; lanes *= 2) {
            layout other = *how;
            ps_mean again[WEIGHTED];
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
    for_all_layouts(check_bits);
}

/* ---- bins and frequencies ---------------------------------------------------------------- */

/* The sum over a ring is its mean times its members, and so is its standard error. */
static void check_ring(const fixture *what, const layout *how) {
    uint32_t *slots = make_slots(what, how);
    ps_mean *bins = calloc(what->bins.num, sizeof *bins);
    ps_mean found[WEIGHTED];
    const double count = (double)(what->bins.bins[6].end - what->bins.bins[6].begin);
    ps_accumulator *accumulator = make_accumulator(what, how, slots, false);
    add_all(accumulator, what, how, slots, M);
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
    for_all_layouts(check_ring);
}

/* Weight 1/4 of one frequency: a quarter of its mean and standard error. */
static void check_frequency(const fixture *given, const layout *how) {
    fixture what = *given;
    uint32_t *slots = make_slots(&what, how);
    ps_mean *powers = calloc(what.set.num, sizeof *powers);
    ps_mean found[WEIGHTED];
    const size_t chosen[WEIGHTED] = {0, 1, 511, what.set.num - 1};
    what.weights = calloc(WEIGHTED * what.set.num, sizeof *what.weights);
    for (size_t w = 0; w < WEIGHTED; w++) {
        what.weights[w * what.set.num + chosen[w]] = 0.25;
    }
    ps_accumulator *accumulator = make_accumulator(&what, how, slots, false);
    add_all(accumulator, &what, how, slots, M);
    assert_ok(ps_accumulator_frequencies(accumulator, powers, error));
    ps_accumulator_weighted(accumulator, found);
    for (size_t w = 0; w < WEIGHTED; w++) {
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
    for_all_layouts(check_frequency);
}

/* Two blocks of realizations that are merged, and an open one. */
enum { MANY = 2 * SUM_BLOCK + 40 };

/* Means of frequencies, and behind them those of bins. */
static void find_all(const fixture *what, const layout *how, bool is_gpu, ps_mean *means) {
    uint32_t *slots = make_slots(what, how);
    ps_device_set_dedicated_local_memory(device, is_gpu);
    ps_accumulator *accumulator = make_accumulator(what, how, slots, false);
    add_all(accumulator, what, how, slots, MANY);
    assert_ok(ps_accumulator_frequencies(accumulator, means, error));
    assert_ok(ps_accumulator_bins(accumulator, means + what->set.num, error));
    ps_accumulator_destroy(accumulator);
    ps_device_set_dedicated_local_memory(device, false);
    free(slots);
}

/* Frequencies have the same bits on the host and on the device, bins on the device, whatever the
 * layout. */
static void check_everywhere(const fixture *what, const layout *how) {
    const bool is_single = how->precision == PS_SINGLE;
    const layout *frequencies_of = &layouts[is_single ? FIRST_SINGLE : 0];
    const layout *bins_of = is_single           ? &layouts[FIRST_SINGLE]
                            : how->is_on_device ? &layouts[FIRST_DOUBLE]
                                                : &layouts[0];
    const size_t num = what->set.num;
    ps_mean *means[3];
    for (size_t i = 0; i < 3; i++) {
        means[i] = calloc(num + what->bins.num, sizeof(ps_mean));
    }
    find_all(what, frequencies_of, false, means[0]);
    find_all(what, bins_of, false, means[1]);
    for (size_t gpu = 0; gpu < (how->is_on_device ? 2 : 1); gpu++) {
        find_all(what, how, gpu > 0, means[2]);
        assert_memory_equal(means[2], means[0], num * sizeof(ps_mean));
        assert_memory_equal(means[2] + num, means[1] + num, what->bins.num * sizeof(ps_mean));
    }
    for (size_t i = 0; i < 3; i++) {
        free(means[i]);
    }
}

static void same_sums_everywhere(void **state) {
    (void)state;
    for_all_layouts(check_everywhere);
}

/* Equal rows have no standard error, exactly. */
static void check_equal_rows(const fixture *given, const layout *how) {
    fixture what = *given;
    const size_t num = what.set.num;
    ps_mean *means = calloc(num + what.bins.num, sizeof *means);
    what.powers = calloc(M * num, sizeof *what.powers);
    for (size_t i = 0; i < M * num; i++) {
        what.powers[i] = given->powers[i % num];
    }
    for (size_t gpu = 0; gpu < (how->is_on_device ? 2 : 1); gpu++) {
        find_all(&what, how, gpu > 0, means);
        for (size_t i = 0; i < num + what.bins.num; i++) {
            assert_true(means[i].standard_error == 0);
            assert_true(i >= num || means[i].mean == what.powers[i]);
        }
    }
    free(what.powers);
    free(means);
}

static void equal_rows(void **state) {
    (void)state;
    for_all_layouts(check_equal_rows);
}

/* ---- correlations ------------------------------------------------------------------------ */

/* Every frequency has the power x of its realization, or 2 - x: equal powers have the relative
 * standard error of x, however many they are; opposite ones have none. */
static void check_correlations(const fixture *given, const layout *how) {
    fixture what = *given;
    const size_t num = what.set.num;
    ps_mean found[WEIGHTED];
    ps_sums sums = {0};
    double mean = 0;
    double scatter = 0;
    uint64_t seed = 31;
    what.powers = calloc(M * num, sizeof *what.powers);
    what.weights = calloc(WEIGHTED * num, sizeof *what.weights);
    for (size_t r = 0; r < M; r++) {
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
    ps_sums_finish(&sums, M, &mean, &scatter);
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
    for_all_layouts(check_correlations);
}

/* ---- the rest ---------------------------------------------------------------------------- */

/* Means alone have the bits of those with standard errors; a reset forgets all. */
static void check_means_and_reset(const fixture *what, const layout *how) {
    uint32_t *slots = make_slots(what, how);
    ps_mean expected[WEIGHTED];
    ps_mean found[WEIGHTED];
    find(what, how, expected);
    ps_accumulator *accumulator = make_accumulator(what, how, slots, true);
    for (size_t round = 0; round < 2; round++) {
        add_all(accumulator, what, how, slots, M);
        assert_ok(ps_accumulator_settle(accumulator, error));
        ps_accumulator_weighted(accumulator, found);
        for (size_t w = 0; w < WEIGHTED; w++) {
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
    for_all_layouts(check_means_and_reset);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_of_rows), cmocka_unit_test(same_bits_for_every_batch),
        cmocka_unit_test(rings),        cmocka_unit_test(frequencies),
        cmocka_unit_test(correlations), cmocka_unit_test(means_and_reset),
        cmocka_unit_test(equal_rows),   cmocka_unit_test(same_sums_everywhere),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("weighted", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
