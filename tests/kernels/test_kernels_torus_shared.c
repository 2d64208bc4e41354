/* torus/product_shared.cl, whose sums and powers must have the bits of a table of torus/list.cl and
 * torus/product.cl; torus/product_units.cl, by the model of matrix units, whose bits must not
 * depend on the size of blocks.
 */
#include "harness_kernels.h"
#include "torus/product.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;
static uint64_t seed = 4;

/* Few points, for Oclgrind. */
enum { RUN = 8, REALIZATIONS = 4, TABLE_POINTS = 3 * RUN };
static const size_t counts[REALIZATIONS] = {0, 1, RUN + 1, TABLE_POINTS};

/* The realizations of a launch go into rows FIRST_ROW .. of more. */
enum { FIRST_ROW = 2, ROWS = FIRST_ROW + REALIZATIONS + 1 };
static const double scales[ROWS] = {8, 16, 1, 0.5, 4, 32, 2};

/* Two blocks, of BLOCK_TILES left tiles and of one, with fewer right tiles than they have room for;
 * one pair is left out. */
enum { LANES = 4, LEFT_TILES = BLOCK_TILES + 1, RIGHT_TILES = 3, DIMENSION = 3 };
enum {
    TILES = LEFT_TILES + RIGHT_TILES,
    PAIRS = LEFT_TILES * RIGHT_TILES - 1,
    STRIDE = PAIRS * LANES * 2 * LANES,
    SUMS = REALIZATIONS * PAIRS * LANES * 8 * LANES,
    POINTS = REALIZATIONS * TABLE_POINTS
};

typedef struct inputs {
    test_memory points, weights, starts, frequencies, pairs, blocks, in_block, scales;
} inputs;

/* Left frequencies have two axes, right ones the third. */
static test_memory make_frequencies(unsigned precision) {
    enum { ROW = TILES * LANES };
    int64_t doubles[DIMENSION * ROW];
    int32_t singles[DIMENSION * ROW];
    for (size_t i = 0; i < DIMENSION * ROW; i++) {
        const bool is_right = i % ROW >= LEFT_TILES * LANES;
        const int32_t k = (int32_t)(test_uniform(&seed) * 4001) - 2000;
        doubles[i] = singles[i] = is_right == (i / ROW == 2) ? k : 0;
    }
    return precision == 64 ? test_memory_create(device, doubles, sizeof doubles)
                           : test_memory_create(device, singles, sizeof singles);
}

/* Of blocks with so many tiles a side: two small ones, or a large one. */
static void make_tiles(inputs *out, uint32_t block_tiles) {
    const uint32_t first_tiles[2][2] = {{0, 0}, {block_tiles, 0}};
    uint32_t in_block[2 * LARGE_TILES * LARGE_TILES];
    uint32_t tiles[PAIRS][2];
    memset(in_block, 0xff, sizeof in_block);
    for (uint32_t i = 0; i < PAIRS; i++) {
        const uint32_t left = (i + 1) / RIGHT_TILES, right = (i + 1) % RIGHT_TILES;
        tiles[i][0] = left;
        tiles[i][1] = right;
        in_block[left * block_tiles + right] = i; /* rows of all blocks, one below the other */
    }
    out->pairs = test_memory_create(device, tiles, sizeof tiles);
    out->blocks = test_memory_create(device, first_tiles, sizeof first_tiles);
    out->in_block = test_memory_create(device, in_block, sizeof in_block);
}

static inputs make_inputs(unsigned precision, uint32_t block_tiles) {
    uint64_t points[POINTS * DIMENSION];
    double weights[POINTS];
    uint64_t offsets[REALIZATIONS + 1] = {0};
    for (size_t r = 0; r < REALIZATIONS; r++) {
        offsets[r + 1] = offsets[r] + counts[r];
    }
    for (size_t i = 0; i < POINTS * DIMENSION; i++) {
        points[i] = (uint64_t)ldexp(test_uniform(&seed), 64);
        weights[i / DIMENSION] = (double)(float)(test_uniform(&seed) - 0.3);
    }
    inputs made = {.points = test_memory_create(device, points, sizeof points),
                   .weights = test_reals_create(device, precision, weights, POINTS),
                   .starts = test_memory_create(device, offsets, sizeof offsets),
                   .frequencies = make_frequencies(precision),
                   .scales = test_reals_create(device, precision, scales, ROWS)};
    make_tiles(&made, block_tiles);
    return made;
}

static ps_kernel *make_kernel(unsigned precision, const char *source, const char *name) {
    return test_kernel(device, source, name,
                       "-DPRECISION=%u -DLANES=%d -DRUN=%d -DDIMENSION=%d -DLEFT_AXES=2 "
                       "-DSTORE_TABLE=1",
                       precision, LANES, RUN, DIMENSION);
}

