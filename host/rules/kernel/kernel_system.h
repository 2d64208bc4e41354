/* Linear systems with the kernel matrix K_ij = c - |u_i-u_j|^(2s-2) of points, for optimal weights
 * and interpolation (docs/mathematics/quadrature.md#optimal-weights,
 * docs/mathematics/quadrature.md#interpolation).
 *
 * By Cholesky in double precision with one step of iterative refinement up to PS_KERNEL_MOST_DENSE
 * points, if no limit of memory forbids N^2 doubles; else by conjugate gradients, which make K on
 * the fly, on the device where there is one with double precision. Exact duplicates are one point:
 * K is singular with them.
 */
#ifndef PS_RULES_KERNEL_KERNEL_SYSTEM_H
#define PS_RULES_KERNEL_KERNEL_SYSTEM_H

#include "base/watch.h"
#include "device/device.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct ps_kernel_system ps_kernel_system;

typedef struct ps_kernel_options {
    uint64_t memory_limit; /* bytes, as somebody asked for; 0: none */
    size_t most_dense;     /* points whose matrix is stored; 0: PS_KERNEL_MOST_DENSE */
    double residual;       /* conjugate gradients end at this |r|/|right side|; 0: 1e-12 */
    size_t most_steps;     /* and fail at so many; 0: 2000 */
    ps_device *device;     /* of conjugate gradients; borrowed. NULL: threads of the host */
    const ps_watch *watch; /* told of the matrix and its factor, or of steps; NULL: nobody */
} ps_kernel_options;

typedef struct ps_kernel_facts {
    size_t num_distinct; /* points that are left when duplicates are one */
    bool is_dense;       /* Cholesky, or else conjugate gradients */
    uint64_t bytes;      /* of the arrays */
    /* Cholesky: an estimate, in the 1-norm. Conjugate gradients: no less than this, of the two
     * nearest points */
    double condition;
    bool is_ill_conditioned; /* solutions have fewer than about four digits: near duplicates */
    size_t num_steps;        /* of conjugate gradients in the last solution */
    double residual;         /* |r|/|right side| that they ended with, computed anew */
} ps_kernel_facts;

/* Bytes that a system of so many points takes, by Cholesky or by conjugate gradients on a device:
 * for announcing them. */
uint64_t ps_kernel_system_bytes(size_t num_points, bool is_dense);
/* The most points whose matrix is stored, 3.2 GB, on every machine: the weights must not depend on
 * how much memory it has. Conjugate gradients are quicker from some 10000 points on
 * (docs/user/quadrature.md), a factor is exact in more cases. */
enum { PS_KERNEL_MOST_DENSE = 20000 };
/* The same where products are made by a GPU: of 20000 points 20 of them are predicted to take 40 ms
 * on an H200, and what the host of 16 cores has to do for conjugate gradients half a second, for a
 * factor 3 s; of 4096 points either takes some 50 ms. */
enum { PS_KERNEL_MOST_DENSE_ON_GPU = 4096 };
/* Which of them; device: NULL: none. */
size_t ps_kernel_most_dense(const ps_device *device);

/* Is it Cholesky? most_dense and memory_limit as in the options. */
bool ps_kernel_system_is_dense(size_t num_points, size_t most_dense, uint64_t memory_limit);

/* points: unit vectors [num_points][3], copied. options NULL: the defaults. Points so near each
 * other that K is not positive definite in double precision are PSPEC_ERROR_INPUT and named. */
pspec_status ps_kernel_system_create(ps_kernel_system **out, size_t num_points,
                                     const double *points, double smoothness,
                                     const ps_kernel_options *options,
                                     ps_error *error) PS_MUST_CHECK;
void ps_kernel_system_destroy(ps_kernel_system *system); /* NULL is allowed */
/* Equal points are PSPEC_ERROR_INPUT, with the first two in the sentence. */
pspec_status ps_kernel_system_check_distinct(const ps_kernel_system *system,
                                             ps_error *error) PS_MUST_CHECK;

/* K x = right, both [num_points]; duplicates share what their one point gets in equal parts, and
 * must have equal right sides (the first one counts). *defect (NULL: not wanted) becomes x . (right
 * - K x), the part of a quadratic form that rounding leaves over. */
pspec_status ps_kernel_system_solve(ps_kernel_system *system, const double *right, double *x,
                                    double *defect, ps_error *error) PS_MUST_CHECK;

ps_kernel_facts ps_kernel_system_facts(const ps_kernel_system *system);

/* values [num_functions][num] of sum_i x_i K(u, u_i) at unit vectors at [num][3], for each row of x
 * [num_functions][num_points]: docs/mathematics/quadrature.md#interpolation. At most
 * PS_SOBOLEV_MOST_SUMS functions, which share their distances. */
void ps_kernel_interpolate(size_t num_points, const double *points, double smoothness,
                           size_t num_functions, const double *x, size_t num, const double *at,
                           double *values);

/* sum a_i b_i, compensated; b NULL: of a. */
double ps_kernel_dot(size_t num, const double *a, const double *b);

#endif
