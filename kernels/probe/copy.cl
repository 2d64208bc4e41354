/* The device's bandwidth: LANES numbers from one buffer to another by each work-item. Launch: (num
 * / LANES).
 *
 *   from, to   [num], num a multiple of LANES
 */
#include "shared/real.h"

__kernel void probe_copy(__global const real *restrict from, __global real *restrict to) {
    const size_t i = get_global_id(0);
    STOREV(LOADV(i, from), i, to);
}
