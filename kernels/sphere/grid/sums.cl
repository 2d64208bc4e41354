/* From values on angles to sum_m |c_lm|^2, by the table of table.cl: lanes are degrees of one
 * parity, so that a vector of the table serves all realizations. A work-group has the orders that
 * are its number modulo the number of groups, so that what it adds up does not depend on the
 * device. Launch: (1, groups) in work-groups of one item.
 *
 *   values   [order][value_sets][even, odd l - m][vector of angles][re, im][LANES] of values.cl
 *   table    [order][even, odd l - m][run][angle][vector of degrees][LANES] (table.h)
 *   offsets  [order][even, odd l - m]
 *   begins   [order][even, odd l - m][most_runs]: angles below are nothing in all degrees of the run
 *   only_even  even degrees only
 *   powers   [group][realization][even, odd degrees][half_pitch], of degrees from the group on; half_pitch has room
 *            for RUN_VECTORS vectors behind degree L / 2. With KEEP
 *            coefficients of one realization, [order][even, odd l - m][re, im][half_pitch]
 */
#define ALONE 1 /* CPUs alone have this kernel */
#include "sphere/grid/lanes.h"
#include "sphere/values.h"

/* Sums one order and parity. begins: where its runs begin. */
static inline void sum_runs(const table_rows of_order, __global const uint *begins,
                            const uint vectors, const set_values from, __global double *powers,
                            const size_t powers_apart) {
    const uint whole = table_run(vectors, RUN_VECTORS);
    table_rows rows = of_order;
    for (uint first = 0; first < vectors; first += whole) {
        rows.table = of_order.table + (size_t)first * of_order.num_angles * LANES;
        rows.begin = begins[first / whole];
        sum_run(rows, min(vectors - first, whole), from, powers + first * LANES, powers_apart);
    }
}

__kernel void sphere_grid_sums(__global const real *restrict values, const uint value_sets,
                               const uint num_realizations, __global const real *restrict table,
                               __global const ulong *restrict offsets,
                               __global const uint *restrict begins, const uint most_runs,
                               const uint L, const uint num_angles, const uint only_even,
                               const uint half_pitch, __global double *restrict all_powers) {
    const uint groups = get_global_size(1), group = get_global_id(1);
    const size_t parity_apart = (size_t)((num_angles + LANES - 1) / LANES) * 2 * LANES;
    const size_t powers_apart = 2 * (size_t)half_pitch;
    for (uint m = group; m <= L; m += groups) {
        for (uint odd = 0; odd < 2 && m + odd <= L; odd++) {
            const table_rows of_order = {table +
                                             table_place(offsets, m, odd, 0, num_angles) * LANES,
                                         0, num_angles, m == group, m == 0 ? 1 : 2};
#if KEEP
            __global double *powers = all_powers + (m * 2 + odd) * powers_apart;
            const size_t ends_apart = half_pitch;
#else
            __global double *powers = all_powers + (size_t)group * num_realizations * powers_apart +
                                      (m + odd) % 2 * half_pitch + (m + odd) / 2;
            const size_t ends_apart = powers_apart;
#endif
            if (only_even == 0 || (m + odd) % 2 == 0) {
                const set_values from = {values + m * order_pitch(value_sets, parity_apart) +
                                             odd * parity_apart,
                                         2 * parity_apart, num_realizations};
                sum_runs(of_order, begins + (2 * m + odd) * most_runs,
                         table_vectors(m, odd, L, LANES), from, powers, ends_apart);
            }
        }
    }
}
