#include "math/linear/tile_product.h"

#include <math.h>

#if defined(__x86_64__) && defined(__GNUC__)
#define HAS_X86_VECTORS 1
#include <immintrin.h>
#else
#define HAS_X86_VECTORS 0
#endif

enum { ROWS = PS_TILE_ROWS, COLUMNS = PS_TILE_COLUMNS };

/* ---- any processor --------------------------------------------------------------------------- */

/* Without fma in the processor a call of it takes a hundred times as long as two roundings. */
static inline double multiply_add(double a, double b, double c) {
#ifdef FP_FAST_FMA
    return fma(a, b, c);
#else
    return a * b + c;
#endif
}

/* Rows and columns whose sums fit the registers of 128 bits of most processors. */
enum { FEW_ROWS = 4, FEW_COLUMNS = 4 };

static void take_few(size_t num, const double *left, const double *right, double *target,
                     size_t stride) {
    double sums[FEW_COLUMNS][FEW_ROWS] = {{0}};
    for (size_t k = 0; k < num; k++) {
        for (size_t j = 0; j < FEW_COLUMNS; j++) {
            for (size_t i = 0; i < FEW_ROWS; i++) {
                sums[j][i] = multiply_add(left[k * ROWS + i], right[k * ROWS + j], sums[j][i]);
            }
        }
    }
    for (size_t j = 0; j < FEW_COLUMNS; j++) {
        for (size_t i = 0; i < FEW_ROWS; i++) {
            target[j * stride + i] -= sums[j][i];
        }
    }
}

static void take_anywhere(size_t num, const double *left, const double *right, double *target,
                          size_t stride) {
    for (size_t j = 0; j < COLUMNS; j += FEW_COLUMNS) {
        for (size_t i = 0; i < ROWS; i += FEW_ROWS) {
            take_few(num, left + i, right + j, target + j * stride + i, stride);
        }
    }
}

/* ---- x86-64 ---------------------------------------------------------------------------------- */

#if HAS_X86_VECTORS
/* A function for three vectors of rows and some columns. Every sum stays in a register: the loops
 * of constant length are unrolled, and what is written is fetched while the sums are made. */
enum { VECTORS = 3 };
#define TAKE(name, features, vector, lanes, columns, prefix)                                       \
    __attribute__((target(features))) static void name(                                            \
        size_t num, const double *left, const double *right, double *target, size_t stride) {      \
        vector sums[columns][VECTORS];                                                             \
        _Pragma("GCC unroll 8") for (size_t j = 0; j < (columns); j++) {                           \
            __builtin_prefetch(target + j * stride, 1);                                            \
            __builtin_prefetch(target + j * stride + (lanes)*VECTORS - 1, 1);                      \
            _Pragma("GCC unroll 3") for (size_t v = 0; v < VECTORS; v++) {                         \
                sums[j][v] = prefix##setzero_pd();                                                 \
            }                                                                                      \
        }                                                                                          \
        for (size_t k = 0; k < num; k++, left += ROWS, right += ROWS) {                            \
            const vector a = prefix##loadu_pd(left);                                               \
            const vector b = prefix##loadu_pd(left + (lanes));                                     \
            const vector c = prefix##loadu_pd(left + 2 * (lanes));                                 \
            _Pragma("GCC unroll 8") for (size_t j = 0; j < (columns); j++) {                       \
                const vector factor = prefix##set1_pd(right[j]);                                   \
                sums[j][0] = prefix##fmadd_pd(a, factor, sums[j][0]);                              \
                sums[j][1] = prefix##fmadd_pd(b, factor, sums[j][1]);                              \
                sums[j][2] = prefix##fmadd_pd(c, factor, sums[j][2]);                              \
            }                                                                                      \
        }                                                                                          \
        _Pragma("GCC unroll 8") for (size_t j = 0; j < (columns); j++) {                           \
            _Pragma("GCC unroll 3") for (size_t v = 0; v < VECTORS; v++) {                         \
                double *const place = target + j * stride + v * (lanes);                           \
                prefix##storeu_pd(place, prefix##sub_pd(prefix##loadu_pd(place), sums[j][v]));     \
            }                                                                                      \
        }                                                                                          \
    }

TAKE(take_512, "avx512f", __m512d, 8, 8, _mm512_)
TAKE(take_quarter, "avx2,fma", __m256d, 4, 4, _mm256_)

static void take_256(size_t num, const double *left, const double *right, double *target,
                     size_t stride) {
    enum { HALF_ROWS = ROWS / 2, HALF_COLUMNS = COLUMNS / 2 };
    for (size_t i = 0; i < ROWS; i += HALF_ROWS) {
        for (size_t j = 0; j < COLUMNS; j += HALF_COLUMNS) {
            take_quarter(num, left + i, right + j, target + j * stride + i, stride);
        }
    }
}
#endif

size_t ps_tile_products(ps_tile_product products[PS_TILE_PRODUCTS]) {
    size_t num = 0;
#if HAS_X86_VECTORS
    if (__builtin_cpu_supports("avx512f")) {
        products[num++] = take_512;
    }
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
        products[num++] = take_256;
    }
#endif
    products[num++] = take_anywhere;
    return num;
}

ps_tile_product ps_tile_product_best(void) {
    ps_tile_product products[PS_TILE_PRODUCTS];
    ps_tile_products(products);
    return products[0];
}
