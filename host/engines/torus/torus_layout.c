#include "engines/torus/torus_layout.h"

#include "base/round.h"
#include "device/kind.h"
#include "device/reals.h"
#include "engines/torus/torus_split.h"
#include "torus/product.h"

/* Share of a CPU's cache that the tables of a group of realizations, one slab of each, may take
 * with their sums: flat optimum around 1/2 of a 32 MB L3 (Zen 5, 2 cores, PoCL 3.1, 2026-11,
 * bench_torus: 7 % slower at 1/4, 15 % at 1). */
static const double group_share = 0.5;

/* Realizations that a slab should leave room for, when there are so many: short slabs of many
 * realizations keep both cores busy to the end of a launch. Files do not tell how many there are.
 */
enum { ROOM_FOR_REALIZATIONS = 16, ROOM_WHEN_UNKNOWN = 4 };

/* On GPUs a group must fill the device: bytes of tables and sums of a group. */
static const double gpu_group_bytes = 512.0 * 1024 * 1024;

/* More realizations at a time gain nothing: launches are then a small part of the work. */
enum { LARGEST_GROUP = 1024 };

/* Largest slab: lists need no tables, but partial sums of every chunk. */
enum { LARGEST_SLAB_CHUNKS = 64 };

/* Tables of a grid, or partial sums of a list, that one chunk of a realization takes. */
static double chunk_bytes(const ps_torus_layout *layout) {
    const double row = (double)layout->lanes * (double)layout->real_bytes;
    const double tiles = (double)(layout->left_tiles + layout->right_tiles);
    const double sums = 4 * tiles * row;
    return layout->has_table ? sums + PS_TORUS_CHUNK * tiles * 2 * row : sums;
}

static void choose_slab(ps_torus_layout *layout, const ps_problem *problem,
                        const ps_device_limits *limits) {
    const uint64_t known = problem->num_realizations;
    const double room = known == 0                      ? ROOM_WHEN_UNKNOWN
                        : known < ROOM_FOR_REALIZATIONS ? (double)known
                                                        : ROOM_FOR_REALIZATIONS;
    const double fitting =
        group_share * ps_device_typical(limits).cache_bytes / room / chunk_bytes(layout);
    const size_t needed = ps_divide_up((size_t)problem->num_points, PS_TORUS_CHUNK);
    size_t chunks = needed < LARGEST_SLAB_CHUNKS ? needed : LARGEST_SLAB_CHUNKS;
    if (fitting < (double)chunks) {
        chunks = fitting > 1 ? (size_t)fitting : 1;
    }
    layout->num_chunks = chunks > 0 ? chunks : 1;
    layout->slab = layout->num_chunks * PS_TORUS_CHUNK;
    layout->table_points =
        problem->num_points < layout->slab ? (size_t)problem->num_points : layout->slab;
}

/* Points and weights of a realization of a group. */
static uint64_t point_bytes(const ps_torus_layout *layout, unsigned dimension) {
    return layout->table_points * (dimension * sizeof(uint64_t) + layout->real_bytes);
}

/* Bytes that every realization of a group takes on the device, and their host copies. */
static uint64_t group_member_bytes(const ps_torus_layout *layout, unsigned dimension) {
    const uint64_t row = (uint64_t)layout->lanes * layout->real_bytes;
    const uint64_t tiles = layout->left_tiles + layout->right_tiles;
    const uint64_t tables = layout->has_table ? tiles * layout->table_points * 2 * row : 0;
    const uint64_t products = layout->max_pairs * layout->lanes * 8 * row;
    return tables + products + 2 * point_bytes(layout, dimension); /* on the host, too */
}

static void choose_group(ps_torus_layout *layout, const ps_problem *problem,
                         const ps_device_limits *limits) {
    const double member = (double)group_member_bytes(layout, problem->frequencies->dimension);
    const double budget = limits->has_dedicated_local_memory
                              ? gpu_group_bytes
                              : group_share * ps_device_typical(limits).cache_bytes;
    const double fitting = budget / member;
    const uint64_t known = problem->num_realizations;
    double group = known > 0 && known < LARGEST_GROUP ? (double)known : LARGEST_GROUP;
    group = group < fitting ? group : fitting;
    layout->group = group > 1 ? (size_t)group : 1;
}

static uint64_t largest(const uint64_t *numbers, size_t num) {
    uint64_t found = 0;
    for (size_t i = 0; i < num; i++) {
        found = numbers[i] > found ? numbers[i] : found;
    }
    return found;
}

size_t ps_torus_shared_items(const ps_torus_layout *layout) {
    const size_t bits = 8 * layout->real_bytes, tiles = layout->block_tiles;
    return layout->units != PS_UNITS_NONE ? UNIT_ITEMS(bits, tiles)
                                          : tiles * tiles * layout->lanes / PRODUCT_STRIP(bits);
}

size_t ps_torus_shared_bytes(const ps_torus_layout *layout) {
    const size_t row = layout->block_tiles * layout->lanes * layout->real_bytes;
    const bool has_units = layout->units != PS_UNITS_NONE;
    const size_t points = has_units ? UNIT_CHUNK : PS_TORUS_RUN;
    const size_t steps = (size_t)UNIT_STEPS(8 * layout->real_bytes);
    return 2 * 2 * points * row +
           (has_units ? 2 * steps * UNIT_GAP : 0); /* sides, cosines and sines */
}

