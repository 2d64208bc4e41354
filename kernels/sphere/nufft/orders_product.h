/* Sums over rings of Lambda_lm times values on rings: lanes are degrees of one parity, so that a
 * row of the table serves all realizations. Device only.
 */
#ifndef PS_SPHERE_ORDERS_PRODUCT_H
#define PS_SPHERE_ORDERS_PRODUCT_H

#include "sphere/nufft/orders_finish.h"
#include "sphere/nufft/orders_table.h"

/* A table [ring][TABLE_ROW], rings first .. end - 1 of it; the sums so far are 0 where these are
 * the first rings, and complete where they are the last. */
typedef struct product_rows {
    __local const real *table;
    uint first, end;
    bool is_first, is_last;
    bool is_lowest;               /* of the orders that are added up */
    double weight;                /* of |c|^2: orders m and -m */
    __local const double *alphas; /* of the degrees: what Lambda_lm is in terms of the table */
} product_rows;

/* NUM realizations, VECTORS vectors of degrees. values: of the first ring of the table,
 * realizations `apart` numbers apart. sums [realization][RUN_VECTORS][re, im][LANES], powers
 * [realization], `powers_apart` from each other. */
#define PRODUCT(NUM, VECTORS)                                                                      \
    static inline __attribute__((always_inline)) void product_##NUM##_##VECTORS(                   \
        const product_rows rows, __global const real *values, const size_t apart,                  \
        __global real *sums, __global double *powers, const size_t powers_apart) {                 \
        realv re[NUM][VECTORS], im[NUM][VECTORS];                                                  \
        _Pragma("unroll") for (int r = 0; r < NUM; r++) {                                          \
            _Pragma("unroll") for (int v = 0; v < VECTORS; v++) {                                  \
                __global const real *from = sums + (r * RUN_VECTORS + v) * 2 * LANES;              \
                re[r][v] = rows.is_first ? (realv)0 : load_global(from, 0);                        \
                im[r][v] = rows.is_first ? (realv)0 : load_global(from, 1);                        \
            }                                                                                      \
        }                                                                                          \
        __local const real *row = rows.table + rows.first * TABLE_ROW;                             \
        __global const real *value = values + 2 * rows.first;                                      \
        for (uint i = rows.first; i < rows.end; i++) {                                             \
            realv lambda[VECTORS];                                                                 \
            _Pragma("unroll") for (int v = 0; v < VECTORS; v++) {                                  \
                lambda[v] = load_local(row, v);                                                    \
            }                                                                                      \
            _Pragma("unroll") for (int r = 0; r < NUM; r++) {                                      \
                const realv value_re = (realv)value[r * apart];                                    \
                const realv value_im = (realv)value[r * apart + 1];                                \
                _Pragma("unroll") for (int v = 0; v < VECTORS; v++) {                              \
                    re[r][v] = fma(lambda[v], value_re, re[r][v]);                                 \
                    im[r][v] = fma(lambda[v], value_im, im[r][v]);                                 \
                }                                                                                  \
            }                                                                                      \
            row += TABLE_ROW;                                                                      \
            value += 2;                                                                            \
        }                                                                                          \
        _Pragma("unroll") for (int r = 0; r < NUM; r++) {                                          \
            _Pragma("unroll") for (int v = 0; v < VECTORS; v++) {                                  \
                __global real *to = sums + (r * RUN_VECTORS + v) * 2 * LANES;                      \
                if (rows.is_last) {                                                                \
                    const doublev alpha = load_doubles(rows.alphas + v * LANES);                   \
                    finish_sums(powers + r * powers_apart + v * LANES, powers_apart, rows.weight,  \
                                rows.is_lowest, TO_DOUBLEV(re[r][v]) * alpha,                      \
                                TO_DOUBLEV(im[r][v]) * alpha);                                     \
                } else {                                                                           \
                    store_global(to, 0, re[r][v]);                                                 \
                    store_global(to, 1, im[r][v]);                                                 \
                }                                                                                  \
            }                                                                                      \
        }                                                                                          \
    }

PRODUCT(1, 1)
PRODUCT(1, 2)
#if RUN_VECTORS > 2
PRODUCT(1, 3)
PRODUCT(1, 4)
#endif
PRODUCT(2, 1)
PRODUCT(2, 2)
#if RUN_VECTORS > 2
PRODUCT(2, 3)
PRODUCT(2, 4)
#endif

#define PRODUCT_CASE(NUM, VECTORS)                                                                 \
    case VECTORS:                                                                                  \
        product_##NUM##_##VECTORS(rows, values, apart, sums, powers, powers_apart);                \
        break

static inline void product_of_one(const product_rows rows, __global const real *values,
                                  const size_t apart, __global real *sums, __global double *powers,
                                  const size_t powers_apart, const uint vectors) {
    switch (vectors) {
        PRODUCT_CASE(1, 1);
        PRODUCT_CASE(1, 2);
#if RUN_VECTORS > 2
        PRODUCT_CASE(1, 3);
        PRODUCT_CASE(1, 4);
#endif
    }
}

static inline void product_of_two(const product_rows rows, __global const real *values,
                                  const size_t apart, __global real *sums, __global double *powers,
                                  const size_t powers_apart, const uint vectors) {
    switch (vectors) {
        PRODUCT_CASE(2, 1);
        PRODUCT_CASE(2, 2);
#if RUN_VECTORS > 2
        PRODUCT_CASE(2, 3);
        PRODUCT_CASE(2, 4);
#endif
    }
}

#endif
