/* Phases k.x mod 1 in fixed point, for one point and LANES frequencies, over the axes begin .. end
 * - 1.
 *
 * A coordinate is X = round(x 2^64). Double: k X wraps mod 2^64 and is exact. Float: the top 32
 * bits of k X are wanted. With X = high 2^32 + low they are k high, which wraps and is exact, plus
 * the integer part of k low / 2^32; that part is below |k| and only needs to be right to a few
 * units (2^-32 turns each), so a float product is enough while the sum of |k| over the axes is
 * below 2^31: the phase is off by at most 2 + (2 + d) 2^-24 sum |k| units.
 */
#ifndef PS_TORUS_PHASE_H
#define PS_TORUS_PHASE_H

#include "shared/real.h"
#include "torus/layout.h"

#if PRECISION == 64
static inline wordv phase_of_point(const wordv *k, const realv *k_real, __global const ulong *x,
                                   const int begin, const int end) {
    (void)k_real;
    wordv turn = k[begin] * (wordv)x[begin];
    for (int axis = begin + 1; axis < end; axis++) {
        turn += k[axis] * (wordv)x[axis];
    }
    return turn;
}
#else
static inline wordv phase_of_point(const wordv *k, const realv *k_real, __global const ulong *x,
                                   const int begin, const int end) {
    const float two_to_minus_32 = 2.3283064365386963e-10f;
    wordv turn = k[begin] * (wordv)(word)(x[begin] >> 32);
    realv low = k_real[begin] * (realv)((float)(word)x[begin] * two_to_minus_32);
    for (int axis = begin + 1; axis < end; axis++) {
        turn += k[axis] * (wordv)(word)(x[axis] >> 32);
        low = fma(k_real[axis], (realv)((float)(word)x[axis] * two_to_minus_32), low);
    }
    return turn + AS_WORDV(TO_SWORDV(low));
}
#endif

#endif
