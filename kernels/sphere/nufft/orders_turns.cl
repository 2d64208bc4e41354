/* Directions as places on a torus. Launch: (vectors of LANES points), rounded up at will.
 *
 *   points     [num_points][3]: vectors of any length
 *   turns      [num_points, rounded up to LANES][2]
 *   shift      added to the angle from the pole: cells of the fine grid in front of it
 */
#include "sphere/turns.h"

__kernel void sphere_orders_turns(__global const double *restrict points,
                                  __global ulong *restrict turns, const ulong num_points,
                                  const ulong shift) {
    const size_t first = get_global_id(0) * LANES;
    if (first < num_points) {
        make_turns(points, turns, first, num_points, shift);
    }
}
