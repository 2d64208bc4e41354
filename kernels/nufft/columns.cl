/* Columns of the transformed rows (nufft/rows.cl) into powers. Launch: (work-items of one group,
 * tiles * columns, realizations).
 *
 *   numbers    powers_numbers of nufft/numbers.h
 *   grid       [realization][tile][column][row][re, im][LANES], columns -K .. K of the axis along rows
 *   radices, twiddles, position, gains  of nufft/transform/finish.h, of the axis across rows
 *   column_gains [column_K + 1], of the axis along rows
 *   scales     [realization]
 *   power      [realization][stride], there from first_power on [tile][column][2K + 1][LANES]
 *   column     local, [n][re, im][LANES]
 */
#include "nufft/transform/finish.h"
#include "nufft/numbers.h"

__kernel void
nufft_columns(const powers_numbers numbers, __global const real *restrict grid,
              __global const uint *restrict radices, __global const real *restrict twiddles,
              __global const uint *restrict position, __global const real *restrict gains,
              __global const real *restrict column_gains, __global const real *restrict scales,
              __global real *restrict power, __local real *column) {
    const uint n = numbers.transform.n, K = numbers.transform.K, column_K = numbers.column_K;
    const uint first_row = numbers.first_row;
    const size_t in_tiles = get_global_id(1);
    const size_t realization = get_global_id(2);
    const uint q = in_tiles % (2 * column_K + 1);
    const transform_axis transform = {radices, twiddles, position, gains, n, K};
    load_row(column, grid, realization * get_global_size(1) + in_tiles, n);
    write_powers(column, transform,
                 scales[first_row + realization] *
                     column_gains[q >= column_K ? q - column_K : column_K - q],
                 power + (first_row + realization) * numbers.stride + numbers.first_power +
                     in_tiles * (2 * K + 1) * LANES);
}