/* Where tile pairs stand, and blocks of them (torus_product.c). */
static uint64_t pair_bytes(const ps_torus_layout *layout) {
    enum { NUMBERS = 2 };
    const uint64_t block = (uint64_t)layout->block_tiles * layout->block_tiles + NUMBERS;
    return (layout->is_shared ? layout->max_blocks * block : layout->max_pairs * NUMBERS) *
           sizeof(uint32_t);
}

static void count_bytes(ps_torus_layout *layout, unsigned dimension) {
    const uint64_t row = (uint64_t)layout->lanes * layout->real_bytes;
    const uint64_t tiles = layout->left_tiles + layout->right_tiles;
    const uint64_t buffers[] = {
        layout->has_table ? tiles * layout->table_points * 2 * row : 0, /* tables */
        layout->max_pairs * layout->lanes * 8 * row,                    /* sums of products */
        layout->table_points * dimension * sizeof(uint64_t),            /* points */
    };
    const uint64_t power = layout->max_stride * layout->real_bytes;
    const uint64_t sums = (layout->num_chunks + 1) * tiles * 4 * row;
    layout->bytes_per_realization = power + sums + 2 * layout->real_bytes;
    layout->largest_buffer_per_realization = power > sums ? power : sums;
    layout->point_bytes = point_bytes(layout, dimension);
    layout->fixed_bytes =
        layout->group * (group_member_bytes(layout, dimension) - 2 * layout->point_bytes) +
        tiles * dimension * row + pair_bytes(layout);
    layout->largest_buffer = layout->group * largest(buffers, sizeof buffers / sizeof buffers[0]);
}

static size_t count_blocks(const ps_torus_layout *layout, unsigned block_tiles) {
    return ps_divide_up(layout->left_tiles, block_tiles) *
           ps_divide_up(layout->right_tiles, block_tiles);
}

static bool fits_device(const ps_torus_layout *layout, const ps_device_limits *limits) {
    return ps_torus_shared_bytes(layout) <= limits->local_bytes &&
           (layout->units == PS_UNITS_NONE ||
            ps_torus_shared_items(layout) <= limits->max_work_group_size);
}

/* Matrix units where they are as exact as is asked. Large blocks take 0.8 of the time of small ones
 * for the same frequencies (single precision, (2, 1024, 128), prototypes on an H200, 2026-11). */
static void choose_units(ps_torus_layout *layout, const ps_problem *problem,
                         const ps_device_limits *limits, ps_precision precision) {
    enum { SMALL_BLOCKS_OF_LARGE = (LARGE_TILES / BLOCK_TILES) * (LARGE_TILES / BLOCK_TILES) };
    const double time_of_large = 0.8 * SMALL_BLOCKS_OF_LARGE;
    const bool has_units = limits->units == PS_UNITS_EMULATED || limits->units == PS_UNITS_PTX;
    ps_torus_layout offer = *layout;
    offer.units = limits->units;
    if (!has_units || layout->lanes != UNIT_LANES ||
        ps_torus_error(problem->frequencies, precision, true, ps_planned_points(problem),
                       ps_expected_power(problem)) > problem->tolerance) {
        return;
    }
    offer.block_tiles = LARGE_TILES;
    if (!fits_device(&offer, limits) || (double)count_blocks(layout, LARGE_TILES) * time_of_large >
                                            (double)count_blocks(layout, BLOCK_TILES)) {
        offer.block_tiles = BLOCK_TILES;
    }
    *layout = fits_device(&offer, limits) ? offer : *layout;
}

ps_torus_layout ps_torus_layout_make(const ps_problem *problem, const ps_device_limits *limits,
                                     ps_precision precision) {
    const ps_frequencies *set = problem->frequencies;
    ps_torus_layout layout = {.lanes = ps_engine_lanes(limits, precision),
                              .real_bytes = ps_real_bytes(precision),
                              .is_grid = set->kind != PS_FREQUENCIES_LIST};
    if (layout.is_grid) {
        layout.left_axes = ps_split_left_axes(set->dimension);
        ps_split_sizes(set, layout.lanes, &layout.num_left, &layout.num_right);
    } else {
        layout.num_left = set->num;
    }
    layout.left_tiles = ps_divide_up(layout.num_left, layout.lanes);
    layout.right_tiles = ps_divide_up(layout.num_right, layout.lanes);
    layout.max_pairs = layout.left_tiles * layout.right_tiles;
    layout.max_stride = layout.max_pairs * 2 * layout.lanes * layout.lanes +
                        (layout.left_tiles + layout.right_tiles) * layout.lanes;
    layout.block_tiles = BLOCK_TILES;
    layout.is_shared = layout.is_grid && limits->has_dedicated_local_memory &&
                       layout.lanes % PRODUCT_STRIP(8 * layout.real_bytes) == 0 &&
                       fits_device(&layout, limits);
    if (layout.is_shared) {
        choose_units(&layout, problem, limits, precision);
    }
    layout.max_blocks = count_blocks(&layout, layout.block_tiles);
    layout.has_table = layout.is_grid && !layout.is_shared;
    choose_slab(&layout, problem, limits);
    choose_group(&layout, problem, limits);
    count_bytes(&layout, set->dimension);
    return layout;
}
