#include "engines/nufft_layout.h"

#include "engines/nufft_plan.h"

/* Places and grids of the realizations that are worked on at a time: on CPUs a share of the last-level
 * cache, on GPUs enough to fill the device. */
static const double work_share = 0.25;
static const double gpu_work_bytes = 512.0 * 1024 * 1024;
enum { DEFAULT_CACHE_BYTES = 8 << 20, MOST_AT_ONCE = 1024 };

/* kernels/nufft/place.h, kernels/nufft/spread.h */
enum { PLACE_UNIT = 16, CHUNK = PS_NUFFT_CHUNK, TURN_REALS = 2 * CHUNK };

static uint64_t round_up(uint64_t a, uint64_t unit) {
    return (a + unit - 1) / unit * unit;
}

/* Points and weights on the host, as they came and sorted. */
static uint64_t place_bytes(const ps_nufft_layout *layout, unsigned dimension) {
    enum { COPIES = 3 };
    return COPIES * (dimension * sizeof(uint64_t) + layout->real_bytes);
}

static void choose_at_once(ps_nufft_layout *layout, const ps_problem *problem,
                           const ps_device_limits *limits) {
    const uint64_t vector_bytes = 2 * layout->lanes * layout->real_bytes;
    const uint64_t each =
        layout->part_places * place_bytes(layout, problem->frequencies->dimension) +
        layout->grid_cells * vector_bytes;
    const double cache =
        limits->cache_bytes > 0 ? (double)limits->cache_bytes : DEFAULT_CACHE_BYTES;
    const double budget = limits->has_dedicated_local_memory ? gpu_work_bytes : work_share * cache;
    const double fitting = budget / (double)each;
    const uint64_t known = problem->num_realizations;
    const size_t most = known > 0 && known < MOST_AT_ONCE ? (size_t)known : MOST_AT_ONCE;
    layout->parts = fitting > (double)most ? most : fitting > 1 ? (size_t)fitting : 1;
    layout->fixed_bytes = layout->parts * each;
    const uint64_t places =
        layout->part_places * problem->frequencies->dimension * sizeof(uint64_t);
    const uint64_t grid = layout->grid_cells * vector_bytes;
    layout->largest_buffer = layout->parts * (grid > places ? grid : places);
}

static void measure_axes(ps_nufft_layout *layout) {
    const ps_nufft_choice *choice = &layout->choice;
    unsigned num_last = 0;
    const ps_nufft_axis *last = ps_nufft_last_axes(choice, &num_last);
    layout->num_tiles = layout->lanes > 0 ? (choice->span + layout->lanes - 1) / layout->lanes : 0;
    layout->row_bytes = 0;
    layout->stride = (size_t)layout->num_tiles * layout->lanes;
    for (unsigned i = 0; i < choice->num_axes; i++) {
        const size_t bytes =
            ps_nufft_row_cells(&choice->axes[i]) * 2 * layout->lanes * layout->real_bytes;
        const size_t numbers = ps_nufft_pitch(&choice->axes[i]) + 2 * (size_t)layout->lanes + 2;
        layout->row_bytes = bytes > layout->row_bytes ? bytes : layout->row_bytes;
        layout->chunk_reals = CHUNK * numbers;
    }
    for (unsigned i = 0; i < num_last; i++) {
        layout->stride *= 2 * (size_t)last[i].max_frequency + 1;
    }
    layout->num_keys = choice->axes[0].n;
    if (num_last == 2) { /* in the order of cells, rows are filled from end to end */
        layout->num_keys = last[0].n * last[1].n;
        layout->grid_cells =
            (size_t)layout->num_tiles * last[0].n * (2 * (size_t)last[1].max_frequency + 1);
    }
    if (choice->is_gridded) {
        layout->grid_reals = choice->axes[0].n;
        for (unsigned i = 1; i < choice->num_axes; i++) {
            layout->grid_reals *= choice->axes[i].n;
        }
        layout->num_keys = (uint32_t)(layout->grid_reals / choice->axes[choice->num_axes - 1].n);
    }
}

