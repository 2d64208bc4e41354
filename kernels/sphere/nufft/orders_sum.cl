/* From values on rings to sum_m |c_lm|^2, as CPUs want it (GPUs: degrees.cl). A work-group has the
 * orders that are its number modulo the number of groups, so that what it adds up does not depend
 * on the device. For each order, Lambda_lm is made for a run of degrees and a block of rings at a
 * time, and used by all realizations, two by two. Launch: (1, groups) in work-groups of one item.
 *
 *   numbers    of numbers.h; their names are used here
 *   values     [order][value_sets, realizations][even, odd l - m][ring_pitch][re, im] of orders.cl: side by side, so
 *              that what an order needs comes in a row
 *   starts, start_scales  [group][ring_pitch]: Lambda_mm of the first order of a group (orders_chains.h), 0 behind the
 *              last ring
 *   steps, step_scales    [ring_pitch]: sin^groups(theta)
 *   ratios     [order]: norm of Lambda_mm over that of the order `groups` below, with the sign of both
 *   cosines    [ring_pitch]: cos(theta)
 *   distances, squares  ring_angles of orders_states.h
 *   states, scales  [group][2][even, odd l - m][ring_pitch], [group][2][ring_pitch]: scratch
 *   diagonal, diagonal_scales  [group][ring_pitch]: scratch
 *   sums       [group][pair of realizations][even, odd l - m][2][RUN_VECTORS][re, im][LANES]: scratch, room for one
 *              realization more
 *   powers     [group][realization][even, odd degrees][half_pitch], of degrees from the group on; half_pitch has room
 *              for RUN_VECTORS vectors behind degree L / 2. With KEEP coefficients of one realization,
 *              [order][even, odd l - m][re, im][half_pitch]
 *   table      local, [even, odd l - m][block][TABLE_ROW]
 *   coefficients  local, [COEFFICIENTS]
 *   begins     local, [block / RING_UNIT]
 */
#include "sphere/nufft/numbers.h"
#include "sphere/nufft/orders_product.h"
#include "sphere/nufft/orders_work.h"
#include "sphere/values.h"

/* Products of all realizations with a run of degrees at some rings. */
typedef struct run_products {
    product_rows rows; /* of even l - m; odd ones come odd_apart further in the table */
    __global const real *values;
    size_t apart; /* of realizations, twice that of parities, in values */
    uint odd_apart;
    __global real *sums;
    __global double *powers; /* of all degrees; with KEEP of even l - m of the run */
    uint half_pitch;
    uint first, degrees; /* of the run */
    uint num_realizations;
} run_products;

/* Realizations r and r + 1. */
static inline void add_products(const run_products of, const uint r, const uint odd) {
    const uint in_parity = odd ? of.degrees / 2 : (of.degrees + 1) / 2;
    const uint vectors = (in_parity + LANES - 1) / LANES;
    if (vectors == 0 || r >= of.num_realizations) {
        return;
    }
    product_rows rows = of.rows;
    rows.table += odd * of.odd_apart;
    rows.alphas += odd * (RUN_DEGREES / 2);
    __global const real *from = of.values + r * of.apart + odd * (of.apart / 2);
    __global real *to = of.sums + (r * 2 + odd * 2) * (RUN_VECTORS * 2 * LANES);
    const size_t powers_apart = 2 * (size_t)of.half_pitch;
#if KEEP
    __global double *powers = of.powers + odd * powers_apart;
    const size_t ends_apart = of.half_pitch;
#else
    __global double *powers =
        of.powers + r * powers_apart + (of.first + odd) % 2 * of.half_pitch + (of.first + odd) / 2;
    const size_t ends_apart = powers_apart;
#endif
    if (r + 1 < of.num_realizations) {
        product_of_two(rows, from, of.apart, to, powers, ends_apart, vectors);
    } else {
        product_of_one(rows, from, of.apart, to, powers, ends_apart, vectors);
    }
}

__kernel void
sphere_orders_sum(const orders_sum_numbers numbers, __global const real *restrict values,
                  __global const double *restrict starts, __global const int *restrict start_scales,
                  __global const double *restrict steps, __global const int *restrict step_scales,
                  __global const double *restrict ratios, __global const double *restrict cosines,
                  __global const double *restrict distances,
                  __global const double *restrict squares, __global double *restrict all_states,
                  __global int *restrict all_scales, __global double *restrict all_diagonals,
                  __global int *restrict all_diagonal_scales, __global real *restrict all_sums,
                  __global double *restrict all_powers, __local real *table,
                  __local double *coefficients, __local uint *begins) {
    const ring_numbers rings = numbers.rings;
    const uint value_sets = numbers.value_sets, num_realizations = numbers.num_realizations;
    const uint L = rings.L, only_even = rings.only_even, half_pitch = numbers.half_pitch;
    const uint num_rings = rings.num_rings, ring_pitch = rings.ring_pitch, block = rings.block;
    const uint groups = get_global_size(1), group = get_global_id(1);
    const size_t apart = 4 * (size_t)ring_pitch;
    const size_t powers_apart = 2 * (size_t)half_pitch;
    __global double *states = all_states + group * 4 * (size_t)ring_pitch;
    __global real *sums =
        all_sums + group * (size_t)(num_realizations + 1) * (2 * RUN_VECTORS * 2 * LANES);
    __global double *powers =
        all_powers + (KEEP ? 0 : (size_t)group * num_realizations * powers_apart);
    ring_work work = {{states, states + 2 * (size_t)ring_pitch,
                       all_scales + group * 2 * (size_t)ring_pitch, ring_pitch},
                      {distances, squares, rings.polar, rings.crossing, rings.equatorial},
                      all_diagonals + group * (size_t)ring_pitch,
                      all_diagonal_scales + group * (size_t)ring_pitch,
                      num_rings,
                      block,
                      0};
    const order_starts from_order = {starts, start_scales, steps, step_scales, ratios, cosines};
    for (uint m = group; m <= L; m += groups) {
        const uint start = work.alive / block * block; /* the first block that is not all zeros */
        uint dead = work.alive;
        begin_order(work, from_order, m, group, ring_pitch);
        for (uint first = m; first <= L; first += RUN_DEGREES) {
            const uint degrees = min(L + 1 - first, (uint)RUN_DEGREES);
            const uint vectors = (degrees + 2 * LANES - 1) / (2 * LANES);
            make_coefficients(coefficients, first, m, 2 * LANES * vectors);
            for (uint ring = start; ring < num_rings; ring += block) {
                const uint here = min(num_rings - ring, block);
                const uint begin =
                    make_block(work, ring, here, coefficients, table, begins, vectors);
                dead = dead >= ring && first + degrees > L ? max(dead, ring + begin) : dead;
                const run_products run = {
                    {table, begin, here, ring == start, ring + block >= num_rings, m == group,
                     m == 0 ? 1 : 2, coefficients + OF_ALPHA},
                    values + m * order_pitch(value_sets, apart / 2) + 2 * ring,
                    apart,
                    block * TABLE_ROW,
                    sums,
                    KEEP ? powers + m * 2 * powers_apart + (first - m) / 2 : powers,
                    half_pitch,
                    first,
                    degrees,
                    num_realizations};
                for (uint job = 0; job < num_realizations + 1; job++) {
                    const uint odd = job % 2;
                    if (only_even == 0 || (m + odd) % 2 == 0) {
                        add_products(run, job / 2 * 2, odd);
                    }
                }
            }
        }
        work.alive = dead / RING_UNIT * RING_UNIT;
    }
}
