/* Sums of w_i w_j P_l(u_i.u_j) over pairs: nearly all the work of pairs_direct. t = 1 - |u.v| = |u
 * -+ v|^2 / 2 comes from differences (pairs/layout.h), the polynomials from pairs/walk.h.
 *
 * One work-item owns a run of pairs and goes through it in chunks of CHUNK vectors of LANES pairs.
 * A chunk walks up the degrees, DEGREES at a time: their sums are in registers while its pairs pass
 * by, with the state of their recurrences.
 *
 * Launch: (runs, realizations) in work-groups of one item, since local memory belongs to one.
 *
 *   points    see pairs/layout.h
 *   counts    points of each realization
 *   inverses  1 / l for l = 1 .. num_degrees
 *   partials  [realization][run of this launch][high, low][num_degrees]; entry l - 1 belongs to degree l
 *   num_degrees  a multiple of 2 DEGREES
 *   run_vectors  of pairs
 */
#include "shared/real.h"
#include "pairs/layout.h"
#include "pairs/walk.h"

/* Kernels of the same program (docs/developer/decisions.md). */
#include "pairs/fold.cl"

/* The state of the vectors of a chunk at degree 0. */
PAIRS_INLINE void begin_chunk(pair_place *at, __local real *memory, const size_t num_vectors) {
    for (size_t v = 0; v < num_vectors; v++) {
        const realv side = side_of_pair(at);
        store_local(AT(STATE_P), v, weight_of_pair(at));
        store_local(AT(STATE_E), v, (realv)0);
        store_local(AT(STATE_T), v, (realv)0.5 * square_of_pair(at, side));
        store_local(AT(STATE_SIDE), v, side);
        pair_next(at);
    }
}

__kernel __attribute__((reqd_work_group_size(1, 1, 1))) void
pairs_sums(__global const real *restrict points, __global const ulong *restrict counts,
           __global const real *restrict inverses, __global real *restrict partials,
           const ulong stride, const ulong first_run, const uint num_degrees,
           const ulong run_vectors) {
    __local real memory[STATES * CHUNK * LANES];
    const size_t realization = get_group_id(1);
    const ulong num_points = counts[realization];
    const ulong all = pair_vectors(num_points);
    const ulong begin = (first_run + get_group_id(0)) * run_vectors;
    const ulong end = min(begin + run_vectors, all);
    __global real *high =
        partials + (realization * get_num_groups(0) + get_group_id(0)) * 2 * num_degrees;
    for (uint i = 0; i < 2 * num_degrees; i++) {
        high[i] = 0;
    }
    if (begin >= all) {
        return;
    }
    pair_place at;
    pair_begin(&at, points + realization * POINT_ARRAYS * stride, stride, num_points, begin);
    for (ulong from = begin; from < end; from += CHUNK) {
        const size_t num_vectors = min(end - from, (ulong)CHUNK);
        begin_chunk(&at, memory, num_vectors);
        walk_chunk(memory, num_vectors, inverses, high, num_degrees);
    }
}
