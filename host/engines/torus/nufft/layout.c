#include "engines/torus/nufft/layout.h"

#include "base/round.h"
#include "device/kind.h"
#include "device/reals.h"
#include "engines/nufft/choose.h"
#include "engines/nufft/kernels.h"
#include "engines/torus/nufft/local.h"

#include <math.h>

/* Places and grids of the realizations that are worked on at a time: on CPUs a share of the
 * last-level cache, on GPUs enough to fill the device. */
static const double work_share = 0.25;
static const double gpu_work_bytes = 512.0 * 1024 * 1024;
enum { MOST_AT_ONCE = 1024 };

static uint64_t starts_bytes(const ps_nufft_layout *layout) {
    return ((uint64_t)layout->num_keys + 2) * sizeof(uint32_t);
}

/* Points sorted together: on the host, as they came and sorted; where cells, places and points
 * begin. */
static uint64_t part_bytes(const ps_nufft_layout *layout, unsigned dimension) {
    enum { COPIES = 3, BEGINNINGS = 4, MEANS = 2 };
    const uint64_t point = dimension * sizeof(uint64_t) + layout->real_bytes;
    return COPIES * layout->part_places * point + starts_bytes(layout) +
           (BEGINNINGS + MEANS) * sizeof(uint64_t);
}

/* Counts what one point of every part takes in the copy that the host keeps
 * (engines/torus/torus_points.h): weights, and coordinates where the device cannot read them there,
 * else they are a second copy of its own. */
static uint64_t host_point_bytes(const ps_nufft_layout *layout, const ps_problem *problem,
                                 const ps_device_limits *limits) {
    const uint64_t coordinates =
        limits->has_unified_memory ? 0 : problem->frequencies->dimension * sizeof(uint64_t);
    return layout->parts * (coordinates + layout->real_bytes);
}

/* Whatever the number of points: plans of the axes (twiddles and pattern, gains, positions;
 * polynomials and radices are small). */
static uint64_t table_bytes(const ps_nufft_layout *layout) {
    enum { SMALL = 1536 };
    uint64_t bytes = 0;
    for (unsigned i = 0; i < layout->choice.num_axes; i++) {
        const ps_nufft_axis *axis = &layout->choice.axes[i];
        const uint64_t reals = 4 * (uint64_t)axis->n + (uint64_t)axis->max_frequency + 1;
        bytes += reals * layout->real_bytes + axis->n * sizeof(uint32_t) + SMALL;
    }
    return bytes;
}

static uint64_t largest_of(const uint64_t *numbers, size_t num) {
    uint64_t largest = 0;
    for (size_t i = 0; i < num; i++) {
        largest = numbers[i] > largest ? numbers[i] : largest;
    }
    return largest;
}

/* Realizations at a time whose `each` bytes of work stay in the cache or fill the device, in whole
 * units, no more than there are. */
static size_t fitting_parts(const ps_problem *problem, const ps_device_limits *limits, double each,
                            size_t unit) {
    const double budget = limits->has_dedicated_local_memory
                              ? gpu_work_bytes
                              : work_share * ps_device_typical(limits).cache_bytes;
    const double fitting = fmin(budget / each, MOST_AT_ONCE);
    const size_t units = fitting > (double)unit ? (size_t)fitting / unit : 1;
    const uint64_t known = problem->num_realizations;
    return known > 0 && known < units * unit ? (size_t)known : units * unit;
}

static void choose_at_once(ps_nufft_layout *layout, const ps_problem *problem,
                           const ps_device_limits *limits) {
    const unsigned dimension = problem->frequencies->dimension;
    const uint64_t grid = layout->grid_cells * 2 * layout->lanes * layout->real_bytes;
    const uint64_t each = part_bytes(layout, dimension) + grid;
    layout->parts = fitting_parts(problem, limits, (double)each, 1);
    layout->fixed_bytes = layout->parts * each + table_bytes(layout);
    const uint64_t buffers[] = {grid, layout->part_places * dimension * sizeof(uint64_t),
                                starts_bytes(layout)};
    layout->largest_buffer =
        layout->parts * largest_of(buffers, sizeof buffers / sizeof buffers[0]);
}