/* The sums and powers by a table and torus_product. */
static void multiply_table(unsigned precision, const product_numbers *numbers, const inputs *in,
                           test_memory *sums, test_memory *power) {
    ps_kernel *list = make_kernel(precision, "torus/list.cl", "torus_list");
    ps_kernel *kernel = make_kernel(precision, "torus/product.cl", "torus_product");
    const size_t entries = (size_t)REALIZATIONS * TILES * 2 * LANES;
    test_memory chunks = test_reals_create(device, precision, NULL, 2 * entries);
    test_memory table = test_reals_create(device, precision, NULL, entries * TABLE_POINTS);
    TEST_LAUNCH(device, list, 1, TILES, 1, REALIZATIONS, PS_BUFFER(in->points.buffer),
                PS_BUFFER(in->weights.buffer), PS_BUFFER(in->starts.buffer),
                PS_BUFFER(in->frequencies.buffer), PS_BUFFER(chunks.buffer), PS_U64(0),
                PS_U64(TILES), PS_U64(TABLE_POINTS), PS_BUFFER(table.buffer), PS_U64(TABLE_POINTS),
                PS_U64(LEFT_TILES));
    TEST_LAUNCH(device, kernel, 1, PAIRS, REALIZATIONS, 1, PS_STRUCT(*numbers),
                PS_BUFFER(table.buffer), PS_BUFFER(in->starts.buffer), PS_BUFFER(in->pairs.buffer),
                PS_BUFFER(sums->buffer), PS_BUFFER(in->scales.buffer), PS_BUFFER(power->buffer));
    test_memory_free(&table);
    test_memory_free(&chunks);
}

static void multiply_shared(unsigned precision, size_t group, const product_numbers *numbers,
                            const inputs *in, test_memory *sums, test_memory *power) {
    ps_kernel *kernel = make_kernel(precision, "torus/product_shared.cl", "torus_product_shared");
    const size_t row = (size_t)BLOCK_TILES * LANES * precision / 8;
    TEST_LAUNCH(device, kernel, group, group, 2, REALIZATIONS, PS_STRUCT(*numbers),
                PS_BUFFER(in->points.buffer), PS_BUFFER(in->weights.buffer),
                PS_BUFFER(in->starts.buffer), PS_BUFFER(in->frequencies.buffer),
                PS_BUFFER(in->blocks.buffer), PS_BUFFER(in->in_block.buffer),
                PS_BUFFER(sums->buffer), PS_BUFFER(in->scales.buffer), PS_BUFFER(power->buffer),
                PS_LOCAL(2 * 2 * RUN * row));
}

static void check_equal(const test_memory *one, const test_memory *other) {
    void *const bytes = test_memory_read(one);
    void *const others = test_memory_read(other);
    assert_memory_equal(bytes, others, one->bytes);
    free(bytes);
    free(others);
}

/* Begun anew, continued and finished; then in one go, when sums need not be kept. */
static void check_equal_bits(unsigned precision, size_t group, const inputs *in) {
    test_memory sums[2], power[2];
    for (size_t i = 0; i < 2; i++) {
        sums[i] = test_reals_create(device, precision, NULL, SUMS);
        power[i] = test_reals_create(device, precision, NULL, (size_t)ROWS * STRIDE);
    }
    for (unsigned step = 0; step < 3; step++) {
        const product_numbers numbers = {.num_pairs = PAIRS,
                                         .num_tiles = TILES,
                                         .num_left_tiles = LEFT_TILES,
                                         .table_points = TABLE_POINTS,
                                         .first_row = FIRST_ROW,
                                         .stride = STRIDE,
                                         .is_first = step != 1,
                                         .is_last = step > 0,
                                         .keeps_sums = step == 1};
        multiply_table(precision, &numbers, in, &sums[0], &power[0]);
        multiply_shared(precision, group, &numbers, in, &sums[1], &power[1]);
        if (step < 2) {
            check_equal(&sums[0], &sums[1]);
        }
        check_equal(&power[0], &power[1]);
    }
    for (size_t i = 0; i < 2; i++) {
        test_memory_free(&sums[i]);
        test_memory_free(&power[i]);
    }
}

static void free_inputs(inputs *in) {
    test_memory *const all[] = {&in->points, &in->weights, &in->starts,   &in->frequencies,
                                &in->pairs,  &in->blocks,  &in->in_block, &in->scales};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        test_memory_free_unchanged(all[i]);
    }
}

static void shared_product(void **state) {
    const size_t groups[] = {16, test_group(128)}; /* several jobs for an item, and one */
    (void)state;
    for (unsigned precision = 32; precision <= 64; precision += 32) {
        if (!test_has_precision(device, precision)) {
            continue;
        }
        inputs in = make_inputs(precision, BLOCK_TILES);
        for (size_t g = 0; g < sizeof groups / sizeof groups[0]; g++) {
            check_equal_bits(precision, groups[g], &in);
        }
        free_inputs(&in);
    }
}

