/** @file
 * Kernel interpolation on the sphere. Included by pointspec.h.
 */
#ifndef POINTSPEC_INTERPOLANT_H
#define POINTSPEC_INTERPOLANT_H

#include "pointspec/context.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @name Kernel interpolation on the sphere
 * @{ */

/** A function on the sphere through given values at points: of all functions f of the Sobolev space
 * H^s with them the one of the smallest norm,
 *
 *     f^(u) = sum_i alpha_i K(u, u_i),   K alpha = f
 *     K(u, v) = c - |u - v|^(2s-2),            c = 2^(2s-1) / s
 */
typedef struct pspec_interpolant pspec_interpolant;

/** Interpolates values [num_points] at unit vectors points [num_points][3] (lengths may be off by
 * 1e-6; they are divided), 1 < smoothness < 2. By Cholesky and a step of refinement in 8
 * num_points^2 bytes, or where these are more than the memory limit of the context (without one:
 * half of the machine's memory) by conjugate gradients on the device; the progress callback is then
 * told of their steps, the total being 0, and can cancel them. A copy is made of everything.
 *
 * Equal points are one: the first value counts. #PSPEC_ERROR_INPUT names points so near each other
 * that K is singular in double precision. */
PSPEC_EXPORT pspec_status pspec_interpolant_create(pspec_interpolant **out, pspec_context *context,
                                                   size_t num_points, const double *points,
                                                   const double *values, double smoothness);
/** NULL is allowed. */
PSPEC_EXPORT void pspec_interpolant_destroy(pspec_interpolant *interpolant);

/** f^ at unit vectors at [num][3], O(num num_points), to values [num]; allocates nothing. */
PSPEC_EXPORT void pspec_interpolant_evaluate(const pspec_interpolant *interpolant, size_t num,
                                             const double *at, double *values);

/** The norm of f^ in H^s, sqrt(f . alpha): no function with these values has a smaller one. */
PSPEC_EXPORT double pspec_interpolant_norm(const pspec_interpolant *interpolant);

/** Bounds [num] at unit vectors at [num][3]: |f(u) - f^(u)| <= bounds(u) |f| for every f of H^s
 * with these values, where bounds(u)^2 = c - k(u) . K^-1 k(u), k_i(u) = K(u, u_i). A solution of
 * the system for each of them: O(num num_points^2). */
PSPEC_EXPORT pspec_status pspec_interpolant_bound(pspec_interpolant *interpolant, size_t num,
                                                  const double *at, double *bounds);

/** The condition number of K in the 1-norm, estimated; a bound from below where it was solved by
 * conjugate gradients. Above 4.5e11 fewer than four digits of alpha are right, since points lie
 * together. */
PSPEC_EXPORT double pspec_interpolant_condition(const pspec_interpolant *interpolant);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
