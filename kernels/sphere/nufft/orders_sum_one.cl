/* From values on rings to sum_m |c_lm|^2, as orders_sum.cl, for one realization: nothing of
 * Lambda_lm is kept, and all sums are in double precision. Launch, numbers and buffers as there,
 * but for
 *
 *   values     of VALUE_PRECISION, written by a kernel of VALUE_LANES lanes
 *   num_realizations, sums, begins  not looked at
 *   table      local, SUM_NUMBERS of orders_one.h: sums over rings
 *
 * PRECISION is 64 and LANES is 2 at least; PARITIES is 1 where only even degrees are wanted.
 */
#ifndef PRECISION
#define PRECISION 64
#endif
#include "sphere/nufft/numbers.h"
#include "sphere/nufft/orders_finish.h"
#include "sphere/nufft/orders_one.h"
#include "sphere/values.h"

/* Sums over lanes of LANES degrees, of a part. */
static inline doublev sum_lanes(__local const double *sums, const uint part) {
    doublev of[LANES], sum = (doublev)0;
#pragma unroll
    for (int i = 0; i < LANES; i++) {
        of[i] = LANES_OF(*(__local const unaligned_statev *)(sums + (PARTS * i + part) * LANES));
    }
    transpose(of);
#pragma unroll
    for (int i = 0; i < LANES; i++) {
        sum += of[i];
    }
    return sum;
}

/* From T_l of LANES degrees l, l + 2, ... to c_{l+1}, on from the c_{l-1} of the last call. */
static inline doublev go_up(const doublev sums, double *last, const doublev scales,
                            const doublev ratios) {
    double from[LANES], ratio[LANES];
    *(unaligned_doublev *)from = sums * scales;
    *(unaligned_doublev *)ratio = ratios;
    for (int i = 0; i < LANES; i++) {
        *last = fma(-ratio[i], *last, from[i]);
        from[i] = *last;
    }
    return *(unaligned_doublev *)from;
}

/* c_{l-1} of the last degree that there was. */
typedef struct odd_degree {
    double re, im;
} odd_degree;

/* Where what an order leaves goes, of even and of odd l - m. */
typedef struct order_powers {
    __global double *of[2];
    size_t apart;
    double weight;
    bool is_lowest;
} order_powers;

/* Are these of even (0) or odd (1) l - m wanted, where `own` is the only parity unless both are? */
static inline bool is_wanted(const uint parity, const uint own) {
    const bool is_only = PARITIES == 1;
    return !is_only || parity == own;
}

/* What a run of degrees from `first` on leaves, `vectors` of LANES even l - m; of odd ones there
 * may be one vector less. */
static inline void finish_run(const order_powers to, __local const double *sums,
                              __local const double *alphas, odd_degree *last, const uint first,
                              const uint m, const uint parity, const uint degrees) {
    const doublev order = (doublev)(double)m, one = (doublev)1;
    for (uint v = 0; 2 * LANES * v < degrees; v++) {
        __local const double *from = sums + v * LANES * PARTS * LANES;
        const doublev alpha = load_doubles(alphas + v * LANES);
        if (is_wanted(0, parity)) {
            finish_sums(to.of[0] + v * LANES, to.apart, to.weight, to.is_lowest,
                        sum_lanes(from, 0) * alpha, sum_lanes(from, 1) * alpha);
        }
        if (2 * LANES * v + 1 < degrees && is_wanted(1, parity)) {
            const doublev l = every_second_from(first + 2 * LANES * v);
            const doublev above = squared_ratio(l + one, order);
            const doublev ratio = sqrt(squared_ratio(l, order) / above);
            const doublev scale = alpha / sqrt(above);
            const doublev re = go_up(sum_lanes(from, PARTS - 2), &last->re, scale, ratio);
            const doublev im = go_up(sum_lanes(from, PARTS - 1), &last->im, scale, ratio);
            finish_sums(to.of[1] + v * LANES, to.apart, to.weight, to.is_lowest, re, im);
        }
    }
}

