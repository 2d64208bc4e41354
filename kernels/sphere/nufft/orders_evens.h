/* Coefficients of the recurrences of orders_chains.h and orders_states.h for even l - m alone, as
 * orders_one.h wants them, and begins of orders. Device only. */
#ifndef PS_SPHERE_ORDERS_EVENS_H
#define PS_SPHERE_ORDERS_EVENS_H

#include "sphere/nufft/orders_states.h"

/* Of a run from degree `first` on, [..][TABLE_ROW] for l = first, first + 2, ... where nothing else
 * is said. */
#define EVEN_STEP 0                     /* A_l */
#define EVEN_POLE (1 * TABLE_ROW)       /* A_l (1 - D_l) */
#define EVEN_EQUATOR (2 * TABLE_ROW)    /* -A_l D_l */
#define EVEN_INVERSE (3 * TABLE_ROW)    /* 1 / alpha_l */
#define EVEN_DIFFERENCE (4 * TABLE_ROW) /* a_{l+1}, b_{l+1}, g_{l+1}, [..][RUN_DEGREES], all l */
#define EVEN_CHAIN (10 * TABLE_ROW)     /* alpha_l from l = first - 4 on, LANES more of them */
#define EVEN_ROOTS (12 * TABLE_ROW)     /* h_l from l = first - 2 on, as many */
#define EVEN_AHEAD 2
#define EVEN_ALPHA (EVEN_CHAIN + EVEN_AHEAD)

/* Numbers of coefficients as states are, LANES of them from number i of a row on. */
static inline void store_row(__local double *row, const uint i, const doublev x) {
#if STATE_PRECISION == 64
    store_doubles(row + i, x);
#else
    typedef float halfv __attribute__((ext_vector_type(LANES)));
    typedef halfv unaligned_halfv __attribute__((aligned(sizeof(float))));
    *(__local unaligned_halfv *)((__local float *)row + i) = PS_JOIN(convert_float, LANES)(x);
#endif
}

/* Degrees l, l + 2, ... */
static inline doublev every_second_from(const uint l) {
    return (doublev)(double)l + (doublev)2 * degrees_from(0);
}

/* h_l of `num` degrees from first - 2 on; of l < m + 2 nothing is asked. */
static inline void make_roots(__local double *roots, const int first, const double m,
                              const uint num) {
    const doublev one = (doublev)1, square = (doublev)(m * m);
    for (uint i = 0; i < num; i += LANES) {
        const doublev l = (doublev)(double)(first - 2 + 2 * (int)i) + (doublev)2 * degrees_from(0);
        const doublev a = l * l, b = (l - one) * (l - one);
        const doublev below = fma((doublev)4, a, -one) * fma((doublev)4, b, -one);
        store_doubles(roots + i, sqrt(fabs((a - square) * (b - square) / below)));
    }
}

/* alpha_l of `num` degrees behind the EVEN_AHEAD that are there, from h_l. */
static inline void make_alphas(__local double *chain, __local const double *roots, const uint first,
                               const uint m, const uint num) {
    for (uint i = 0; i < num; i += LANES) {
        const doublev ratio = -load_doubles(roots + i) / load_doubles(roots + i + 1);
        store_doubles(chain + EVEN_AHEAD + i, ratio);
    }
    for (uint i = 0; i < num; i++) {
        const double ratio = first + 2 * i < m + CHAIN_AHEAD ? 1 : chain[EVEN_AHEAD + i];
        chain[EVEN_AHEAD + i] = ratio * chain[i];
    }
}

static inline void make_even_steps(__local double *to, const uint first, const double m,
                                   const uint num) {
    const doublev order = (doublev)m, one = (doublev)1;
    for (uint i = 0; i < num; i += LANES) {
        const doublev l = every_second_from(first + 2 * i);
        const doublev alpha = load_doubles(to + EVEN_ALPHA + i);
        const doublev far = load_doubles(to + EVEN_ROOTS + 2 + i);
        const doublev step = alpha / (far * load_doubles(to + EVEN_ALPHA + 1 + i));
        const doublev diagonal = squared_ratio(l + one, order) + squared_ratio(l, order);
        store_row(to + EVEN_STEP, i, step);
        store_row(to + EVEN_POLE, i, step * (one - diagonal));
        store_row(to + EVEN_EQUATOR, i, -step * diagonal);
        store_row(to + EVEN_INVERSE, i, one / alpha);
    }
}

/* Of `num` degrees, even and odd ones. */
static inline void make_differences(__local double *to, const uint first, const double m,
                                    const uint num) {
    const doublev order = (doublev)m, one = (doublev)1, two = (doublev)2;
    for (uint i = 0; i < num; i += LANES) {
        const doublev l = degrees_from(first + i), twice = two * l;
        const doublev sum = l + one + order, difference = l + one - order;
        const doublev g = sqrt((twice + (doublev)3) * sum / ((twice + one) * difference));
        const doublev share = g / sum;
        store_row(to, i, share * (l - order));
        store_row(to, RUN_DEGREES + i, -share * (twice + one));
        store_row(to, 2 * RUN_DEGREES + i, g);
    }
}

/* All of a run of `vectors` vectors of even l - m, by one work-item. */
static inline void make_even_coefficients(__local double *to, const uint first, const uint m,
                                          const uint vectors) {
    __local double *chain = to + EVEN_CHAIN;
    const uint num = vectors * LANES;
    for (uint j = 0; j < EVEN_AHEAD; j++) {
        chain[j] = first == m ? 1 : chain[TABLE_ROW + j];
    }
    make_roots(to + EVEN_ROOTS, (int)first, m, num + 2 * LANES);
    make_alphas(chain, to + EVEN_ROOTS, first, m, num + LANES);
    make_even_steps(to, first, m, num);
    make_differences(to + EVEN_DIFFERENCE, first, m, 2 * num);
}

/* As begin_order of orders_work.h, of degree m alone, by one work-item. */
static inline void begin_even_order(const ring_work work, const order_starts from, const uint m,
                                    const uint group, const uint ring_pitch) {
    for (uint i = work.alive; i < ring_pitch; i += LANES) {
        doublev value;
        intv scale;
        if (m == group) {
            value = *(__global const unaligned_doublev *)(from.starts + group * ring_pitch + i);
            scale = *(__global const unaligned_intv *)(from.start_scales + group * ring_pitch + i);
        } else {
            value = *(__global const unaligned_doublev *)(work.diagonal + i) *
                    *(__global const unaligned_doublev *)(from.steps + i) * (doublev)from.ratios[m];
            scale = *(__global const unaligned_intv *)(work.diagonal_scales + i) +
                    *(__global const unaligned_intv *)(from.step_scales + i);
        }
        const longv is_small =
            value != (doublev)0 && fabs(value) < (doublev)SCALE_DOWN; /* true is -1 */
        value *= is_small ? (doublev)SCALE_UP : (doublev)1;
        scale -= TO_INTV(is_small);
        double values[LANES];
        int scales[LANES];
        *(unaligned_doublev *)values = value;
        *(unaligned_intv *)scales = scale;
        *(__global unaligned_doublev *)(work.diagonal + i) = value;
        *(__global unaligned_intv *)(work.diagonal_scales + i) = scale;
        for (uint lane = 0; lane < LANES; lane++) {
            work.states.value[i + lane] = values[lane];
            work.states.before[i + lane] = 0;
            work.states.scale[i + lane] = scales[lane];
        }
    }
}

#endif
