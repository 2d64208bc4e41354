/* The program of sphere_nufft on GPUs, but for what it has of other engines.
 *
 * From c_lm of degrees.cl to sum_m |c_lm|^2, in double precision: of the orders of a group, which
 * are its number modulo the number of groups, as orders_sum.cl leaves them for orders_ends.cl.
 * Launch: (degrees, rounded up at will, groups, realizations); with KEEP (degrees, orders, 1).
 *
 *   sums    [realization][order][degree from the order on][re, im] of degrees.cl
 *   powers  [group][realization][even, odd degrees][half_pitch]; with KEEP coefficients of the first realization,
 *           [order][even, odd l - m][re, im][half_pitch]
 *   step    2: even degrees only
 */
#include "shared/real.h"
#include "sphere/nufft/degrees.h"
#include "sphere/nufft/orders_ends.cl"

#pragma OPENCL EXTENSION cl_khr_fp64 : enable

#ifndef KEEP
#define KEEP 0
#endif

__kernel void sphere_degree_powers(__global const real *restrict sums, const uint L,
                                   const uint step, const uint half_pitch,
                                   __global double *restrict powers) {
    const uint l = get_global_id(0) * step, set = get_global_id(2);
    const size_t set_apart = 2 * (size_t)coefficients_of(L, L + 1);
    __global const real *const own = sums + set * set_apart;
    if (l > L) {
        return;
    }
#if KEEP
    const uint m = get_global_id(1);
    if (m <= l) {
        __global const real *const c = own + 2 * ((size_t)coefficients_of(L, m) + l - m);
        __global double *const to =
            powers + ((size_t)m * 2 + (l - m) % 2) * 2 * half_pitch + (l - m) / 2;
        to[0] = c[0];
        to[half_pitch] = c[1];
    }
#else
    const uint group = get_global_id(1), groups = get_global_size(1);
    const size_t row = ((size_t)group * get_global_size(2) + set) * 2 * half_pitch;
    double sum = 0;
    for (uint m = group; m <= l; m += groups) {
        __global const real *const c = own + 2 * ((size_t)coefficients_of(L, m) + l - m);
        const double re = c[0], im = c[1];
        sum = fma(fma(re, re, im * im), m == 0 ? 1.0 : 2.0, sum);
    }
    if (group <= l) {
        powers[row + l % 2 * half_pitch + l / 2] = sum;
    }
#endif
}
