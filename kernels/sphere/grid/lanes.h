/* Sums of an order and parity, of two realizations at a time: lanes are degrees, so that a vector
 * of the table serves all realizations. Device only.
 */
#ifndef PS_SPHERE_GRID_LANES_H
#define PS_SPHERE_GRID_LANES_H

#include "shared/ahead.h"
#include "shared/lanes.h"
#include "sphere/grid/table.h"
#include "sphere/nufft/orders_finish.h"

/* Vectors of degrees of a run: in registers, with real and imaginary parts of two realizations,
 * half of 32 of them, or 8 of 16. */
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

/* Numbers of some realizations: [realization][vector of angles][re, im][LANES]. */
typedef struct set_values {
    __global const real *values;
    size_t apart;
    uint num; /* realizations */
} set_values;

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

/* One run of `here` vectors, pairs of realizations by turns. */
static inline void sum_run(const table_rows rows, const uint here, const set_values from,
                           __global double *powers, const size_t powers_apart) {
    for (uint r = 0; r < from.num; r += 2) {
        __global const real *values = from.values + r * from.apart;
        __global double *to = powers + (KEEP ? 0 : r * powers_apart);
        if (r + 1 < from.num) {
            product_of_two(rows, values, from.apart, to, powers_apart, here);
        } else {
            product_of_one(rows, values, from.apart, to, powers_apart, here);
        }
    }
}

#endif
