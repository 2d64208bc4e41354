/* The first pass and the last, which all ways of sphere_nufft and sphere_grid have.
 */
#include "sphere/turns.h"

/* Directions as places on a torus. Launch: (vectors of LANES points), rounded up at will.
 *
 *   points     [num_points][3]: vectors of any length
 *   turns      [num_points, rounded up to LANES][2]
 *   shift      added to the angle from the pole: cells of the fine grid in front of it
 */
__kernel void sphere_orders_turns(__global const double *restrict points,
                                  __global ulong *restrict turns, const ulong num_points,
                                  const ulong shift) {
    const size_t first = get_global_id(0) * LANES;
    if (first < num_points) {
        make_turns(points, turns, first, num_points, shift);
    }
}

/* powers [group][..] of all groups into those of the first: num of each, LANES degrees of one
 * parity at a time. Degree l has orders, and powers, of groups up to l. Launch: (num / LANES),
 * rounded up at will; half_pitch is a multiple of LANES. */
__kernel void sphere_orders_fold(__global double *restrict powers, const uint groups,
                                 const ulong num, const uint half_pitch) {
    const size_t i = get_global_id(0) * LANES;
    if (i >= num) {
        return;
    }
    const size_t degree = i % half_pitch * 2 + i / half_pitch % 2;
    __global unaligned_doublev *to = (__global unaligned_doublev *)(powers + i);
    if (degree + 1 < groups) { /* the first LANES degrees have more groups from one to the next */
        for (uint lane = 0; lane < LANES; lane++) {
            const uint end = (uint)min((size_t)groups, degree + 2 * lane + 1);
            for (uint group = 1; group < end; group++) {
                powers[i + lane] += powers[group * num + i + lane];
            }
        }
        return;
    }
    doublev sum = *to;
    for (uint group = 1; group < groups; group++) {
        sum += *(__global const unaligned_doublev *)(powers + group * num + i);
    }
    *to = sum;
}