static void measure_axes(ps_nufft_layout *layout) {
    const ps_nufft_choice *choice = &layout->choice;
    unsigned num_last = 0;
    const ps_nufft_axis *last = ps_nufft_last_axes(choice, &num_last);
    layout->num_tiles =
        layout->lanes > 0 ? (uint32_t)ps_divide_up(ps_nufft_tiled(choice), layout->lanes) : 0;
    layout->row_bytes = 0;
    layout->stride = (size_t)layout->num_tiles * layout->lanes;
    for (unsigned i = 0; i < choice->num_axes; i++) {
        const size_t bytes =
            ps_nufft_row_cells(&choice->axes[i]) * 2 * layout->lanes * layout->real_bytes;
        const size_t numbers = ps_nufft_pitch(&choice->axes[i]) + 2 * (size_t)layout->lanes + 2;
        layout->row_bytes = bytes > layout->row_bytes ? bytes : layout->row_bytes;
        layout->chunk_reals = PS_NUFFT_CHUNK * numbers;
    }
    for (unsigned i = 0; i < num_last; i++) {
        layout->stride *= 2 * (size_t)last[i].max_frequency + 1;
    }
    layout->line = ps_nufft_lines_measure(choice, layout->lanes);
    layout->first_line_power = layout->stride;
    layout->stride += layout->line.powers;
    layout->num_keys = choice->axes[0].n;
    if (num_last == 2) { /* in the order of cells, rows are filled from end to end */
        layout->num_keys = last[0].n * last[1].n;
        layout->grid_cells =
            (size_t)layout->num_tiles * last[0].n * (2 * (size_t)last[1].max_frequency + 1);
    }
    if (ps_nufft_way_of(choice) == PS_NUFFT_LARGE) {
        layout->num_keys = choice->axes[0].n;
        layout->grid_reals = 1;
        for (unsigned i = 0; i < choice->num_axes; i++) {
            layout->grid_reals *= choice->axes[i].n;
        }
    }
}

/* Equal shares of a whole, at most `most` each and whole units; one unit when not even that fits.
 */
static uint64_t share_out(uint64_t whole, uint64_t most, uint64_t unit) {
    const uint64_t fitting = most / unit > 0 ? most / unit * unit : unit;
    const uint64_t shares = ps_divide_up(whole, fitting);
    const uint64_t share = ps_round_up(ps_divide_up(whole, shares), unit);
    return share < whole ? share : whole;
}

/* The grid of a large set in buffers that the device allows: slabs of axis 0 where points are
 * spread, which are copied together for strips of columns where axis 0 is transformed, into some
 * tiles at a time. */
static void split_grid(ps_nufft_layout *layout, uint64_t limit) {
    enum { STRIPS = 16 };
    const uint64_t n = layout->choice.axes[0].n;
    const uint64_t columns = layout->grid_reals / n;
    const uint64_t lanes = 2 * layout->lanes;
    const uint64_t tile_rows = columns * lanes * layout->real_bytes;
    const uint64_t tile_transformed =
        layout->grid_cells / layout->num_tiles * lanes * layout->real_bytes;
    const uint64_t tile = tile_rows > tile_transformed ? tile_rows : tile_transformed;
    layout->slab_rows = (uint32_t)share_out(n, limit / (columns * layout->real_bytes), 1);
    layout->num_slabs = (uint32_t)ps_divide_up(n, layout->slab_rows);
    layout->tiles_at_once = (uint32_t)share_out(layout->num_tiles, limit / tile, 1);
    if (layout->num_slabs > 1) {
        const uint64_t fitting = limit / (n * layout->real_bytes);
        const uint64_t wanted = ps_round_up(ps_divide_up(columns, STRIPS), lanes);
        layout->strip_columns = share_out(columns, wanted < fitting ? wanted : fitting, lanes);
    }
}

