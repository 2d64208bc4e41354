/* From rows of cells that are there (nufft/first.cl) to powers, or to the grid of nufft/columns.cl.
 * Launch: (work-items of one group, tiles * rows); one row where there is one transform left.
 *
 *   numbers    powers_numbers of nufft/numbers.h
 *   rows       [tile][row][n][re, im][LANES]
 *   radices, twiddles, position, gains, n, K  of nufft/transform/finish.h, of the axis along rows
 *   scales     [realization]
 *   power      [realization][stride], there from first_power on [tile][2K + 1][LANES]
 *   grid       [tile][column -K .. K][row][re, im][LANES]
 *   row        local, [n][re, im][LANES]
 */
#include "nufft/transform/finish.h"
#include "nufft/numbers.h"

__kernel void nufft_finish_tile(const powers_numbers numbers, __global const real *restrict rows,
                                __global const uint *restrict radices,
                                __global const real *restrict twiddles,
                                __global const uint *restrict position,
                                __global const real *restrict gains,
                                __global const real *restrict scales, __global real *restrict power,
                                __local real *row) {
    const uint n = numbers.transform.n, K = numbers.transform.K;
    const uint realization = numbers.first_row;
    const size_t tile = get_global_id(1);
    const transform_axis axis = {radices, twiddles, position, gains, n, K};
    load_row(row, rows, tile, n);
    write_powers(row, axis, scales[realization],
                 power + realization * numbers.stride + numbers.first_power +
                     tile * (2 * K + 1) * LANES);
}

__kernel void nufft_finish_rows(__global const real *restrict rows,
                                __global const uint *restrict radices,
                                __global const real *restrict twiddles,
                                __global const uint *restrict position,
                                __global real *restrict grid, const uint num_rows, const uint n,
                                const uint K, __local real *row) {
    const size_t index = get_global_id(1);
    const size_t tile = index / num_rows, m = index % num_rows;
    const transform_axis axis = {radices, twiddles, position, 0, n, K};
    load_row(row, rows, index, n);
    write_columns(row, axis, num_rows, grid + (tile * (2 * K + 1) * num_rows + m) * 2 * LANES);
}
