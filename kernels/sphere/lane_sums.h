/* Sums over the lanes of several vectors at once. Nothing of it in C11.
 *
 * Adding the even and the odd half of two vectors interleaved halves their number and keeps both sums: after
 * log2(LANES) rounds one vector has the sum of a vector in each lane, in their order.
 */
#ifndef PS_SPHERE_LANE_SUMS_H
#define PS_SPHERE_LANE_SUMS_H

#include "shared/transpose.h"

#ifdef __OPENCL_C_VERSION__

/* totals[i] = sum of the lanes of v[i] for i < num, a multiple of LANES; v is used up. */
static inline __attribute__((always_inline)) void sum_lanes(realv *v, const int num,
                                                            real *totals) {
#pragma unroll
    for (int group = 0; group < num; group += LANES) {
#if LANES > 1
#pragma unroll
        for (int apart = LANES / 2; apart > 0; apart /= 2) {
#pragma unroll
            for (int i = 0; i < apart; i++) {
                const realv a = v[group + i], b = v[group + i + apart];
                v[group + i] = INTERLEAVE_LOW(a, b) + INTERLEAVE_HIGH(a, b);
            }
        }
#endif
        STOREV(v[group], 0, totals + group);
    }
}

#endif

#endif
