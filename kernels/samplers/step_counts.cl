/* Pairs of points by their distance: for step blue noise.
 *
 * Work-item (r, s) has the tiles of rows r and num_blocks - 1 - r, which are as long as those of
 * any other r together, and of these every S-th, from the s-th on. Launch: ((num_blocks + 1) / 2,
 * S), the first rounded up at will, once for every part of the points of a block (step_first). With
 * SHARED=0, S is 1, and each work-item has a copy of its own.
 *
 *   points  [axis][stride]
 *   counts  [(num_blocks + 1) / 2][num_bins + 1], zero before
 */
#include "samplers/step.h"

#ifndef SHARED
#define SHARED 0
#endif

#if SHARED
#define STEP_COUNT(bin) atomic_inc(counts + (bin))
#define STEP_MEMORY volatile __global
#else
#define STEP_COUNT(bin) counts[bin]++
#define STEP_MEMORY __global
#endif

/* Pairs of a point at a time: their bins, which wait for roots, and counting, which waits for
 * memory, are loops of their own (1.15 ns a pair instead of 1.45, an EPYC with AVX-512, PoCL 3.1,
 * 2026-11). */
#define CHUNK 64

/* is_whole: all of the other block's points are there, and come later. */
STEP_INLINE void count_tile(const step_layout *layout, __global const double *points,
                            STEP_MEMORY uint *counts, const uint row, const uint column,
                            const bool is_whole) {
    const uint end = step_first_end(layout, row);
    const uint last = step_block_end(layout, column);
    int bins[CHUNK];
    for (uint i = step_first(layout, row); i < end; i++) {
        const double8 x = (double8)points[i];
        const double8 y = (double8)points[layout->stride + i];
        for (uint from = column * layout->block; from < last; from += CHUNK) {
            const uint num = min(last - from, (uint)CHUNK);
            for (uint k = 0; k < num; k += STEP_LANES) {
                const uint j = from + k;
                const double8 dx = step_wrap(x - step_load(points + j));
                const double8 dy = step_wrap(y - step_load(points + layout->stride + j));
                const int8 near = step_bins(layout, dx, dy);
                vstore8(is_whole ? near : step_keep(layout, near, j, i + 1), 0, bins + k);
            }
            for (uint k = 0; k < num; k += STEP_LANES) {
                for (uint l = 0; l < STEP_LANES; l++) {
                    STEP_COUNT(bins[k + l]);
                }
            }
        }
    }
}

/* Tiles of a row: those of the first and the last block are looked at pair by pair. */
STEP_INLINE void count_row(const step_layout *layout, __global const double *points,
                           STEP_MEMORY uint *counts, const uint row) {
    for (uint j = row + get_global_id(1); j < layout->num_blocks; j += get_global_size(1)) {
        if (j > row && j + 1 < layout->num_blocks) {
            count_tile(layout, points, counts, row, j, true);
        } else {
            count_tile(layout, points, counts, row, j, false);
        }
    }
}

__kernel void step_counts(const step_layout layout, __global const double *restrict points,
                          STEP_MEMORY uint *restrict counts) {
    const uint r = get_global_id(0);
    const uint other = layout.num_blocks - 1 - r;
    if (r >= (layout.num_blocks + 1) / 2) {
        return;
    }
    STEP_MEMORY uint *own = counts + r * (layout.num_bins + 1);
    count_row(&layout, points, own, r);
    if (other > r) {
        count_row(&layout, points, own, other);
    }
}
