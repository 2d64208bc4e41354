/* Tiles of a problem with one fast transform: LANES frequencies of axis 0 are summed directly,
 * those of the transform by spreading.
 * Launch: (work-items of one group, groups of tiles, realizations).
 *
 *   places, sorted, heights  of nufft/sort.cl
 *   numbers    tile_numbers of nufft/numbers.h
 *   coefficients  of nufft/window.h
 *   radices, twiddles, position, gains  of nufft/transform/finish.h
 *   means      [realization]: what frequency 0 leaves in a cell
 *   pattern    [n][cosine, sine]: and how it turns
 *   scales     [realization]
 *   power      [realization][stride]: frequency q of lane in slot ((tile (2K+1) + K + q) LANES + lane
 *   lines      [realization][n]: frequency 0 of axis 0, with LINE
 *   rows       local, [group][n + width + GAP][re, im][LANES]
 *   line_reals local, of nufft/line.h
 *   reals, along, cells  local, of a chunk: nufft/spread.h
 */
#include "nufft/transform/finish.h"
#include "nufft/line.h"

/* Kernels of the same program (docs/developer/decisions.md). */
#include "nufft/lines.cl"
#include "nufft/sort.cl"

__kernel void
nufft_tile(const tile_numbers numbers, __global const ulong *restrict places,
           __global const ulong *restrict sorted, __global const real *restrict heights,
           __global const real *restrict coefficients, __global const uint *restrict radices,
           __global const real *restrict twiddles, __global const uint *restrict position,
           __global const real *restrict gains, __global const real *restrict means,
           __global const real *restrict pattern, __global const real *restrict scales,
           __global real *restrict power, __global real *restrict lines, __local real *rows,
           __local real *line_reals, __local real *reals, __local ulong *along,
           __local uint *cells) {
    const uint num_tiles = numbers.num_tiles, group = numbers.group;
    const uint dimension = numbers.dimension, axis = numbers.along.axis;
    const uint n = numbers.along.window.n, K = numbers.K;
    const uint first_row = numbers.first_row;
    const uint first_tile = get_global_id(1) * group;
    const uint own_tiles = min(group, num_tiles - first_tile);
    const size_t realization = get_global_id(2);
    const window_axis window = make_window(coefficients, numbers.along);
    const transform_axis transform = {radices, twiddles, position, gains, n, K};
    const chunk chunk = make_chunk(reals, along, cells, window);
    const line line = make_line(line_reals, window, first_tile == 0);
    clear_line(line);
    clear_rows(rows, own_tiles * row_cells(window));
    for (size_t place = places[realization]; place < places[realization + 1]; place += CHUNK) {
        for (uint part = get_local_id(0); part < CHUNK / LANES; part += get_local_size(0)) {
            const size_t at = place + part * LANES;
            fill_places(chunk, part, load_coordinates(sorted + at * dimension, dimension, 0),
                        load_coordinates(sorted + at * dimension, dimension, axis),
                        load_global(heights + at, 0), window);
        }
        add_chunk(rows, chunk, window, numbers.base + first_tile * LANES, own_tiles);
        add_to_line(line, chunk, window);
    }
    write_line(line, window, means[realization], lines + (first_row + realization) * n);
    for (uint i = 0; i < own_tiles; i++) {
        __local real *row = rows + i * row_cells(window) * 2 * LANES;
        const size_t tile = first_tile + i;
        fold_row(row, window);
        if (tile == 0 && !line.is_own) {
            take_off_mean(row, means[realization], pattern, n);
        }
        write_powers(row, transform, scales[first_row + realization],
                     power + (first_row + realization) * numbers.stride +
                         tile * (2 * K + 1) * LANES);
    }
}
