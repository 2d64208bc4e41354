/* Lambda_lm over alpha_l (orders_chains.h) of rings, for a run of degrees at a time. Device only.
 *
 * The rings next to the pole and to the equator by differences: with t = 1 - cos(theta) and D = the
 * part of Lambda_lm that is not just Lambda_{l-1,m} normalised anew
 * (docs/mathematics/numerics.md#high-order, multiplied by the norm),
 *
 *     D_l = a_l D_{l-1} + b_l t Lambda_{l-1},   Lambda_l = g_l Lambda_{l-1} + D_l
 *     g_l = sqrt((2l+1)(l+m) / ((2l-1)(l-m))),  a_l = g_l (l-m-1)/(l+m),  b_l = -g_l (2l-1)/(l+m)
 *
 * which keeps its digits there, at twice the operations.
 */
#ifndef PS_SPHERE_ORDERS_TABLE_H
#define PS_SPHERE_ORDERS_TABLE_H

#include "sphere/nufft/orders_chains.h"

/* States of the rings of a work-group, between two runs: [even, odd l - m][ring_pitch] each. By
 * differences, the even ones are Lambda_lm and D. */
typedef struct ring_states {
    __global double *value, *before; /* p_l, p_{l-2} */
    __global int *scale;
    size_t parity_apart;
} ring_states;

/* [ring]. Rings below `polar` and from `equatorial` on go by differences; those below `crossing`
 * have the bracket of the pole. Multiples of RING_UNIT. */
typedef struct ring_angles {
    __global const double *distances; /* 1 - cos(theta) */
    __global const double *squares;   /* -sin^2(theta), from `crossing` on cos^2(theta) */
    uint polar, crossing, equatorial;
} ring_angles;

typedef struct chain_state {
    doublev value, before;
    intv scale;
} chain_state;

/* Those above 1 that are scaled down so far come up. */
static inline void look(chain_state *state) {
    const longv comes_up = fabs(state->value) > (doublev)1 && TO_LONGV(state->scale) > (longv)0;
    const doublev factor = comes_up ? (doublev)SCALE_DOWN : (doublev)1;
    state->value *= factor;
    state->before *= factor;
    state->scale += TO_INTV(comes_up); /* true is -1 */
}

static inline void load_state(chain_state *to, const ring_states from, const uint parity,
                              const uint ring) {
    const size_t at = parity * from.parity_apart + ring;
    to->value = *(__global const unaligned_doublev *)(from.value + at);
    to->before = *(__global const unaligned_doublev *)(from.before + at);
    to->scale = *(__global const unaligned_intv *)(from.scale + at);
}

static inline void store_state(const ring_states to, const chain_state *from, const uint parity,
                               const uint ring) {
    const size_t at = parity * to.parity_apart + ring;
    *(__global unaligned_doublev *)(to.value + at) = from->value;
    *(__global unaligned_doublev *)(to.before + at) = from->before;
    *(__global unaligned_intv *)(to.scale + at) = from->scale;
}

static inline bool is_large(const chain_state *state) {
    return any(fabs(state->value) > (doublev)1 && TO_LONGV(state->scale) > (longv)0) != 0;
}

static inline bool is_scaled_down(const chain_state *state) {
    return any(TO_LONGV(state->scale) > (longv)0) != 0;
}

static inline bool is_more_than_zeros(const chain_state *state) {
    return any(TO_LONGV(state->scale) <= (longv)0 &&
               fmax(fabs(state->value), fabs(state->before)) > (doublev)NEGLIGIBLE) != 0;
}

static inline doublev shown(const chain_state *state, const bool is_scaled) {
    return is_scaled && TO_LONGV(state->scale) > (longv)0 ? (doublev)0 : state->value;
}

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

static inline void advance_difference(chain_state *state, const doublev t,
                                      __local const double *coefficients) {
    const doublev step = (doublev)coefficients[RUN_DEGREES] * t;
    const doublev rest = (doublev)coefficients[0] * state->before;
    state->before = fma(step, state->value, rest);
    state->value = fma((doublev)coefficients[2 * RUN_DEGREES], state->value, state->before);
}

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
    bool is_there = false;
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
        is_there = is_there || is_more_than_zeros(&state[j]);
    }
    return is_there;
}

/* ---- every second degree -------------------------------------------------------------------- */

static inline void advance(chain_state *state, const doublev square, const double step,
                           const double rest) {
    const doublev bracket = fma((doublev)step, square, (doublev)rest);
    const doublev next = fma(bracket, state->value, state->before);
    state->before = state->value;
    state->value = next;
}

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

/* Without a table: whether there is more than zeros at the end; if not, the states go on. Between
 * two looks numbers may grow beyond 2^100 here (by 2^200 at m = 2^15, and less from look to look):
 * in the end all come down. */
static inline bool try_chain(chain_state *states, const doublev *squares,
                             __local const double *steps, __local const double *rests,
                             const uint num) {
    bool is_there = false;
    for (uint i = 0; i < num; i += 2 * LANES) {
#pragma unroll
        for (uint k = 0; k < 2 * LANES; k += 2) {
#pragma unroll
            for (int j = 0; j < RING_VECTORS; j++) {
                advance(&states[j], squares[j], steps[i + k], rests[i + k]);
            }
        }
#pragma unroll
        for (int j = 0; j < RING_VECTORS; j++) {
            look(&states[j]);
        }
    }
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        while (is_large(&states[j])) {
            look(&states[j]);
        }
        is_there = is_there || is_more_than_zeros(&states[j]);
    }
    return is_there;
}

/* Those that are scaled down are tried first: most of them come to zeros. */
static inline bool make_chain_run(const ring_states states, const ring_angles angles,
                                  const uint parity, const uint ring,
                                  __local const double *coefficients, __local real *table,
                                  const uint vectors) {
    __local const double *steps = coefficients + OF_STEP + parity;
    __local const double *rests =
        coefficients + (ring < angles.crossing ? OF_POLE : OF_EQUATOR) + parity;
    chain_state state[RING_VECTORS], trial[RING_VECTORS];
    doublev squares[RING_VECTORS];
    bool is_scaled = false, is_there = true;
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        load_state(&state[j], states, parity, ring + j * LANES);
        trial[j] = state[j];
        squares[j] = *(__global const unaligned_doublev *)(angles.squares + ring + j * LANES);
        is_scaled = is_scaled || is_scaled_down(&state[j]);
    }
    if (is_scaled) {
        is_there = try_chain(trial, squares, steps, rests, 2 * LANES * vectors);
    }
    if (!is_there) {
#pragma unroll
        for (int j = 0; j < RING_VECTORS; j++) {
            state[j] = trial[j];
        }
    }
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
