/* A grid of all axes for one large set at a time: what it takes (large.c does it). */
#include "base/round.h"
#include "device/reals.h"
#include "engines/torus/nufft/local.h"
#include "engines/torus/nufft/measure.h"
#include "engines/torus/nufft/layout.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>

/* Grids take one set at a time: never worth while for fewer points. */
static const double least_points = 30000;

/* ---- choice ------------------------------------------------------------------------------ */

static bool offer(const ps_problem *problem, unsigned lanes, unsigned which,
                  ps_nufft_choice *choice) {
    (void)lanes;
    *choice = ps_nufft_choice_of_axes(problem, 0);
    return which == 0 && choice->num_axes > 1 && ps_planned_points(problem) >= least_points;
}

/* Cells of the last axis fill whole vectors, twice. */
static uint32_t unit(const ps_nufft_choice *choice, unsigned axis) {
    return axis + 1 == choice->num_axes ? 2 * choice->lanes : 1;
}

/* Points that put so many windows on a cell. */
static double points_for(const ps_nufft_choice *choice, double windows_on_a_cell) {
    double points = windows_on_a_cell;
    for (unsigned i = 0; i < choice->num_axes; i++) {
        points *= (double)choice->axes[i].n / choice->axes[i].window.width;
    }
    return points;
}

/* Points added up before their sums go into pairs: so that what the mean of the cells rounds off
 * stays small, without going over the grid too often. */
static uint64_t choose_chunk(const ps_nufft_choice *choice) {
    const double windows_on_a_cell = 16;
    const double least = 4096;
    const double most = PS_NUFFT_MOST_CHUNK_POINTS;
    return (uint64_t)fmin(fmax(points_for(choice, windows_on_a_cell), least), most);
}

/* Roundings of plain sums of more windows on a cell may be in step beyond what the bound allows
 * for: whole realizations were tried to thousands, large sets were not. */
static bool can_be_plain(const ps_nufft_choice *choice, double num_points) {
    const double windows_on_a_cell = 256;
    return num_points <= points_for(choice, windows_on_a_cell);
}

/* Where windows of few points touch a cell, sums may do without pairs. */
static bool complete(ps_nufft_choice *choice, const ps_problem *problem, ps_precision precision,
                     unsigned which) {
    const bool has_plain = can_be_plain(choice, ps_planned_points(problem));
    (void)precision;
    choice->chunk = has_plain && which == 0 ? 0 : choose_chunk(choice);
    return which == 0 || (has_plain && which == 1);
}

/* ---- cost -------------------------------------------------------------------------------- */

/* Spreading in boxes. */
static void count_boxes(ps_nufft_counts *counts, const ps_nufft_choice *choice,
                        ps_precision precision, double num_points) {
    enum { ROW_BYTES = 32 };
    const ps_nufft_axis *axes = choice->axes;
    const ps_nufft_boxes boxes = ps_nufft_boxes_measure(choice, 0);
    const double real_bytes = (double)ps_real_bytes(precision);
    const ps_nufft_axis *last = &axes[choice->num_axes - 1];
    const double rows = choice->num_axes == 3 ? (double)axes[0].window.width * axes[1].window.width
                                              : axes[0].window.width;
    const double cells =
        (double)ps_nufft_boxes_reals(&boxes) * (double)ps_nufft_boxes_count(&boxes);
    const uint64_t chunk = choice->chunk > 0 ? choice->chunk : PS_NUFFT_MOST_CHUNK_POINTS;
    const double chunks = ceil(num_points / (double)chunk);
    ps_nufft_add(counts, PS_NUFFT_BOX_POINT, num_points);
    ps_nufft_add(counts, PS_NUFFT_WHOLE_POLYNOMIAL, num_points * ps_nufft_polynomials(choice));
    ps_nufft_add(counts, PS_NUFFT_BOX_ROW,
                 num_points * rows * ps_nufft_cells_of_row(last, precision) * real_bytes /
                     ROW_BYTES);
    ps_nufft_add(counts, PS_NUFFT_BOX_CELL, cells * real_bytes / PS_NUFFT_WORD_BYTES * chunks);
}

/* Spreading on a grid, the transform along axis 0, and tiles of it. */
static void count(ps_nufft_counts *counts, const ps_nufft_choice *choice, ps_precision precision,
                  double num_points) {
    const ps_nufft_axis *axes = choice->axes;
    const double columns =
        (choice->num_axes == 3 ? (double)axes[1].n : 1) * axes[choice->num_axes - 1].n;
    const double words =
        columns * axes[0].n * (double)(ps_real_bytes(precision) / PS_NUFFT_WORD_BYTES);
    ps_nufft_add_tiles(counts, choice, num_points);
    count_boxes(counts, choice, precision, num_points);
    ps_nufft_add_transforms(counts, columns / (2 * choice->lanes), axes[0].n);
    ps_nufft_add(counts, PS_NUFFT_GRID_CELL, words);
    if (choice->chunk > 0) {
        ps_nufft_add(counts, PS_NUFFT_GRID_PAIR, words * ceil(num_points / (double)choice->chunk));
    }
}

