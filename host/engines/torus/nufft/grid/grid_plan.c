/* The grid of GPUs, for many sets at a time: what it takes (grid.c does it). */
#include "base/round.h"
#include "device/reals.h"
#include "engines/nufft/fft.h"
#include "engines/torus/nufft/measure.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>

/* ---- choice ------------------------------------------------------------------------------ */

/* Sets of up to so many points are there whole, many at a time (60 bytes a point of the plane);
 * others come in chunks, each of which reads and writes all boxes once more. */
static const double most_whole_points = 1 << 24;
enum { CHUNK_POINTS = 1 << 23 };

static bool offer(const ps_problem *problem, unsigned lanes, unsigned which,
                  ps_nufft_choice *choice) {
    (void)lanes;
    *choice = ps_nufft_choice_of_axes(problem, 0);
    return which == 0 && ps_planned_points(problem) <= most_whole_points;
}

static bool offer_chunks(const ps_problem *problem, unsigned lanes, unsigned which,
                         ps_nufft_choice *choice) {
    (void)lanes;
    *choice = ps_nufft_choice_of_axes(problem, 0);
    return which == 0 && ps_planned_points(problem) > most_whole_points;
}

/* Boxes have edges that divide the cells: long axes have long ones. */
static uint32_t unit(const ps_nufft_choice *choice, unsigned axis) {
    enum { LEAST = 16, OF_LONG = 32, OF_LINE = 128, LONG_FREQUENCY = 128 };
    const bool is_long = choice->axes[axis].max_frequency >= LONG_FREQUENCY;
    return !is_long ? LEAST : choice->num_axes == 1 ? OF_LINE : OF_LONG;
}

static double cells_of(const ps_nufft_choice *choice) {
    double cells = 1;
    for (unsigned i = 0; i < choice->num_axes; i++) {
        cells *= choice->axes[i].n;
    }
    return cells;
}

/* Roundings of plain sums of more windows on a cell may be in step beyond what the bound allows
 * for, as in large.c. */
static bool can_be_plain(const ps_nufft_choice *choice, double num_points) {
    const double windows_on_a_cell = 256;
    double windows = num_points;
    for (unsigned i = 0; i < choice->num_axes; i++) {
        windows *= (double)choice->axes[i].window.width / choice->axes[i].n;
    }
    return windows <= windows_on_a_cell;
}

static void put_into_pairs(ps_nufft_choice *choice) {
    choice->chunk = (uint64_t)(cells_of(choice) * PS_NUFFT_GRID_FLUSH);
}

static bool complete_chunks(ps_nufft_choice *choice, const ps_problem *problem,
                            ps_precision precision, unsigned which) {
    (void)problem;
    (void)precision;
    put_into_pairs(choice);
    return which == 0;
}

static bool complete(ps_nufft_choice *choice, const ps_problem *problem, ps_precision precision,
                     unsigned which) {
    const bool has_plain = can_be_plain(choice, ps_planned_points(problem));
    (void)precision;
    if (has_plain && which == 0) {
        choice->chunk = 0;
    } else {
        put_into_pairs(choice);
    }
    return which == 0 || (has_plain && which == 1);
}

/* ---- cost -------------------------------------------------------------------------------- */

/* Cells of a point, in whole steps of 64 work-items (kernels/nufft/grid/spread.cl). */
static double steps_of_point(const ps_nufft_choice *choice) {
    enum { COLUMNS = 8, ITEMS = 64 };
    double cells = 1;
    for (unsigned i = 0; i < choice->num_axes; i++) {
        const unsigned slots = i + 1 == choice->num_axes ? COLUMNS : COLUMNS / 2;
        cells *= (double)ps_round_up(choice->axes[i].window.width, slots);
    }
    return ceil(cells / ITEMS);
}

/* Lines of every axis, the last first, with the frequencies that are left of those before. The
 * first ones are read from boxes. */
