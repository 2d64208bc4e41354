/* Differences of coordinates of the torus, to the nearest image. */
#ifndef PS_INTEGRANDS_FOLD_H
#define PS_INTEGRANDS_FOLD_H

#include "shared/real.h"

/* Before a loop over axes. PoCL 3.1 unrolls none by itself, and coordinates are in memory then
 * (bench_integrands: a disk took 1.3 times as long). */
#ifdef __OPENCL_C_VERSION__
#define FOR_AXES _Pragma("unroll") for
#else
#define FOR_AXES for
#endif

/* rint of what is below 2^51, or 2^22 in single precision: what is added leaves no place for a
 * fraction. PoCL 3.1 makes some twenty instructions of rint and of floor: with them a disk took
 * three times as long in double precision (bench_integrands). */
static inline realv nearest_whole(const realv x) {
#if PRECISION == 64
    const realv no_fractions = 6755399441055744.0; /* 1.5 2^52 */
#else
    const realv no_fractions = 12582912.0f; /* 1.5 2^23 */
#endif
    return (x + no_fractions) - no_fractions;
}

/* x - c in [-1/2,1/2]. */
static inline realv fold_difference(const realv x, const real c) {
    const realv difference = x - c;
    return difference - nearest_whole(difference);
}

#endif
