/* Lambda_lm over alpha_l (orders_chains.h) of rings on its way from degree to degree. Device only.
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
#ifndef PS_SPHERE_ORDERS_STATES_H
#define PS_SPHERE_ORDERS_STATES_H

#include "sphere/nufft/orders_chains.h"

/* Numbers on their way are doubles, or floats, twice as many to a vector. */
#ifndef STATE_PRECISION
#define STATE_PRECISION 64
#endif
#if STATE_PRECISION == 64
typedef double state_real;
typedef doublev statev;
typedef longv maskv;
typedef intv scalev;
#define TO_MASKV(x) TO_LONGV(x)
#define TO_SCALEV(x) TO_INTV(x)
#define AS_LONGV(x) (x)
#define STATE_LANES LANES
#else
typedef float state_real;
typedef float statev __attribute__((ext_vector_type(2 * LANES)));
typedef int maskv __attribute__((ext_vector_type(2 * LANES)));
typedef maskv scalev;
#define TO_MASKV(x) (x)
#define TO_SCALEV(x) (x)
#define AS_LONGV(x) PS_JOIN(as_, PS_VECTOR(long))(x)
#define STATE_LANES (2 * LANES)
#endif
typedef statev unaligned_statev __attribute__((aligned(sizeof(state_real))));
typedef scalev unaligned_scalev __attribute__((aligned(sizeof(int))));

/* States of the rings of a work-group, between two runs: [even, odd l - m][ring_pitch] each. By
 * differences, the even ones are Lambda_lm and D. */
typedef struct ring_states {
    __global state_real *value, *before; /* p_l, p_{l-2} */
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

/* What a work-group has of rings. Those below `alive` are nothing in all degrees, and stay so in
 * higher orders. */
typedef struct ring_work {
    ring_states states;
    ring_angles angles;
    __global double *diagonal;
    __global int *diagonal_scales;
    uint num_rings, block, alive;
} ring_work;

/* What orders begin with (orders_sum.cl). */
typedef struct order_starts {
    __global const double *starts;
    __global const int *start_scales;
    __global const double *steps;
    __global const int *step_scales;
    __global const double *ratios, *cosines;
} order_starts;

typedef struct chain_state {
    statev value, before;
    scalev scale;
} chain_state;

/* Those above 1 that are scaled down so far come up. */
static inline void look(chain_state *state) {
    const maskv comes_up = fabs(state->value) > (statev)1 && TO_MASKV(state->scale) > (maskv)0;
    const statev factor = comes_up ? (statev)(state_real)SCALE_DOWN : (statev)1;
    state->value *= factor;
    state->before *= factor;
    state->scale += TO_SCALEV(comes_up); /* true is -1 */
}

static inline void load_state(chain_state *to, const ring_states from, const uint parity,
                              const uint ring) {
    const size_t at = parity * from.parity_apart + ring;
    to->value = *(__global const unaligned_statev *)(from.value + at);
    to->before = *(__global const unaligned_statev *)(from.before + at);
    to->scale = *(__global const unaligned_scalev *)(from.scale + at);
}

static inline void store_state(const ring_states to, const chain_state *from, const uint parity,
                               const uint ring) {
    const size_t at = parity * to.parity_apart + ring;
    *(__global unaligned_statev *)(to.value + at) = from->value;
    *(__global unaligned_statev *)(to.before + at) = from->before;
    *(__global unaligned_scalev *)(to.scale + at) = from->scale;
}

/* Of masks: any() of PoCL 3.1 asks lane by lane (2026-11, Zen 4: 7 % of orders_sum_one.cl). */
static inline bool any_lane(const maskv of) {
    const longv mask = AS_LONGV(of);
#if LANES == 16
    const long8 of_eight = mask.lo | mask.hi;
#elif LANES == 8
    const long8 of_eight = mask;
#endif
#if LANES >= 8
    const long4 of_four = of_eight.lo | of_eight.hi;
#elif LANES == 4
    const long4 of_four = mask;
#endif
#if LANES >= 4
    const long2 of_two = of_four.lo | of_four.hi;
#else
    const long2 of_two = mask;
#endif
    return (of_two.lo | of_two.hi) != 0;
}

static inline bool is_large(const chain_state *state) {
    return any_lane(fabs(state->value) > (statev)1 && TO_MASKV(state->scale) > (maskv)0);
}

static inline bool is_scaled_down(const chain_state *states) {
    scalev scale = states[0].scale;
#pragma unroll
    for (int j = 1; j < RING_VECTORS; j++) {
        scale = max(scale, states[j].scale);
    }
    return any_lane(TO_MASKV(scale) > (maskv)0);
}

static inline bool is_more_than_zeros(const chain_state *states) {
    maskv mask = (maskv)0;
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        mask |=
            TO_MASKV(states[j].scale) <= (maskv)0 &&
            fmax(fabs(states[j].value), fabs(states[j].before)) > (statev)(state_real)NEGLIGIBLE;
    }
    return any_lane(mask);
}

static inline statev shown(const chain_state *state, const bool is_scaled) {
    return is_scaled && TO_MASKV(state->scale) > (maskv)0 ? (statev)0 : state->value;
}

static inline void advance_difference(chain_state *state, const statev t,
                                      __local const state_real *coefficients) {
    const statev step = (statev)coefficients[RUN_DEGREES] * t;
    const statev rest = (statev)coefficients[0] * state->before;
    state->before = fma(step, state->value, rest);
    state->value = fma((statev)coefficients[2 * RUN_DEGREES], state->value, state->before);
}

static inline void advance(chain_state *state, const statev square, const state_real step,
                           const state_real rest) {
    const statev bracket = fma((statev)step, square, (statev)rest);
    const statev next = fma(bracket, state->value, state->before);
    state->before = state->value;
    state->value = next;
}

/* Without a table: whether there is more than zeros at the end; if not, the states go on. Between
 * two looks numbers may grow beyond 2^100 here (by 2^200 at m = 2^15, and less from look to look):
 * in the end all come down. The recurrence stands at every `stride`-th step, a constant. */
static inline bool try_chain(chain_state *states, const statev *squares,
                             __local const state_real *steps, __local const state_real *rests,
                             const uint num, const uint stride) {
    for (uint i = 0; i < num; i += stride * LANES) {
#pragma unroll
        for (uint k = 0; k < stride * LANES; k += stride) {
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
    }
    return is_more_than_zeros(states);
}

/* Loads the states of RING_UNIT rings. Those that are scaled down are tried first, since most of
 * them come to zeros: then the states are those after `num` degrees, and nothing else is to be done
 * for them. Returns whether there is more. */
static inline __attribute__((always_inline)) bool
begin_chain(chain_state *state, statev *squares, bool *is_scaled, const ring_states states,
            const ring_angles angles, const uint parity, const uint ring,
            __local const state_real *steps, __local const state_real *rests, const uint num) {
    chain_state trial[RING_VECTORS];
    bool is_there = true;
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        load_state(&state[j], states, parity, ring + j * LANES);
        trial[j] = state[j];
        squares[j] = *(__global const unaligned_statev *)(angles.squares + ring + j * LANES);
    }
    *is_scaled = is_scaled_down(state);
    if (*is_scaled) {
        is_there = try_chain(trial, squares, steps, rests, num, 2);
    }
    if (!is_there) {
#pragma unroll
        for (int j = 0; j < RING_VECTORS; j++) {
            state[j] = trial[j];
        }
    }
    return is_there;
}

#endif
