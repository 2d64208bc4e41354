#include "engines/nufft/cost.h"

#include "base/round.h"
#include "device/reals.h"
#include "engines/nufft/axis.h"
#include "engines/nufft/sizes/boxes.h"
#include "engines/nufft/fft.h"
#include "engines/nufft/kernels.h"
#include "engines/nufft/sizes/strips.h"
#include "engines/nufft/sizes/whole.h"

#include <math.h>

/* Two fused operations in a cycle. */
static const double flops_per_lane = 4;

/* Local memory for rows to choose for, whatever the device has; the rest is for a chunk of points.
 */
static const double nominal_local_bytes = (1 << 20) - (8 << 10);

/* The nearest cache of a core (Zen 5), nominal as well. */
static const double near_bytes = 32 << 10;

static void add(ps_nufft_counts *counts, ps_nufft_part part, double num) {
    counts->num[part] += num;
}

/* num transforms of a length. */
static void add_transforms(ps_nufft_counts *counts, double num, uint32_t length) {
    add(counts, PS_NUFFT_OPERATION, num * ps_fft_flops(length));
    add(counts, PS_NUFFT_PASSED, num * ps_fft_passed(length));
}

static double sum_cycles(const ps_nufft_counts *counts) {
    double cycles = 0;
    for (size_t i = 0; i < PS_NUFFT_NUM_PARTS; i++) {
        cycles += ps_nufft_cycles[i] * counts->num[i];
    }
    return cycles;
}

/* Tiles of a realization in strips that still are in a cache when they are transformed (Zen 4):
 * beyond it, a K of 512 took 1.3 to 1.5 times what K up to 256 says. Nominal, too. */
static const double strips_bytes = 4 << 20;

/* ---- tiles ------------------------------------------------------------------------------- */

/* Four neighbours are added together: to cells from the first of one window to the last of another.
 */
static double touched_cells(const ps_nufft_axis *axis, double num_points) {
    const double between = 3 * (double)axis->n / num_points;
    return axis->window.width + fmin(between, axis->window.width);
}

/* Rows that fit into local memory; less than 1 where tiles must be narrower. */
static double rows_at_once(const ps_nufft_axis *axis) {
    const double vector_bytes = 64;
    return nominal_local_bytes / (2 * vector_bytes * axis->n);
}

/* Transforms of the rows of the tiles, all the way to powers. */
static void count_tiles(ps_nufft_counts *counts, const ps_nufft_choice *choice, double num_tiles) {
    unsigned num = 0;
    const ps_nufft_axis *axes = ps_nufft_last_axes(choice, &num);
    const ps_nufft_axis *last = &axes[num - 1];
    const double kept = 2.0 * last->max_frequency + 1;
    const double rows = num_tiles * (num == 1 ? 1 : axes[0].n);
    add_transforms(counts, rows, last->n);
    add(counts, PS_NUFFT_CLEARED, rows * last->n);
    add(counts, PS_NUFFT_POWER, rows * kept);
    if (num > 1) {
        add_transforms(counts, num_tiles * kept, axes[0].n);
        add(counts, PS_NUFFT_POWER, num_tiles * kept * kept);
    }
}

/* A line of frequency 0, of which realizations share transforms: places that are added to it, and
 * its part of a tile, half of whose columns are kept. */
