/* One tile of a problem with one fast transform: LANES frequencies of axis 0 by direct phases, those of the
 * transform by spreading. Launch: (work-items of one group, tiles, realizations).
 *
 *   places, starts, cells, windows, along, phases  of nufft/sort.cl and nufft/place.cl, a part for each
 *              realization, or ...
 *   sums, low  ... [tile][n + width + GAP][re, im][LANES], if has_sums: of nufft/add.cl
 *   radices, twiddles, position, gains  of nufft/finish.h
 *   means      [realization]: what frequency 0 leaves in a cell
 *   pattern    [n][cosine, sine]: and how it turns
 *   scales     [realization]
 *   power      [realization][stride]: frequency q of lane in slot ((tile (2K+1) + K + q) LANES + lane
 *   base       the first frequency of tile 0
 *   row        local, [n + width + GAP][re, im][LANES]
 */
#include "nufft/finish.h"
#include "nufft/spread.h"

__kernel void
nufft_tile(__global const ulong *restrict places, __global const uint *restrict starts,
           __global const uint *restrict cells, __global const real *restrict windows,
           __global const ulong *restrict along, __global const real *restrict phases,
           __global const real *restrict sums, __global const real *restrict low,
           const uint has_sums, __global const uint *restrict radices,
           __global const real *restrict twiddles, __global const uint *restrict position,
           __global const real *restrict gains, __global const real *restrict means,
           __global const real *restrict pattern, __global const real *restrict scales,
           __global real *restrict power, const uint first_row, const ulong stride, const uint base,
           const uint n, const uint width, const uint pitch, const uint gap, const uint K,
           __local real *row) {
    const uint tile = get_global_id(1);
    const size_t realization = get_global_id(2);
    const row_axis axis = {cells, windows, n, width, pitch};
    const transform_axis transform = {radices, twiddles, position, gains, n, K};
    if (has_sums) {
        load_sums(row, axis, sums, low, tile);
    } else {
        const tile_values values = {along, phases, base + tile * LANES};
        clear_row(row, axis);
        add_sorted(row, axis, values, gap, places[realization], places[realization + 1],
                   starts + realization * (n + 2));
    }
    fold_row(row, axis);
    if (tile == 0) {
        take_off_mean(row, means[realization], pattern, n);
    }
    write_powers(row, transform, scales[first_row + realization],
                 power + (first_row + realization) * stride + (size_t)tile * (2 * K + 1) * LANES);
}
