/* torus/product.cl, fold.cl and power.cl alone, with whole numbers chosen so that every sum is
 * exact in a pair and beyond the reach of one number: results must be equal, not near.
 */
#include "harness_kernels.h"
#include "torus/product.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;
static uint64_t seed = 4;

/* A kernel is tried at each of these; lanes 0 stands for the device's own. */
typedef struct build {
    unsigned precision, lanes;
    size_t num_groups; /* how many work-group sizes */
} build;

static const build builds[] = {{32, 0, 3}, {64, 0, 1}, {32, 1, 1}, {64, 4, 1}};

static bool prepare(build *out, size_t index) {
    *out = builds[index];
    if (out->lanes == 0) {
        out->lanes = ps_engine_lanes(ps_device_get_limits(device),
                                     out->precision == 64 ? PS_DOUBLE : PS_SINGLE);
    }
    return test_has_precision(device, out->precision);
}

/* Calls check for every build that the device can run. */
static void for_all_builds(void (*check)(const build *)) {
    for (size_t i = 0; i < sizeof builds / sizeof builds[0]; i++) {
        build one;
        if (prepare(&one, i)) {
            check(&one);
        }
    }
}

/* ---- product ----------------------------------------------------------------------------- */

enum { RUN = 8, REALIZATIONS = 7, LEFT_TILES = 3, RIGHT_TILES = 2, PAIRS = 5 };
enum { TILES = LEFT_TILES + RIGHT_TILES, TABLE_POINTS = 20 * RUN };

/* Not in order, one pair left out. */
static const uint32_t pairs[PAIRS][2] = {{2, 1}, {0, 0}, {1, 1}, {0, 1}, {2, 0}};
static const size_t counts[REALIZATIONS] = {0, 1, 2, RUN - 1, RUN + 1, 67, TABLE_POINTS};

/* Products and their runs fit into a number (24 or 53 bits), sums over all runs do not. */
static double largest_entry(unsigned precision) {
    return precision == 64 ? 0x1p24 : 0x1p10;
}

/* [realization][tile][point][cos, sin][lanes]; points that a realization lacks are NaN. */
static double *make_table(const build *one) {
    const size_t num = (size_t)REALIZATIONS * TILES * TABLE_POINTS * 2 * one->lanes;
    double *table = test_whole_numbers(&seed, num, largest_entry(one->precision));
    for (size_t i = 0; i < num; i++) {
        const size_t j = i / (2 * one->lanes) % TABLE_POINTS;
        const size_t r = i / (2 * one->lanes) / TABLE_POINTS / TILES;
        table[i] = j < counts[r] ? (i % 3 == 0 ? fabs(table[i]) : table[i]) : NAN;
    }
    return table;
}

static const double *table_at(const build *one, const double *table, size_t r, size_t tile,
                              size_t j) {
    return table + ((r * TILES + tile) * TABLE_POINTS + j) * 2 * one->lanes;
}

/* One of cc, sc, cs, ss of a left and a right frequency. */
static int64_t expected_product(const build *one, const double *table, size_t r, size_t pair,
                                size_t left, size_t which, size_t right) {
    int64_t sum = 0;
    for (size_t j = 0; j < counts[r]; j++) {
        const double *l = table_at(one, table, r, pairs[pair][0], j);
        const double *x = table_at(one, table, r, LEFT_TILES + pairs[pair][1], j);
        const int64_t a = (int64_t)l[which % 2 * one->lanes + left];
        sum += a * (int64_t)x[which / 2 * one->lanes + right];
    }
    return sum;
}

/* Everything in sums is `times` what one launch adds. */
static void check_products(const build *one, const double *table, const test_memory *sums,
                           int times) {
    double *found = test_reals_read(sums, one->precision);
    const double *at = found;
    for (size_t r = 0; r < REALIZATIONS; r++) {
        for (size_t i = 0; i < PAIRS * one->lanes * 4; i++, at += 2 * one->lanes) {
            for (size_t right = 0; right < one->lanes; right++) {
                const int64_t sum = times * expected_product(one, table, r, i / 4 / one->lanes,
                                                             i / 4 % one->lanes, i % 4, right);
                assert_true((int64_t)at[right] + (int64_t)at[one->lanes + right] == sum);
                assert_true(isfinite(at[right]) && isfinite(at[one->lanes + right]));
            }
        }
    }
    free(found);
}

