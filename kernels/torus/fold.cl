/* Adds the chunk sums of torus/list.cl up, in the order of the chunks, whatever the slabs were.
 *
 * One work-item owns one tile of one realization. Launch: (tiles, realizations), tiles
 * rounded up at will.
 *
 *   sums    [row][chunk][tile][cos high, cos low, sin high, sin low][LANES]
 *   totals  [row][tile][the same four][LANES]; begun anew when is_first is set
 */
#include "shared/real.h"
#include "shared/lanes.h"
#include "shared/pair.h"

__kernel void torus_fold(__global const real *restrict sums, __global real *restrict totals,
                         const ulong first_row, const ulong num_tiles, const uint num_chunks,
                         const uint is_first) {
    const size_t tile = get_global_id(0);
    const size_t row = first_row + get_global_id(1);
    if (tile >= num_tiles) {
        return;
    }
    __global real *total = totals + (row * num_tiles + tile) * 4 * LANES;
    for (int part = 0; part < 4; part += 2) {
        realv high = is_first ? (realv)0 : load_global(total, part);
        realv low = is_first ? (realv)0 : load_global(total, part + 1);
        for (uint chunk = 0; chunk < num_chunks; chunk++) {
            __global const real *sum =
                sums + ((row * num_chunks + chunk) * num_tiles + tile) * 4 * LANES;
            pair_add(&high, &low, load_global(sum, part));
            low += load_global(sum, part + 1);
        }
        store_global(total, part, high);
        store_global(total, part + 1, low);
    }
}
