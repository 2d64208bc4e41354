/* Rows of a tile of a problem with two fast transforms: what touches a row of cells is spread along it and
 * transformed; 2K + 1 columns are kept. Launch: (work-items of one group, tiles * rows, realizations).
 *
 *   places, starts, along, phases  of nufft/sort.cl and nufft/place.cl, sorted by rows; a part for each
 *              realization, or ...
 *   sums, low  ... [tile][row][n + width + GAP][re, im][LANES], if has_sums: of nufft/add.cl
 *   row_cells, row_windows  [place]: of the axis across rows
 *   cells, windows          [place]: of the axis along rows
 *   means      [realization]: what frequency 0 leaves in a cell
 *   pattern    [row][cosine, sine]: and how it turns from row to row
 *   grid       [realization][tile][column -K .. K][row][re, im][LANES]
 *   row        local, [n + width + GAP][re, im][LANES]
 */
#include "nufft/finish.h"
#include "nufft/spread.h"

__kernel void
nufft_rows(__global const ulong *restrict places, __global const uint *restrict starts,
           __global const uint *restrict row_cells, __global const real *restrict row_windows,
           __global const uint *restrict cells, __global const real *restrict windows,
           __global const ulong *restrict along, __global const real *restrict phases,
           __global const real *restrict sums, __global const real *restrict low,
           const uint has_sums, __global const uint *restrict radices,
           __global const real *restrict twiddles, __global const uint *restrict position,
           __global const real *restrict means, __global const real *restrict pattern,
           __global real *restrict grid, const uint base, const uint num_rows, const uint row_width,
           const uint row_pitch, const uint n, const uint width, const uint pitch, const uint K,
           const uint num_tiles, __local real *row) {
    const uint tile = get_global_id(1) / num_rows, m = get_global_id(1) % num_rows;
    const size_t realization = get_global_id(2);
    const row_axis axis = {cells, windows, n, width, pitch};
    const transform_axis transform = {radices, twiddles, position, 0, n, K};
    if (has_sums) {
        load_sums(row, axis, sums, low, get_global_id(1));
    } else {
        const tile_values values = {along, phases, base + tile * LANES};
        const sorted_rows rows = {starts + realization * (num_rows + 2),
                                  row_cells,
                                  row_windows,
                                  num_rows,
                                  row_width,
                                  row_pitch};
        clear_row(row, axis);
        add_touching(row, axis, values, rows, m, places[realization]);
    }
    fold_row(row, axis);
    if (tile == 0) {
        const real mean = means[realization];
        for (uint i = get_local_id(0); i < n; i += get_local_size(0)) {
            row[i * 2 * LANES] -= mean * pattern[2 * m];
            row[(i * 2 + 1) * LANES] -= mean * pattern[2 * m + 1];
        }
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    fft_transform(row, n, radices, twiddles);
    __global real *out =
        grid + ((realization * num_tiles + tile) * (2 * K + 1) * num_rows + m) * 2 * LANES;
    for (uint i = get_local_id(0); i < 2 * K + 1; i += get_local_size(0)) {
        store_global(out, (size_t)i * num_rows, kept_frequency(row, transform, i));
    }
}
