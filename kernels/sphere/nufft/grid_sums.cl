/* From values on angles to sum_m |c_lm|^2, by the table of grid_table.cl: lanes are degrees of one
 * parity, so that a vector of the table serves all realizations. A work-group has the orders that
 * are its number modulo the number of groups, so that what it adds up does not depend on the
 * device; groups that have the same ones share the realizations (shares.h). Launch: (work-items of
 * one group, groups times shares).
 *
 *   values   [order][value_sets][even, odd l - m][vector of angles][re, im][LANES] of grid_values.cl
 *   table    [order][even, odd l - m][run][angle][vector of degrees][LANES] (grid_table.h)
 *   offsets  [order][even, odd l - m]
 *   begins   [order][even, odd l - m][most_runs]: angles below are nothing in all degrees of the run
 *   only_even  even degrees only
 *   powers   [group][realization][even, odd degrees][half_pitch], of degrees from the group on; half_pitch has room for
 *            RUN_VECTORS vectors behind degree L / 2. With KEEP coefficients of one realization,
 *            [order][even, odd l - m][re, im][half_pitch]
 */
#include "shared/ahead.h"
#include "shared/group.h"
#include "shared/lanes.h"
#include "sphere/nufft/orders_finish.h"
#include "sphere/nufft/grid_table.h"
#include "sphere/shares.h"
#include "sphere/values.h"

/* Vectors of degrees in registers: with real and imaginary parts of two realizations half of 32 of
 * them, or 8 of 16. */
#ifndef RUN_VECTORS
#define RUN_VECTORS 4
#endif

/* A run of the table from angle `begin` on, and where its sums go. */
typedef struct table_rows {
    __global const real *table;
    uint begin, num_angles;
    bool is_lowest; /* of the orders that are added up */
    double weight;  /* of |c|^2: orders m and -m */
} table_rows;

/* NUM realizations, VECTORS vectors of degrees. values: of the first angle, realizations `apart`
 * numbers apart; powers [realization], `powers_apart` from each other. */
#define PRODUCT(NUM, VECTORS)                                                                      \
    static inline __attribute__((always_inline)) void product_##NUM##_##VECTORS(                   \
        const table_rows rows, __global const real *values, const size_t apart,                    \
        __global double *powers, const size_t powers_apart) {                                      \
        realv re[NUM][VECTORS], im[NUM][VECTORS];                                                  \
        _Pragma("unroll") for (int r = 0; r < NUM; r++) {                                          \
            _Pragma("unroll") for (int v = 0; v < VECTORS; v++) {                                  \
                re[r][v] = im[r][v] = (realv)0;                                                    \
            }                                                                                      \
        }                                                                                          \
        __global const real *row = rows.table + rows.begin * (size_t)(VECTORS * LANES);            \
        for (uint i = rows.begin; i < rows.num_angles;) {                                          \
            const uint end = min((i / LANES + 1) * LANES, rows.num_angles);                        \
            __global const real *value = values + i / LANES * (2 * LANES) + i % LANES;             \
            _Pragma("unroll") for (int r = NUM; r < 2 * NUM; r++) { /* of the next realizations */ \
                will_read(value + r * apart);                                                      \
                will_read(value + r * apart + LANES);                                              \
            }                                                                                      \
            for (; i < end; i++) {                                                                 \
                realv lambda[VECTORS];                                                             \
                _Pragma("unroll") for (int v = 0; v < VECTORS; v++) {                              \
                    lambda[v] = load_global(row, v);                                               \
                }                                                                                  \
                _Pragma("unroll") for (int r = 0; r < NUM; r++) {                                  \
                    const realv value_re = (realv)value[r * apart];                                \
                    const realv value_im = (realv)value[r * apart + LANES];                        \
                    _Pragma("unroll") for (int v = 0; v < VECTORS; v++) {                          \
                        re[r][v] = fma(lambda[v], value_re, re[r][v]);                             \
                        im[r][v] = fma(lambda[v], value_im, im[r][v]);                             \
                    }                                                                              \
                }                                                                                  \
                row += VECTORS * LANES;                                                            \
                value++;                                                                           \
            }                                                                                      \
        }                                                                                          \
        _Pragma("unroll") for (int r = 0; r < NUM; r++) {                                          \
            _Pragma("unroll") for (int v = 0; v < VECTORS; v++) {                                  \
                finish_sums(powers + r * powers_apart + v * LANES, powers_apart, rows.weight,      \
                            rows.is_lowest, TO_DOUBLEV(re[r][v]), TO_DOUBLEV(im[r][v]));           \
            }                                                                                      \
        }                                                                                          \
    }

