/* Lambda_lm of rings, for a run of degrees at a time. Device only.
 *
 * With t = 1 - cos(theta) and D = the part of Lambda_lm that is not just Lambda_{l-1,m} normalised anew (mathematics.md
 * 7.5, multiplied by the norm):
 *
 *     D_l = a_l D_{l-1} + b_l t Lambda_{l-1},   Lambda_l = g_l Lambda_{l-1} + D_l
 *     g_l = sqrt((2l+1)(l+m) / ((2l-1)(l-m))),  a_l = g_l (l-m-1)/(l+m),  b_l = -g_l (2l-1)/(l+m)
 *
 * which keeps its digits near the pole. In double precision, whatever is summed: the recurrence in single precision
 * is off by 6e-5 at l = 512. A number stands for value 2^(-SCALE s), s >= 0, since sin^m(theta) underflows. Where
 * s > 0 it is taken for zero. LANES is 2 at least.
 */
#ifndef PS_SPHERE_ORDERS_TABLE_H
#define PS_SPHERE_ORDERS_TABLE_H

#include "shared/group.h"
#include "shared/lanes.h"
#include "shared/transpose.h"

#pragma OPENCL EXTENSION cl_khr_fp64 : enable

typedef PS_VECTOR(double) doublev;
typedef PS_VECTOR(int) intv;
typedef PS_VECTOR(long) longv;
typedef doublev unaligned_doublev __attribute__((aligned(sizeof(double))));
typedef intv unaligned_intv __attribute__((aligned(sizeof(int))));
#define TO_DOUBLEV(x) PS_JOIN(convert_, PS_VECTOR(double))(x)
#define TO_LONGV(x) PS_JOIN(convert_, PS_VECTOR(long))(x)

/* 2^-100 is far below what counts in either precision, and a normal number in both. Numbers grow by a factor of
 * 2^8 at most from degree to degree (g_l at l = m + 1 = 2^15), so it is enough to look every few degrees. */
#define SCALE_DOWN 7.888609052210118e-31 /* 2^-100 */
#define SCALE_UP 1.2676506002282294e30   /* 2^100 */
#define DEGREES_BETWEEN_LOOKS 4

/* Degrees are done in runs of 2 RUN_VECTORS LANES: RUN_VECTORS vectors of even l - m, and of odd l - m. */
#ifndef RUN_VECTORS
#define RUN_VECTORS 4
#endif
#define RUN_DEGREES (2 * RUN_VECTORS * LANES)
#define TABLE_ROW (RUN_VECTORS * LANES)

/* Rings are done in units of so many vectors: each step of the recurrence waits for the one before, and in single
 * precision a vector of its doubles is two of the processor's. */
#if PRECISION == 64
#define RING_VECTORS 2
#else
#define RING_VECTORS 1
#endif
#define RING_UNIT (RING_VECTORS * LANES)

/* Rings below this (2^-40, 2^-70) in the last degree of a run count as zeros in all of it: towards the poles
 * Lambda_lm falls faster than exponentially, and grows with l. */
#if PRECISION == 64
#define NEGLIGIBLE 8.470329472543003e-22
#else
#define NEGLIGIBLE 9.094947017729282e-13
#endif

/* Of the rings of a work-group, between two runs: [ring] each. */
typedef struct ring_states {
    __global double *value, *difference;
    __global int *scale;
    __global const double *t;
} ring_states;

/* Recurrence from degree `first` on: [a, b, g][RUN_DEGREES] of degrees first + 1, ... */
static inline void make_coefficients(__local double *to, const uint first, const uint m) {
    for (uint i = own_item(); i < RUN_DEGREES; i += num_items()) {
        const double l = (double)(first + 1 + i), order = (double)m;
        const double g = sqrt((2 * l + 1) * (l + order) / ((2 * l - 1) * (l - order)));
        to[i] = g * (l - order - 1) / (l + order);
        to[RUN_DEGREES + i] = -g * (2 * l - 1) / (l + order);
        to[2 * RUN_DEGREES + i] = g;
    }
}

typedef struct lambda_state {
    doublev value, difference, t;
    intv scale;
} lambda_state;