/* Memory of a large set: a chunk of points, the grid in pairs, rows of tiles, what two transforms
 * leave. */
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
    const unsigned dimension = problem->frequencies->dimension;
    const uint64_t part = part_bytes(layout, dimension);
    const uint64_t grid = (layout->has_pairs ? 2 : 1) * (reals + strip);
    const size_t parts = ps_divide_up(problem->num_points, layout->part_points);
    layout->parts = parts < PS_NUFFT_MOST_PARTS ? parts : PS_NUFFT_MOST_PARTS;
    layout->fixed_bytes = layout->parts * part + grid + rows + transformed + table_bytes(layout);
    const uint64_t buffers[] = {rows,
                                slab,
                                transformed,
                                strip,
                                layout->parts * starts_bytes(layout),
                                layout->parts * layout->part_places * dimension * sizeof(uint64_t)};
    layout->largest_buffer = layout->num_slabs > PS_NUFFT_MOST_SLABS
                                 ? reals
                                 : largest_of(buffers, sizeof buffers / sizeof buffers[0]);
}

/* Tiles of a work-group share windows and phases. One on GPUs, where there is little local memory;
 * on CPUs what it holds, in groups of equal size, but work for all cores. */
static uint32_t choose_group(const ps_nufft_layout *layout, const ps_problem *problem,
                             const ps_device_limits *limits) {
    if (limits->has_dedicated_local_memory) {
        return 1;
    }
    uint64_t groups =
        ps_divide_up(layout->num_tiles, ps_nufft_fitting_tiles(layout, limits->local_bytes));
    const bool has_one = problem->num_realizations == 1 && layout->choice.num_axes == 1;
    const size_t cores = ps_device_typical(limits).served_units;
    groups = has_one && groups < cores ? cores : groups;
    return (uint32_t)ps_divide_up(layout->num_tiles, groups);
}

/* Work-groups for each core: so few that grids stay in the cache, so many that no core waits long
 * for another. */
enum { GROUPS_PER_CORE = 4 };

/* Gains, turns of one dimension, plans of the windows and of the two transforms. */
static uint64_t whole_table_bytes(const ps_nufft_layout *layout) {
    enum { SMALL = 1536 };
    const ps_nufft_choice *choice = &layout->choice;
    const uint64_t turns = choice->num_axes == 1 ? 2 * (uint64_t)choice->lengths[1] *
                                                       (layout->lanes + layout->num_tiles)
                                                 : 0;
    const uint64_t cells = (uint64_t)choice->lengths[0] + choice->lengths[1];
    const uint64_t reals = layout->stride + turns + 2 * cells;
    return reals * layout->real_bytes + cells * sizeof(uint32_t) + choice->num_axes * SMALL;
}

/* Points on the host and on the device, grids and rows of the work-groups, tables. Parts are
 * realizations: as many as keep all cores at work. */
static void count_whole(ps_nufft_layout *layout, const ps_problem *problem,
                        const ps_device_limits *limits) {
    const size_t cores = ps_device_typical(limits).served_units;
    const uint64_t point = problem->frequencies->dimension * sizeof(uint64_t) + layout->real_bytes;
    const double each = 2 * (double)(layout->part_points * point);
    layout->parts = fitting_parts(problem, limits, each, cores);
    layout->groups =
        layout->parts < GROUPS_PER_CORE * cores ? layout->parts : GROUPS_PER_CORE * cores;
    const uint64_t grids = layout->groups * layout->whole.grid_reals * layout->real_bytes;
    const uint64_t rows = layout->groups * layout->whole.row_reals * layout->real_bytes;
    layout->host_bytes = host_point_bytes(layout, problem, limits) * layout->part_points;
    layout->fixed_bytes = 2 * layout->parts * layout->part_points * point + grids + rows +
                          whole_table_bytes(layout) +
                          layout->parts * (sizeof(uint64_t) + 2 * layout->real_bytes);
    const uint64_t buffers[] = {grids, rows,
                                layout->parts * layout->part_points *
                                    problem->frequencies->dimension * sizeof(uint64_t)};
    layout->largest_buffer = largest_of(buffers, sizeof buffers / sizeof buffers[0]);
}