static void count_line(ps_nufft_counts *counts, const ps_nufft_choice *choice, double visits) {
    unsigned num = 0;
    const ps_nufft_axis *axes = ps_nufft_last_axes(choice, &num);
    const ps_nufft_axis *last = &axes[num - 1];
    const double rows = num == 1 ? 1 : axes[0].n;
    const double vectors = (double)ps_nufft_bins(last) / choice->lanes;
    add(counts, PS_NUFFT_VALUE, visits);
    add(counts, PS_NUFFT_WHOLE_POLYNOMIAL, visits * (last->window.width + 2.0) * vectors);
    add(counts, PS_NUFFT_WHOLE_ROW, visits * fmax(1, vectors));
    add(counts, PS_NUFFT_CLEARED, rows * last->n);
    add_transforms(counts, rows / choice->lanes, last->n);
    if (num > 1) {
        add_transforms(counts, (last->max_frequency + 1.0) / choice->lanes, axes[0].n);
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
                            double num_tiles, double num_points) {
    const ps_nufft_axis *first = &choice->axes[0];
    const ps_nufft_axis *last = &choice->axes[choice->num_axes - 1];
    const bool has_rows = choice->num_axes == 2;
    /* a list for each row that touches another */
    const double lists = has_rows ? (double)first->n * first->window.width : 1;
    const double points_of_list = has_rows ? num_points / first->n : num_points;
    const double visits = lists * filled_places(points_of_list);
    const double touched = touched_cells(last, points_of_list);
    const double groups = ceil(num_tiles / fmax(1, floor(rows_at_once(last))));
    const double degree = last->window.width + 2;
    add(counts, PS_NUFFT_PHASE, visits * groups);
    add(counts, PS_NUFFT_COEFFICIENT,
        visits * groups * last->window.width * degree / choice->lanes);
    add(counts, PS_NUFFT_VALUE, visits * num_tiles);
    add(counts, PS_NUFFT_TOUCHED, visits * num_tiles * touched);
    if (choice->has_line) {
        count_line(counts, choice, visits);
    }
}

/* Cells of a row that a point is added to, kernels/nufft/chunk.h. */
static double cells_of_row(const ps_nufft_axis *axis, ps_precision precision) {
    enum { OF_DOUBLES = 12 };
    const bool is_short = precision == PS_DOUBLE && axis->window.width <= OF_DOUBLES;
    return fmin(ps_nufft_bins(axis), is_short ? OF_DOUBLES : HUGE_VAL);
}

/* ---- grids of large sets ----------------------------------------------------------------- */

static const size_t word_bytes = sizeof(float);

/* Polynomials of the windows of a point on all axes, in vectors; mirrored ones count half. */
static double polynomials_of(const ps_nufft_choice *choice) {
    double sum = 0;
    for (unsigned i = 0; i < choice->num_axes; i++) {
        const ps_nufft_axis *axis = &choice->axes[i];
        const double mirrored = i + 1 < choice->num_axes ? 2 : 1;
        sum += (axis->window.width + 2.0) * ps_nufft_bins(axis) / (choice->lanes * mirrored);
    }
    return sum;
}

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
    add(counts, PS_NUFFT_BOX_POINT, num_points);
    add(counts, PS_NUFFT_WHOLE_POLYNOMIAL, num_points * polynomials_of(choice));
    add(counts, PS_NUFFT_BOX_ROW,
        num_points * rows * cells_of_row(last, precision) * real_bytes / ROW_BYTES);
    add(counts, PS_NUFFT_BOX_CELL, cells * real_bytes / (double)word_bytes * chunks);
}

/* Spreading on a grid and the transform along axis 0. */
static void count_grid(ps_nufft_counts *counts, const ps_nufft_choice *choice,
                       ps_precision precision, double num_points) {
    const ps_nufft_axis *axes = choice->axes;
    const double columns =
        (choice->num_axes == 3 ? (double)axes[1].n : 1) * axes[choice->num_axes - 1].n;
    const double words = columns * axes[0].n * (double)(ps_real_bytes(precision) / word_bytes);
    count_boxes(counts, choice, precision, num_points);
    add_transforms(counts, columns / (2 * choice->lanes), axes[0].n);
    add(counts, PS_NUFFT_GRID_CELL, words);
    if (choice->chunk > 0) {
        add(counts, PS_NUFFT_GRID_PAIR, words * ceil(num_points / (double)choice->chunk));
    }
}

/* ---- whole realizations ------------------------------------------------------------------ */

static void count_whole_transforms(ps_nufft_counts *counts, const ps_nufft_choice *choice) {
    const unsigned lanes = choice->lanes;
    uint32_t kept[2];
    ps_nufft_whole_kept(choice, kept);
    const double groups = (double)ps_divide_up(choice->lengths[1], 2 * lanes);
    const double tiles = (double)ps_divide_up(choice->span, lanes);
    const double shared = ps_nufft_whole_shared(choice, lanes);
    const double turned = tiles - (shared > 0 ? 1 : 0);
    const double second = turned + shared / lanes; /* of a shared tile, its part */
    add_transforms(counts, groups, choice->lengths[0]);
    add_transforms(counts, second, choice->lengths[1]);
    add(counts, PS_NUFFT_WHOLE_CELL, groups * choice->lengths[0] + second * choice->lengths[1]);
    add(counts, PS_NUFFT_WHOLE_TURNED, groups * turned * lanes);
    add(counts, PS_NUFFT_WHOLE_SHARED, shared * choice->lengths[1]);
    add(counts, PS_NUFFT_WHOLE_POWER, tiles * (2.0 * kept[1] + 1));
}

double ps_nufft_whole_transform_cycles(const ps_nufft_choice *choice) {
    ps_nufft_counts counts = {{0}};
    count_whole_transforms(&counts, choice);
    return sum_cycles(&counts);
}

