/* What tiles of frequencies take, whose axis 0 is summed directly (tiles.c does it). */
#include "base/round.h"
#include "engines/torus/nufft/local.h"
#include "engines/torus/nufft/measure.h"
#include "engines/torus/nufft/layout.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>

/* Sets of more points always go on a grid, in two and three dimensions: the places of all others
 * take memory for every point, up to 96 bytes of it. */
static const double most_sorted_points = 1 << 23;

/* One dimension has at most so many tiles; more of them mean shorter transforms. */
enum { MOST_TILES = 64 };

/* ---- choice ------------------------------------------------------------------------------ */

/* One dimension: a transform of every stride-th frequency. */
static bool offer_stride(const ps_problem *problem, unsigned lanes, unsigned which,
                         ps_nufft_choice *choice) {
    const uint64_t max_frequency = (uint64_t)problem->frequencies->max_frequency;
    const uint32_t stride = lanes << which;
    const uint64_t needed = ps_divide_up(max_frequency + 1, stride);
    *choice = (ps_nufft_choice){
        .num_axes = 1,
        .span = stride,
        .stride = stride,
        .axes = {{.axis = 0, .factor = stride, .max_frequency = (int32_t)(needed / 2)}}};
    return 1U << which <= MOST_TILES;
}

/* Direct phases for the whole of axis 0, transforms on all others. */
static bool offer(const ps_problem *problem, unsigned lanes, unsigned which,
                  ps_nufft_choice *choice) {
    if (problem->frequencies->dimension == 1) {
        return offer_stride(problem, lanes, which, choice);
    }
    *choice = ps_nufft_choice_of_axes(problem, 1);
    return which == 0 && ps_planned_points(problem) <= most_sorted_points;
}

static void settle(ps_nufft_choice *choice, const ps_problem *problem) {
    choice->has_line = ps_nufft_lines_pay(choice, problem);
}

/* ---- cost -------------------------------------------------------------------------------- */

/* Four neighbours are added together: to cells from the first of one window to the last of another.
 */
static double touched_cells(const ps_nufft_axis *axis, double num_points) {
    const double between = 3 * (double)axis->n / num_points;
    return axis->window.width + fmin(between, axis->window.width);
}

/* A line of frequency 0, of which realizations share transforms: places that are added to it, and
 * its part of a tile, half of whose columns are kept. */
static void count_line(ps_nufft_counts *counts, const ps_nufft_choice *choice, double visits) {
    unsigned num = 0;
    const ps_nufft_axis *axes = ps_nufft_last_axes(choice, &num);
    const ps_nufft_axis *last = &axes[num - 1];
    const double rows = num == 1 ? 1 : axes[0].n;
    const double vectors = (double)ps_nufft_bins(last) / choice->lanes;
    ps_nufft_add(counts, PS_NUFFT_VALUE, visits);
    ps_nufft_add(counts, PS_NUFFT_WHOLE_POLYNOMIAL, visits * (last->window.width + 2.0) * vectors);
    ps_nufft_add(counts, PS_NUFFT_WHOLE_ROW, visits * fmax(1, vectors));
    ps_nufft_add(counts, PS_NUFFT_CLEARED, rows * last->n);
    ps_nufft_add_transforms(counts, rows / choice->lanes, last->n);
    if (num > 1) {
        ps_nufft_add_transforms(counts, (last->max_frequency + 1.0) / choice->lanes, axes[0].n);
    }
}

/* Places that are filled for the num_points points of a list, in mean: lists go through whole
 * chunks. */
static double filled_places(double num_points) {
    const double half = 0.5; /* of a chunk is empty at the end of a long list */
    const double is_not_empty = -expm1(-num_points);
    return PS_NUFFT_CHUNK * fmax(is_not_empty, num_points / PS_NUFFT_CHUNK + half);
}

