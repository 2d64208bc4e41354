/* A sparse approximation L of the inverse of the Cholesky factor of a kernel matrix, L^T L ~ K^-1,
 * that makes conjugate gradients fast: factorized sparse approximate inverses (L. Yu. Kolotilina,
 * A. Yu. Yeremin, 1993). Points are put in a random order; row i knows of the points before i only
 * those nearest to it, and is exact for these. The first points are few and far from each other,
 * later ones are in between: every scale has its rows, which makes this work for kernels whose
 * inverse is nearly local (F. Schaefer, M. Katzfuss, H. Owhadi, 2021).
 */
#ifndef PS_RULES_KERNEL_KERNEL_FACTOR_H
#define PS_RULES_KERNEL_KERNEL_FACTOR_H

#include "base/watch.h"

#include <stddef.h>
#include <stdint.h>

typedef struct ps_kernel_factor {
    size_t num;
    uint32_t *columns; /* [num][PS_KERNEL_NEIGHBOURS], the row's own point last */
    double *values;    /* the same; 0 where a row has fewer */
    double nearest;    /* the smallest distance of two points */
    size_t near[2];    /* which ones */
} ps_kernel_factor;

/* Entries of a row: see docs/user/quadrature.md for steps against this. */
enum { PS_KERNEL_NEIGHBOURS = 32 };

/* Bytes while it is made; it keeps less. */
uint64_t ps_kernel_factor_bytes(size_t num);

/* Distinct unit vectors [num][3], num < 2^32. O(num^2) distances, in several threads; the same bits
 * on any number. Freed by ps_kernel_factor_free, also after an error. */
pspec_status ps_kernel_factor_create(ps_kernel_factor *out, double smoothness, size_t num,
                                     const double *points, const ps_watch *watch,
                                     ps_error *error) PS_MUST_CHECK;
void ps_kernel_factor_free(ps_kernel_factor *factor);

/* out = L^T L x; both [num], not the same memory. */
void ps_kernel_factor_apply(const ps_kernel_factor *factor, const double *x, double *out);

#endif