/* Equal shares of a whole, at most `most` each and whole units; one unit when not even that fits. */
static uint64_t share_out(uint64_t whole, uint64_t most, uint64_t unit) {
    const uint64_t fitting = most / unit > 0 ? most / unit * unit : unit;
    const uint64_t shares = (whole + fitting - 1) / fitting;
    const uint64_t share = round_up((whole + shares - 1) / shares, unit);
    return share < whole ? share : whole;
}

/* The grid of a large set in buffers that the device allows: slabs of axis 0 where points are spread, which are
 * copied together for strips of columns where axis 0 is transformed, into some tiles at a time. */
static void split_grid(ps_nufft_layout *layout, uint64_t limit) {
    enum { STRIPS = 16 };
    const uint64_t n = layout->choice.axes[0].n;
    const uint64_t columns = layout->grid_reals / n;
    const uint64_t unit = layout->choice.num_axes == 2 ? PS_NUFFT_BLOCK_ROWS : 1;
    const uint64_t lanes = 2 * layout->lanes;
    const uint64_t tile_rows = columns * lanes * layout->real_bytes;
    const uint64_t tile_transformed =
        layout->grid_cells / layout->num_tiles * lanes * layout->real_bytes;
    const uint64_t tile = tile_rows > tile_transformed ? tile_rows : tile_transformed;
    layout->slab_rows = (uint32_t)share_out(n, limit / (columns * layout->real_bytes), unit);
    layout->num_slabs = (uint32_t)((n + layout->slab_rows - 1) / layout->slab_rows);
    layout->tiles_at_once = (uint32_t)share_out(layout->num_tiles, limit / tile, 1);
    if (layout->num_slabs > 1) {
        const uint64_t fitting = limit / (n * layout->real_bytes);
        const uint64_t wanted = round_up((columns + STRIPS - 1) / STRIPS, lanes);
        layout->strip_columns = share_out(columns, wanted < fitting ? wanted : fitting, lanes);
    }
}

static uint64_t larger(uint64_t a, uint64_t b) {
    return a > b ? a : b;
}

/* Memory of a large set: a chunk of points, the grid in pairs, rows of tiles, what two transforms leave. */
static void measure_grid(ps_nufft_layout *layout, const ps_problem *problem, uint64_t limit) {
    split_grid(layout, limit);
    const uint64_t vector_bytes = 2 * layout->lanes * layout->real_bytes;
    const uint64_t n = layout->choice.axes[0].n;
    const uint64_t columns = layout->grid_reals / n;
    const uint64_t rows = layout->tiles_at_once * columns * vector_bytes;
    const uint64_t transformed =
        layout->grid_cells / layout->num_tiles * layout->tiles_at_once * vector_bytes;
    const uint64_t reals = layout->grid_reals * layout->real_bytes;
    const uint64_t slab = layout->slab_rows * columns * layout->real_bytes;
    const uint64_t strip = layout->strip_columns * n * layout->real_bytes;
    const uint64_t starts = ((uint64_t)layout->num_keys + 2) * sizeof(uint32_t);
    const uint64_t points =
        layout->part_places * problem->frequencies->dimension * sizeof(uint64_t);
    const size_t parts = (problem->num_points + layout->part_points - 1) / layout->part_points;
    layout->parts = parts < PS_NUFFT_MOST_PARTS ? parts : PS_NUFFT_MOST_PARTS;
    layout->fixed_bytes =
        layout->parts *
            (layout->part_places * place_bytes(layout, problem->frequencies->dimension) + starts) +
        2 * (reals + strip) + rows + transformed;
    layout->largest_buffer = larger(larger(larger(rows, slab), larger(transformed, strip)),
                                    layout->parts * larger(starts, points));
    if (layout->num_slabs > PS_NUFFT_MOST_SLABS) {
        layout->largest_buffer = reals;
    }
}

/* Of a tile: its row, and how much each point of a chunk turns. */
static size_t tile_bytes(const ps_nufft_layout *layout) {
    return layout->row_bytes + TURN_REALS * layout->real_bytes;
}