static void measure_whole(ps_nufft_layout *layout, const ps_problem *problem,
                          const ps_device_limits *limits) {
    const ps_nufft_choice *choice = &layout->choice;
    uint32_t kept[2];
    ps_nufft_whole_kept(choice, kept);
    layout->whole = ps_nufft_whole_measure(choice, layout->lanes);
    while (layout->lanes > 0 && ps_nufft_local_bytes(layout) > limits->local_bytes) {
        layout->lanes /= 2;
        layout->whole =
            layout->lanes > 0 ? ps_nufft_whole_measure(choice, layout->lanes) : layout->whole;
    }
    if (layout->lanes == 0) {
        return;
    }
    layout->num_tiles = (uint32_t)ps_divide_up(choice->span, layout->lanes);
    layout->stride = (size_t)layout->num_tiles * layout->lanes * (2 * (size_t)kept[1] + 1);
    layout->bytes_per_realization = layout->stride * layout->real_bytes;
    layout->largest_buffer_per_realization = layout->bytes_per_realization;
    layout->part_points = problem->num_points;
    count_whole(layout, problem, limits);
}

/* Strips and tiles of all work-groups together. */
enum { MOST_STRIP_BYTES = 1 << 27 };

static size_t choose_strip_groups(const ps_nufft_layout *layout, size_t cores) {
    const size_t reals = layout->strips.strip_reals + layout->strips.tile_reals;
    const size_t fitting = MOST_STRIP_BYTES / (reals * layout->real_bytes);
    const size_t most = fitting < GROUPS_PER_CORE * cores ? fitting : GROUPS_PER_CORE * cores;
    return layout->parts < most ? layout->parts : most;
}

/* Sorted points, strips and tiles of work-groups. */
static void count_strips(ps_nufft_layout *layout, const ps_problem *problem,
                         const ps_device_limits *limits) {
    const size_t cores = ps_device_typical(limits).served_units;
    const unsigned dimension = problem->frequencies->dimension;
    const uint64_t part = part_bytes(layout, dimension);
    layout->parts = fitting_parts(problem, limits, (double)part, cores);
    layout->groups = choose_strip_groups(layout, cores);
    const uint64_t strips = layout->groups * layout->strips.strip_reals * layout->real_bytes;
    const uint64_t tiles = layout->groups * layout->strips.tile_reals * layout->real_bytes;
    layout->fixed_bytes = layout->parts * part + strips + tiles + table_bytes(layout);
    const uint64_t buffers[] = {strips, tiles,
                                layout->parts * layout->part_places * dimension * sizeof(uint64_t)};
    layout->largest_buffer = largest_of(buffers, sizeof buffers / sizeof buffers[0]);
}

/* Measures rows in as many lanes as local memory has room for; false: it has no room for one. */
static bool measure_rows(ps_nufft_layout *layout, const ps_problem *problem,
                         const ps_device_limits *limits) {
    measure_axes(layout);
    while (layout->lanes > 0 && ps_nufft_fitting_tiles(layout, limits->local_bytes) < 1) {
        layout->lanes /= 2;
        measure_axes(layout);
    }
    if (layout->lanes == 0) {
        return false;
    }
    layout->group = choose_group(layout, problem, limits);
    layout->bytes_per_realization = layout->stride * layout->real_bytes;
    layout->largest_buffer_per_realization = layout->bytes_per_realization;
    return true;
}

static void set_part_points(ps_nufft_layout *layout, size_t part_points) {
    layout->part_points = part_points;
    layout->part_places = ps_round_up(part_points, PS_NUFFT_PLACE_UNIT);
}

/* Lines of all realizations of a batch are there together, and so are their transforms, in whole
 * groups of lanes. */
static void count_lines(ps_nufft_layout *layout) {
    const uint64_t line = layout->line.cells * layout->real_bytes;
    const uint64_t grid = layout->line.grid_reals * layout->real_bytes;
    const uint64_t each[] = {layout->largest_buffer_per_realization, line, grid / layout->lanes};
    layout->bytes_per_realization += line + grid / layout->lanes;
    layout->fixed_bytes += grid;
    layout->largest_buffer_per_realization = largest_of(each, sizeof each / sizeof each[0]);
}

