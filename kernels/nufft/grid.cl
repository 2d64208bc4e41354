/* Points of one large set spread on the whole fine grid, as real numbers, a block of rows by each
 * work-group. Launch: (work-items of one group, outer cells * blocks).
 *
 * Rows lie along the last axis; blocks are BLOCK_ROWS cells of the axis before it. In three dimensions
 * axis 0 is the outer one; in two there is none: outer_n and outer_width are 1.
 *
 *   places, sorted, heights  of nufft/sort.cl, in parts
 *   starts    [part][outer_n block_n + 2]: places in the order of outer cells and cells of the block's axis
 *   outer_*, block_*, last_*  axes of nufft/window.h; the coordinates are those of the points
 *   high, low [outer cell][cell of the block's axis][cell of the last axis]: pairs of numbers, continued; a slab of
 *             them, the blocks from first_block on
 *   rows      local, [BLOCK_ROWS][last_n + last_bins]; last_n is a multiple of LANES
 */
#include "nufft/window.h"
#include "shared/pair.h"

#define BLOCK_ROWS 8

/* Largest number of window values. */
#define MOST_BINS 16

typedef struct grid_axes {
    window_axis outer, block, last;
    uint dimension;
} grid_axes;

/* Where a point falls. */
typedef struct grid_point {
    real scale;         /* weight, times the window of the outer axis */
    real across, along; /* centred fractions, of the block's axis and the last */
    uint cell;          /* of the last axis */
} grid_point;

static inline grid_point locate(const grid_axes axes, __global const ulong *x, const real weight,
                                const uint outer_bin) {
    ulong fraction;
    grid_point point = {.scale = weight};
    if (axes.dimension == 3) {
        first_cell(x[axes.outer.axis], axes.outer.n, axes.outer.width, &fraction);
        point.scale *= window_bin(axes.outer, centred(fraction), outer_bin);
    }
    first_cell(x[axes.block.axis], axes.block.n, axes.block.width, &fraction);
    point.across = centred(fraction);
    point.cell = first_cell(x[axes.last.axis], axes.last.n, axes.last.width, &fraction);
    point.along = centred(fraction);
    return point;
}

/* Rows first .. end of a block take a point, row first with bin first_bin of the block's axis. */
static inline void add_alone(__local real *rows, const grid_axes axes, const grid_point point,
                             const uint first, const uint end, const uint first_bin) {
    const uint pitch = axes.last.n + axes.last.bins;
    real across[MOST_BINS];
    for (uint bin = 0; bin < axes.block.bins; bin += 8) {
        vstore8(window_bins(axes.block, point.across, bin) * (real8)point.scale, 0, across + bin);
    }
    for (uint bin = 0; bin < axes.last.bins; bin += 8) {
        const real8 values = window_bins(axes.last, point.along, bin);
        __local real *at = rows + first * pitch + point.cell + bin;
        for (uint row = first; row < end; row++) {
            const real8 height = (real8)across[first_bin + row - first];
            __local unaligned_real8 *cells = (__local unaligned_real8 *)at;
            *cells = fma(height, values, *cells);
            at += pitch;
        }
    }
}

/* The same by all work-items: each has the cells that are its number modulo their number. */
static inline void add_together(__local real *rows, const grid_axes axes, const grid_point point,
                                const uint first, const uint end, const uint first_bin) {
    const uint pitch = axes.last.n + axes.last.bins;
    const uint size = get_local_size(0);
    const uint own = (get_local_id(0) + size - point.cell % size) % size;
    for (uint bin = own; bin < axes.last.width; bin += size) {
        const real value = window_bin(axes.last, point.along, bin);
        for (uint row = first; row < end; row++) {
            const real height =
                window_bin(axes.block, point.across, first_bin + row - first) * point.scale;
            __local real *at = rows + row * pitch + point.cell + bin;
            *at = fma(height, value, *at);
        }
    }
}

/* The cells behind the end of rows are the first ones again; then into the pairs. */
static inline void add_to_grid(__local real *rows, const uint num_rows, const window_axis last,
                               __global real *high, __global real *low) {
    const uint pitch = last.n + last.bins;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint row = 0; row < num_rows; row++) {
        for (uint i = get_local_id(0); i < last.bins; i += get_local_size(0)) {
            rows[row * pitch + i] += rows[row * pitch + last.n + i];
        }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint row = 0; row < num_rows; row++) {
        for (size_t i = get_local_id(0); i < last.n / LANES; i += get_local_size(0)) {
            const size_t at = row * (size_t)(last.n / LANES) + i;
            realv sum = load_global(high, at), rest = load_global(low, at);
            pair_add(&sum, &rest, load_local(rows + row * pitch, i));
            store_global(high, at, sum);
            store_global(low, at, rest);
        }
    }
}

__kernel void
nufft_grid(__global const ulong *restrict places, __global const ulong *restrict sorted,
           __global const real *restrict heights, __global const uint *restrict starts,
           const uint num_parts, const uint dimension, __global const real *restrict outer_window,
           const uint outer_n, const uint outer_width, const uint outer_degree,
           const uint outer_bins, __global const real *restrict block_window, const uint block_n,
           const uint block_width, const uint block_degree, const uint block_bins,
           __global const real *restrict last_window, const uint last_n, const uint last_width,
           const uint last_degree, const uint last_bins, const uint first_block,
           __global real *restrict high, __global real *restrict low, __local real *rows) {
    const uint num_blocks = (block_n + BLOCK_ROWS - 1) / BLOCK_ROWS;
    const size_t block = first_block + get_global_id(1);
    const uint outer_cell = block / num_blocks;
    const uint first_row = block % num_blocks * BLOCK_ROWS;
    const uint num_rows = min((uint)BLOCK_ROWS, block_n - first_row);
    const grid_axes axes = {
        {outer_window, outer_n, outer_width, 0, outer_degree, outer_bins, 0, 1},
        {block_window, block_n, block_width, dimension - 2, block_degree, block_bins, 0, 1},
        {last_window, last_n, last_width, dimension - 1, last_degree, last_bins, 0, 1},
        dimension};
    const size_t slab_row =
        first_block / num_blocks * (size_t)block_n + first_block % num_blocks * BLOCK_ROWS;
    const size_t at = ((size_t)outer_cell * block_n + first_row - slab_row) * last_n;
    for (uint i = get_local_id(0); i < num_rows * (last_n + last_bins); i += get_local_size(0)) {
        rows[i] = 0;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint outer_bin = 0; outer_bin < outer_width; outer_bin++) {
        const uint outer = (outer_cell + outer_n - outer_bin) % outer_n;
        for (uint j = 0; j < num_rows + block_width - 1;
             j++) { /* windows that begin j - width + 1 rows on */
            const uint key =
                outer * block_n + (first_row + j + block_n - block_width + 1) % block_n;
            const uint first = max(j + 1, block_width) - block_width;
            const uint end = min(j + 1, num_rows);
            const uint first_bin = first + block_width - 1 - j;
            for (uint part = 0; part < num_parts; part++) {
                __global const uint *start = starts + part * ((size_t)outer_n * block_n + 2) + key;
                for (size_t place = places[part] + start[0]; place < places[part] + start[1];
                     place++) {
                    const grid_point point =
                        locate(axes, sorted + place * dimension, heights[place], outer_bin);
                    if (get_local_size(0) == 1) {
                        add_alone(rows, axes, point, first, end, first_bin);
                    } else {
                        add_together(rows, axes, point, first, end, first_bin);
                    }
                }
            }
        }
    }
    add_to_grid(rows, num_rows, axes.last, high + at, low + at);
}