/* ---- matrix units ------------------------------------------------------------------------ */

static void multiply_units(unsigned precision, uint32_t block_tiles, const product_numbers *numbers,
                           const inputs *in, test_memory *sums, test_memory *power) {
    ps_kernel *kernel =
        test_kernel(device, "torus/product_units.cl", "torus_product_units",
                    "-DPRECISION=%u -DLANES=%d -DDIMENSION=%d -DLEFT_AXES=2 "
                    "-DTILES=%u %s",
                    precision, LANES, DIMENSION, block_tiles, ps_units_option(PS_UNITS_EMULATED));
    const size_t items = UNIT_ITEMS(precision, block_tiles);
    const size_t row = (size_t)block_tiles * LANES * precision / 8;
    const size_t steps = (size_t)UNIT_STEPS(precision);
    TEST_LAUNCH(device, kernel, items, items, block_tiles == BLOCK_TILES ? 2 : 1, REALIZATIONS,
                PS_STRUCT(*numbers), PS_BUFFER(in->points.buffer), PS_BUFFER(in->weights.buffer),
                PS_BUFFER(in->starts.buffer), PS_BUFFER(in->frequencies.buffer),
                PS_BUFFER(in->blocks.buffer), PS_BUFFER(in->in_block.buffer),
                PS_BUFFER(sums->buffer), PS_BUFFER(in->scales.buffer), PS_BUFFER(power->buffer),
                PS_LOCAL(2 * 2 * UNIT_CHUNK * row + 2 * steps * UNIT_GAP));
}

/* Sums of weights below 1 of at most two slabs: 8 u of the sum of sizes is what factors, products
 * of lower parts, cuts and additions are off by together, at the most. */
static void check_near(unsigned precision, const test_memory *one, const test_memory *other) {
    const double most = ldexp(8, precision == 32 ? -24 : -53) * 2 * TABLE_POINTS;
    double *const sums = test_reals_read(one, precision);
    double *const others = test_reals_read(other, precision);
    for (size_t i = 0; i < SUMS; i++) {
        const size_t high = i / (2 * LANES) * 2 * LANES + i % LANES;
        if (!(fabs(sums[high] + sums[high + LANES] - others[high] - others[high + LANES]) <=
              most)) {
            fail_msg("sum %zu is %g instead of %g", high, others[high], sums[high]);
        }
    }
    free(sums);
    free(others);
}

/* [0]: fused operations, [1]: small blocks, [2]: large ones where they fit. */
static void check_units(unsigned precision, const inputs *small, const inputs *large) {
    enum { WAYS = 3 };
    test_memory sums[WAYS], power[WAYS];
    for (size_t i = 0; i < WAYS; i++) {
        sums[i] = test_reals_create(device, precision, NULL, SUMS);
        power[i] = test_reals_create(device, precision, NULL, (size_t)ROWS * STRIDE);
    }
    for (unsigned step = 0; step < 2; step++) { /* begun anew, continued and finished */
        const product_numbers numbers = {.num_pairs = PAIRS,
                                         .num_tiles = TILES,
                                         .num_left_tiles = LEFT_TILES,
                                         .table_points = TABLE_POINTS,
                                         .first_row = FIRST_ROW,
                                         .stride = STRIDE,
                                         .is_first = step == 0,
                                         .is_last = step == 1,
                                         .keeps_sums = 1};
        multiply_table(precision, &numbers, small, &sums[0], &power[0]);
        multiply_units(precision, BLOCK_TILES, &numbers, small, &sums[1], &power[1]);
        check_near(precision, &sums[0], &sums[1]);
        if (precision == 32) {
            multiply_units(precision, LARGE_TILES, &numbers, large, &sums[2], &power[2]);
            check_equal(&sums[1], &sums[2]);
            check_equal(&power[1], &power[2]);
        }
    }
    for (size_t i = 0; i < WAYS; i++) {
        test_memory_free(&sums[i]);
        test_memory_free(&power[i]);
    }
}

/* The model of units is long arithmetic for a simulator, which does the one warp of the probe. */
static void product_by_units(void **state) {
    (void)state;
    assert_true(ps_units_are_right(device, PS_UNITS_EMULATED));
    if (ps_device_is_simulator(ps_device_get_limits(device))) {
        return;
    }
    for (unsigned precision = 32; precision <= 64; precision += 32) {
        const uint64_t begin = seed;
        if (!test_has_precision(device, precision)) {
            continue;
        }
        inputs small = make_inputs(precision, BLOCK_TILES);
        seed = begin; /* the same points */
        inputs large = make_inputs(precision, LARGE_TILES);
        check_units(precision, &small, &large);
        free_inputs(&small);
        free_inputs(&large);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(shared_product),
                                       cmocka_unit_test(product_by_units)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernels_torus_shared", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
