/* accumulate/blocks.cl and fold.cl alone, with whole numbers chosen so that every sum is exact in a
 * pair and beyond the reach of one number: results must be equal, not near.
 */
#include "harness_kernels.h"

#include "accumulate/blocks.h"
#include "spectra/accumulate/accumulate_device.h"

#include <math.h>
#include <stdlib.h>

__extension__ typedef __int128 wide;

static ps_device *device;
static uint64_t seed = 5;

enum { BLOCK = PS_ACCUMULATE_BLOCK };

/* lanes 0 stands for the device's own. */
typedef struct build {
    unsigned precision, lanes;
    size_t num_groups; /* how many work-group sizes */
} build;

static const build builds[] = {{32, 0, 3}, {64, 0, 1}, {32, 4, 3}, {32, 1, 1}, {64, 4, 1}};

static void for_all_builds(void (*check)(const build *)) {
    for (size_t i = 0; i < sizeof builds / sizeof builds[0]; i++) {
        build one = builds[i];
        if (one.lanes == 0) {
            one.lanes = ps_engine_lanes(ps_device_get_limits(device),
                                        one.precision == 64 ? PS_DOUBLE : PS_SINGLE);
        }
        if (test_has_precision(device, one.precision)) {
            check(&one);
        }
    }
}

/* ---- rings of blocks --------------------------------------------------------------------- */

/* Rings of any length in every block, one of them empty; members in any order, some of them twice;
 * pieces in an order of their own. */
enum { RINGS_OF_BLOCK = 9, MEMBERS_OF_RING = 41 };

typedef struct ring_table {
    size_t num_blocks, num_rings;
    uint32_t *first_rings;
    ps_block_ring *rings;
    uint16_t *members;
    size_t num_members;
} ring_table;

static size_t slots_of_block(size_t block, size_t stride) {
    return stride - block * BLOCK < BLOCK ? stride - block * BLOCK : BLOCK;
}

static ring_table make_table(size_t stride) {
    ring_table made = {.num_blocks = (stride + BLOCK - 1) / BLOCK};
    made.num_rings = made.num_blocks * RINGS_OF_BLOCK;
    made.first_rings = calloc(made.num_blocks + 1, sizeof *made.first_rings);
    made.rings = calloc(made.num_rings, sizeof *made.rings);
    made.members = calloc(made.num_rings * MEMBERS_OF_RING, sizeof *made.members);
    for (size_t i = 0; i < made.num_rings; i++) {
        const size_t slots = slots_of_block(i / RINGS_OF_BLOCK, stride);
        const size_t length =
            i % RINGS_OF_BLOCK == 3 ? 0 : 1 + (size_t)(test_uniform(&seed) * MEMBERS_OF_RING);
        made.rings[i] =
            (ps_block_ring){(uint32_t)made.num_members, (uint32_t)(made.num_members + length),
                            (uint32_t)(made.num_rings - 1 - i)};
        for (size_t m = 0; m < length; m++) {
            made.members[made.num_members++] = (uint16_t)(test_uniform(&seed) * (double)slots);
        }
    }
    for (size_t b = 0; b <= made.num_blocks; b++) {
        made.first_rings[b] = (uint32_t)(b * RINGS_OF_BLOCK);
    }
    return made;
}

static void free_table(ring_table *table) {
    free(table->first_rings);
    free(table->rings);
    free(table->members);
}

/* What the kernel keeps of frequencies. Batches begin behind BEFORE realizations of power 0: one
 * whole block, and an open one that they fill up, so that both are carried to the second level. */
enum { NUM_STATES = 4, LEVELS = 2, BEFORE = 2 * SUM_BLOCK - 28, MOST_STRIPS = 2 };

/* What a launch is given; states NULL: bins alone; mean_only: no squares, the last two are not
 * touched. */
typedef struct launch {
    const build *one;
    size_t group, stride, done;
    const ring_table *table;
    const test_memory *sums, *states;
    bool mean_only;
    bool by_strips; /* as on GPUs: bins by several groups, frequencies by strips.cl */
} launch;

#define STATES(with)                                                                               \
    PS_BUFFER((with)->states[0].buffer), PS_BUFFER((with)->states[1].buffer),                      \
        PS_BUFFER((with)->states[2].buffer), PS_BUFFER((with)->states[3].buffer)

