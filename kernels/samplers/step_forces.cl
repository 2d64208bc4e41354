/* Forces of a tile of pairs on the points of both of its blocks: for step blue noise.
 *
 * Work-item (column, row), row <= column, has a tile. Launch: (num_blocks, num_blocks), the first
 * rounded up at will, at once or some rows after the others; either once for every part of the
 * points of a block (step_first), from the first to the last.
 *
 *   points   [axis][stride]
 *   table    [num_bins + 1] of forces over distances; the last is 0
 *   forces   [num_blocks][axis][stride]: those of points of a block on all points
 */
#include "samplers/step.h"

/* Kernels of the same program (docs/developer/decisions.md). */
#include "samplers/step_counts.cl"
#include "samplers/step_fold.cl"

STEP_INLINE double sum_lanes(const double8 x) {
    const double4 four = x.lo + x.hi;
    const double2 two = four.lo + four.hi;
    return two.x + two.y;
}

STEP_INLINE double8 look_up(__global const double *table, const int8 bin) {
    return (double8)(table[bin.s0], table[bin.s1], table[bin.s2], table[bin.s3], table[bin.s4],
                     table[bin.s5], table[bin.s6], table[bin.s7]);
}

/* What a tile is of, and where its forces go. */
typedef struct step_tile {
    uint row_begin, row_end, begin, end;
    __global double *on_row, *on_column;
} step_tile;

/* is_alone: a block with itself, every pair twice: both points get theirs. is_whole: all points of
 * the column's block are there. */
STEP_INLINE void force_tile(const step_layout *layout, __global const double *points,
                            __global const double *table, const step_tile *tile,
                            const bool is_alone, const bool is_whole) {
    const uint stride = layout->stride;
    for (uint i = tile->row_begin; i < tile->row_end; i++) {
        const double8 x = (double8)points[i];
        const double8 y = (double8)points[stride + i];
        double8 sum_x = (double8)0;
        double8 sum_y = (double8)0;
        for (uint j = tile->begin; j < tile->end; j += STEP_LANES) {
            const double8 dx = step_wrap(x - step_load(points + j));
            const double8 dy = step_wrap(y - step_load(points + stride + j));
            const int8 bin = step_bins(layout, dx, dy);
            const double8 force = look_up(table, is_whole ? bin : step_keep(layout, bin, j, 0));
            sum_x = fma(force, dx, sum_x);
            sum_y = fma(force, dy, sum_y);
            if (!is_alone) {
                __global double *on_x = tile->on_column + j;
                __global double *on_y = tile->on_column + stride + j;
                step_store(on_x, fma(-force, dx, step_load(on_x)));
                step_store(on_y, fma(-force, dy, step_load(on_y)));
            }
        }
        tile->on_row[i] = sum_lanes(sum_x);
        tile->on_row[stride + i] = sum_lanes(sum_y);
    }
}

STEP_INLINE void clear(const step_tile *tile, const uint stride) {
    for (uint j = tile->begin; j < tile->end; j += STEP_LANES) {
        step_store(tile->on_column + j, (double8)0);
        step_store(tile->on_column + stride + j, (double8)0);
    }
}

__kernel void step_forces(const step_layout layout, __global const double *restrict points,
                          __global const double *restrict table, __global double *forces) {
    const uint column = get_global_id(0);
    const uint row = get_global_id(1);
    if (column >= layout.num_blocks || row > column) {
        return;
    }
    const size_t plane = 2 * (size_t)layout.stride;
    const step_tile tile = {step_first(&layout, row), step_first_end(&layout, row),
                            column * layout.block,    step_block_end(&layout, column),
                            forces + column * plane,  forces + row * plane};
    if (row == column) {
        force_tile(&layout, points, table, &tile, true, false);
    } else {
        if (layout.first == 0) {
            clear(&tile, layout.stride);
        }
        if (column + 1 < layout.num_blocks) {
            force_tile(&layout, points, table, &tile, false, true);
        } else {
            force_tile(&layout, points, table, &tile, false, false);
        }
    }
}
