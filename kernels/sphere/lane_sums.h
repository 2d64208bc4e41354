/* What all lanes say together: sums over the lanes of several vectors, and whether a lane is
 * negative. Nothing of it in C11.
 *
 * Adding the two halves of two vectors interleaved leaves one vector with half the terms of either
 * sum: after log2(LANES) rounds one vector has the sum of a vector in each lane, in their order.
 * Everything is written out: vectors stay in registers only where no loop has to be unrolled first.
 */
#ifndef PS_SPHERE_LANE_SUMS_H
#define PS_SPHERE_LANE_SUMS_H

#include "shared/lanes.h"
#include "shared/transpose.h"

#ifdef __OPENCL_C_VERSION__

#define MERGE(i, apart)                                                                            \
    v[i] = INTERLEAVE_LOW(v[i], v[(i) + (apart)]) + INTERLEAVE_HIGH(v[i], v[(i) + (apart)]);
#define MERGE_FIRST2(i, apart) MERGE(i, apart) MERGE((i) + 1, apart)
#define MERGE_FIRST4(i, apart) MERGE_FIRST2(i, apart) MERGE_FIRST2((i) + 2, apart)
#define MERGE_FIRST8(i, apart) MERGE_FIRST4(i, apart) MERGE_FIRST4((i) + 4, apart)
#define MERGE_2(i) MERGE(i, 1)
#define MERGE_4(i) MERGE_FIRST2(i, 2) MERGE_2(i)
#define MERGE_8(i) MERGE_FIRST4(i, 4) MERGE_4(i)
#define MERGE_16(i) MERGE_FIRST8(i, 8) MERGE_8(i)

#if LANES == 16
#define MERGE_GROUP(i) MERGE_16(i)
#elif LANES == 8
#define MERGE_GROUP(i) MERGE_8(i)
#elif LANES == 4
#define MERGE_GROUP(i) MERGE_4(i)
#elif LANES == 2
#define MERGE_GROUP(i) MERGE_2(i)
#else
#define MERGE_GROUP(i)
#endif

#define NUM_LANE_SUMS 16

/* totals[i] = sum of the lanes of v[i], i < NUM_LANE_SUMS; v is used up. */
static inline __attribute__((always_inline)) void sum_lanes(realv *v, real *totals) {
    MERGE_GROUP(0)
    *(unaligned_realv *)(totals) = v[0];
#if LANES <= 8
    MERGE_GROUP(8)
    *(unaligned_realv *)(totals + 8) = v[8];
#endif
#if LANES <= 4
    MERGE_GROUP(4)
    MERGE_GROUP(12)
    *(unaligned_realv *)(totals + 4) = v[4];
    *(unaligned_realv *)(totals + 12) = v[12];
#endif
#if LANES <= 2
    for (int i = 2; i < NUM_LANE_SUMS; i += 4) {
        MERGE_GROUP(i)
        *(unaligned_realv *)(totals + i) = v[i];
    }
#endif
#if LANES == 1
    for (int i = 1; i < NUM_LANE_SUMS; i += 2) {
        totals[i] = v[i];
    }
#endif
}

/* Is any lane negative? */
static inline __attribute__((always_inline)) uint any_negative(const swordv x) {
#if LANES == 1
    return x < 0;
#else
    return any(x < (swordv)0);
#endif
}

#endif

#endif
