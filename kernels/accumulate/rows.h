/* How sums over bins take rows of powers: LANES realizations at a time. Nothing of it in C11. */
#ifndef PS_ACCUMULATE_ROWS_H
#define PS_ACCUMULATE_ROWS_H

#include "shared/lanes.h"

#ifdef __OPENCL_C_VERSION__

/* Fixed: sums depend on it. Long enough that pieces are few, short enough for the local memory of
 * any device and for the nearest cache of a core. PS_ACCUMULATE_BLOCK of the host is the same. */
#define BLOCK 512

/* LANES slots of the first `count` of LANES realizations; the others are 0. */
static inline void load_rows(realv *powers, __global const real *rows, const ulong stride,
                             const uint count) {
#pragma unroll
    for (uint i = 0; i < LANES; i++) {
        powers[i] = i < count ? load_global(rows + i * stride, 0) : (realv)0;
    }
}

#endif

#endif
