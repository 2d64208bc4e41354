/* pairs/sums.cl for GPUs: a work-group has a run of pairs, a work-item OWN vectors of LANES pairs
 * at a time, whose states stay in its registers while it walks up the degrees. What DEGREES degrees
 * add is added over all items of the group by way of local memory, in one order, whatever the
 * device.
 *
 * Launch: (runs, realizations) in work-groups of JOBS items.
 *
 *   points, counts, inverses, partials, stride, first_run, num_degrees  of pairs/sums.cl
 *   run_vectors  of a run, a multiple of OWN * JOBS
 *
 * A degree and a pair are 6 operations in 4 instructions, of OWN * LANES pairs of an item; sums
 * over the group take some 60 more for DEGREES degrees of them all: 60 % of the peak, counted.
 */
#ifndef JOBS
#define JOBS 64
#endif
#include "shared/group_sums.h"
#include "pairs/layout.h"
#include "pairs/walk.h"

/* With 4 lanes in double precision 254 registers, nothing spilled. */
#define OWN 2

typedef struct own_pairs {
    realv p[OWN], e[OWN], t[OWN], side[OWN];
} own_pairs;

/* Vectors index, index + JOBS, ..; those from `end` on weigh nothing. */
PAIRS_INLINE void begin_own(own_pairs *own, pair_place *at, const ulong index, const ulong end) {
#pragma unroll
    for (uint k = 0; k < OWN; k++) {
        const bool is_there = index + k * JOBS < end;
        pair_begin(at, at->points, at->stride, at->num_points,
                   is_there ? index + k * JOBS : end - 1);
        own->side[k] = side_of_pair(at);
        own->t[k] = (realv)0.5 * square_of_pair(at, own->side[k]);
        own->p[k] = is_there ? weight_of_pair(at) : (realv)0;
        own->e[k] = (realv)0;
    }
}

PAIRS_INLINE real sum_of_lanes(const realv v) {
    real lanes[LANES];
    real sum = 0;
    *(unaligned_realv *)lanes = v;
#pragma unroll
    for (uint i = 0; i < LANES; i++) {
        sum += lanes[i];
    }
    return sum;
}

/* DEGREES degrees of all items, added to a row. All items call it. */
PAIRS_INLINE void add_over_group(__local real *of_items, __local real *of_parts, const realv *sums,
                                 __global real *high, __global real *low) {
    const uint item = get_local_id(0);
    real own[DEGREES];
#pragma unroll
    for (uint i = 0; i < DEGREES; i++) {
        own[i] = sum_of_lanes(sums[i]);
    }
    const real total = group_sum(of_items, of_parts, own, DEGREES);
    if (item < DEGREES) {
        add_total(high + item, low + item, total);
    }
}

__kernel __attribute__((reqd_work_group_size(JOBS, 1, 1))) void
pairs_sums_shared(__global const real *restrict points, __global const ulong *restrict counts,
                  __global const real *restrict inverses, __global real *restrict partials,
                  const ulong stride, const ulong first_run, const uint num_degrees,
                  const ulong run_vectors) {
    __local real of_items[DEGREES * (JOBS + 1)];
    __local real of_parts[JOBS];
    const size_t realization = get_group_id(1);
    const ulong begin = (first_run + get_group_id(0)) * run_vectors;
    const ulong end = min(begin + run_vectors, pair_vectors(counts[realization]));
    __global real *high =
        partials + (realization * get_num_groups(0) + get_group_id(0)) * 2 * num_degrees;
    pair_place at = {
        points + realization * POINT_ARRAYS * stride, stride, counts[realization], 0, 0, 0};
    for (uint i = get_local_id(0); i < 2 * num_degrees; i += JOBS) {
        high[i] = 0;
    }
    barrier(CLK_GLOBAL_MEM_FENCE);
    for (ulong from = begin; from < end; from += OWN * JOBS) {
        own_pairs own;
        begin_own(&own, &at, from + get_local_id(0), end);
        for (uint before = 0; before < num_degrees; before += DEGREES) {
            realv sums[DEGREES];
            clear_sums(sums);
#pragma unroll
            for (uint k = 0; k < OWN; k++) {
                walk_vector(&own.p[k], &own.e[k], own.t[k], own.side[k], inverses + before,
                            (real)(2 * before + 1), sums);
            }
            add_over_group(of_items, of_parts, sums, high + before, high + num_degrees + before);
        }
    }
}