/* Without turns. */
static size_t chunk_bytes(const ps_nufft_layout *layout) {
    return layout->chunk_reals * layout->real_bytes + CHUNK * (sizeof(uint64_t) + sizeof(uint32_t));
}

/* Tiles of a work-group share windows and phases. One on GPUs, where there is little local memory; on CPUs
 * what it holds, in groups of equal size, but work for all cores. */
static uint32_t choose_group(const ps_nufft_layout *layout, const ps_problem *problem,
                             const ps_device_limits *limits) {
    if (limits->has_dedicated_local_memory) {
        return 1;
    }
    const size_t room = (limits->local_bytes - chunk_bytes(layout)) / tile_bytes(layout);
    const uint32_t largest = room > 1 ? (uint32_t)room : 1;
    uint32_t groups = (layout->num_tiles + largest - 1) / largest;
    const bool has_one = problem->num_realizations == 1 && layout->choice.num_axes == 1;
    groups = has_one && groups < limits->compute_units ? limits->compute_units : groups;
    return (layout->num_tiles + groups - 1) / groups;
}

ps_nufft_layout ps_nufft_layout_make(const ps_problem *problem, const ps_device_limits *limits,
                                     ps_precision precision) {
    ps_nufft_layout layout = {.choice = ps_nufft_choose(problem, precision),
                              .lanes = ps_engine_lanes(limits, precision),
                              .real_bytes =
                                  precision == PS_SINGLE ? sizeof(float) : sizeof(double)};
    if (layout.choice.num_axes == 0) {
        layout.lanes = 0;
        return layout;
    }
    measure_axes(&layout);
    while (layout.lanes > 0 && tile_bytes(&layout) + chunk_bytes(&layout) > limits->local_bytes) {
        layout.lanes /= 2;
        measure_axes(&layout);
    }
    if (layout.lanes == 0) {
        return layout;
    }
    layout.group = choose_group(&layout, problem, limits);
    layout.chunk_reals += layout.group * TURN_REALS;
    layout.part_points = problem->num_points;
    if (layout.choice.is_gridded &&
        layout.part_points > layout.choice.chunk / PS_NUFFT_MOST_PARTS) {
        layout.part_points = layout.choice.chunk / PS_NUFFT_MOST_PARTS;
    }
    layout.part_places = (size_t)round_up(layout.part_points, PLACE_UNIT);
    layout.bytes_per_realization = layout.stride * layout.real_bytes;
    layout.largest_buffer_per_realization = layout.bytes_per_realization;
    if (layout.choice.is_gridded) {
        measure_grid(&layout, problem, limits->max_allocation_bytes);
    } else {
        choose_at_once(&layout, problem, limits);
    }
    layout.host_bytes = layout.parts * layout.part_places *
                        (problem->frequencies->dimension * sizeof(uint64_t) + layout.real_bytes);
    return layout;
}

uint32_t ps_nufft_slot(const ps_nufft_layout *layout, const int32_t *k, unsigned dimension) {
    const ps_nufft_choice *choice = &layout->choice;
    const int32_t sign = k[0] < 0 ? -1 : 1; /* |S(-k)| = |S(k)| */
    const uint32_t along = (uint32_t)(sign * k[0]);
    const uint32_t within = choice->stride != 0 ? along % choice->stride : along;
    unsigned num = 0;
    const ps_nufft_axis *last = ps_nufft_last_axes(choice, &num);
    uint32_t slot = within / layout->lanes;
    for (unsigned i = num;
         i-- > 0;) { /* kernels/nufft/columns.cl writes the first axis innermost */
        const int32_t q = choice->stride != 0
                              ? (int32_t)(along / choice->stride) - last[i].max_frequency
                              : sign * k[dimension - num + i];
        slot = slot * (2 * (uint32_t)last[i].max_frequency + 1) +
               (uint32_t)(last[i].max_frequency + q);
    }
    return slot * layout->lanes + within % layout->lanes;
}
