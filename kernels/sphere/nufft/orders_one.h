/* Lambda_lm of a run of degrees times the values of one realization on RING_UNIT rings, without a
 * table: lanes are rings, so that a number of Lambda_lm is used where it is made. Device only.
 *
 * All in double precision, whatever the values are: taking Lambda_lm to single precision costs what
 * a product does.
 */
#ifndef PS_SPHERE_ORDERS_ONE_H
#define PS_SPHERE_ORDERS_ONE_H

#include "sphere/nufft/orders_states.h"

#ifndef VALUE_PRECISION
#define VALUE_PRECISION 64
#endif
#if VALUE_PRECISION == 64
typedef double value_real;
#else
typedef float value_real;
#endif
typedef value_real unaligned_values
    __attribute__((ext_vector_type(LANES), aligned(sizeof(value_real))));

/* Of RING_UNIT rings. */
typedef struct ring_values {
    doublev re[RING_VECTORS], im[RING_VECTORS];
} ring_values;

/* From [ring][re, im]; behind the last of `num` rings there are zeros. */
static inline __attribute__((always_inline)) void
load_values(ring_values *to, __global const value_real *from, const uint num) {
    double re[RING_UNIT], im[RING_UNIT];
    if (num >= RING_UNIT) {
#pragma unroll
        for (int j = 0; j < RING_VECTORS; j++) {
            __global const unaligned_values *at =
                (__global const unaligned_values *)(from + 2 * LANES * j);
            const doublev first = TO_DOUBLEV(at[0]), second = TO_DOUBLEV(at[1]);
            to->re[j] = (doublev)(first.even, second.even);
            to->im[j] = (doublev)(first.odd, second.odd);
        }
        return;
    }
    for (uint i = 0; i < RING_UNIT; i++) {
        re[i] = i < num ? from[2 * i] : 0;
        im[i] = i < num ? from[2 * i + 1] : 0;
    }
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        to->re[j] = *(const unaligned_doublev *)(re + LANES * j);
        to->im[j] = *(const unaligned_doublev *)(im + LANES * j);
    }
}

/* To the sums of a degree, [re, im][LANES]. */
static inline __attribute__((always_inline)) void
add_degree(__local double *sums, const doublev *lambda, const ring_values *values) {
    doublev re = load_doubles(sums), im = load_doubles(sums + LANES);
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        re = fma(lambda[j], values->re[j], re);
        im = fma(lambda[j], values->im[j], im);
    }
    store_doubles(sums, re);
    store_doubles(sums + LANES, im);
}

/* LANES degrees of one parity. */
static inline __attribute__((always_inline)) void
add_degrees(chain_state *states, const doublev *squares, const ring_values *values,
            __local const double *steps, __local const double *rests, __local double *sums,
            const bool is_scaled) {
#pragma unroll
    for (int i = 0; i < LANES; i++) {
        doublev lambda[RING_VECTORS];
#pragma unroll
        for (int j = 0; j < RING_VECTORS; j++) {
            lambda[j] = shown(&states[j], is_scaled);
            advance(&states[j], squares[j], steps[2 * i], rests[2 * i]);
            if (is_scaled && i % (DEGREES_BETWEEN_LOOKS / 2) == 1) {
                look(&states[j]);
            }
        }
        add_degree(sums + i * 2 * LANES, lambda, values);
    }
}

/* `vectors` vectors of degrees of a parity, to sums [degree][re, im][LANES]; whether there is more
 * than zeros. */
static inline bool add_chain_run(const ring_states states, const ring_angles angles,
                                 const uint parity, const uint ring,
                                 __local const double *coefficients, const ring_values *values,
                                 __local double *sums, const uint vectors) {
    __local const double *steps = coefficients + OF_STEP + parity;
    __local const double *rests =
        coefficients + (ring < angles.crossing ? OF_POLE : OF_EQUATOR) + parity;
    chain_state state[RING_VECTORS];
    doublev squares[RING_VECTORS];
    bool is_scaled;
    const bool is_there = begin_chain(state, squares, &is_scaled, states, angles, parity, ring,
                                      steps, rests, 2 * LANES * vectors);
    if (is_there && is_scaled) {
        for (uint i = 0; i < vectors; i++) {
            add_degrees(state, squares, values, steps + 2 * LANES * i, rests + 2 * LANES * i,
                        sums + i * LANES * 2 * LANES, true);
        }
    } else if (is_there) {
        for (uint i = 0; i < vectors; i++) {
            add_degrees(state, squares, values, steps + 2 * LANES * i, rests + 2 * LANES * i,
                        sums + i * LANES * 2 * LANES, false);
        }
    }
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        store_state(states, &state[j], parity, ring + j * LANES);
    }
    return is_there;
}

/* By differences, both parities: sums of the odd degrees are `apart` numbers behind those of the
 * even ones. */
static inline bool add_difference_run(const ring_states states, const ring_angles angles,
                                      const uint ring, __local const double *coefficients,
                                      const ring_values *values, __local double *sums,
                                      const size_t apart, const uint vectors) {
    chain_state state[RING_VECTORS];
    doublev t[RING_VECTORS], lambda[RING_VECTORS];
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        load_state(&state[j], states, 0, ring + j * LANES);
        t[j] = *(__global const unaligned_doublev *)(angles.distances + ring + j * LANES);
    }
    for (uint i = 0; i < 2 * LANES * vectors; i++) {
        const doublev inverse = (doublev)coefficients[OF_INVERSE + i];
        const uint odd = i % 2;
#pragma unroll
        for (int j = 0; j < RING_VECTORS; j++) {
            lambda[j] = shown(&state[j], true) * inverse;
            advance_difference(&state[j], t[j], coefficients + OF_DIFFERENCE + i);
            if (i % DEGREES_BETWEEN_LOOKS == DEGREES_BETWEEN_LOOKS - 1) {
                look(&state[j]);
            }
        }
        add_degree(sums + odd * apart + i / 2 * 2 * LANES, lambda, &values[odd]);
    }
#pragma unroll
    for (int j = 0; j < RING_VECTORS; j++) {
        store_state(states, &state[j], 0, ring + j * LANES);
    }
    return is_more_than_zeros(state);
}

/* A run of RING_UNIT rings from `ring` on, of the parities that are wanted; whether there is more
 * than zeros in it, by that of even degrees alone, so that rings go on or not whether others are
 * wanted or not. values: of the even ones of the first ring, those of the odd ones
 * `values_apart` numbers behind; num: of rings that are left. */
static inline bool add_run(const ring_states states, const ring_angles angles, const uint ring,
                           const uint num, __local const double *coefficients,
                           __global const value_real *values, const size_t values_apart,
                           __local double *sums, const size_t apart, const uint even,
                           const bool has_both, const uint vectors) {
    ring_values both[2];
    bool is_there = false;
    load_values(&both[0], values, num);
    load_values(&both[1], values + values_apart, num);
    if (ring < angles.polar || ring >= angles.equatorial) {
        return add_difference_run(states, angles, ring, coefficients, both, sums, apart, vectors);
    }
    for (uint parity = 0; parity < 2; parity++) {
        if (has_both || parity == even) {
            const bool has_more = add_chain_run(states, angles, parity, ring, coefficients,
                                                &both[parity], sums + parity * apart, vectors);
            is_there = parity == even ? has_more : is_there;
        }
    }
    return is_there;
}

#endif
