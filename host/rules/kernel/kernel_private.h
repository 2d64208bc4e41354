/* What kernel systems are made of. Private to the files kernel_*.c. */
#ifndef PS_RULES_KERNEL_KERNEL_PRIVATE_H
#define PS_RULES_KERNEL_KERNEL_PRIVATE_H

#include "base/watch.h"
#include "rules/kernel/kernel_product.h"
#include "rules/kernel/kernel_system.h"
#include <stddef.h>
#include <stdint.h>

/* A sparse approximation L of the inverse of the Cholesky factor of a kernel matrix, L^T L ~ K^-1,
 * that makes conjugate gradients fast: factorized sparse approximate inverses (L. Yu. Kolotilina,
 * A. Yu. Yeremin, 1993). Points are put in a random order; row i knows of the points before i only
 * those nearest to it, and is exact for these. The first points are few and far from each other,
 * later ones are in between: every scale has its rows, which makes this work for kernels whose
 * inverse is nearly local (F. Schaefer, M. Katzfuss, H. Owhadi, 2021).
 */

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

/* Arrays of N doubles: solution and residual; then numbers in two parts, or the three of conjugate
 * gradients. */
enum { PS_KERNEL_DENSE_ROWS = 4, PS_KERNEL_GRADIENT_ROWS = 5 };

struct ps_kernel_system {
    size_t num_points, num; /* num: distinct ones */
    double smoothness, constant;
    double *points; /* [num][3] */
    size_t *group;  /* [num_points]: which distinct point each one is */
    double *shares; /* [num]: 1 over how many points it is */
    /* [num][num]: factor in the lower, K in the strict upper triangle; NULL: not dense */
    double *matrix;
    double *rows; /* [PS_KERNEL_.._ROWS][num] */
    double norm;  /* of K, the 1-norm */
    /* of conjugate gradients */
    ps_kernel_factor factor;
    ps_kernel_product *product; /* NULL: on the host */
    ps_kernel_options options;
    ps_kernel_facts facts;
};

/* ---- the points ----------------------------------------------------------------------------- */

/* Numbers the distinct points in the order of their first ones, and keeps which one every point is.
 */
pspec_status ps_kernel_points_merge(ps_kernel_system *system, const double *points,
                                    ps_error *error) PS_MUST_CHECK;
/* The distinct point nearest to one of them: what makes a matrix singular. */
size_t ps_kernel_points_nearest(const ps_kernel_system *system, size_t i, double *distance);
/* The sentence for two of the distinct points that are too near each other. */
pspec_status ps_kernel_points_refuse(const ps_kernel_system *system, size_t i, size_t j,
                                     double distance, ps_error *error);

/* ---- the matrix in memory ------------------------------------------------------------------ */

/* Both triangles, with the diagonal. */
pspec_status ps_kernel_matrix_fill(ps_kernel_system *system, ps_error *error) PS_MUST_CHECK;
/* Sets the norm to the 1-norm of a matrix that was just filled; uses the rows. */
pspec_status ps_kernel_matrix_norm(ps_kernel_system *system, ps_error *error) PS_MUST_CHECK;
/* residual = right - K x with sums of 64 bits; K is in the strict upper triangle, and c on the
 * diagonal. x and residual are the first two rows, or anything else but the next two. */
pspec_status ps_kernel_matrix_residual(ps_kernel_system *system, const double *right,
                                       const double *x, double *residual,
                                       ps_error *error) PS_MUST_CHECK;

/* ---- the matrix on the fly ----------------------------------------------------------------- */

/* Factor, device, norm and what is known of the condition, for a system with points and rows. */
pspec_status ps_kernel_gradients_prepare(ps_kernel_system *system, ps_error *error) PS_MUST_CHECK;
/* x and residual: [num] in the first two rows. */
pspec_status ps_kernel_gradients_solve(ps_kernel_system *system, const double *right, double *x,
                                       double *residual, ps_error *error) PS_MUST_CHECK;

#endif
