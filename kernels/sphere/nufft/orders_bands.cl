/* Sorted points of a large set spread on the fine grid, a band of longitudes by each work-group:
 * part by part, so that every cell adds the same numbers in the same order. Launch: (work-items of
 * one group, bands).
 *
 *   numbers    of numbers.h; their names are used here
 *   sorted, heights, starts  of orders_sort.cl, in parts of part_points
 *   window     of orders.cl
 *   grid       of sphere/bands.h, continued unless is_first
 *   windows, cells  local, of a chunk: nufft/chunk.h
 */
#include "sphere/bands.h"
#include "sphere/nufft/numbers.h"
#include "sphere/nufft/orders_grid.h"

__kernel void
sphere_orders_bands(const orders_bands_numbers numbers, __global const ulong *restrict sorted,
                    __global const real *restrict heights, __global const uint *restrict starts,
                    __global const real *restrict window, __global real *restrict grid,
                    __local real *windows, __local uint *cells) {
    const uint num_parts = numbers.num_parts, tiles = numbers.tiles, bands = numbers.bands;
    const uint band_rows = numbers.band_rows, pitch = numbers.pitch;
    const ulong part_points = numbers.part_points;
    const uint band = get_global_id(1);
    const window_axis across = make_chunk_window(window, numbers.window, 0);
    const window_axis along = make_chunk_window(window, numbers.window, 1);
    const chunk_axes axes = {across, along, 2};
    __global real *own = grid + band * (size_t)band_rows * pitch;
    const orders_grid to = {own, pitch, band_rows,
                            start_of_band(band, numbers.window.n, bands) * pitch};
    const chunk chunk = make_chunk(windows, cells, across, along);
    clear_cells(own, numbers.is_first ? (size_t)band_rows * pitch : 0);
    for (uint part = 0; part < num_parts; part++) {
        __global const uint *start =
            starts + part * ((size_t)bands * tiles + 1) + (size_t)band * tiles;
        const size_t end = part * part_points + start[tiles];
        spread_points(to, chunk, sorted, heights, part * part_points + start[0], end, axes);
    }
}