static void launch_strips(const launch *with, const blocks_numbers *numbers,
                          const test_memory *rows) {
    const build *one = with->one;
    const size_t vectors = with->stride / one->lanes;
    const size_t end = numbers->done + numbers->num_realizations;
    const size_t num_strips = (end + SUM_BLOCK - 1) / SUM_BLOCK - numbers->done / SUM_BLOCK;
    ps_kernel *kernels[2];
    for (size_t i = 0; i < 2; i++) {
        kernels[i] = test_kernel(device, "accumulate/strips.cl",
                                 i == 0 ? "accumulate_strips" : "accumulate_merge",
                                 "-DPRECISION=%u -DLANES=%u -DSQUARES=%d", one->precision,
                                 one->lanes, with->mean_only ? 0 : 1);
    }
    assert_true(num_strips <= MOST_STRIPS);
    TEST_LAUNCH(device, kernels[0], with->group, vectors, num_strips, 1, PS_STRUCT(*numbers),
                PS_BUFFER(rows->buffer), STATES(with), PS_U32(1 + LEVELS));
    TEST_LAUNCH(device, kernels[1], with->group, vectors, 1, 1, PS_STRUCT(*numbers), STATES(with),
                PS_U32(1 + LEVELS));
}

static void launch_blocks(const launch *with, const double *power, size_t num_rows) {
    const build *one = with->one;
    const ring_table *table = with->table;
    const bool in_one = with->states != NULL && !with->by_strips;
    const size_t at_once = one->lanes * (in_one ? num_rows + 1 : 2); /* all, or some */
    const size_t num_groups = num_rows / at_once + 1;
    ps_kernel *kernel = test_kernel(device, "accumulate/blocks.cl",
                                    in_one ? "accumulate_bins_and_frequencies" : "accumulate_bins",
                                    "-DPRECISION=%u -DLANES=%u -DSQUARES=%d", one->precision,
                                    one->lanes, with->mean_only ? 0 : 1);
    test_memory rows = test_reals_create(device, one->precision, power, num_rows * with->stride);
    test_memory first_rings = test_memory_create(
        device, table->first_rings, (table->num_blocks + 1) * sizeof *table->first_rings);
    test_memory rings =
        test_memory_create(device, table->rings, table->num_rings * sizeof *table->rings);
    test_memory members =
        test_memory_create(device, table->members, table->num_members * sizeof *table->members);
    const blocks_numbers numbers = {.stride = with->stride,
                                    .num_pieces = table->num_rings,
                                    .done = with->done,
                                    .num_realizations = (uint32_t)num_rows,
                                    .at_once = (uint32_t)at_once};
    const ps_argument block = PS_LOCAL(BLOCK * one->lanes * one->precision / 8);
    if (in_one) {
        TEST_LAUNCH(device, kernel, with->group, 1, table->num_blocks, 1, PS_STRUCT(numbers),
                    PS_BUFFER(rows.buffer), PS_BUFFER(first_rings.buffer), PS_BUFFER(rings.buffer),
                    PS_BUFFER(members.buffer), PS_BUFFER(with->sums->buffer), STATES(with), block);
    } else {
        TEST_LAUNCH(device, kernel, with->group, 1, table->num_blocks, num_groups,
                    PS_STRUCT(numbers), PS_BUFFER(rows.buffer), PS_BUFFER(first_rings.buffer),
                    PS_BUFFER(rings.buffer), PS_BUFFER(members.buffer),
                    PS_BUFFER(with->sums->buffer), block);
    }
    if (with->by_strips) {
        launch_strips(with, &numbers, &rows);
    }
    test_memory_free_unchanged(&rows);
    test_memory_free_unchanged(&first_rings);
    test_memory_free_unchanged(&rings);
    test_memory_free_unchanged(&members);
}

static size_t count_groups(const build *one, size_t num_rows) {
    return (num_rows + one->lanes - 1) / one->lanes;
}

static test_memory create_sums(const build *one, size_t num_rows, size_t num_pairs) {
    return test_reals_create(device, one->precision, NULL,
                             count_groups(one, num_rows) * num_pairs * 2 * one->lanes);
}

