/* Sums of w_i w_j |u_i - u_j|^(2 power) over pairs: kernels of Sobolev spaces
 * (docs/mathematics/quadrature.md#sobolev-kernel).
 *
 * One work-item owns a run of vectors of pairs. Launch: (runs, realizations) in work-groups of any
 * size, runs rounded up; no local memory. Equal points have the chord 0, exactly.
 *
 *   points, counts  as in pairs/sums.cl
 *   power           one number; not looked at with ROOT, which is for power 1/2
 *   partials        [realization][num_runs][high, low][LANES]
 */
#include "shared/real.h"
#include "shared/pair.h"
#include "shared/power.h"
#include "pairs/layout.h"

#ifndef ROOT
#define ROOT 0
#endif

__kernel void kernel_chords(__global const real *restrict points,
                            __global const ulong *restrict counts,
                            __global const real *restrict power, __global real *restrict partials,
                            const ulong stride, const ulong run_vectors, const ulong num_runs) {
    const ulong run = get_global_id(0);
    const size_t realization = get_global_id(1);
    if (run >= num_runs) {
        return;
    }
    const ulong num_points = counts[realization];
    const ulong begin = run * run_vectors;
    const ulong end = min(begin + run_vectors, pair_vectors(num_points));
    const realv exponent = (realv)power[0];
    realv high = (realv)0, low = (realv)0;
    if (begin < end) {
        pair_place at;
        pair_begin(&at, points + realization * POINT_ARRAYS * stride, stride, num_points, begin);
        for (ulong v = begin; v < end; v++) {
            const realv square = square_of_pair(&at, (realv)1);
            const realv value = ROOT ? sqrt(square) : power_of(square, exponent);
            pair_add(&high, &low, weight_of_pair(&at) * value);
            pair_next(&at);
        }
    }
    __global real *to = partials + (realization * num_runs + run) * 2 * LANES;
    store_global(to, 0, high);
    store_global(to, 1, low);
}
