/* Lambda_lm of a run of degrees times the values of one realization on ONE_UNIT rings, without a
 * table: lanes are rings, so that a number of Lambda_lm is used where it is made. Device only.
 *
 * Only even l - m are made. Since cos(theta) Lambda_l = e_{l+1} Lambda_{l+1} + e_l Lambda_{l-1},
 * sums T_l of Lambda_l times cos(theta) and the values of odd l - m give the coefficients of these,
 *
 *     c_{l+1} = (T_l - e_l c_{l-1}) / e_{l+1},
 *
 * so that a number of Lambda_lm is used four times, not twice. e_l / e_{l+1} < 1: an error of T_l
 * comes back in each later degree as large as it was at most, with turning sign, and rounding of T
 * is u.
 *
 * In double precision, whatever the values are: taking Lambda_lm to single precision costs what a
 * product does. Where the tolerance allows it (STATE_PRECISION 32), Lambda_lm and sums of a run are
 * floats, twice as many to a vector; what comes of them, and coefficients, are doubles.
 */
#ifndef PS_SPHERE_ORDERS_ONE_H
#define PS_SPHERE_ORDERS_ONE_H

#include "sphere/nufft/orders_evens.h"

#if VALUE_PRECISION == 64
typedef double value_real;
#else
typedef float value_real;
#endif
typedef value_real valuev __attribute__((ext_vector_type(STATE_LANES)));
typedef valuev unaligned_valuev __attribute__((aligned(sizeof(value_real))));
#if STATE_PRECISION == 64
#define TO_STATEV(x) TO_DOUBLEV(x)
#define LANES_OF(x) (x)
#else
#define TO_STATEV(x) (x)
#define LANES_OF(x) (TO_DOUBLEV((x).lo) + TO_DOUBLEV((x).hi))
#endif

/* Rings of a unit. */
#define ONE_UNIT (RING_VECTORS * STATE_LANES)

/* STATE_LANES numbers of rings. */
static inline statev load_rings(__global const double *from) {
#if STATE_PRECISION == 64
    return *(__global const unaligned_doublev *)from;
#else
    return (
        statev)(PS_JOIN(convert_float, LANES)(*(__global const unaligned_doublev *)from),
                PS_JOIN(convert_float, LANES)(*(__global const unaligned_doublev *)(from + LANES)));
#endif
}

/* What sums of a degree there are: [those of even l - m, of odd l - m][re, im]; one of the two
 * where only even degrees are wanted. */
#ifndef PARITIES
#define PARITIES 2
#endif
#define PARTS (2 * PARITIES)
#define SUM_NUMBERS (TABLE_ROW * PARTS * LANES)

/* Of ONE_UNIT rings; those of odd l - m are times cos(theta). */
typedef struct ring_values {
    statev of[RING_VECTORS][PARTS];
} ring_values;

/* Of one parity from [ring][re, im], times `factors` unless that is NULL; there are `lead` zeros
 * before the first of `num` rings, and zeros behind the last. */
static inline __attribute__((always_inline)) void load_values(ring_values *to, const uint part,
                                                              __global const value_real *from,
                                                              const uint lead, const uint num,
                                                              __global const double *factors) {
    const bool is_whole = lead == 0 && num >= ONE_UNIT;
    state_real re[ONE_UNIT], im[ONE_UNIT];
    for (uint i = 0; !is_whole && i < ONE_UNIT; i++) {
        const bool is_there = i >= lead && i - lead < num;
        re[i] = is_there ? from[2 * (i - lead)] : 0;
        im[i] = is_there ? from[2 * (i - lead) + 1] : 0;
    }
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        const statev factor = factors != 0 ? load_rings(factors + j * STATE_LANES) : (statev)1;
        if (is_whole) {
            __global const unaligned_valuev *at =
                (__global const unaligned_valuev *)(from + 2 * STATE_LANES * j);
            const statev first = TO_STATEV(at[0]), second = TO_STATEV(at[1]);
            to->of[j][part] = factor * (statev)(first.even, second.even);
            to->of[j][part + 1] = factor * (statev)(first.odd, second.odd);
        } else {
            to->of[j][part] = factor * *(const unaligned_statev *)(re + STATE_LANES * j);
            to->of[j][part + 1] = factor * *(const unaligned_statev *)(im + STATE_LANES * j);
        }
    }
}

/* To the sums of a degree, [part][LANES]. */
static inline __attribute__((always_inline)) void
add_degree(__local double *sums, const statev *lambda, const ring_values *values) {
#pragma unroll
    for (int part = 0; part < PARTS; part++) {
        __local unaligned_statev *at = (__local unaligned_statev *)(sums + part * LANES);
        statev sum = *at;
#pragma unroll
        for (int j = 0; j < RING_VECTORS; j++) {
            sum = fma(lambda[j], values->of[j][part], sum);
        }
        *at = sum;
    }
}

/* Numbers grow by some 2^30 at most meanwhile: from l = m on by 17 sqrt(s / k) in the k-th degree
 * of a ring that is scaled down s times. */
#define EVENS_BETWEEN_LOOKS 4

/* LANES degrees. */
static inline __attribute__((always_inline)) void
add_degrees(chain_state *states, const statev *squares, const ring_values *values,
            __local const state_real *steps, __local const state_real *rests, __local double *sums,
            const bool is_scaled) {
#pragma unroll
    for (int i = 0; i < LANES; i++) {
        const bool is_time = i % EVENS_BETWEEN_LOOKS == EVENS_BETWEEN_LOOKS - 1 || i == LANES - 1;
        statev lambda[RING_VECTORS];
#pragma unroll
        for (int j = 0; j < RING_VECTORS; j++) {
            lambda[j] = shown(&states[j], is_scaled);
            advance(&states[j], squares[j], steps[i], rests[i]);
            if (is_scaled && is_time) {
                look(&states[j]);
            }
        }
        add_degree(sums + i * PARTS * LANES, lambda, values);
    }
}