/* Those above 1 that are scaled down so far come up. */
static inline void look(lambda_state *state) {
    const longv is_large = fabs(state->value) > (doublev)1 && TO_LONGV(state->scale) > (longv)0;
    const doublev factor = is_large ? (doublev)SCALE_DOWN : (doublev)1;
    state->value *= factor;
    state->difference *= factor;
    state->scale += PS_JOIN(convert_, PS_VECTOR(int))(is_large); /* true is -1 */
}

static inline realv shown(const lambda_state *state, const bool is_scaled) {
    if (is_scaled) {
        return TO_REALV(TO_LONGV(state->scale) > (longv)0 ? (doublev)0 : state->value);
    }
    return TO_REALV(state->value);
}

static inline void advance(lambda_state *state, __local const double *coefficients) {
    const doublev step = (doublev)coefficients[RUN_DEGREES] * state->t;
    const doublev rest = (doublev)coefficients[0] * state->difference;
    state->difference = fma(step, state->value, rest);
    state->value = fma((doublev)coefficients[2 * RUN_DEGREES], state->value, state->difference);
}

/* 2 LANES degrees of RING_UNIT rings: table [ring][degree] of even and of odd l - m. */
static inline __attribute__((always_inline)) void make_square(lambda_state *states,
                                                              __local const double *coefficients,
                                                              __local real *even, __local real *odd,
                                                              const bool is_scaled) {
    realv of_even[RING_VECTORS][LANES], of_odd[RING_VECTORS][LANES];
#pragma unroll
    for (int i = 0; i < LANES; i++) {
#pragma unroll
        for (int j = 0; j < RING_VECTORS; j++) {
            of_even[j][i] = shown(&states[j], is_scaled);
            advance(&states[j], coefficients + 2 * i);
        }
#pragma unroll
        for (int j = 0; j < RING_VECTORS; j++) {
            of_odd[j][i] = shown(&states[j], is_scaled);
            advance(&states[j], coefficients + 2 * i + 1);
            if (is_scaled && i % (DEGREES_BETWEEN_LOOKS / 2) == 1) {
                look(&states[j]);
            }
        }
    }
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        transpose(of_even[j]);
        transpose(of_odd[j]);
#pragma unroll
        for (int i = 0; i < LANES; i++) {
            store_local(even + (j * LANES + i) * TABLE_ROW, 0, of_even[j][i]);
            store_local(odd + (j * LANES + i) * TABLE_ROW, 0, of_odd[j][i]);
        }
    }
}

static inline bool is_more_than_zeros(const lambda_state *state) {
    return any(TO_LONGV(state->scale) <= (longv)0 &&
               fmax(fabs(state->value), fabs(state->difference)) > (doublev)NEGLIGIBLE) != 0;
}

/* A run of RING_UNIT rings from `ring` on, `vectors` of it; whether there is more than zeros in it. */
static inline bool make_run(const ring_states states, const uint ring,
                            __local const double *coefficients, __local real *even,
                            __local real *odd, const uint vectors) {
    lambda_state state[RING_VECTORS];
    bool is_scaled = false, is_there = false;
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        const uint at = ring + j * LANES;
        state[j].value = *(__global const unaligned_doublev *)(states.value + at);
        state[j].difference = *(__global const unaligned_doublev *)(states.difference + at);
        state[j].t = *(__global const unaligned_doublev *)(states.t + at);
        state[j].scale = *(__global const unaligned_intv *)(states.scale + at);
        is_scaled = is_scaled || any(TO_LONGV(state[j].scale) > (longv)0) != 0;
    }
    for (uint i = 0; i < vectors; i++) {
        if (is_scaled) {
            make_square(state, coefficients + 2 * LANES * i, even + LANES * i, odd + LANES * i,
                        true);
        } else {
            make_square(state, coefficients + 2 * LANES * i, even + LANES * i, odd + LANES * i,
                        false);
        }
    }
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        const uint at = ring + j * LANES;
        *(__global unaligned_doublev *)(states.value + at) = state[j].value;
        *(__global unaligned_doublev *)(states.difference + at) = state[j].difference;
        *(__global unaligned_intv *)(states.scale + at) = state[j].scale;
        is_there = is_there || is_more_than_zeros(&state[j]);
    }
    return is_there;
}

#endif