#define PRODUCT_CASE(NUM, VECTORS)                                                                 \
    case VECTORS:                                                                                  \
        product_##NUM##_##VECTORS(rows, values, apart, powers, powers_apart);                      \
        break
#if RUN_VECTORS > 2
#define PRODUCTS(NUM) PRODUCT(NUM, 1) PRODUCT(NUM, 2) PRODUCT(NUM, 3) PRODUCT(NUM, 4)
#define PRODUCT_CASES(NUM)                                                                         \
    PRODUCT_CASE(NUM, 1);                                                                          \
    PRODUCT_CASE(NUM, 2);                                                                          \
    PRODUCT_CASE(NUM, 3);                                                                          \
    PRODUCT_CASE(NUM, 4)
#else
#define PRODUCTS(NUM) PRODUCT(NUM, 1) PRODUCT(NUM, 2)
#define PRODUCT_CASES(NUM)                                                                         \
    PRODUCT_CASE(NUM, 1);                                                                          \
    PRODUCT_CASE(NUM, 2)
#endif

PRODUCTS(1)
PRODUCTS(2)

static inline void product_of_one(const table_rows rows, __global const real *values,
                                  const size_t apart, __global double *powers,
                                  const size_t powers_apart, const uint vectors) {
    switch (vectors) { PRODUCT_CASES(1); }
}

static inline void product_of_two(const table_rows rows, __global const real *values,
                                  const size_t apart, __global double *powers,
                                  const size_t powers_apart, const uint vectors) {
    switch (vectors) { PRODUCT_CASES(2); }
}

/* Sums one order and parity, pairs of realizations by turns. begins: where its runs begin. */
static inline void sum_runs(const table_rows of_order, __global const uint *begins,
                            const uint vectors, __global const real *values, const size_t apart,
                            const uint num_realizations, __global double *powers,
                            const size_t powers_apart) {
    const uint whole = table_run(vectors, RUN_VECTORS);
    table_rows rows = of_order;
    for (uint first = 0; first < vectors; first += whole) {
        const uint here = min(vectors - first, whole);
        rows.table = of_order.table + (size_t)first * of_order.num_angles * LANES;
        rows.begin = begins[first / whole];
        for (uint r = 2 * own_item(); r < num_realizations; r += 2 * num_items()) {
            __global const real *from = values + r * apart;
            __global double *to = powers + (KEEP ? 0 : r * powers_apart) + first * LANES;
            if (r + 1 < num_realizations) {
                product_of_two(rows, from, apart, to, powers_apart, here);
            } else {
                product_of_one(rows, from, apart, to, powers_apart, here);
            }
        }
    }
}

__kernel void sphere_grid_sums(__global const real *restrict values, const uint value_sets,
                               const uint num_realizations, __global const real *restrict table,
                               __global const ulong *restrict offsets,
                               __global const uint *restrict begins, const uint most_runs,
                               const uint L, const uint num_angles, const uint only_even,
                               const uint half_pitch, const uint shares,
                               __global double *restrict all_powers) {
    const uint groups = get_global_size(1) / shares, group = get_global_id(1) / shares;
    const uint share = get_global_id(1) % shares;
    const uint begin = share_begin(share, shares, num_realizations);
    const uint num = share_begin(share + 1, shares, num_realizations) - begin;
    if (num == 0) {
        return;
    }
    const size_t parity_apart = (size_t)((num_angles + LANES - 1) / LANES) * 2 * LANES;
    const size_t powers_apart = 2 * (size_t)half_pitch;
    for (uint m = group; m <= L; m += groups) {
        for (uint odd = 0; odd < 2 && m + odd <= L; odd++) {
            const table_rows rows = {table + table_place(offsets, m, odd, 0, num_angles) * LANES, 0,
                                     num_angles, m == group, m == 0 ? 1 : 2};
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
                sum_runs(rows, begins + (2 * m + odd) * most_runs, table_vectors(m, odd, L, LANES),
                         values + m * order_pitch(value_sets, parity_apart) + odd * parity_apart +
                             begin * 2 * parity_apart,
                         2 * parity_apart, num, powers, ends_apart);
            }
        }
        barrier_everywhere();
    }
}