/* The realizations of a launch go into rows FIRST_ROW .. of more. */
enum { FIRST_ROW = 2, ROWS = FIRST_ROW + REALIZATIONS + 1 };
static const double scales[ROWS] = {8, 16, 1, 0.5, 4, 32, 2, 0.25, 64, 128};

/* |(cc - ss, sc + cs)|^2 and |(cc + ss, sc - cs)|^2 of pairs. */
static double expected_square(const double *sum, size_t lanes, bool is_minus) {
    const double cc = sum[0] + sum[lanes], sc = sum[2 * lanes] + sum[3 * lanes];
    const double cs = sum[4 * lanes] + sum[5 * lanes], ss = sum[6 * lanes] + sum[7 * lanes];
    const double re = is_minus ? cc + ss : cc - ss, im = is_minus ? sc - cs : sc + cs;
    return re * re + im * im;
}

/* Powers in the rows of this launch; rows of others and what lies behind must survive (NaN). */
static void check_powers(const build *one, const test_memory *sums, const test_memory *power,
                         size_t stride) {
    const size_t lanes = one->lanes, num_left = PAIRS * lanes;
    const double allowed = one->precision == 64 ? 0x1p-50 : 0x1p-21;
    double *values = test_reals_read(sums, one->precision);
    double *found = test_reals_read(power, one->precision);
    for (size_t i = 0; i < ROWS * stride; i++) {
        const size_t r = i / stride - FIRST_ROW, left = i % stride / (2 * lanes);
        if (r >= REALIZATIONS || left >= num_left) { /* or before the first */
            assert_true(isnan(found[i]));
            continue;
        }
        const double *sum = values + (r * num_left + left) * 8 * lanes + i % lanes;
        const double expected =
            expected_square(sum, lanes, i % stride / lanes % 2 == 1) * scales[FIRST_ROW + r];
        assert_true(fabs(found[i] - expected) <= allowed * expected);
    }
    free(values);
    free(found);
}

typedef struct product_memory {
    test_memory table, starts, sums, factors, power;
} product_memory;

static void launch_pairs(ps_kernel *kernel, size_t group, const product_numbers *numbers,
                         const product_memory *memory) {
    test_memory tiles = test_memory_create(device, pairs, sizeof pairs);
    TEST_LAUNCH(device, kernel, group, PAIRS, REALIZATIONS, 1, PS_STRUCT(*numbers),
                PS_BUFFER(memory->table.buffer), PS_BUFFER(memory->starts.buffer),
                PS_BUFFER(tiles.buffer), PS_BUFFER(memory->sums.buffer),
                PS_BUFFER(memory->factors.buffer), PS_BUFFER(memory->power.buffer));
    test_memory_free_unchanged(&tiles);
}

static void check_group(const build *one, ps_kernel *kernel, size_t group, const double *values) {
    const size_t table_length = (size_t)REALIZATIONS * TILES * TABLE_POINTS * 2 * one->lanes;
    const size_t sums_length = (size_t)REALIZATIONS * PAIRS * one->lanes * 8 * one->lanes;
    const size_t stride = (PAIRS * one->lanes * 2 + 1) * one->lanes;
    uint64_t offsets[REALIZATIONS + 1] = {17}; /* only differences count */
    for (size_t r = 0; r < REALIZATIONS; r++) {
        offsets[r + 1] = offsets[r] + counts[r];
    }
    product_memory memory = {
        .table = test_reals_create(device, one->precision, values, table_length),
        .starts = test_memory_create(device, offsets, sizeof offsets),
        .sums = test_reals_create(device, one->precision, NULL, sums_length),
        .factors = test_reals_create(device, one->precision, scales, ROWS),
        .power = test_reals_create(device, one->precision, NULL, ROWS * stride)};
    for (int times = 1; times <= 2; times++) { /* begun anew, then continued and finished */
        const product_numbers numbers = {.num_pairs = PAIRS,
                                         .num_tiles = TILES,
                                         .num_left_tiles = LEFT_TILES,
                                         .table_points = TABLE_POINTS,
                                         .first_row = FIRST_ROW,
                                         .stride = stride,
                                         .is_first = times == 1,
                                         .is_last = times == 2};
        launch_pairs(kernel, group, &numbers, &memory);
        check_products(one, values, &memory.sums, times);
    }
    check_powers(one, &memory.sums, &memory.power, stride);
    test_memory_free_unchanged(&memory.factors);
    test_memory_free(&memory.power);
    test_memory_free_unchanged(&memory.table);
    test_memory_free_unchanged(&memory.starts);
    test_memory_free(&memory.sums);
}