/* Spreading by direct phases on axis 0. */
static void count_spreading(ps_nufft_counts *counts, const ps_nufft_choice *choice,
                            double num_points) {
    const ps_nufft_axis *first = &choice->axes[0];
    const ps_nufft_axis *last = &choice->axes[choice->num_axes - 1];
    const bool has_rows = choice->num_axes == 2;
    const double num_tiles = ps_nufft_num_tiles(choice);
    /* a list for each row that touches another */
    const double lists = has_rows ? (double)first->n * first->window.width : 1;
    const double points_of_list = has_rows ? num_points / first->n : num_points;
    const double visits = lists * filled_places(points_of_list);
    const double touched = touched_cells(last, points_of_list);
    const double groups = ceil(num_tiles / fmax(1, floor(ps_nufft_rows_at_once(last))));
    const double degree = last->window.width + 2;
    ps_nufft_add(counts, PS_NUFFT_PHASE, visits * groups);
    ps_nufft_add(counts, PS_NUFFT_COEFFICIENT,
                 visits * groups * last->window.width * degree / choice->lanes);
    ps_nufft_add(counts, PS_NUFFT_VALUE, visits * num_tiles);
    ps_nufft_add(counts, PS_NUFFT_TOUCHED, visits * num_tiles * touched);
    if (choice->has_line) {
        count_line(counts, choice, visits);
    }
}

static void count(ps_nufft_counts *counts, const ps_nufft_choice *choice, ps_precision precision,
                  double num_points) {
    (void)precision;
    ps_nufft_add_tiles(counts, choice, num_points);
    count_spreading(counts, choice, num_points);
}

/* ---- sizes ------------------------------------------------------------------------------- */

static void choose_at_once(ps_nufft_layout *layout, const ps_problem *problem,
                           const ps_device_limits *limits) {
    const unsigned dimension = problem->frequencies->dimension;
    const uint64_t grid = layout->grid_cells * 2 * layout->lanes * layout->real_bytes;
    const uint64_t each = ps_nufft_part_bytes(layout, dimension) + grid;
    layout->parts = ps_nufft_fitting_parts(problem, limits, (double)each, 1);
    layout->fixed_bytes = layout->parts * each + ps_nufft_table_bytes(layout);
    const uint64_t buffers[] = {grid, layout->part_places * dimension * sizeof(uint64_t),
                                ps_nufft_starts_bytes(layout),
                                ps_nufft_order_largest(&layout->order)};
    layout->largest_buffer =
        layout->parts * ps_nufft_largest(buffers, sizeof buffers / sizeof buffers[0]);
}

/* Lines of all realizations of a batch are there together, and so are their transforms, in whole
 * groups of lanes. */
static void count_lines(ps_nufft_layout *layout) {
    const uint64_t line = layout->line.cells * layout->real_bytes;
    const uint64_t grid = layout->line.grid_reals * layout->real_bytes;
    const uint64_t each[] = {layout->largest_buffer_per_realization, line, grid / layout->lanes};
    layout->bytes_per_realization += line + grid / layout->lanes;
    layout->fixed_bytes += grid;
    layout->largest_buffer_per_realization = ps_nufft_largest(each, sizeof each / sizeof each[0]);
}

static void measure(ps_nufft_layout *layout, const ps_problem *problem,
                    const ps_device_limits *limits) {
    if (ps_nufft_measure_rows(layout, problem, limits)) {
        ps_nufft_set_part_points(layout, problem->num_points, limits);
        choose_at_once(layout, problem, limits);
        count_lines(layout);
        layout->host_bytes = layout->parts * layout->real_bytes * layout->part_places;
    }
}

/* Sorting, then one or two launches that spread and transform, for some realizations at a time; as
 * many for frequency 0 of axis 0, where it is a line, for all of a batch. */
static double count_launches(const ps_nufft_layout *layout, double num_points,
                             double realizations) {
    unsigned num_last = 0;
    (void)num_points;
    ps_nufft_last_axes(&layout->choice, &num_last);
    const double of_lines = layout->choice.has_line ? num_last : 0;
    return ceil(realizations / (double)layout->parts) *
               (ps_nufft_order_launches(&layout->order) + num_last) +
           of_lines;
}

static void describe(const ps_nufft_layout *layout, ps_text *text) {
    ps_text_append(text, "%s group=%lu", layout->choice.has_line ? " line" : "",
                   (unsigned long)layout->group);
}

const ps_nufft_variant ps_nufft_tiles = {.on_cpus = true,
                                         .most_cells = PS_NUFFT_MOST_ROW_CELLS,
                                         .offer = offer,
                                         .settle = settle,
                                         .count = count,
                                         .measure = measure,
                                         .local_bytes = ps_nufft_tiles_local_bytes,
                                         .slot = ps_nufft_tile_slot,
                                         .count_launches = count_launches,
                                         .programs = {1, 1},
                                         .program = {"nufft/tile.cl", "nufft/rows.cl"},
                                         .describe = describe,
                                         .launcher = &ps_nufft_tiles_launcher};
