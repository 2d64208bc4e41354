/* Lambda_lm over alpha_l of rings, for a run of degrees at a time, as a table. Device only. */
#ifndef PS_SPHERE_ORDERS_TABLE_H
#define PS_SPHERE_ORDERS_TABLE_H

#include "sphere/nufft/orders_states.h"

/* LANES degrees of RING_UNIT rings, turned: table [ring][degree]. */
static inline __attribute__((always_inline)) void store_square(realv square[RING_VECTORS][LANES],
                                                               __local real *table) {
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        transpose(square[j]);
#pragma unroll
        for (int i = 0; i < LANES; i++) {
            store_local(table + (j * LANES + i) * TABLE_ROW, 0, square[j][i]);
        }
    }
}

static inline void store_zeros(__local real *table) {
#pragma unroll
    for (int i = 0; i < RING_UNIT; i++) {
        store_local(table + i * TABLE_ROW, 0, (realv)0);
    }
}

/* ---- by differences ------------------------------------------------------------------------- */

/* 2 LANES degrees. */
static inline void difference_squares(chain_state *states, const doublev *t,
                                      __local const double *coefficients, __local real *even,
                                      __local real *odd) {
    realv of_even[RING_VECTORS][LANES], of_odd[RING_VECTORS][LANES];
#pragma unroll
    for (int i = 0; i < 2 * LANES; i++) {
        const doublev inverse = (doublev)coefficients[OF_INVERSE + i];
#pragma unroll
        for (int j = 0; j < RING_VECTORS; j++) {
            const realv value = TO_REALV(shown(&states[j], true) * inverse);
            if (i % 2 == 0) {
                of_even[j][i / 2] = value;
            } else {
                of_odd[j][i / 2] = value;
            }
            advance_difference(&states[j], t[j], coefficients + OF_DIFFERENCE + i);
            if (i % DEGREES_BETWEEN_LOOKS == DEGREES_BETWEEN_LOOKS - 1) {
                look(&states[j]);
            }
        }
    }
    store_square(of_even, even);
    store_square(of_odd, odd);
}

static inline bool make_difference_run(const ring_states states, const ring_angles angles,
                                       const uint ring, __local const double *coefficients,
                                       __local real *even, __local real *odd, const uint vectors) {
    chain_state state[RING_VECTORS];
    doublev t[RING_VECTORS];
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        load_state(&state[j], states, 0, ring + j * LANES);
        t[j] = *(__global const unaligned_doublev *)(angles.distances + ring + j * LANES);
    }
    for (uint i = 0; i < vectors; i++) {
        difference_squares(state, t, coefficients + 2 * LANES * i, even + LANES * i,
                           odd + LANES * i);
    }
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        store_state(states, &state[j], 0, ring + j * LANES);
    }
    return is_more_than_zeros(state);
}

/* ---- every second degree -------------------------------------------------------------------- */

/* LANES degrees of one parity. */
static inline __attribute__((always_inline)) void
chain_square(chain_state *states, const doublev *squares, __local const double *steps,
             __local const double *rests, __local real *table, const bool is_scaled) {
    realv of[RING_VECTORS][LANES];
#pragma unroll
    for (int i = 0; i < LANES; i++) {
#pragma unroll
        for (int j = 0; j < RING_VECTORS; j++) {
            of[j][i] = TO_REALV(shown(&states[j], is_scaled));
            advance(&states[j], squares[j], steps[2 * i], rests[2 * i]);
            if (is_scaled && i % (DEGREES_BETWEEN_LOOKS / 2) == 1) {
                look(&states[j]);
            }
        }
    }
    store_square(of, table);
}

static inline bool make_chain_run(const ring_states states, const ring_angles angles,
                                  const uint parity, const uint ring,
                                  __local const double *coefficients, __local real *table,
                                  const uint vectors) {
    __local const double *steps = coefficients + OF_STEP + parity;
    __local const double *rests =
        coefficients + (ring < angles.crossing ? OF_POLE : OF_EQUATOR) + parity;
    chain_state state[RING_VECTORS];
    doublev squares[RING_VECTORS];
    bool is_scaled;
    const bool is_there = begin_chain(state, squares, &is_scaled, states, angles, parity, ring,
                                      steps, rests, 2 * LANES * vectors);
    for (uint i = 0; i < vectors; i++) {
        if (!is_there) {
            store_zeros(table + LANES * i);
        } else if (is_scaled) {
            chain_square(state, squares, steps + 2 * LANES * i, rests + 2 * LANES * i,
                         table + LANES * i, true);
        } else {
            chain_square(state, squares, steps + 2 * LANES * i, rests + 2 * LANES * i,
                         table + LANES * i, false);
        }
    }
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        store_state(states, &state[j], parity, ring + j * LANES);
    }
    return is_there;
}

/* A run of RING_UNIT rings from `ring` on, `vectors` of it; whether there is more than zeros in it.
 */
static inline bool make_run(const ring_states states, const ring_angles angles, const uint ring,
                            __local const double *coefficients, __local real *even,
                            __local real *odd, const uint vectors) {
    bool is_there = false;
    if (ring < angles.polar || ring >= angles.equatorial) {
        return make_difference_run(states, angles, ring, coefficients, even, odd, vectors);
    }
    for (uint parity = 0; parity < 2; parity++) {
        is_there = make_chain_run(states, angles, parity, ring, coefficients,
                                  parity == 0 ? even : odd, vectors) ||
                   is_there;
    }
    return is_there;
}

#endif