/* Rings that begin as zeros are tried first, since most of them end so, too: then nothing is to be
 * added. Those of a unit that has more are not tried, since Lambda_lm does not vanish again. */
static inline bool is_worth_adding(chain_state *states, const statev *squares,
                                   __local const state_real *steps, __local const state_real *rests,
                                   const uint num) {
    chain_state trial[RING_VECTORS];
    if (is_more_than_zeros(states)) {
        return true;
    }
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        trial[j] = states[j];
    }
    const bool is_there = try_chain(trial, squares, steps, rests, num, 1);
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        states[j] = is_there ? states[j] : trial[j];
    }
    return is_there;
}

/* `vectors` vectors of degrees, to sums [degree][part][LANES]; whether there is more than zeros. */
static inline bool add_chain_run(const ring_states states, const ring_angles angles,
                                 const uint ring, __local const double *coefficients,
                                 const ring_values *values, __local double *sums,
                                 const uint vectors) {
    __local const state_real *steps = (__local const state_real *)(coefficients + EVEN_STEP);
    __local const state_real *rests =
        (__local const state_real *)(coefficients +
                                     (ring < angles.crossing ? EVEN_POLE : EVEN_EQUATOR));
    chain_state state[RING_VECTORS];
    statev squares[RING_VECTORS];
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        load_state(&state[j], states, 0, ring + j * STATE_LANES);
        squares[j] = load_rings(angles.squares + ring + j * STATE_LANES);
    }
    const bool is_there = is_worth_adding(state, squares, steps, rests, vectors * LANES);
    bool is_scaled = is_scaled_down(state);
    for (uint i = 0; is_there && i < vectors * LANES; i += LANES) {
        if (is_scaled) {
            add_degrees(state, squares, values, steps + i, rests + i, sums + i * PARTS * LANES,
                        true);
            is_scaled = is_scaled_down(state);
        } else {
            add_degrees(state, squares, values, steps + i, rests + i, sums + i * PARTS * LANES,
                        false);
        }
    }
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        store_state(states, &state[j], 0, ring + j * STATE_LANES);
    }
    return is_there;
}

/* By differences, which go through all degrees. */
static inline __attribute__((always_inline)) void
add_by_differences(chain_state *state, const statev *t, __local const double *coefficients,
                   const ring_values *values, __local double *sums, const uint num,
                   const bool is_scaled) {
    __local const state_real *inverses = (__local const state_real *)(coefficients + EVEN_INVERSE);
    for (uint i = 0; i < num; i++) {
        __local const state_real *differences =
            (__local const state_real *)(coefficients + EVEN_DIFFERENCE) + 2 * i;
        const statev inverse = (statev)inverses[i];
        statev lambda[RING_VECTORS];
#pragma unroll
        for (int j = 0; j < RING_VECTORS; j++) {
            lambda[j] = shown(&state[j], is_scaled) * inverse;
            advance_difference(&state[j], t[j], differences);
            advance_difference(&state[j], t[j], differences + 1);
            if (is_scaled && i % 2 == 1) {
                look(&state[j]);
            }
        }
        add_degree(sums + i * PARTS * LANES, lambda, values);
    }
}

static inline bool add_difference_run(const ring_states states, const ring_angles angles,
                                      const uint ring, __local const double *coefficients,
                                      const ring_values *values, __local double *sums,
                                      const uint vectors) {
    chain_state state[RING_VECTORS];
    statev t[RING_VECTORS];
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        load_state(&state[j], states, 0, ring + j * STATE_LANES);
        t[j] = load_rings(angles.distances + ring + j * STATE_LANES);
    }
    if (is_scaled_down(state)) {
        add_by_differences(state, t, coefficients, values, sums, vectors * LANES, true);
    } else {
        add_by_differences(state, t, coefficients, values, sums, vectors * LANES, false);
    }
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        store_state(states, &state[j], 0, ring + j * STATE_LANES);
    }
    return is_more_than_zeros(state);
}

/* Where the values of an order are: those of odd l - m lie parity_apart behind those of even ones.
 * Of one parity, it is `parity`. */
typedef struct order_values {
    __global const value_real *from;
    size_t parity_apart;
    __global const double *cosines;
    uint parity, lead; /* lead: rings before the first value */
} order_values;

/* A run of ONE_UNIT rings from `ring` on, `num` of which are there; whether there is more than
 * zeros in it. */
static inline bool add_run(const ring_states states, const ring_angles angles, const uint ring,
                           const uint num, __local const double *coefficients,
                           const order_values from, __local double *sums, const uint vectors) {
    const uint lead = ring < from.lead ? from.lead - ring : 0;
    const uint first = ring < from.lead ? 0 : ring - from.lead;
    ring_values values;
#pragma unroll
    for (uint i = 0; i < PARITIES; i++) {
        const uint parity = PARITIES == 2 ? i : from.parity;
        load_values(&values, 2 * i, from.from + parity * from.parity_apart + 2 * first, lead,
                    num - lead, parity != 0 ? from.cosines + ring : 0);
    }
    return ring < angles.polar || ring >= angles.equatorial
               ? add_difference_run(states, angles, ring, coefficients, &values, sums, vectors)
               : add_chain_run(states, angles, ring, coefficients, &values, sums, vectors);
}

#endif
