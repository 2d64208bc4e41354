/* The transform along axis 0 of a grid of real numbers (nufft/boxes.cl). Launch: (work-items of one
 * group, groups of 2 LANES columns).
 *
 * Lanes are neighbouring columns here (nufft/transform/halves.h). The result is turned, so that
 * lanes are frequencies, as nufft/finish.cl wants it.
 *
 *   numbers    first_numbers of nufft/numbers.h
 *   high, low  [cell of axis 0][column], pairs, or high alone without PAIRS; some columns: cells of all other axes, a multiple of 2 LANES
 *   mean       taken off every cell: frequency 0
 *   radices, twiddles, position  of nufft/transform/finish.h; gains [K + 1]: 1 / squared transform of the window
 *   rows       [tile][column][re, im][LANES]: frequencies tile LANES + lane from first_tile on; what exceeds K is 0;
 *              all_columns of them, these from first_column on
 *   cells      local, [n][re, im][LANES]
 */
#include "nufft/transform/halves.h"
#include "nufft/numbers.h"

#ifndef PAIRS
#define PAIRS 1
#endif

static inline realv load_sum(__global const real *high, __global const real *low,
                             const size_t index) {
#if PAIRS
    return load_global(high, index) + load_global(low, index);
#else
    (void)low;
    return load_global(high, index);
#endif
}

static inline void load_cells(__local real *cells, __global const real *high,
                              __global const real *low, const real mean, const size_t columns,
                              const size_t first, const uint n) {
    for (uint m = get_local_id(0); m < n; m += get_local_size(0)) {
        const size_t at = m * columns + first;
        store_complex(cells, m,
                      (complexv){load_sum(high + at, low + at, 0) - (realv)mean,
                                 load_sum(high + at, low + at, 1) - (realv)mean});
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

__kernel void nufft_first(const first_numbers numbers, __global const real *restrict high,
                          __global const real *restrict low, __global const real *restrict mean,
                          __global const uint *restrict radices,
                          __global const real *restrict twiddles,
                          __global const uint *restrict position,
                          __global const real *restrict gains, __global real *restrict rows,
                          __local real *cells) {
    const uint n = numbers.transform.n, num_tiles = numbers.num_tiles;
    const ulong all_columns = numbers.all_columns;
    const size_t first = get_global_id(1) * (size_t)(2 * LANES);
    const transform_axis axis = {radices, twiddles, position, gains, n, numbers.transform.K};
    load_cells(cells, high, low, mean[0], numbers.columns, first, n);
    fft_transform(cells, 2 * LANES, n, radices, twiddles);
    for (uint tile = get_local_id(0); tile < num_tiles; tile += get_local_size(0)) {
        turn_halves(cells, 2 * LANES, axis, (numbers.first_tile + tile) * LANES,
                    rows + (tile * all_columns + numbers.first_column + first) * (2 * LANES));
    }
}
