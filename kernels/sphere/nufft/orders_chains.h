/* Lambda_lm of one parity of l - m, by a recurrence over every second degree. Device only.
 *
 *     cos^2(theta) Lambda_l = h_{l+2} Lambda_{l+2} + D_l Lambda_l + h_l Lambda_{l-2},
 *     e_l^2 = (l^2 - m^2) / (4 l^2 - 1),   h_l = e_l e_{l-1},   D_l = e_{l+1}^2 + e_l^2
 *
 * With Lambda_l = alpha_l p_l, alpha_l = -(h_{l-2} / h_l) alpha_{l-4} and alpha = 1 for the first
 * two of a parity, a degree takes two fused operations,
 *
 *     p_{l+2} = (A_l cos^2(theta) - A_l D_l) p_l + p_{l-2},   A_l = alpha_l / (h_{l+2} alpha_{l+2}),
 *
 * and sums over rings take alpha_l at the end. A degree's alpha is between 1 and about 1 / sqrt(m).
 *
 * The bracket is A_l (1 - D_l) - A_l sin^2(theta) towards the pole, so that it keeps its digits
 * there. At the pole and at the equator themselves, where it is close to 2 and to -2, errors of it
 * still grow with L^2: the first and the last rings have the recurrence of differences
 * (orders_states.h). At L = 2000 Lambda_lm would be off by 4e-14 to 1e-13 without them, depending
 * on the order, in the mean over rings of white sets; by differences everywhere by 3e-14.
 *
 * In double precision, whatever is summed: in single precision the recurrence is off by 6e-5 at l =
 * 512. Numbers have scales (scales.h). LANES is 2 at least.
 */
#ifndef PS_SPHERE_ORDERS_CHAINS_H
#define PS_SPHERE_ORDERS_CHAINS_H

#include "shared/lanes.h"
#include "shared/transpose.h"
#include "sphere/doubles.h"
#include "sphere/nufft/scales.h"

/* Degrees are done in runs of 2 RUN_VECTORS LANES: RUN_VECTORS vectors of even l - m, and of odd l
 * - m. */
#ifndef RUN_VECTORS
#define RUN_VECTORS 4
#endif
#define RUN_DEGREES (2 * RUN_VECTORS * LANES)
#define TABLE_ROW (RUN_VECTORS * LANES)

/* Rings are done in units of so many vectors: each step of the recurrence waits for the one before,
 * and in single precision a vector of its doubles is two of the processor's. */
#ifndef RING_VECTORS
#if PRECISION == 64
#define RING_VECTORS 2
#else
#define RING_VECTORS 1
#endif
#endif
#define RING_UNIT (RING_VECTORS * LANES)

/* Rings below this (2^-40, 2^-70) in the last degrees of a run count as zeros in all of it: towards
 * the poles Lambda_lm falls faster than exponentially, and grows with l. */
#ifndef VALUE_PRECISION /* the same, unless a kernel says */
#define VALUE_PRECISION PRECISION
#endif
#if VALUE_PRECISION == 64
#define NEGLIGIBLE 8.470329472543003e-22
#else
#define NEGLIGIBLE 9.094947017729282e-13
#endif

/* ---- coefficients of a run ------------------------------------------------------------------ */

/* Coefficients of degrees first, first + 1, ... [..][RUN_DEGREES], but for alphas. */
#define OF_STEP 0                    /* A_l */
#define OF_POLE (1 * RUN_DEGREES)    /* A_l (1 - D_l) */
#define OF_EQUATOR (2 * RUN_DEGREES) /* -A_l D_l */
#define OF_DIFFERENCE                                                                              \
    (3 * RUN_DEGREES) /* a_{l+1}, b_{l+1}, g_{l+1} of orders_states.h, and 1 / alpha_l */
#define OF_INVERSE (6 * RUN_DEGREES)
#define OF_ALPHA (7 * RUN_DEGREES) /* alpha_l of even l - m, then of odd */
#define OF_CHAIN                                                                                   \
    (8 * RUN_DEGREES) /* alpha of degrees first - 2, ...: those of the last run go on */
#define CHAIN_AHEAD 4 /* more alphas than degrees */
#define COEFFICIENTS (9 * RUN_DEGREES + CHAIN_AHEAD)

static inline void store_doubles(__local double *to, const doublev x) {
    *(__local unaligned_doublev *)to = x;
}

