/* From values on angles to sum_m |c_lm|^2, by the table of table.cl: lanes are degrees of one
 * parity, so that a vector of the table serves all realizations. A work-group has the orders that
 * are its number modulo the number of groups, so that what it adds up does not depend on the
 * device, of group_sets realizations: on CPUs all. Launch: (work-items of one group, groups, parts
 * of the realizations).
 *
 *   values   [order][value_sets][even, odd l - m][vector of angles][re, im][LANES] of values.cl
 *   table    [order][even, odd l - m][run][angle][vector of degrees][LANES] (table.h)
 *   offsets  [order][even, odd l - m]
 *   begins   [order][even, odd l - m][most_runs]: angles below are nothing in all degrees of the run
 *   only_even  even degrees only
 *   powers   [group][realization][even, odd degrees][half_pitch], of degrees from the group on; half_pitch has room
 *            for RUN_VECTORS vectors behind degree L / 2, with TILES for one, and no more is written. With KEEP
 *            coefficients of one realization, [order][even, odd l - m][re, im][half_pitch]
 *   rows, columns  local, [TILE_ANGLES][RUN_VECTORS], [TILE_ANGLES][COLUMN_VECTORS] with TILES (tiles.h); else not touched
 */
#include "shared/ahead.h"
#include "sphere/grid/rows.h"
#include "sphere/nufft/numbers.h"
#include "sphere/values.h"

/* A source is inlined once: what both include comes first. */
#ifndef TILES
#define TILES 0
#endif
#if TILES
#include "sphere/grid/tiles.h"
#else
#include "sphere/grid/lanes.h"
#endif

/* Sums one order and parity. begins: where its runs begin. */
static inline void sum_runs(const table_rows of_order, __global const uint *begins,
                            const uint vectors, const set_values from, __global double *powers,
                            const size_t powers_apart, __local realv *local_rows,
                            __local realv *columns) {
    const uint whole = table_run(vectors, RUN_VECTORS);
    table_rows rows = of_order;
    for (uint first = 0; first < vectors; first += whole) {
        rows.table = of_order.table + (size_t)first * of_order.num_angles * LANES;
        rows.begin = begins[first / whole];
        sum_run(rows, min(vectors - first, whole), from, powers + first * LANES, powers_apart,
                local_rows, columns);
    }
}

__kernel void sphere_grid_sums(__global const real *restrict values, const uint value_sets,
                               const uint num_realizations, __global const real *restrict table,
                               __global const ulong *restrict offsets,
                               __global const uint *restrict begins, const uint most_runs,
                               const uint L, const uint num_angles, const uint only_even,
                               const uint half_pitch, const uint group_sets,
                               __global double *restrict all_powers, __local realv *rows,
                               __local realv *columns) {
    const uint groups = get_global_size(1), group = get_global_id(1);
    const uint begin = get_global_id(2) * group_sets;
    const uint num = min(num_realizations - begin, group_sets);
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
            __global double *powers = all_powers +
                                      ((size_t)group * num_realizations + begin) * powers_apart +
                                      (m + odd) % 2 * half_pitch + (m + odd) / 2;
            const size_t ends_apart = powers_apart;
#endif
            if (only_even == 0 || (m + odd) % 2 == 0) {
                const set_values from = {values + m * order_pitch(value_sets, parity_apart) +
                                             odd * parity_apart + begin * 2 * parity_apart,
                                         2 * parity_apart, num};
                sum_runs(of_order, begins + (2 * m + odd) * most_runs,
                         table_vectors(m, odd, L, LANES), from, powers, ends_apart, rows, columns);
            }
        }
        barrier_everywhere();
    }
}