/* Sum of a ring's powers in a row; rows that there are not have none. */
static int64_t sum_ring(const ring_table *table, size_t ring, const double *power, size_t stride,
                        size_t row, size_t num_rows) {
    int64_t sum = 0;
    for (uint32_t m = table->rings[ring].first; row < num_rows && m < table->rings[ring].end; m++) {
        const size_t slot = ring / RINGS_OF_BLOCK * BLOCK + table->members[m];
        sum += (int64_t)power[row * stride + slot];
    }
    return sum;
}

static void check_pieces(const launch *with, const double *power, size_t num_rows) {
    const ring_table *table = with->table;
    const size_t lanes = with->one->lanes;
    double *found = test_reals_read(with->sums, with->one->precision);
    for (size_t row = 0; row < count_groups(with->one, num_rows) * lanes; row++) {
        for (size_t i = 0; i < table->num_rings; i++) {
            const size_t entry = row / lanes * table->num_rings + table->rings[i].piece;
            const double *pair = found + entry * 2 * lanes + row % lanes;
            assert_true(isfinite(pair[0]) && isfinite(pair[lanes]));
            assert_true((int64_t)pair[0] + (int64_t)pair[lanes] ==
                        sum_ring(table, i, power, with->stride, row, num_rows));
        }
    }
    free(found);
}

/* ---- both kernels ------------------------------------------------------------------------ */

/* Squares that need a pair themselves, and low parts that stay exact. */
static double largest_power(unsigned precision) {
    return precision == 64 ? 0x1p32 : 0x1p16;
}

/* Slot i of one row of sums: realizations first .. end - 1, and zeros. */
static void check_row(const launch *with, double *const *found, size_t row, size_t i,
                      const double *power, size_t first, size_t end) {
    const size_t at = row * with->stride + i;
    wide sum = 0, squares = 0;
    for (size_t r = first; r < end; r++) {
        const int64_t p = (int64_t)power[r * with->stride + i];
        sum += p;
        squares += with->mean_only ? 0 : (wide)p * p;
    }
    assert_true((wide)found[0][at] + (wide)found[1][at] == sum);
    assert_true((wide)found[2][at] + (wide)found[3][at] == squares);
}

static void check_states(const launch *with, const double *power, size_t num_rows) {
    const size_t stride = with->stride;
    double *found[NUM_STATES];
    for (size_t i = 0; i < NUM_STATES; i++) {
        found[i] = test_reals_read(&with->states[i], with->one->precision);
    }
    const size_t closing = 2 * SUM_BLOCK - BEFORE;
    for (size_t i = 0; i < stride && num_rows > closing; i++) {
        check_row(with, found, LEVELS, i, power, 0, closing);
        check_row(with, found, 0, i, power, closing, num_rows);
    }
    for (size_t i = 0; i < NUM_STATES; i++) {
        free(found[i]);
    }
}

/* Batches of 7, 0, 1 and 32 realizations, one after the other. */
static void run_batches(launch with) {
    double *power = test_whole_numbers(&seed, 40 * with.stride, largest_power(with.one->precision));
    const size_t batches[] = {7, 0, 1, 32};
    const size_t num = (1 + LEVELS + MOST_STRIPS) * with.stride;
    double *zeros = calloc(num, sizeof *zeros);
    test_memory states[NUM_STATES];
    size_t done = 0;
    for (size_t i = 0; i < NUM_STATES; i++) {
        states[i] = test_reals_create(device, with.one->precision, zeros, num);
    }
    with.states = states;
    for (size_t b = 0; b < 4; b++) {
        test_memory sums = create_sums(with.one, batches[b], with.table->num_rings);
        with.sums = &sums;
        with.done = BEFORE + done;
        launch_blocks(&with, power + done * with.stride, batches[b]);
        check_pieces(&with, power + done * with.stride, batches[b]);
        test_memory_free(&sums);
        done += batches[b];
        check_states(&with, power, done);
    }
    for (size_t i = 0; i < NUM_STATES; i++) {
        test_memory_free(&states[i]);
    }
    free(zeros);
    free(power);
}

