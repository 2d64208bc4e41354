/* Sums of Gaussians of all points of a set (samplers/gaussian.h): one work-item has one point.
 * Launch: (points), rounded up at will.
 *
 *   points   [axis][stride], by cells, with room for a vector behind the last point
 *   begins   [cells^dimension + 1]
 *   sums     [1 + dimension][stride]
 */
#ifndef PRECISION
#define PRECISION 64 /* no other: the host has the same bits */
#endif
#ifndef DIMENSION
#define DIMENSION 2
#endif
#include "samplers/gaussian.h"

__kernel void gaussian_sums(const gaussian_grid grid, __global const real *restrict points,
                            __global const uint *restrict begins, __global real *restrict sums) {
    const size_t i = get_global_id(0);
    if (i >= grid.num_points) {
        return;
    }
    real own[GAUSSIAN_SUMS];
    gaussian_point(&grid, DIMENSION, points, begins, i, own);
    for (uint k = 0; k < 1 + DIMENSION; k++) {
        sums[k * grid.stride + i] = own[k];
    }
}