static void count_whole(ps_nufft_counts *counts, const ps_nufft_choice *choice,
                        ps_precision precision, double num_points) {
    const unsigned lanes = choice->lanes;
    const ps_nufft_whole_sizes sizes = ps_nufft_whole_measure(choice, lanes);
    const ps_nufft_axis *last = &choice->axes[choice->num_axes - 1];
    const bool is_near = (double)(sizes.grid_reals * ps_real_bytes(precision)) <= near_bytes;
    const double rows = choice->num_axes > 1 ? choice->axes[0].window.width : 1;
    const double vectors = fmax(1, cells_of_row(last, precision) / (double)lanes);
    add(counts, PS_NUFFT_WHOLE_POINT, num_points);
    add(counts, PS_NUFFT_WHOLE_POLYNOMIAL, num_points * polynomials_of(choice));
    add(counts, is_near ? PS_NUFFT_WHOLE_ROW : PS_NUFFT_WHOLE_FAR_ROW, num_points * rows * vectors);
    add(counts, PS_NUFFT_WHOLE_CLEARED, (double)sizes.grid_reals / lanes);
    count_whole_transforms(counts, choice);
}

/* ---- strips ------------------------------------------------------------------------------ */

static void count_strips(ps_nufft_counts *counts, const ps_nufft_choice *choice,
                         ps_precision precision, double num_points) {
    const unsigned lanes = choice->lanes;
    const ps_nufft_axis *axes = choice->axes;
    const ps_nufft_strip_sizes sizes = ps_nufft_strips_measure(choice, lanes);
    const double groups = axes[1].n / (2.0 * lanes);
    const double tiles = (double)ps_divide_up(choice->span, lanes);
    const double strips = (double)axes[1].n / sizes.columns;
    const double vectors = fmax(1, cells_of_row(&axes[1], precision) / (double)lanes);
    const double added = num_points * (1 + 1 / strips); /* those of the last strip twice */
    const double bytes = (double)sizes.tile_reals * (double)ps_real_bytes(precision);
    const bool are_far = bytes > strips_bytes;
    add(counts, PS_NUFFT_SORTED, num_points);
    add(counts, PS_NUFFT_WHOLE_POINT, added);
    add(counts, PS_NUFFT_WHOLE_POLYNOMIAL, added * polynomials_of(choice));
    add(counts, PS_NUFFT_WHOLE_FAR_ROW, added * axes[0].window.width * vectors);
    add(counts, PS_NUFFT_WHOLE_CLEARED, 2 * strips * (double)sizes.strip_reals / lanes);
    add_transforms(counts, groups, axes[0].n);
    add_transforms(counts, tiles, axes[1].n);
    add(counts, PS_NUFFT_WHOLE_CELL, groups * axes[0].n + tiles * axes[1].n);
    add(counts, PS_NUFFT_WHOLE_TURNED, groups * tiles * lanes);
    add(counts, PS_NUFFT_WHOLE_POWER, tiles * (2.0 * axes[1].max_frequency + 1));
    add(counts, PS_NUFFT_STRIP_FAR, are_far ? bytes / (double)word_bytes : 0);
}

/* ---- all --------------------------------------------------------------------------------- */

ps_nufft_counts ps_nufft_count(const ps_nufft_choice *choice, ps_precision precision,
                               double num_points) {
    ps_nufft_counts counts = {{0}};
    if (choice->is_whole) {
        count_whole(&counts, choice, precision, num_points);
        return counts;
    }
    if (choice->is_in_strips) {
        count_strips(&counts, choice, precision, num_points);
        return counts;
    }
    const ps_nufft_axis *last = &choice->axes[choice->num_axes - 1];
    const double narrower = ceil(1 / fmin(1, rows_at_once(last)));
    const double num_tiles = (double)ps_divide_up(ps_nufft_tiled(choice), choice->lanes) * narrower;
    add(&counts, PS_NUFFT_SORTED, num_points);
    count_tiles(&counts, choice, num_tiles);
    if (choice->is_gridded) {
        count_grid(&counts, choice, precision, num_points);
    } else {
        count_spreading(&counts, choice, num_tiles, num_points);
    }
    return counts;
}

double ps_nufft_flops(const ps_nufft_choice *choice, ps_precision precision, double num_points) {
    const ps_nufft_counts counts = ps_nufft_count(choice, precision, num_points);
    return sum_cycles(&counts) * choice->lanes * flops_per_lane;
}
