/* The reproducing kernel of the Sobolev space H^s of the sphere, 1 < s < 2
 * (docs/mathematics/quadrature.md#sobolev-kernel):
 *
 *     K(u,v) = c - |u-v|^(2s-2) = sum_l a_l (2l+1)/(4 pi) P_l(u.v),    c = 2^(2s-1)/s
 */
#ifndef PS_MATH_SOBOLEV_H
#define PS_MATH_SOBOLEV_H

#include "base/status.h"

#include <stddef.h>

/* Powers of so many numbers side by side: those of libm come one at a time. */
enum { PS_POWERS = 128 };

/* values[i] becomes values[i]^exponent for 0 <= values[i] <= 4 and 0 < exponent < 1. Numbers below
 * the smallest normal one become 0. The error is below 1e-15 (tests/math/test_sobolev.c), and the
 * same bits come from any processor. */
void ps_powers(double exponent, double values[PS_POWERS]);

/* Refuses s outside (1, 2), with the reason. */
pspec_status ps_sobolev_check(double smoothness, ps_error *error) PS_MUST_CHECK;

/* c = K(u,u). */
double ps_sobolev_constant(double smoothness);

/* a_0 .. a_max_degree, by (K1): relative error below 1e-12 up to degree 10^4. */
void ps_sobolev_eigenvalues(double smoothness, size_t max_degree, double *eigenvalues);

/* tau_L = sum_{l>L} a_l (2l+1)/(4 pi) from a_{L+1} (K2). */
double ps_sobolev_tail(double smoothness, size_t max_degree, double next_eigenvalue);

/* |u-v|^(2s-2) from |u-v|^2 by coordinate differences, which keeps the digits of near points and
 * makes it 0 for equal ones. */
double ps_sobolev_distance(double smoothness, const double u[3], const double v[3]);

/* Up to so many points in columns, for sums over them that go side by side. */
enum { PS_SOBOLEV_CHUNK = PS_POWERS };
typedef struct ps_sobolev_chunk {
    size_t num;
    double x[PS_SOBOLEV_CHUNK], y[PS_SOBOLEV_CHUNK], z[PS_SOBOLEV_CHUNK];
    double weights[PS_SOBOLEV_CHUNK]; /* 0 beyond num */
} ps_sobolev_chunk;

/* num <= PS_SOBOLEV_CHUNK points [num][3]; weights NULL: all 1. */
void ps_sobolev_chunk_fill(ps_sobolev_chunk *chunk, size_t num, const double *points,
                           const double *weights);

/* |u-v_j|^(2s-2), whatever the weights; 1 beyond num or anything else. The same bits whichever of
 * both is u. */
void ps_sobolev_chunk_distances(double smoothness, const double u[3], const ps_sobolev_chunk *chunk,
                                double values[PS_SOBOLEV_CHUNK]);

/* sum_j weights[j] |u-v_j|^(2s-2) over the chunk; the order of the additions is always the same. */
double ps_sobolev_chunk_sum(double smoothness, const double u[3], const ps_sobolev_chunk *chunk);

/* The same over any number of points: chunk by chunk, compensated. */
double ps_sobolev_distance_sum(double smoothness, const double u[3], size_t num,
                               const double *points, const double *weights);
/* The same bits for each of num_sums <= PS_SOBOLEV_MOST_SUMS rows of weights [num_sums][num], in
 * little more time than one takes. */
enum { PS_SOBOLEV_MOST_SUMS = 16 };
void ps_sobolev_distance_sums(double smoothness, const double u[3], size_t num,
                              const double *points, size_t num_sums, const double *weights,
                              double *sums);

#endif
