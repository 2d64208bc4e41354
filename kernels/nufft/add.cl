/* Parts of one large set added to the rows of its fine grid. Launch: (work-items of one group, tiles * rows);
 * one row where there is one transform.
 *
 *   places, starts, along, phases  of nufft/sort.cl and nufft/place.cl, parts first_part .. end_part
 *   row_cells, row_windows         as in nufft/rows.cl; num_rows 1: not read
 *   cells, windows                 of the axis along rows
 *   sums, low   [tile][row][n + width + GAP][re, im][LANES]: pairs of numbers, continued
 *   parts_at_once  parts added up in working precision before a pair takes the sum
 *   row         local, [n + width + GAP][re, im][LANES]
 */
#include "nufft/spread.h"
#include "shared/pair.h"

static inline void add_to_sums(__local const real *row, __global real *sums, __global real *low,
                               const uint count) {
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint i = get_local_id(0); i < count; i += get_local_size(0)) {
        realv high = LOADV(i, sums), rest = LOADV(i, low);
        pair_add(&high, &rest, LOADV(i, row));
        STOREV(high, i, sums);
        STOREV(rest, i, low);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

__kernel void nufft_add(__global const ulong *restrict places, __global const uint *restrict starts,
                        __global const uint *restrict row_cells,
                        __global const real *restrict row_windows,
                        __global const uint *restrict cells, __global const real *restrict windows,
                        __global const ulong *restrict along, __global const real *restrict phases,
                        __global real *restrict sums, __global real *restrict low,
                        const uint num_parts, const uint parts_at_once, const uint base,
                        const uint num_rows, const uint row_width, const uint row_pitch,
                        const uint n, const uint width, const uint pitch, const uint gap,
                        __local real *row) {
    const uint tile = get_global_id(1) / num_rows, m = get_global_id(1) % num_rows;
    const row_axis axis = {cells, windows, n, width, pitch};
    const tile_values values = {along, phases, base + tile * LANES};
    const size_t cells_of_row = n + width + GAP;
    const size_t own = get_global_id(1) * cells_of_row * 2 * LANES;
    for (uint first = 0; first < num_parts; first += parts_at_once) {
        clear_row(row, axis);
        for (uint part = first; part < min(first + parts_at_once, num_parts); part++) {
            if (num_rows == 1) {
                add_sorted(row, axis, values, gap, places[part], places[part + 1],
                           starts + part * (n + 2));
            } else {
                const sorted_rows rows = {starts + part * (num_rows + 2),
                                          row_cells,
                                          row_windows,
                                          num_rows,
                                          row_width,
                                          row_pitch};
                add_touching(row, axis, values, rows, m, places[part]);
            }
        }
        add_to_sums(row, sums + own, low + own, 2 * cells_of_row);
    }
}
