/* Adds the forces of all blocks on every point, in their order (samplers/step_forces.cl). Launch:
 * (points), rounded up at will.
 *
 *   forces  [num_blocks][axis][stride]
 *   sums    [axis][stride]
 */
#include "samplers/step.h"

__kernel void step_fold(const step_layout layout, __global const double *restrict forces,
                        __global double *restrict sums) {
    const size_t i = get_global_id(0);
    if (i >= layout.num_points) {
        return;
    }
    double x = 0;
    double y = 0;
    for (uint block = 0; block < layout.num_blocks; block++) {
        __global const double *from = forces + (size_t)block * 2 * layout.stride;
        x += from[i];
        y += from[layout.stride + i];
    }
    sums[i] = x;
    sums[layout.stride + i] = y;
}
