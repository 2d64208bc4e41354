/* Sums over pairs of any isotropic kernel from one histogram of chords,
 *
 *     sum_ij w_i w_j K(u_i.u_j),   K(x) = sum_l k_l P_l(x)   or   K = |u - v|^(2 power),
 *
 * the diagonal i = j included. The histogram is that of pairs_histogram: N^2 / 2 pairs once,
 * however many kernels there are.
 *
 * Zonal kernels are sum_l k_l Q(l) of its Legendre sums, so that their error is at most sum_l |k_l|
 * times the engine's.
 *
 * |u - v|^(2 power) is not smooth where points meet. Nearer than rho, the edge of a bin, a
 * polynomial takes its place,
 *
 *     g(r) = rho^(2 power) sum_{k < 8} binom(power, k) ((r / rho)^2 - 1)^k,
 *
 * which goes on in r^(2 power) with seven derivatives; what it is off by is added for each pair of
 * points that is so near, of which there are few. Between the K = 8 Chebyshev nodes of a bin of
 * width h, max |g^(8)| (h/2)^8 / (8! 2^7) is lost at most, with
 *
 *     |g^(8)| <= |2p (2p - 1) .. (2p - 7)| rho^(2p - 8)                                 beyond rho, p = power
 *     |g^(8)| <= rho^(2p - 8) sum_j |c_2j| (2j)! / (2j - 8)!                            below it, g = rho^2p sum_j c_2j (r / rho)^2j
 *     |g^(8)| <= sum_i binom(8, i) |p .. (p - i + 1)| |p .. (p - 7 + i)| (2 - sqrt 2)^(p - i) 2^(p - 8 + i)
 *
 * where u.v < 0: r = |u + v| <= sqrt 2 and the kernel is (2 - r)^p (2 + r)^p. rho is as small as
 * the tolerance allows.
 */
#ifndef PS_ENGINES_PAIRS_PAIRS_ISOTROPIC_H
#define PS_ENGINES_PAIRS_PAIRS_ISOTROPIC_H

#include "base/watch.h"
#include "engines/engine.h"

typedef struct ps_isotropic_kernel {
    size_t num_coefficients;    /* L + 1; 0: the power is asked for */
    const double *coefficients; /* k_0 .. k_L */
    double power;               /* above 0, at most 1 */
} ps_isotropic_kernel;

/* sums[k] of the kernels for a pattern that was checked, whose weights are w 2^-exponent, and
 * bounds[k] of their errors in units of (sum |w|)^2. Single precision where it is enough for the
 * tolerance, in the same units; PSPEC_ERROR_TOLERANCE where nothing is. sum |w| is that of the
 * weights 2^-exponent, which may be any number that is not 0. watch, which may be NULL, may stop
 * it: PSPEC_ERROR_CANCELLED. */
pspec_status ps_pairs_isotropic_sums(ps_device *device, const pspec_pattern *pattern, int exponent,
                                     const ps_isotropic_kernel *kernels, size_t num_kernels,
                                     double tolerance, double *sums, double *bounds,
                                     const ps_watch *watch, ps_error *error) PS_MUST_CHECK;

#endif