static inline doublev load_doubles(__local const double *from) {
    return *(__local const unaligned_doublev *)from;
}

/* Degrees l, l + 1, ... */
static inline doublev degrees_from(const uint l) {
    int lanes[LANES];
    for (int i = 0; i < LANES; i++) {
        lanes[i] = (int)l + i;
    }
    return TO_DOUBLEV(*(unaligned_intv *)lanes);
}

/* e_l^2; of l = m 0. */
static inline doublev squared_ratio(const doublev l, const doublev m) {
    return (l - m) * (l + m) / (((doublev)2 * l - (doublev)1) * ((doublev)2 * l + (doublev)1));
}

/* alpha_l over alpha_{l-4} in place of the alphas of `num` degrees from first + 2 on. Those that
 * have none in front of them begin with 1, as the four before the run do. */
static inline void make_alpha_ratios(__local double *chain, const uint first, const uint m,
                                     const uint num) {
    const doublev order = (doublev)(double)m, one = (doublev)1;
    for (uint i = 0; i < num; i += LANES) {
        const doublev l = degrees_from(first + 2 + i);
        const doublev here = squared_ratio(l, order) * squared_ratio(l - one, order);
        const doublev below =
            squared_ratio(l - (doublev)2, order) * squared_ratio(l - (doublev)3, order);
        const doublev ratio = -sqrt(below / here);
        store_doubles(chain + CHAIN_AHEAD + i, l < order + (doublev)CHAIN_AHEAD ? one : ratio);
    }
}

/* Along the chain. */
static inline void multiply_alphas(__local double *chain, const uint num) {
    double last[CHAIN_AHEAD];
    for (uint j = 0; j < CHAIN_AHEAD; j++) {
        last[j] = chain[j];
    }
    for (uint i = CHAIN_AHEAD; i < num + CHAIN_AHEAD; i += CHAIN_AHEAD) {
        for (uint j = 0; j < CHAIN_AHEAD; j++) {
            last[j] *= chain[i + j];
            chain[i + j] = last[j];
        }
    }
}

/* What is left once alphas are there. chain[2] is alpha_first. */
static inline void make_steps(__local double *to, const uint first, const uint m, const uint num) {
    const doublev order = (doublev)(double)m, one = (doublev)1, two = (doublev)2;
    __local const double *alpha = to + OF_CHAIN + 2;
    for (uint i = 0; i < num; i += LANES) {
        const doublev l = degrees_from(first + i), next = l + one;
        const doublev above = squared_ratio(next, order);
        const doublev diagonal = above + squared_ratio(l, order);
        const doublev inverse = one / load_doubles(alpha + i);
        const doublev far = squared_ratio(l + two, order) * above;
        const doublev step = load_doubles(alpha + i) / (load_doubles(alpha + 2 + i) * sqrt(far));
        const doublev g =
            sqrt((two * l + (doublev)3) * (next + order) / ((two * l + one) * (next - order)));
        store_doubles(to + OF_STEP + i, step);
        store_doubles(to + OF_POLE + i, step * (one - diagonal));
        store_doubles(to + OF_EQUATOR + i, -step * diagonal);
        store_doubles(to + OF_DIFFERENCE + i, g * (l - order) / (next + order));
        store_doubles(to + OF_DIFFERENCE + RUN_DEGREES + i, -g * (two * l + one) / (next + order));
        store_doubles(to + OF_DIFFERENCE + 2 * RUN_DEGREES + i, g);
        store_doubles(to + OF_INVERSE + i, inverse);
        for (uint lane = i; lane < i + LANES; lane++) {
            to[OF_ALPHA + lane % 2 * (RUN_DEGREES / 2) + lane / 2] = alpha[lane];
        }
    }
}

/* Makes those of `num` degrees, a multiple of 2 LANES, from `first` on. */
static inline void make_coefficients(__local double *to, const uint first, const uint m,
                                     const uint num) {
    for (uint j = 0; j < CHAIN_AHEAD; j++) {
        to[OF_CHAIN + j] = first == m ? 1 : to[OF_CHAIN + RUN_DEGREES + j];
    }
    make_alpha_ratios(to + OF_CHAIN, first, m, num);
    multiply_alphas(to + OF_CHAIN, num);
    make_steps(to, first, m, num);
}

#endif
