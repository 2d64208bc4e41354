/* A square of LANES vectors of LANES numbers, turned: v[i][j] <-> v[j][i], in registers. Nothing of
 * it in C11. One shuffle for each vector and each factor of two of LANES.
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

/* Doubles go two by two, then whole blocks of two, the even ones and the odd ones of two vectors:
 * the shuffles that processors do fastest (sums over rings took 0.9 of the time, Zen 5, PoCL 3.1).
 * Floats do not: LLVM 14 makes several shuffles for each when they are asked for like that. */
#if PRECISION == 64 && LANES == 8
#define BLOCK_LANES 2
#define NUMBERS_LOW(a, b) ((realv)((a).s0, (b).s0, (a).s2, (b).s2, (a).s4, (b).s4, (a).s6, (b).s6))
#define NUMBERS_HIGH(a, b) ((realv)((a).s1, (b).s1, (a).s3, (b).s3, (a).s5, (b).s5, (a).s7, (b).s7))
#define BLOCKS_EVEN(a, b) ((realv)((a).s0, (a).s1, (a).s4, (a).s5, (b).s0, (b).s1, (b).s4, (b).s5))
#define BLOCKS_ODD(a, b) ((realv)((a).s2, (a).s3, (a).s6, (a).s7, (b).s2, (b).s3, (b).s6, (b).s7))
#elif PRECISION == 64 && LANES == 4
#define BLOCK_LANES 2
#define NUMBERS_LOW(a, b) ((realv)((a).s0, (b).s0, (a).s2, (b).s2))
#define NUMBERS_HIGH(a, b) ((realv)((a).s1, (b).s1, (a).s3, (b).s3))
#define BLOCKS_EVEN(a, b) ((realv)((a).s0, (a).s1, (b).s0, (b).s1))
#define BLOCKS_ODD(a, b) ((realv)((a).s2, (a).s3, (b).s2, (b).s3))
#endif

#ifdef BLOCK_LANES

/* Block j of v[B i + k] <-> block i of v[B j + k], B = BLOCK_LANES. */
static inline __attribute__((always_inline)) void transpose_blocks(realv *v) {
#pragma unroll
    for (int blocks = LANES / BLOCK_LANES; blocks > 1; blocks /= 2) {
        realv old[LANES];
#pragma unroll
        for (int i = 0; i < LANES; i++) {
            old[i] = v[i];
        }
#pragma unroll
        for (int i = 0; i < LANES / 2; i++) {
            const int from = i + i / BLOCK_LANES * BLOCK_LANES;
            v[i] = BLOCKS_EVEN(old[from], old[from + BLOCK_LANES]);
            v[i + LANES / 2] = BLOCKS_ODD(old[from], old[from + BLOCK_LANES]);
        }
    }
}

static inline __attribute__((always_inline)) void transpose(realv *v) {
#pragma unroll
    for (int i = 0; i < LANES; i += BLOCK_LANES) {
        const realv first = v[i];
        v[i] = NUMBERS_LOW(first, v[i + 1]);
        v[i + 1] = NUMBERS_HIGH(first, v[i + 1]);
    }
    transpose_blocks(v);
}

#else

/* Any number: interleaving the first half of the vectors with the second half, log2(LANES) times,
 * is the transposition. */
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

#endif
