/* Up the degrees of Legendre polynomials, many arguments side by side, with sums over all of them:
 * what pairs/sums.cl does with pairs of points, pairs/nodes_sums.cl with nodes of a histogram.
 *
 * With t = 1 - |x| and differences, P_l(1 - t) has no cancellation
 * (docs/mathematics/numerics.md#legendre-sums):
 *
 *     E_l = l (P_l - P_{l-1}):   E_{l+1} = E_l - (2l + 1) t P_l,   P_{l+1} = P_l + E_{l+1} / (l + 1)
 *
 * P_0 is the weight, which so costs nothing further. (2l + 1) t goes up by 2 t from degree to
 * degree and is made anew for every block: four and a half operations for a degree, half of them
 * fused, the others additions, for which CPUs have units of their own. Arguments x < 0 have side
 * -1: P_l(-x) = (-1)^l P_l(x).
 */
#ifndef PS_PAIRS_WALK_H
#define PS_PAIRS_WALK_H

#include "shared/lanes.h"
#include "pairs/layout.h"
#include "sphere/lane_sums.h"

#ifndef CHUNK
#define CHUNK 64
#endif
#ifndef RUN
#define RUN 16 /* chunks */
#endif
#ifndef ONLY_EVEN
#define ONLY_EVEN 0
#endif

/* Degrees of a block: as many sums as registers hold beside a state. Sums of lanes are made for two
 * blocks at a time. */
#define DEGREES 8

#define STATE_P 0
#define STATE_E 1
#define STATE_T 2
#define STATE_SIDE 3
#define STATES 4

#ifdef __OPENCL_C_VERSION__

#define AT(state) (memory + (state)*CHUNK * LANES)

#if ONLY_EVEN
#define ADD_ODD(i)
#else
#define ADD_ODD(i) sums[i] = fma(side, p, sums[i]);
#endif
#define STEP(i)                                                                                    \
    e = fma(-u, p, e);                                                                             \
    p = fma((realv)inverses[i], e, p);                                                             \
    u += twice;
#define STEP_TWICE(i)                                                                              \
    STEP(i)                                                                                        \
    ADD_ODD(i)                                                                                     \
    STEP((i) + 1)                                                                                  \
    sums[(i) + 1] += p;

/* A vector of pairs, up DEGREES degrees from `before` on, odd = 2 before + 1: added to the sums of
 * each. */
PAIRS_INLINE void walk_vector(realv *state_p, realv *state_e, const realv t, const realv side,
                              __global const real *inverses, const real odd, realv *sums) {
    const realv twice = t + t;
    realv p = *state_p, e = *state_e, u = t * (realv)odd;
    (void)side;
    STEP_TWICE(0)
    STEP_TWICE(2)
    STEP_TWICE(4)
    STEP_TWICE(6)
    *state_p = p;
    *state_e = e;
}

PAIRS_INLINE void clear_sums(realv *sums) {
    sums[0] = sums[1] = sums[2] = sums[3] = (realv)0;
    sums[4] = sums[5] = sums[6] = sums[7] = (realv)0;
}

/* Degrees before + 1 .. before + DEGREES of a chunk: their sums over all pairs. */
PAIRS_INLINE void walk_block(__local real *memory, const size_t num_vectors,
                             __global const real *inverses, const uint before, realv *sums) {
    const real odd = (real)(2 * before + 1);
    clear_sums(sums);
    for (size_t v = 0; v < num_vectors; v++) {
        realv p = load_local(AT(STATE_P), v);
        realv e = load_local(AT(STATE_E), v);
        walk_vector(&p, &e, load_local(AT(STATE_T), v), load_local(AT(STATE_SIDE), v), inverses,
                    odd, sums);
        store_local(AT(STATE_P), v, p);
        store_local(AT(STATE_E), v, e);
    }
}

/* As in shared/pair.h. */
PAIRS_INLINE void add_total(__global real *high, __global real *low, const real x) {
    const real old = *high;
    const real sum = old + x;
    const real x_part = sum - old;
    *low += (old - (sum - x_part)) + (x - x_part);
    *high = sum;
}

/* All degrees of a chunk whose states begin: added to a row [high, low][num_degrees]. */
PAIRS_INLINE void walk_chunk(__local real *memory, const size_t num_vectors,
                             __global const real *inverses, __global real *high,
                             const uint num_degrees) {
    for (uint before = 0; before < num_degrees; before += NUM_LANE_SUMS) {
        realv sums[NUM_LANE_SUMS];
        real totals[NUM_LANE_SUMS];
        walk_block(memory, num_vectors, inverses + before, before, sums);
        walk_block(memory, num_vectors, inverses + before + DEGREES, before + DEGREES,
                   sums + DEGREES);
        sum_lanes(sums, totals);
        for (int i = 0; i < NUM_LANE_SUMS; i++) {
            add_total(high + before + i, high + num_degrees + before + i, totals[i]);
        }
    }
}

#endif

#endif
