/* From values on rings to sum_m |c_lm|^2, as orders_sum.cl, for one realization: nothing of
 * Lambda_lm is kept, and all sums are in double precision. Launch, numbers and buffers as there,
 * but for
 *
 *   values     of VALUE_PRECISION, written by a kernel of VALUE_LANES lanes
 *   num_realizations, sums  not looked at
 *   table      local, [even, odd l - m][degree of a run][re, im][LANES]: sums over rings
 *
 * PRECISION is 64 and LANES is 2 at least. One work-item of a group goes through the rings.
 */
#ifndef PRECISION
#define PRECISION 64
#endif
#include "sphere/nufft/numbers.h"
#include "sphere/nufft/orders_finish.h"
#include "sphere/nufft/orders_one.h"
#include "sphere/nufft/orders_work.h"
#include "sphere/values.h"

/* Numbers of the sums of a parity. */
#define SUM_NUMBERS (TABLE_ROW * 2 * LANES)

/* Sums over lanes of LANES degrees, part 0 or 1 of [re, im]. */
static inline doublev sum_lanes(__local const double *sums, const uint part) {
    doublev of[LANES], sum = (doublev)0;
#pragma unroll
    for (int i = 0; i < LANES; i++) {
        of[i] = load_doubles(sums + (2 * i + part) * LANES);
    }
    transpose(of);
#pragma unroll
    for (int i = 0; i < LANES; i++) {
        sum += of[i];
    }
    return sum;
}

/* What a run of degrees of a parity leaves. */
static inline void finish_run(__local const double *sums, __local const double *alphas,
                              __global double *powers, const size_t powers_apart,
                              const double weight, const bool is_lowest, const uint vectors) {
    for (uint v = 0; v < vectors; v++) {
        __local const double *from = sums + v * LANES * 2 * LANES;
        const doublev alpha = load_doubles(alphas + v * LANES);
        finish_sums(powers + v * LANES, powers_apart, weight, is_lowest, sum_lanes(from, 0) * alpha,
                    sum_lanes(from, 1) * alpha);
    }
}

/* All rings for a run of degrees; the first that is more than zeros. */
static inline uint add_rings(const ring_work work, __local const double *coefficients,
                             __global const value_real *values, const size_t values_apart,
                             __local double *sums, const uint even, const bool has_both,
                             const uint vectors) {
    uint begin = work.num_rings;
    for (uint i = 0; i < 2 * SUM_NUMBERS; i += LANES) {
        store_doubles(sums + i, (doublev)0);
    }
    for (uint ring = work.alive; ring < work.num_rings; ring += RING_UNIT) {
        const bool is_there =
            add_run(work.states, work.angles, ring, work.num_rings - ring, coefficients,
                    values + 2 * ring, values_apart, sums, SUM_NUMBERS, even, has_both, vectors);
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
    __local double *sums, __local double *coefficients, __local uint *begins) {
    const ring_numbers rings = numbers.rings;
    const uint L = rings.L, half_pitch = numbers.half_pitch, ring_pitch = rings.ring_pitch;
    const uint group = get_global_id(1), groups = get_global_size(1);
    const size_t parity_apart = 2 * (size_t)ring_pitch;
    const size_t powers_apart = 2 * (size_t)half_pitch;
    __global double *states = all_states + group * 4 * (size_t)ring_pitch;
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
    (void)unused_sums;
    for (uint m = group; m <= L; m += groups) {
        const uint even = m % 2; /* parity of l - m of even degrees */
        const bool has_both = rings.only_even == 0;
        __global const value_real *from =
            values + m * order_pitch(numbers.value_sets, parity_apart);
        begin_order(work, from_order, m, group, ring_pitch);
        for (uint first = m; first <= L; first += RUN_DEGREES) {
            const uint degrees = min(L + 1 - first, (uint)RUN_DEGREES);
            const uint vectors = (degrees + 2 * LANES - 1) / (2 * LANES);
            barrier_everywhere();
            make_coefficients(coefficients, first, m, 2 * LANES * vectors);
            if (own_item() == 0) {
                begins[0] = add_rings(work, coefficients, from, parity_apart, sums, even, has_both,
                                      vectors);
            }
            barrier_everywhere();
            for (uint odd = own_item(); odd < 2; odd += num_items()) {
                const uint in_parity = odd ? degrees / 2 : (degrees + 1) / 2;
#if KEEP
                __global double *to = powers + (m * 2 + odd) * powers_apart + (first - m) / 2;
#else
                __global double *to = powers + (first + odd) % 2 * half_pitch + (first + odd) / 2;
#endif
                if (has_both || odd == even) {
                    finish_run(sums + odd * SUM_NUMBERS,
                               coefficients + OF_ALPHA + odd * (RUN_DEGREES / 2), to,
                               KEEP ? half_pitch : powers_apart, m == 0 ? 1 : 2, m == group,
                               (in_parity + LANES - 1) / LANES);
                }
            }
        }
        barrier_everywhere();
        work.alive = begins[0] / RING_UNIT * RING_UNIT;
    }
}
