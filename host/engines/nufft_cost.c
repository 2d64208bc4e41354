/* What a realization costs, of each of the ways that nufft_choice.h describes. */
#include "base/round.h"
#include "engines/nufft_fft.h"
#include "engines/nufft_kernels.h"
#include "engines/nufft_whole_shape.h"

#include <math.h>

/* Cycles on a core with vectors of `lanes` numbers (Zen 5, PoCL 3.1, 2026-11, profile of bench_nufft, parts left
 * out in turn): of a point to be sorted; for its phases, once for all tiles whose rows are in local memory
 * together, and for its windows, where a fused operation makes a value of `lanes` points; of a point in a tile,
 * and of a cell that it touches there; of a cell to be cleared, and of a frequency to be written. */
static const double cycles_per_point = 8;
static const double cycles_per_phase = 13;
static const double cycles_per_coefficient = 0.5;
static const double cycles_per_value = 2.5;
static const double cycles_per_touched = 1;
static const double cycles_per_cell = 2.3;
static const double cycles_per_power = 12;

/* Local memory for rows to choose for, whatever the device has; the rest is for a chunk of points. */
static const double nominal_local_bytes = (1 << 20) - (8 << 10);

/* Two fused operations in a cycle. */
static const double flops_per_lane = 4;

/* A point on its way to a block of rows of a grid, and a row of the block. */
static const double cycles_per_block = 80;
static const double cycles_per_row = 6;

/* A cell of a grid: cleared, taken into pairs for every chunk, fetched by the transform. */
static const double cycles_per_grid_cell = 10;
static const double cycles_per_pair = 2;

/* Spreading on a grid and the transform along axis 0. */
static double grid_cycles(const ps_nufft_choice *choice, unsigned lanes, double num_points) {
    const ps_nufft_axis *axes = choice->axes;
    const ps_nufft_axis *block = &axes[choice->num_axes - 2];
    const ps_nufft_axis *last = &axes[choice->num_axes - 1];
    const double outer = choice->num_axes == 3 ? axes[0].window.width : 1;
    const double blocks = (PS_NUFFT_BLOCK_ROWS + block->window.width - 1.0) / PS_NUFFT_BLOCK_ROWS;
    const double strips = last->window.width > PS_NUFFT_BLOCK_ROWS ? 2 : 1;
    const double columns = (choice->num_axes == 3 ? (double)block->n : 1) * last->n;
    return num_points * outer *
               (blocks * cycles_per_block + block->window.width * strips * cycles_per_row) +
           columns / (2 * lanes) * ps_fft_cycles(axes[0].n) +
           columns * axes[0].n *
               (cycles_per_grid_cell + cycles_per_pair * ceil(num_points / (double)choice->chunk));
}

/* Four neighbours are added together: to cells from the first of one window to the last of another. */
static double touched_cells(const ps_nufft_axis *axis, double num_points) {
    const double between = 3 * (double)axis->n / num_points;
    return axis->window.width + fmin(between, axis->window.width);
}

/* Rows that fit into local memory; less than 1 where tiles must be narrower. */
static double rows_at_once(const ps_nufft_axis *axis) {
    const double vector_bytes = 64;
    return nominal_local_bytes / (2 * vector_bytes * axis->n);
}

/* Of a point: windows and phases, for all tiles. */
static double cycles_of_point(const ps_nufft_axis *axis, double num_tiles, double lanes) {
    const double degree = axis->window.width + 2;
    return ceil(num_tiles / fmax(1, floor(rows_at_once(axis)))) *
           (cycles_per_phase + cycles_per_coefficient * axis->window.width * degree / lanes);
}

/* Transforms of the rows of one tile, all the way to powers. */
static double tile_cycles(const ps_nufft_choice *choice) {
    unsigned num = 0;
    const ps_nufft_axis *axes = ps_nufft_last_axes(choice, &num);
    const ps_nufft_axis *last = &axes[num - 1];
    const double kept = 2.0 * last->max_frequency + 1;
    const double row = ps_fft_cycles(last->n) + cycles_per_cell * last->n + cycles_per_power * kept;
    return num == 1 ? row
                    : axes[0].n * row + kept * (ps_fft_cycles(axes[0].n) + cycles_per_power * kept);
}

/* Spreading by direct phases on axis 0. */
static double spread_cycles(const ps_nufft_choice *choice, double lanes, double num_tiles,
                            double num_points) {
    const ps_nufft_axis *first = &choice->axes[0];
    const ps_nufft_axis *last = &choice->axes[choice->num_axes - 1];
    const bool has_rows = choice->num_axes == 2;
    const double visits = num_points * (has_rows ? first->window.width : 1);
    const double touched = touched_cells(last, visits / (has_rows ? first->n : 1));
    return visits * (cycles_of_point(last, num_tiles, lanes) +
                     num_tiles * (cycles_per_value + cycles_per_touched * touched));
}

double ps_nufft_flops(const ps_nufft_choice *choice, ps_precision precision, double num_points) {
    const ps_nufft_axis *last = &choice->axes[choice->num_axes - 1];
    const unsigned lanes = ps_nufft_nominal_lanes(precision);
    if (choice->is_whole) {
        return ps_nufft_whole_cycles(choice, precision, lanes, num_points) * lanes * flops_per_lane;
    }
    const double narrower = ceil(1 / fmin(1, rows_at_once(last)));
    const double num_tiles = (double)ps_divide_up(choice->span, lanes) * narrower;
    const double cycles =
        num_points * cycles_per_point + num_tiles * tile_cycles(choice) +
        (choice->is_gridded ? grid_cycles(choice, lanes, num_points)
                            : spread_cycles(choice, lanes, num_tiles, num_points));
    return cycles * lanes * flops_per_lane;
}
