/* Phases k x mod 1 in fixed point, x in units of 2^-64, k a whole number: of one point for the lanes of a
 * tile, of LANES points for one k. torus/phase.h has the reasons; off by at most 2 + 3 2^-24 k units of
 * 2^-32 turns in single precision, exact in double. Device only.
 */
#ifndef PS_NUFFT_PHASE_H
#define PS_NUFFT_PHASE_H

#include "shared/real.h"
#include "shared/turn.h"

typedef PS_VECTOR(ulong) ulongv;
#define TO_WORDV(x) PS_JOIN(convert_, PS_VECTOR(WORD))(x)

#if PRECISION == 64

static inline wordv phases_of_lanes(const wordv lanes, const ulong x) {
    return lanes * (wordv)x;
}

static inline wordv phases_of_points(const uint k, const ulongv x) {
    return x * (ulongv)k;
}

#else

#define TWO_TO_MINUS_32 2.3283064365386963e-10f

static inline wordv phases_of_lanes(const wordv lanes, const ulong x) {
    const realv low = TO_REALV(lanes) * (realv)((float)(word)x * TWO_TO_MINUS_32);
    return lanes * (wordv)(word)(x >> 32) + AS_WORDV(TO_SWORDV(low));
}

static inline wordv phases_of_points(const uint k, const ulongv x) {
    const realv low = TO_REALV(TO_WORDV(x)) * (realv)((float)k * TWO_TO_MINUS_32);
    return TO_WORDV(x >> (ulongv)32) * (wordv)k + AS_WORDV(TO_SWORDV(low));
}

#endif

#endif
