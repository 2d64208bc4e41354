/* A square of LANES vectors of LANES numbers, turned: v[i][j] <-> v[j][i], in registers. Nothing of it in C11.
 *
 * Interleaving the first half of the vectors with the second half, log2(LANES) times, is the
 * transposition; every interleaving is one shuffle for each vector.
 */
#ifndef PS_SHARED_TRANSPOSE_H
#define PS_SHARED_TRANSPOSE_H

#include "shared/real.h"

#ifdef __OPENCL_C_VERSION__

#if LANES == 2
#define INTERLEAVE_LOW(a, b) ((realv)((a).s0, (b).s0))
#define INTERLEAVE_HIGH(a, b) ((realv)((a).s1, (b).s1))
#elif LANES == 4
#define INTERLEAVE_LOW(a, b) ((realv)((a).s0, (b).s0, (a).s1, (b).s1))
#define INTERLEAVE_HIGH(a, b) ((realv)((a).s2, (b).s2, (a).s3, (b).s3))
#elif LANES == 8
#define INTERLEAVE_LOW(a, b)                                                                       \
    ((realv)((a).s0, (b).s0, (a).s1, (b).s1, (a).s2, (b).s2, (a).s3, (b).s3))
#define INTERLEAVE_HIGH(a, b)                                                                      \
    ((realv)((a).s4, (b).s4, (a).s5, (b).s5, (a).s6, (b).s6, (a).s7, (b).s7))
#elif LANES == 16
#define INTERLEAVE_LOW(a, b)                                                                       \
    ((realv)((a).s0, (b).s0, (a).s1, (b).s1, (a).s2, (b).s2, (a).s3, (b).s3, (a).s4, (b).s4,       \
             (a).s5, (b).s5, (a).s6, (b).s6, (a).s7, (b).s7))
#define INTERLEAVE_HIGH(a, b)                                                                      \
    ((realv)((a).s8, (b).s8, (a).s9, (b).s9, (a).sa, (b).sa, (a).sb, (b).sb, (a).sc, (b).sc,       \
             (a).sd, (b).sd, (a).se, (b).se, (a).sf, (b).sf))
#endif

static inline void transpose(realv *v) {
#if LANES == 1
    (void)v;
#else
#pragma unroll
    for (int step = 1; step < LANES; step *= 2) {
        realv old[LANES];
#pragma unroll
        for (int i = 0; i < LANES; i++) {
            old[i] = v[i];
        }
#pragma unroll
        for (int i = 0; i < LANES / 2; i++) {
            v[2 * i] = INTERLEAVE_LOW(old[i], old[i + LANES / 2]);
            v[2 * i + 1] = INTERLEAVE_HIGH(old[i], old[i + LANES / 2]);
        }
    }
#endif
}

#endif

#endif