static void check_product(const build *one) {
    double *values = make_table(one);
    ps_kernel *kernel =
        test_kernel(device, "torus/product.cl", "torus_product",
                    "-DPRECISION=%u -DLANES=%u -DRUN=%d", one->precision, one->lanes, RUN);
    for (size_t g = 0; g < one->num_groups; g++) {
        check_group(one, kernel, TEST_GROUP_SIZES[2 - g], values);
    }
    free(values);
}

static void product(void **state) {
    (void)state;
    for_all_builds(check_product);
}

/* ---- fold -------------------------------------------------------------------------------- */

/* The first row of sums belongs to somebody else. */
enum { FOLD_TILES = 5, FOLD_REALIZATIONS = 3, FOLD_FIRST_ROW = 1 };

/* Low parts are small, as they are in sums. */
static double *make_chunks(const build *one, size_t num) {
    double *chunks = test_whole_numbers(&seed, num, one->precision == 64 ? 0x1p53 : 0x1p24);
    for (size_t i = 0; i < num; i++) {
        chunks[i] = i / one->lanes % 2 == 0 ? chunks[i] : rint(chunks[i] * 0x1p-14);
    }
    return chunks;
}

static void launch_fold(const build *one, ps_kernel *kernel, size_t group, const double *chunks,
                        size_t num_chunks, bool is_first, test_memory *totals) {
    test_memory sums = test_reals_create(device, one->precision, chunks,
                                         (FOLD_FIRST_ROW + FOLD_REALIZATIONS) * num_chunks *
                                             FOLD_TILES * 4 * one->lanes);
    TEST_LAUNCH(device, kernel, group, FOLD_TILES, FOLD_REALIZATIONS, 1, PS_BUFFER(sums.buffer),
                PS_BUFFER(totals->buffer), PS_U64(FOLD_FIRST_ROW), PS_U64(FOLD_TILES),
                PS_U32(num_chunks), PS_U32(is_first));
    test_memory_free_unchanged(&sums);
}

/* Adds the chunks to expected[realization][tile][cos, sin][lanes]. */
static void add_chunks(const build *one, const double *chunks, size_t num_chunks,
                       int64_t *expected) {
    const size_t row = FOLD_TILES * 4 * one->lanes;
    const double *first = chunks + FOLD_FIRST_ROW * num_chunks * row;
    for (size_t i = 0; i < FOLD_REALIZATIONS * num_chunks * row; i++) {
        const size_t r = i / row / num_chunks, part = i % row / one->lanes;
        expected[(r * FOLD_TILES * 2 + part / 2) * one->lanes + i % one->lanes] +=
            (int64_t)first[i];
    }
}

static void check_totals(const build *one, const test_memory *totals, const int64_t *expected) {
    double *found = test_reals_read(totals, one->precision);
    const double *first = found + (size_t)FOLD_FIRST_ROW * FOLD_TILES * 4 * one->lanes;
    for (const double *other = found; other < first; other++) {
        assert_true(isnan(*other));
    }
    for (size_t i = 0; i < FOLD_REALIZATIONS * FOLD_TILES * 2 * one->lanes; i++) {
        const double *pair = first + i / one->lanes * 2 * one->lanes + i % one->lanes;
        assert_true(isfinite(pair[0]) && isfinite(pair[one->lanes]));
        assert_true((int64_t)pair[0] + (int64_t)pair[one->lanes] == expected[i]);
    }
    free(found);
}

