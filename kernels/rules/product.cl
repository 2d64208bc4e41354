/* Products of a matrix of distances with a vector: sum_j x_j |u_i - u_j|^(2 power) for all i, the
 * kernel of a Sobolev space but for its constant (docs/mathematics/quadrature.md#sobolev-kernel,
 * docs/mathematics/quadrature.md#optimal-weights). Nothing of the matrix is kept.
 *
 * One work-item owns LANES points i and a segment of points j, BLOCK of which are added up before
 * they join the sum in two parts: the same sums whatever the work-groups. Launch: (vectors of
 * points i, segments, sets) in work-groups of any size, the vectors rounded up; no local memory.
 * Equal points have the distance 0, exactly.
 *
 *   points    [set][3][stride]: coordinates, any numbers beyond the points; stride is a multiple of LANES and of BLOCK
 *   x         [set][stride]; 0 beyond the points
 *   power     one number; not looked at with ROOT, which is for power 1/2
 *   partials  [set][segment][high, low][stride]
 *   segment   points j of a segment, a multiple of BLOCK
 */
#include "shared/real.h"
#include "shared/lanes.h"
#include "shared/pair.h"
#include "shared/power.h"

#ifndef ROOT
#define ROOT 0
#endif
#ifndef BLOCK
#define BLOCK 8
#endif

__kernel void kernel_product(__global const real *restrict all_points,
                             __global const real *restrict all_x,
                             __global const real *restrict power, __global real *restrict partials,
                             const ulong stride, const ulong segment) {
    const ulong vector = get_global_id(0);
    const size_t index = get_global_id(1), set = get_global_id(2);
    __global const real *const points = all_points + set * 3 * stride;
    __global const real *const x = all_x + set * stride;
    if (vector * LANES >= stride) {
        return;
    }
    const realv exponent = (realv)power[0];
    const realv u0 = load_global(points, vector);
    const realv u1 = load_global(points + stride, vector);
    const realv u2 = load_global(points + 2 * stride, vector);
    const ulong begin = index * segment;
    const ulong end = min(begin + segment, stride);
    realv high = (realv)0, low = (realv)0;
    for (ulong j = begin; j < end; j += BLOCK) {
        realv sum = (realv)0;
        for (uint k = 0; k < BLOCK; k++) {
            const realv d0 = u0 - (realv)points[j + k];
            const realv d1 = u1 - (realv)points[stride + j + k];
            const realv d2 = u2 - (realv)points[2 * stride + j + k];
            const realv square = fma(d2, d2, fma(d1, d1, d0 * d0));
            sum = fma((realv)x[j + k], (ROOT ? sqrt(square) : power_of(square, exponent)), sum);
        }
        pair_add(&high, &low, sum);
    }
    __global real *to = partials + (set * get_global_size(1) + index) * 2 * stride;
    store_global(to, vector, high);
    store_global(to + stride, vector, low);
}