static void count_lines(ps_nufft_counts *counts, const ps_nufft_choice *choice,
                        ps_precision precision) {
    enum { WORDS_OF_SINGLE = 2 };
    const double factor = precision == PS_SINGLE ? 1 : 2;
    double numbers = cells_of(choice);
    for (unsigned i = choice->num_axes; i-- > 0;) {
        const ps_nufft_axis *axis = &choice->axes[i];
        const bool is_first = i + 1 == choice->num_axes;
        const double lines = numbers / axis->n;
        const double left = lines * ((is_first ? 1 : 2) * axis->max_frequency + 1.0);
        ps_nufft_add(counts, PS_NUFFT_GPU_OPERATION, factor * lines * ps_fft_flops(axis->n));
        ps_nufft_add(counts, PS_NUFFT_GPU_WORD,
                     WORDS_OF_SINGLE * factor * (left + (is_first ? 0 : numbers)));
        numbers = left;
    }
}

static void count(ps_nufft_counts *counts, const ps_nufft_choice *choice, ps_precision precision,
                  double num_points) {
    const double flushes =
        choice->chunk > 0 ? 2 * ceil(num_points / (double)choice->chunk) : 1; /* high and low */
    const double factor = precision == PS_SINGLE ? 1 : 2;
    const double tile = ps_nufft_grid_nominal_tile(choice, num_points, ps_real_bytes(precision));
    ps_nufft_add(counts, PS_NUFFT_GPU_SORTED, num_points);
    ps_nufft_add(counts, PS_NUFFT_GPU_POINT, num_points * factor);
    ps_nufft_add(counts, PS_NUFFT_GPU_STEP, num_points * factor * steps_of_point(choice));
    ps_nufft_add(counts, PS_NUFFT_GPU_WORD, 2 * flushes * factor * tile);
    count_lines(counts, choice, precision);
}

/* ---- sizes ------------------------------------------------------------------------------- */

static size_t local_bytes(const ps_nufft_layout *layout) {
    return layout->grid.local_bytes;
}

/* Twiddles of passes and of axes, gains, polynomials. */
static uint64_t table_bytes(const ps_nufft_layout *layout) {
    enum { SMALL = 1536 };
    uint64_t bytes = 0;
    for (unsigned i = 0; i < layout->grid.num_passes; i++) {
        const ps_nufft_pass *pass = &layout->grid.passes[i];
        const ps_nufft_axis *axis = &layout->choice.axes[pass->axis];
        const uint64_t turns = pass->is_turned ? 2 * (uint64_t)axis->n : 2;
        const uint64_t gains = (uint64_t)axis->max_frequency + 1;
        bytes += (2 * (uint64_t)pass->length + turns + gains) * layout->real_bytes + SMALL;
    }
    return bytes;
}

static bool is_in_chunks(const ps_nufft_layout *layout) {
    return layout->choice.variant == &ps_nufft_grid_chunks;
}

static void choose_at_once(ps_nufft_layout *layout, const ps_problem *problem,
                           const ps_device_limits *limits) {
    const ps_nufft_grid_sizes *grid = &layout->grid;
    const unsigned dimension = problem->frequencies->dimension;
    const uint64_t tiles = grid->tile_reals * layout->real_bytes;
    const uint64_t numbers[2] = {2 * grid->numbers[0] * layout->real_bytes,
                                 2 * grid->numbers[1] * layout->real_bytes};
    const uint64_t each = ps_nufft_part_bytes(layout, dimension) +
                          (layout->has_pairs ? 2 : 1) * tiles + numbers[0] + numbers[1];
    layout->parts =
        is_in_chunks(layout) ? 1 : ps_nufft_fitting_parts(problem, limits, (double)each, 1);
    layout->fixed_bytes = layout->parts * each + table_bytes(layout);
    const uint64_t buffers[] = {tiles,
                                numbers[0],
                                numbers[1],
                                layout->part_places * dimension * sizeof(uint64_t),
                                ps_nufft_starts_bytes(layout),
                                ps_nufft_order_largest(&layout->order)};
    layout->largest_buffer =
        layout->parts * ps_nufft_largest(buffers, sizeof buffers / sizeof buffers[0]);
}