/* Less than a block, a block, two and a part. */
static void check_frequencies(const build *one) {
    const size_t strides[] = {one->lanes, 5 * one->lanes, BLOCK, 2 * BLOCK + 3 * one->lanes};
    for (size_t i = 0; i < 4; i++) {
        ring_table table = make_table(strides[i]);
        for (size_t g = 0; g < one->num_groups; g++) {
            launch with = {
                .one = one, .group = TEST_GROUP_SIZES[g], .stride = strides[i], .table = &table};
            for (int way = 0; way < 4; way++) {
                with.by_strips = way / 2 > 0;
                with.mean_only = way % 2 > 0;
                run_batches(with);
            }
        }
        free_table(&table);
    }
}

static void bins_and_frequencies(void **state) {
    (void)state;
    for_all_builds(check_frequencies);
}

/* Two groups of realizations, the second not full: numbers as large as there are whole ones. */
static void check_bins(const build *one) {
    const size_t stride = BLOCK + one->lanes, num_rows = one->lanes + (one->lanes + 1) / 2;
    ring_table table = make_table(stride);
    double *power =
        test_whole_numbers(&seed, num_rows * stride, one->precision == 64 ? 0x1p53 : 0x1p24);
    for (size_t g = 0; g < one->num_groups; g++) {
        test_memory sums = create_sums(one, num_rows, table.num_rings);
        const launch with = {.one = one,
                             .group = TEST_GROUP_SIZES[g],
                             .stride = stride,
                             .table = &table,
                             .sums = &sums};
        launch_blocks(&with, power, num_rows);
        check_pieces(&with, power, num_rows);
        test_memory_free(&sums);
    }
    free(power);
    free_table(&table);
}

static void bins_alone(void **state) {
    (void)state;
    for_all_builds(check_bins);
}

/* ---- fold -------------------------------------------------------------------------------- */

/* Pieces of bins: two pieces, one, none at all, one, five. */
enum { BINS = 5, PIECES = 9, GROUPS = 2 };
static const uint32_t bins[BINS][2] = {{0, 2}, {2, 3}, {3, 3}, {3, 4}, {4, 9}};

static void check_folded(const build *one, const double *pieces, const test_memory *result) {
    const size_t lanes = one->lanes;
    double *found = test_reals_read(result, one->precision);
    for (size_t i = 0; i < GROUPS * BINS * lanes; i++) {
        const size_t lane = i % lanes, bin = i / lanes % BINS, group = i / lanes / BINS;
        const double *pair = found + i / lanes * 2 * lanes + lane;
        int64_t sum = 0;
        for (uint32_t piece = bins[bin][0]; piece < bins[bin][1]; piece++) {
            const double *part = pieces + (group * PIECES + piece) * 2 * lanes + lane;
            sum += (int64_t)part[0] + (int64_t)part[lanes];
        }
        assert_true(isfinite(pair[0]) && isfinite(pair[lanes]));
        assert_true((int64_t)pair[0] + (int64_t)pair[lanes] == sum);
    }
    free(found);
}

static void check_fold(const build *one) {
    const size_t pair = 2 * one->lanes;
    ps_kernel *kernel = test_kernel(device, "accumulate/fold.cl", "accumulate_fold",
                                    "-DPRECISION=%u -DLANES=%u", one->precision, one->lanes);
    double *pieces =
        test_whole_numbers(&seed, GROUPS * PIECES * pair, one->precision == 64 ? 0x1p50 : 0x1p21);
    for (size_t g = 0; g < one->num_groups; g++) {
        test_memory sums =
            test_reals_create(device, one->precision, pieces, GROUPS * PIECES * pair);
        test_memory ranges = test_memory_create(device, bins, sizeof bins);
        test_memory result = test_reals_create(device, one->precision, NULL, GROUPS * BINS * pair);
        TEST_LAUNCH(device, kernel, TEST_GROUP_SIZES[g], BINS, GROUPS, 1, PS_BUFFER(sums.buffer),
                    PS_BUFFER(ranges.buffer), PS_BUFFER(result.buffer), PS_U64(BINS),
                    PS_U64(PIECES));
        check_folded(one, pieces, &result);
        test_memory_free_unchanged(&sums);
        test_memory_free_unchanged(&ranges);
        test_memory_free(&result);
    }
    free(pieces);
}

static void pieces_of_bins(void **state) {
    (void)state;
    for_all_builds(check_fold);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bins_and_frequencies),
        cmocka_unit_test(bins_alone),
        cmocka_unit_test(pieces_of_bins),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernels_accumulate", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
