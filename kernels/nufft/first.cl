/* The transform along axis 0 of a grid of real numbers (nufft/grid.cl). Launch: (work-items of one
 * group, groups of 2 LANES columns).
 *
 * Lanes are neighbouring columns here (nufft/halves.h). The result is turned, so that lanes are
 * frequencies, as nufft/finish.cl wants it.
 *
 *   high, low  [cell of axis 0][column], some columns: cells of all other axes, a multiple of 2 LANES
 *   mean       taken off every cell: frequency 0
 *   radices, twiddles, position, K, n  of nufft/finish.h; gains [K + 1]: 1 / squared transform of the window
 *   rows       [tile][column][re, im][LANES]: frequencies tile LANES + lane from first_tile on; what exceeds K is 0;
 *              all_columns of them, these from first_column on
 *   cells      local, [n][re, im][LANES]
 */
#include "nufft/halves.h"

static inline void load_cells(__local real *cells, __global const real *high,
                              __global const real *low, const real mean, const size_t columns,
                              const size_t first, const uint n) {
    for (uint m = get_local_id(0); m < n; m += get_local_size(0)) {
        const size_t at = m * columns + first;
        store_complex(
            cells, m,
            (complexv){load_global(high + at, 0) + load_global(low + at, 0) - (realv)mean,
                       load_global(high + at, 1) + load_global(low + at, 1) - (realv)mean});
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

__kernel void nufft_first(__global const real *restrict high, __global const real *restrict low,
                          __global const real *restrict mean, const ulong columns,
                          __global const uint *restrict radices,
                          __global const real *restrict twiddles,
                          __global const uint *restrict position,
                          __global const real *restrict gains, const uint n, const uint K,
                          const uint first_tile, const uint num_tiles, const ulong first_column,
                          const ulong all_columns, __global real *restrict rows,
                          __local real *cells) {
    const size_t first = get_global_id(1) * (size_t)(2 * LANES);
    const transform_axis axis = {radices, twiddles, position, gains, n, K};
    load_cells(cells, high, low, mean[0], columns, first, n);
    fft_transform(cells, 2 * LANES, n, radices, twiddles);
    for (uint tile = get_local_id(0); tile < num_tiles; tile += get_local_size(0)) {
        turn_halves(cells, 2 * LANES, axis, (first_tile + tile) * LANES,
                    rows + (tile * all_columns + first_column + first) * (2 * LANES));
    }
}