/* Boxes as kernels/nufft/sort.cl counts them. */
static void set_boxes(ps_nufft_layout *layout) {
    const ps_nufft_grid_sizes *grid = &layout->grid;
    layout->has_boxes = true;
    for (unsigned i = 0; i < PS_NUFFT_MAX_AXES; i++) {
        layout->boxes.num[i] = grid->boxes[i];
        layout->boxes.per_cell[i] = (uint32_t)(((uint64_t)1 << 32) / grid->edges[i]);
    }
    layout->num_keys = (uint32_t)ps_nufft_grid_boxes(grid);
    layout->num_tiles = layout->num_keys;
}

static void measure(ps_nufft_layout *layout, const ps_problem *problem,
                    const ps_device_limits *limits) {
    const ps_nufft_choice *choice = &layout->choice;
    layout->grid =
        ps_nufft_grid_measure(choice, ps_planned_points(problem), limits, layout->real_bytes);
    if (layout->grid.num_passes == 0 || cells_of(choice) > UINT32_MAX) {
        layout->lanes = 0;
        return;
    }
    layout->has_pairs = choice->chunk > 0;
    layout->stride = layout->grid.passes[layout->grid.num_passes - 1].to;
    set_boxes(layout);
    layout->bytes_per_realization = layout->stride * layout->real_bytes;
    layout->largest_buffer_per_realization = layout->bytes_per_realization;
    const bool is_cut = is_in_chunks(layout) && problem->num_points > CHUNK_POINTS;
    ps_nufft_set_part_points(layout, is_cut ? CHUNK_POINTS : problem->num_points, limits);
    choose_at_once(layout, problem, limits);
    layout->host_bytes = layout->parts * layout->real_bytes * layout->part_places;
}

/* [k_0][k_1][k_2], the last of them from 0 on: |S(-k)| = |S(k)|. */
static uint32_t slot(const ps_nufft_layout *layout, const int32_t *k, unsigned dimension) {
    const int32_t sign = k[dimension - 1] < 0 ? -1 : 1;
    uint32_t place = 0;
    for (unsigned i = 0; i + 1 < dimension; i++) {
        const int32_t K = layout->choice.axes[i].max_frequency;
        place = place * (2 * (uint32_t)K + 1) + (uint32_t)(K + sign * k[i]);
    }
    const uint32_t last = (uint32_t)layout->choice.axes[dimension - 1].max_frequency + 1;
    return place * last + (uint32_t)(sign * k[dimension - 1]);
}

/* Sorting and spreading, of some realizations at a time or a chunk of one, and passes. */
static double count_launches(const ps_nufft_layout *layout, double num_points,
                             double realizations) {
    const double chunks =
        is_in_chunks(layout) ? fmax(1, ceil(num_points / (double)layout->part_points)) : 1;
    return ceil(realizations / (double)layout->parts) *
           (chunks * (ps_nufft_order_launches(&layout->order) + 1) + layout->grid.num_passes);
}

static void describe(const ps_nufft_layout *layout, ps_text *text) {
    const ps_nufft_grid_sizes *grid = &layout->grid;
    ps_text_append(text, " boxes=%lux%lux%lu copies=%lu passes=%u", (unsigned long)grid->edges[0],
                   (unsigned long)grid->edges[1], (unsigned long)grid->edges[2],
                   (unsigned long)grid->copies, grid->num_passes);
}

/* Long axes are transformed in two halves, each of which fits into a work-group. Kernels: sort,
 * spread, and lines of each axis. */
#define GRID_ROW(OFFER, COMPLETE, LAUNCHER)                                                        \
    {                                                                                              \
        .on_gpus = true, .is_gridded = true, .are_alike = true, .most_cells = 1 << 24,             \
        .offer = (OFFER), .unit = unit, .complete = (COMPLETE), .count = count,                    \
        .has_lattices = true, .measure = measure, .local_bytes = local_bytes, .slot = slot,        \
        .count_launches = count_launches, .programs = {3, 5}, .describe = describe,                \
        .launcher = (LAUNCHER)                                                                     \
    }

const ps_nufft_variant ps_nufft_grid = GRID_ROW(offer, complete, &ps_nufft_grid_launcher);
const ps_nufft_variant ps_nufft_grid_chunks =
    GRID_ROW(offer_chunks, complete_chunks, &ps_nufft_grid_chunks_launcher);
