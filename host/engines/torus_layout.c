#include "engines/torus_layout.h"

#include "engines/torus_split.h"

/* Share of the device's cache that the tables of one slab may take: both cores of a CPU work on
 * tables of their own, and points and sums need room too. Flat optimum between 1/8 and 1/2 on a
 * 32 MB L3 (Zen 5, 2 cores, 2026-11, ./dev bench torus). */
enum { CACHE_SHARE = 4 };

/* Largest slab: lists need no tables, but partial sums of every chunk. */
enum { LARGEST_SLAB_CHUNKS = 64 };

/* Cache to plan with when a device does not tell. */
enum { DEFAULT_CACHE_BYTES = 8 << 20 };

static size_t divide_up(size_t a, size_t b) {
    return (a + b - 1) / b;
}

static size_t choose_slab(const ps_torus_layout *layout, const ps_problem *problem,
                          const ps_device_limits *limits) {
    const uint64_t cache = limits->cache_bytes > 0 ? limits->cache_bytes : DEFAULT_CACHE_BYTES;
    const size_t tiles = layout->left_tiles + layout->right_tiles;
    const size_t table_bytes_per_chunk =
        PS_TORUS_CHUNK * tiles * 2 * layout->lanes * layout->real_bytes;
    size_t chunks = layout->is_grid ? (size_t)(cache / CACHE_SHARE) / table_bytes_per_chunk
                                    : LARGEST_SLAB_CHUNKS;
    const size_t needed = divide_up((size_t)problem->num_points, PS_TORUS_CHUNK);
    chunks = chunks < needed ? chunks : needed;
    chunks = chunks < LARGEST_SLAB_CHUNKS ? chunks : LARGEST_SLAB_CHUNKS;
    return (chunks > 0 ? chunks : 1) * PS_TORUS_CHUNK;
}

static void count_bytes(ps_torus_layout *layout, unsigned dimension) {
    const uint64_t row = (uint64_t)layout->lanes * layout->real_bytes;
    const uint64_t tiles = layout->left_tiles + layout->right_tiles;
    const uint64_t tables = layout->is_grid ? tiles * layout->slab * 2 * row : 0;
    const uint64_t products = layout->is_grid ? layout->max_pairs * layout->lanes * 8 * row : 0;
    const uint64_t chunk_sums = layout->num_chunks * tiles * 4 * row;
    const uint64_t power = layout->max_stride * layout->real_bytes;
    const uint64_t points =
        layout->slab * (dimension * sizeof(uint64_t) + layout->real_bytes) + sizeof(uint64_t);
    layout->bytes_per_realization = tables + products + chunk_sums + tiles * 4 * row + power +
                                    2 * points + layout->real_bytes; /* host copy of points */
    layout->fixed_bytes = tiles * dimension * row + layout->max_pairs * 2 * sizeof(uint32_t) +
                          layout->lanes * power; /* rows are padded to whole groups of lanes */
    layout->largest_buffer_per_realization = tables > products ? tables : products;
    if (power > layout->largest_buffer_per_realization) {
        layout->largest_buffer_per_realization = power;
    }
}

ps_torus_layout ps_torus_layout_make(const ps_problem *problem, const ps_device_limits *limits,
                                     ps_precision precision) {
    const ps_frequencies *set = problem->frequencies;
    ps_torus_layout layout = {.lanes = ps_engine_lanes(limits, precision),
                              .real_bytes = precision == PS_SINGLE ? sizeof(float) : sizeof(double),
                              .is_grid = set->kind != PS_FREQUENCIES_LIST};
    if (layout.is_grid) {
        ps_split_sizes(set, layout.lanes, &layout.num_left, &layout.num_right);
    } else {
        layout.num_left = set->num;
    }
    layout.left_tiles = divide_up(layout.num_left, layout.lanes);
    layout.right_tiles = divide_up(layout.num_right, layout.lanes);
    layout.max_pairs = layout.left_tiles * layout.right_tiles;
    layout.max_stride = layout.max_pairs * 2 * layout.lanes * layout.lanes +
                        (layout.left_tiles + layout.right_tiles) * layout.lanes;
    layout.slab = choose_slab(&layout, problem, limits);
    layout.num_chunks = layout.slab / PS_TORUS_CHUNK;
    count_bytes(&layout, set->dimension);
    return layout;
}
