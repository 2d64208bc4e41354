/* Legendre sums over weighted nodes, sum_n W_n P_l(x_n), the same nodes for all realizations; as
 * pairs/sums.cl, with nodes instead of pairs.
 *
 * Launch: (runs, realizations) in work-groups of one item, since local memory belongs to one.
 *
 *   nodes     [t, side][capacity], capacity a multiple of LANES
 *   weights   [realization][capacity]
 *   inverses, partials, num_degrees  as there
 */
#include "shared/real.h"
#include "pairs/walk.h"

PAIRS_INLINE void begin_chunk(__global const real *nodes, __global const real *weights,
                              const ulong capacity, const ulong from, __local real *memory,
                              const size_t num_vectors) {
    for (size_t v = 0; v < num_vectors; v++) {
        store_local(AT(STATE_P), v, load_global(weights, from + v));
        store_local(AT(STATE_E), v, (realv)0);
        store_local(AT(STATE_T), v, load_global(nodes, from + v));
        store_local(AT(STATE_SIDE), v, load_global(nodes + capacity, from + v));
    }
}

__kernel __attribute__((reqd_work_group_size(1, 1, 1))) void
pairs_nodes_sums(__global const real *restrict nodes, __global const real *restrict weights,
                 __global const real *restrict inverses, __global real *restrict partials,
                 const ulong capacity, const uint num_degrees) {
    __local real memory[STATES * CHUNK * LANES];
    const size_t realization = get_group_id(1);
    const ulong all = capacity / LANES;
    const ulong begin = get_group_id(0) * (CHUNK * RUN);
    const ulong end = min(begin + CHUNK * RUN, all);
    __global real *high =
        partials + (realization * get_num_groups(0) + get_group_id(0)) * 2 * num_degrees;
    for (uint i = 0; i < 2 * num_degrees; i++) {
        high[i] = 0;
    }
    for (ulong from = begin; from < end; from += CHUNK) {
        const size_t num_vectors = min(end - from, (ulong)CHUNK);
        begin_chunk(nodes, weights + realization * capacity, capacity, from, memory, num_vectors);
        walk_chunk(memory, num_vectors, inverses, high, num_degrees);
    }
}
