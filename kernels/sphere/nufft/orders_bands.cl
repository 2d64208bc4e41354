/* Sorted points of a large set spread on the fine grid, a band of longitudes by each work-group:
 * tile by tile, and within one part by part, so that every cell adds the same numbers in the same
 * order. A part has some ten points in a tile, all parts together so many that the cells stay in
 * the nearest cache meanwhile: they are brought together first. Launch: (1, bands) in
 * work-groups of one item.
 *
 *   numbers    of numbers.h; their names are used here
 *   sorted, heights, starts  of orders_sort.cl, in parts of part_points
 *   window     of orders.cl
 *   grid       of sphere/bands.h, continued unless is_first
 *   staged, staged_heights  [band][STAGED_POINTS][2], [band][STAGED_POINTS]: scratch
 *   windows, cells  local, of a chunk: nufft/chunk.h
 */
#define ALONE 1 /* CPUs alone have this kernel */
#include "sphere/bands.h"
#include "sphere/nufft/numbers.h"
#include "sphere/nufft/orders_grid.h"

/* Points of a tile on their way to the grid. */
typedef struct staged_points {
    __global ulong *turns;
    __global real *heights;
    uint num;
} staged_points;

static inline void stage_points(const staged_points to, __global const ulong *turns,
                                __global const real *heights, const size_t from, const uint num,
                                const bool has_weights) {
    for (uint i = 0; i < num; i++) {
        to.turns[2 * (to.num + i)] = turns[2 * (from + i)];
        to.turns[2 * (to.num + i) + 1] = turns[2 * (from + i) + 1];
        to.heights[to.num + i] = has_weights ? heights[from + i] : (real)1;
    }
}

static inline void spread_staged(staged_points *from, const orders_grid to, const chunk chunk,
                                 const chunk_axes axes) {
    spread_points(to, chunk, from->turns, from->heights, 0, from->num, axes);
    from->num = 0;
}

__kernel void
sphere_orders_bands(const orders_bands_numbers numbers, __global const ulong *restrict sorted,
                    __global const real *restrict heights, __global const uint *restrict starts,
                    __global const real *restrict window, __global real *restrict grid,
                    __global ulong *restrict staged, __global real *restrict staged_heights,
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
    staged_points points = {staged + band * (size_t)STAGED_POINTS * 2,
                            staged_heights + band * (size_t)STAGED_POINTS, 0};
    clear_cells(own, numbers.is_first ? (size_t)band_rows * pitch : 0);
    for (uint tile = 0; tile < tiles; tile++) {
        for (uint part = 0; part < num_parts; part++) {
            __global const uint *start =
                starts + part * ((size_t)bands * tiles + 1) + (size_t)band * tiles + tile;
            const size_t end = part * part_points + start[1];
            for (size_t from = part * part_points + start[0]; from < end;) {
                const uint num = (uint)min(end - from, (size_t)(STAGED_POINTS - points.num));
                stage_points(points, sorted, heights, from, num, numbers.has_weights != 0);
                points.num += num;
                from += num;
                if (points.num == STAGED_POINTS) {
                    spread_staged(&points, to, chunk, axes);
                }
            }
        }
    }
    spread_staged(&points, to, chunk, axes);
}
