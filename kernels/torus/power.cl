/* Powers |S|^2 from finished sums of lists: the last pass of torus_direct.
 *
 * power is [row][stride], one row per realization; the kernel fills slots first_slot .. of it.
 * scales[row] turns |S|^2 into the normalization asked for.
 */
#include "shared/real.h"
#include "shared/lanes.h"

/* Totals of torus/fold.cl. Launch: (tiles, realizations), tiles rounded up at will. */
__kernel void torus_power_list(__global const real *restrict totals,
                               __global const real *restrict scales, __global real *restrict power,
                               const ulong num_tiles, const ulong first_slot, const ulong stride) {
    const size_t tile = get_global_id(0);
    const size_t realization = get_global_id(1);
    if (tile >= num_tiles) {
        return;
    }
    __global const real *total = totals + (realization * num_tiles + tile) * 4 * LANES;
    const realv re = load_global(total, 0) + load_global(total, 1);
    const realv im = load_global(total, 2) + load_global(total, 3);
    STOREV(fma(re, re, im * im) * (realv)scales[realization], tile,
           power + realization * stride + first_slot);
}
