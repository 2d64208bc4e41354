/* Rows of tiles of a problem with two fast transforms: what touches a row of cells is spread along
 * it and transformed; 2K + 1 columns are kept. Launch: (work-items of one group, groups of tiles *
 * rows, realizations).
 *
 *   places, sorted, heights, starts  of nufft/sort.cl, sorted by rows and by cells along them
 *   numbers    rows_numbers of nufft/numbers.h
 *   row_coefficients, coefficients  of nufft/window.h, of the axis across rows and along them
 *   radices, twiddles, position  of nufft/transform/finish.h, of the axis along rows
 *   means      [realization]: what frequency 0 leaves in a cell
 *   grid       [realization][tile][column -K .. K][row][re, im][LANES]
 *   lines      [realization][row][n]: frequency 0 of axis 0, with LINE
 *   rows       local, [group][n + width + GAP][re, im][LANES]
 *   line_reals local, of nufft/line.h
 *   reals, along, cells  local, of a chunk: nufft/spread.h
 */
#include "nufft/transform/finish.h"
#include "nufft/line.h"

#define DIMENSION 3 /* two axes are transformed */

/* Kernels of the same program (docs/developer/decisions.md). */
#include "nufft/columns.cl"
#include "nufft/lines.cl"
#include "nufft/sort.cl"

/* LANES places from `place` on, nothing where the list has ended. */
static inline void fill_touching(const chunk to, const uint part, __global const ulong *sorted,
                                 __global const real *heights, const size_t place, const size_t end,
                                 const window_axis axis, const window_axis across, const uint bin) {
    const size_t first = min(place, end - 1);
    const uint num = (uint)min(end - first, (size_t)LANES);
    __global const ulong *x = sorted + first * DIMENSION;
    real weights[LANES];
    for (uint i = 0; i < LANES; i++) {
        weights[i] = place + i < end ? heights[place + i] : 0;
    }
    wordv fractions;
    first_cells((ulongv)across.factor * load_some_coordinates(x, DIMENSION, across.axis, num),
                across.n, across.width, &fractions);
    fill_places(to, part, load_some_coordinates(x, DIMENSION, 0, num),
                load_some_coordinates(x, DIMENSION, axis.axis, num),
                LOADV(0, weights) * window_bin_of_points(across, centred_fractions(fractions), bin),
                axis);
}

/* Places begin .. end, in the order of cells, whose windows touch the row with `bin`. */
static inline void add_places(__local real *rows, const line line, const chunk to,
                              __global const ulong *sorted, __global const real *heights,
                              const size_t begin, const size_t end, const window_axis axis,
                              const window_axis across, const uint bin, const uint k,
                              const uint num_tiles) {
    for (size_t place = begin; place < end; place += CHUNK) {
        for (uint part = get_local_id(0); part < CHUNK / LANES; part += get_local_size(0)) {
            fill_touching(to, part, sorted, heights, place + part * LANES, end, axis, across, bin);
        }
        add_chunk(rows, to, axis, k, num_tiles);
        add_to_line(line, to, axis);
    }
}

__kernel void
nufft_rows(const rows_numbers numbers, __global const ulong *restrict places,
           __global const ulong *restrict sorted, __global const real *restrict heights,
           __global const uint *restrict starts, __global const real *restrict row_coefficients,
           __global const real *restrict coefficients, __global const uint *restrict radices,
           __global const real *restrict twiddles, __global const uint *restrict position,
           __global const real *restrict means, __global real *restrict grid,
           __global real *restrict lines, __local real *rows, __local real *line_reals,
           __local real *reals, __local ulong *along, __local uint *cells) {
    const uint num_rows = numbers.across.window.n, n = numbers.along.window.n;
    const uint num_tiles = numbers.num_tiles, group = numbers.group, K = numbers.K;
    const uint m = get_global_id(1) % num_rows;
    const uint first_tile = get_global_id(1) / num_rows * group;
    const uint own_tiles = min(group, num_tiles - first_tile);
    const size_t realization = get_global_id(2), first = places[realization];
    const window_axis window = make_window(coefficients, numbers.along);
    const window_axis across = make_window(row_coefficients, numbers.across);
    const transform_axis transform = {radices, twiddles, position, 0, n, K};
    const chunk chunk = make_chunk(reals, along, cells, window);
    __global const uint *start = starts + realization * ((size_t)num_rows * n + 2);
    const line line = make_line(line_reals, window, first_tile == 0);
    clear_line(line);
    clear_rows(rows, own_tiles * row_cells(window));
    for (uint bin = 0; bin < across.width; bin++) {
        const uint begun = m >= bin ? m - bin : num_rows + m - bin;
        add_places(rows, line, chunk, sorted, heights, first + start[begun * n],
                   first + start[(begun + 1) * n], window, across, bin,
                   numbers.base + first_tile * LANES, own_tiles);
    }
    write_line(line, window, means[realization],
               lines + ((numbers.first_row + realization) * num_rows + m) * n);
    for (uint t = 0; t < own_tiles; t++) {
        __local real *row = rows + t * row_cells(window) * 2 * LANES;
        const size_t tile = first_tile + t;
        fold_row(row, window);
        for (uint i = get_local_id(0); tile == 0 && !line.is_own && i < n; i += get_local_size(0)) {
            row[i * 2 * LANES] -= means[realization];
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        const size_t from = (realization * num_tiles + tile) * (2 * K + 1) * num_rows + m;
        write_columns(row, transform, num_rows, grid + from * 2 * LANES);
    }
}