static void measure_tiles(ps_nufft_layout *layout, const ps_problem *problem,
                          const ps_device_limits *limits) {
    if (measure_rows(layout, problem, limits)) {
        set_part_points(layout, problem->num_points);
        choose_at_once(layout, problem, limits);
        count_lines(layout);
        layout->host_bytes = host_point_bytes(layout, problem, limits) * layout->part_places;
    }
}

static void measure_strips(ps_nufft_layout *layout, const ps_problem *problem,
                           const ps_device_limits *limits) {
    layout->strips = ps_nufft_strips_measure(&layout->choice, layout->lanes);
    if (ps_nufft_local_bytes(layout) > limits->local_bytes) {
        layout->lanes = 0;
        return;
    }
    measure_axes(layout);
    layout->num_keys = layout->choice.axes[1].n;
    layout->bytes_per_realization = layout->stride * layout->real_bytes;
    layout->largest_buffer_per_realization = layout->bytes_per_realization;
    set_part_points(layout, problem->num_points);
    count_strips(layout, problem, limits);
    layout->host_bytes = host_point_bytes(layout, problem, limits) * layout->part_places;
}

/* Boxes as large as local memory has room for; false: it has no room for the smallest. Where edges
 * are halved, sums round in another order. */
static bool choose_boxes(ps_nufft_layout *layout, const ps_device_limits *limits) {
    enum { MOST_HALVINGS = 4 };
    unsigned halvings = 0;
    do {
        layout->boxes = ps_nufft_boxes_measure(&layout->choice, halvings++);
    } while (halvings <= MOST_HALVINGS && ps_nufft_local_bytes(layout) > limits->local_bytes);
    layout->num_keys = (uint32_t)ps_nufft_boxes_count(&layout->boxes);
    return ps_nufft_local_bytes(layout) <= limits->local_bytes;
}

static void measure_large(ps_nufft_layout *layout, const ps_problem *problem,
                          const ps_device_limits *limits) {
    const uint64_t chunk =
        layout->choice.chunk > 0 ? layout->choice.chunk : PS_NUFFT_MOST_CHUNK_POINTS;
    const uint64_t most = chunk / PS_NUFFT_MOST_PARTS;
    const bool has_rows = measure_rows(layout, problem, limits);
    layout->has_pairs = layout->choice.chunk > 0;
    layout->lanes = has_rows && choose_boxes(layout, limits) ? layout->lanes : 0;
    if (layout->lanes > 0) {
        set_part_points(layout, problem->num_points < most ? problem->num_points : most);
        measure_grid(layout, problem, limits->max_allocation_bytes);
        layout->host_bytes = host_point_bytes(layout, problem, limits) * layout->part_places;
    }
}

/* Each fills the layout of its way, or leaves it without lanes. */
static void (*const measures[PS_NUFFT_NUM_WAYS])(ps_nufft_layout *, const ps_problem *,
                                                 const ps_device_limits *) = {
    [PS_NUFFT_TILES] = measure_tiles,
    [PS_NUFFT_LARGE] = measure_large,
    [PS_NUFFT_WHOLE] = measure_whole,
    [PS_NUFFT_STRIPS] = measure_strips};

ps_nufft_layout ps_nufft_layout_make(const ps_problem *problem, const ps_device_limits *limits,
                                     ps_precision precision) {
    ps_nufft_layout layout = {.choice = ps_nufft_choose(problem, limits, precision),
                              .lanes = ps_engine_lanes(limits, precision),
                              .real_bytes = ps_real_bytes(precision)};
    if (layout.choice.num_axes == 0) {
        layout.lanes = 0;
    } else {
        measures[ps_nufft_way_of(&layout.choice)](&layout, problem, limits);
    }
    return layout;
}

void ps_nufft_layout_shrink(ps_nufft_layout *layout, size_t batch) {
    if (ps_nufft_way_of(&layout->choice) != PS_NUFFT_LARGE) {
        layout->parts = layout->parts < batch ? layout->parts : batch;
        layout->groups = layout->groups < batch ? layout->groups : batch;
    }
}
