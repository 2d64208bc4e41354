/* Points of a large set in the order of bands of longitudes, within them of tiles of angles from
 * the pole: a counting sort, stable, of each part by one work-item, as CPUs want it. Launch:
 * (parts), rounded up at will.
 *
 *   numbers          of numbers.h; their names are used here
 *   points, weights  [first_point + num_points][3], [num_points]
 *   turns            [num_points, rounded up to LANES][2]: scratch
 *   keys             [num_points, rounded up to LANES]: scratch
 *   sorted, heights  [num_points][2] of sphere/turns.h, [num_points]: as long as the points; heights are left alone
 *                    without weights (has_weights 0)
 *   starts           [part][bands tiles + 1]: from the beginning of the part
 */
#include "sphere/bands.h"
#include "sphere/nufft/numbers.h"
#include "sphere/turns.h"

#define TO_UINTV(x) PS_JOIN(convert_, PS_VECTOR(uint))(x)

/* The bands of sphere/bands.h, cell bands / n: a half of a cell is far more than rounding, and a
 * division of integers for each point took a sixth of the time. */
static inline uintv bands_of_cells(const uintv cells, const uint n, const uint bands) {
    const doublev places = fma(TO_DOUBLEV(cells), (doublev)(double)bands, (doublev)0.5);
    return TO_UINTV(places * (doublev)(1 / (double)n));
}

/* Makes the keys of points first .. first + LANES - 1; there is room for all. */
static inline void make_keys(__global const ulong *turns, __global uint *keys, const size_t first,
                             const uint n, const uint width, const uint bands, const uint tiles) {
    wordv fraction;
    const uintv rows = first_cells(load_coordinates(turns + first * 2, 2, 0), n, width, &fraction);
    const uintv columns =
        first_cells(load_coordinates(turns + first * 2, 2, 1), n, width, &fraction);
    const uintv own = min(columns / (uintv)TILE_CELLS, (uintv)(tiles - 1));
    *(__global unaligned_uintv *)(keys + first) =
        bands_of_cells(rows, n, bands) * (uintv)tiles + own;
}

__kernel void sphere_orders_sort(const orders_sort_numbers numbers,
                                 __global const double *restrict points,
                                 __global const real *restrict weights,
                                 __global ulong *restrict turns, __global uint *restrict keys,
                                 __global ulong *restrict sorted, __global real *restrict heights,
                                 __global uint *restrict starts) {
    const ulong num_points = numbers.num_points, part_points = numbers.part_points;
    const uint bands = numbers.bands, tiles = numbers.tiles, has_weights = numbers.has_weights;
    const size_t part = get_global_id(0), begin = part * part_points;
    const uint num_keys = bands * tiles;
    if (begin >= num_points) {
        return;
    }
    const size_t end = min(begin + part_points, (size_t)num_points);
    __global uint *start = starts + part * ((size_t)num_keys + 1);
    for (uint key = 0; key <= num_keys; key++) {
        start[key] = 0;
    }
    for (size_t first = begin; first < end; first += LANES) {
        const uint num = (uint)min((size_t)LANES, end - first);
        make_turns(points + 3 * numbers.first_point, turns, first, num_points, numbers.shift);
        make_keys(turns, keys, first, numbers.n, numbers.width, bands, tiles);
        for (uint i = 0; i < num; i++) {
            start[keys[first + i]]++;
        }
    }
    for (uint key = 1; key < num_keys; key++) { /* to the end of each, ... */
        start[key] += start[key - 1];
    }
    start[num_keys] = (uint)(end - begin);
    for (size_t i = end; i-- > begin;) { /* ... from which it goes back to its beginning */
        const size_t place = begin + --start[keys[i]];
        sorted[place * 2] = turns[i * 2];
        sorted[place * 2 + 1] = turns[i * 2 + 1];
        if (has_weights) {
            heights[place] = weights[i];
        }
    }
}