/* Slabs of 5, 0, 1 and 2 chunks, one after the other. */
static void check_fold(const build *one) {
    const size_t slabs[] = {5, 0, 1, 2};
    ps_kernel *kernel = test_kernel(device, "torus/fold.cl", "torus_fold",
                                    "-DPRECISION=%u -DLANES=%u", one->precision, one->lanes);
    for (size_t g = 0; g < one->num_groups; g++) {
        const size_t length = (FOLD_FIRST_ROW + FOLD_REALIZATIONS) * FOLD_TILES * 4 * one->lanes;
        test_memory totals = test_reals_create(device, one->precision, NULL, length);
        int64_t *expected = calloc(length / 2, sizeof *expected);
        for (size_t slab = 0; slab < sizeof slabs / sizeof slabs[0]; slab++) {
            double *chunks = make_chunks(one, slabs[slab] * length);
            launch_fold(one, kernel, TEST_GROUP_SIZES[g], chunks, slabs[slab], slab == 0, &totals);
            add_chunks(one, chunks, slabs[slab], expected);
            check_totals(one, &totals, expected);
            free(chunks);
        }
        free(expected);
        test_memory_free(&totals);
    }
}

static void fold(void **state) {
    (void)state;
    for_all_builds(check_fold);
}

/* ---- power ------------------------------------------------------------------------------- */

enum { POWER_REALIZATIONS = 3 };

/* Real parts and imaginary parts up to it have squares that a number holds. */
static double largest_part(unsigned precision) {
    return precision == 64 ? 0x1p23 : 0x1p9;
}

/* Rows have room before and behind, and there are rows behind: they must survive (NaN). */
static void check_power_list(const build *one) {
    enum { NUM_TILES = 5 };
    const size_t lanes = one->lanes, first_slot = 2 * lanes, stride = (NUM_TILES + 3) * lanes;
    const size_t length = (size_t)POWER_REALIZATIONS * NUM_TILES * 4 * lanes;
    ps_kernel *kernel = test_kernel(device, "torus/power.cl", "torus_power_list",
                                    "-DPRECISION=%u -DLANES=%u", one->precision, one->lanes);
    double *values = test_whole_numbers(&seed, length, largest_part(one->precision));
    for (size_t g = 0; g < one->num_groups; g++) {
        test_memory totals = test_reals_create(device, one->precision, values, length);
        test_memory factors = test_reals_create(device, one->precision, scales, ROWS);
        test_memory power = test_reals_create(device, one->precision, NULL, ROWS * stride);
        TEST_LAUNCH(device, kernel, TEST_GROUP_SIZES[g], NUM_TILES, POWER_REALIZATIONS, 1,
                    PS_BUFFER(totals.buffer), PS_BUFFER(factors.buffer), PS_BUFFER(power.buffer),
                    PS_U64(NUM_TILES), PS_U64(first_slot), PS_U64(stride));
        double *found = test_reals_read(&power, one->precision);
        for (size_t i = 0; i < ROWS * stride; i++) {
            const size_t r = i / stride, slot = i % stride - first_slot;
            if (r >= POWER_REALIZATIONS || slot >= NUM_TILES * lanes) { /* or before the first */
                assert_true(isnan(found[i]));
                continue;
            }
            const double *total =
                values + (r * NUM_TILES + slot / lanes) * 4 * lanes + slot % lanes;
            const double re = total[0] + total[lanes], im = total[2 * lanes] + total[3 * lanes];
            assert_true(found[i] == (re * re + im * im) * scales[r]);
        }
        free(found);
        test_memory_free_unchanged(&totals);
        test_memory_free_unchanged(&factors);
        test_memory_free(&power);
    }
    free(values);
}

static void power_of_lists(void **state) {
    (void)state;
    for_all_builds(check_power_list);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(product),
        cmocka_unit_test(fold),
        cmocka_unit_test(power_of_lists),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernels_torus", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