/* ---- sizes ------------------------------------------------------------------------------- */

/* Transforms have a row. */
static size_t local_bytes(const ps_nufft_layout *layout) {
    const size_t spread = ps_nufft_local_sum(ps_nufft_boxes_local(layout));
    return spread > layout->row_bytes ? spread : layout->row_bytes;
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
    const uint64_t part = ps_nufft_part_bytes(layout, dimension);
    const uint64_t grid = (layout->has_pairs ? 2 : 1) * (reals + strip);
    const size_t parts = ps_divide_up(problem->num_points, layout->part_points);
    layout->parts = parts < PS_NUFFT_MOST_PARTS ? parts : PS_NUFFT_MOST_PARTS;
    layout->fixed_bytes =
        layout->parts * part + grid + rows + transformed + ps_nufft_table_bytes(layout);
    const uint64_t buffers[] = {rows,
                                slab,
                                transformed,
                                strip,
                                layout->parts * ps_nufft_starts_bytes(layout),
                                layout->parts * ps_nufft_order_largest(&layout->order),
                                layout->parts * layout->part_places * dimension * sizeof(uint64_t)};
    layout->largest_buffer = layout->num_slabs > PS_NUFFT_MOST_SLABS
                                 ? reals
                                 : ps_nufft_largest(buffers, sizeof buffers / sizeof buffers[0]);
}

/* Boxes as large as local memory has room for; false: it has no room for the smallest. Where edges
 * are halved, sums round in another order. */
static bool choose_boxes(ps_nufft_layout *layout, const ps_device_limits *limits) {
    enum { MOST_HALVINGS = 4 };
    unsigned halvings = 0;
    do {
        layout->boxes = ps_nufft_boxes_measure(&layout->choice, halvings++);
    } while (halvings <= MOST_HALVINGS && local_bytes(layout) > limits->local_bytes);
    layout->num_keys = (uint32_t)ps_nufft_boxes_count(&layout->boxes);
    return local_bytes(layout) <= limits->local_bytes;
}

static void measure(ps_nufft_layout *layout, const ps_problem *problem,
                    const ps_device_limits *limits) {
    const uint64_t chunk =
        layout->choice.chunk > 0 ? layout->choice.chunk : PS_NUFFT_MOST_CHUNK_POINTS;
    const uint64_t most = chunk / PS_NUFFT_MOST_PARTS;
    const bool has_rows = ps_nufft_measure_rows(layout, problem, limits);
    layout->has_pairs = layout->choice.chunk > 0;
    layout->has_boxes = true;
    layout->grid_reals = 1;
    for (unsigned i = 0; i < layout->choice.num_axes; i++) {
        layout->grid_reals *= layout->choice.axes[i].n;
    }
    layout->lanes = has_rows && choose_boxes(layout, limits) ? layout->lanes : 0;
    if (layout->lanes > 0) {
        ps_nufft_set_part_points(layout, problem->num_points < most ? problem->num_points : most,
                                 limits);
        measure_grid(layout, problem, limits->max_allocation_bytes);
        layout->host_bytes = layout->parts * layout->real_bytes * layout->part_places;
    }
}

/* Sorting of every chunk and a launch for each colour of boxes, then one for each axis. */
static double count_launches(const ps_nufft_layout *layout, double num_points,
                             double realizations) {
    unsigned num_last = 0;
    ps_nufft_last_axes(&layout->choice, &num_last);
    const double chunks = ceil(num_points / ((double)layout->parts * (double)layout->part_points));
    const uint32_t *const colours = layout->boxes.colours;
    const double spreading = (double)(colours[0] * colours[1] * colours[2]);
    return realizations *
           ((ps_nufft_order_launches(&layout->order) + spreading) * chunks + 1 + num_last);
}

static void describe(const ps_nufft_layout *layout, ps_text *text) {
    (void)layout;
    ps_text_append(text, " gridded");
}

/* Kernels: all that makes tiles of a grid. */
const ps_nufft_variant ps_nufft_large = {.on_cpus = true,
                                         .most_cells = PS_NUFFT_MOST_ROW_CELLS,
                                         .is_gridded = true,
                                         .offer = offer,
                                         .unit = unit,
                                         .complete = complete,
                                         .count = count,
                                         .has_lattices = true,
                                         .measure = measure,
                                         .local_bytes = local_bytes,
                                         .slot = ps_nufft_tile_slot,
                                         .count_launches = count_launches,
                                         .programs = {5, 5},
                                         .describe = describe,
                                         .launcher = &ps_nufft_large_launcher};