/* All rings for a run of degrees; the first that is more than zeros. */
static inline uint add_rings(const ring_work work, __local const double *coefficients,
                             const order_values values, __local double *sums, const uint vectors) {
    uint begin = work.num_rings;
    for (uint i = 0; i < SUM_NUMBERS; i += LANES) {
        store_doubles(sums + i, (doublev)0);
    }
    for (uint ring = work.alive; ring < work.num_rings; ring += ONE_UNIT) {
        const bool is_there = add_run(work.states, work.angles, ring, work.num_rings - ring,
                                      coefficients, values, sums, vectors);
        begin = is_there ? min(begin, ring) : begin;
    }
    return begin;
}

__kernel void sphere_orders_sum_one(
    const orders_sum_numbers numbers, __global const value_real *restrict values,
    __global const double *restrict starts, __global const int *restrict start_scales,
    __global const double *restrict steps, __global const int *restrict step_scales,
    __global const double *restrict ratios, __global const double *restrict cosines,
    __global const double *restrict distances, __global const double *restrict squares,
    __global double *restrict all_states, __global int *restrict all_scales,
    __global double *restrict all_diagonals, __global int *restrict all_diagonal_scales,
    __global double *restrict unused_sums, __global double *restrict all_powers,
    __local double *sums, __local double *coefficients, __local uint *unused_begins) {
    const ring_numbers rings = numbers.rings;
    const uint L = rings.L, half_pitch = numbers.half_pitch, ring_pitch = rings.ring_pitch;
    const uint group = get_global_id(1), groups = get_global_size(1);
    const size_t parity_apart = 2 * (size_t)ring_pitch;
    const size_t powers_apart = 2 * (size_t)half_pitch;
    __global state_real *states =
        (__global state_real *)(all_states + group * 4 * (size_t)ring_pitch);
    __global double *powers = all_powers + (KEEP ? 0 : group * powers_apart);
    ring_work work = {
        {states, states + parity_apart, all_scales + group * parity_apart, ring_pitch},
        {distances, squares, rings.polar, rings.crossing, rings.equatorial},
        all_diagonals + group * (size_t)ring_pitch,
        all_diagonal_scales + group * (size_t)ring_pitch,
        rings.num_rings,
        rings.block,
        0};
    const order_starts from_order = {starts, start_scales, steps, step_scales, ratios, cosines};
    (void)unused_sums, (void)unused_begins;
    for (uint m = group; m <= L; m += groups) {
        const uint even = m % 2; /* parity of l - m of even degrees */
        const order_values from = {values + m * order_pitch(numbers.value_sets, parity_apart),
                                   parity_apart, cosines, even, rings.lead};
        odd_degree last = {0, 0};
        uint begin = 0;
        begin_even_order(work, from_order, m, group, ring_pitch);
        for (uint first = m; first <= L; first += RUN_DEGREES) {
            const uint degrees = min(L + 1 - first, (uint)RUN_DEGREES);
            const uint vectors = (degrees + 2 * LANES - 1) / (2 * LANES);
#if KEEP
            __global double *of_even = powers + m * 2 * powers_apart + (first - m) / 2;
            const order_powers to = {{of_even, of_even + powers_apart}, half_pitch, 1, true};
#else
            const order_powers to = {{powers + first % 2 * half_pitch + first / 2,
                                      powers + (first + 1) % 2 * half_pitch + (first + 1) / 2},
                                     powers_apart,
                                     m == 0 ? 1 : 2,
                                     m == group};
#endif
            make_even_coefficients(coefficients, first, m, vectors);
            begin = add_rings(work, coefficients, from, sums, vectors);
            finish_run(to, sums, coefficients + EVEN_ALPHA, &last, first, m, even, degrees);
        }
        work.alive = begin / ONE_UNIT * ONE_UNIT;
    }
}
