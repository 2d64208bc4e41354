/* The worst-case error of shading integrals as truncated inner products in spherical or
 * hemispherical harmonics (docs/mathematics/quadrature.md#truncation):
 *
 *     SH:   E(L)^2 = sum_{l>L} a_l b_l^2
 *     HSH:  E(L)^2 = sum_l a_l (b_l - b'_l)^2,   b'_l = sum_{l'<=L} b~_l' M_{l'l}
 */
#ifndef PS_RULES_TRUNCATION_H
#define PS_RULES_TRUNCATION_H

#include "rules/representer.h"
#include "base/status.h"

#include <stddef.h>

/* Most degrees L of hemispherical harmonics: the conversion to spherical ones takes L X^2 steps, X
 * > 4 L. */
enum { PS_MOST_HEMISPHERICAL_DEGREE = 500 };

/* E(L) for L = 0 .. max_degree and a bound on what truncation adds to or takes off it, [max_degree
 * + 1] each. max_degree > representer->max_degree is an error; best it is less than half of
 * that. */
pspec_status ps_truncation_spherical(const ps_representer *representer, size_t max_degree,
                                     double *errors, double *bounds, ps_error *error) PS_MUST_CHECK;

/* The same for hemispherical harmonics, max_degree <= PS_MOST_HEMISPHERICAL_DEGREE. *sh_degree
 * becomes X, the last spherical degree of the sum, which grows until the bounds are below tolerance
 * times the errors, or it is 3000. Lobes that go below the horizon are refused. */
pspec_status ps_truncation_hemispherical(const ps_brdf *brdf, double smoothness, size_t max_degree,
                                         double tolerance, double *errors, double *bounds,
                                         size_t *sh_degree, ps_error *error) PS_MUST_CHECK;

/* Hemispherical harmonics written in spherical ones
 * (docs/mathematics/quadrature.md#hemispherical-harmonics). */

/* M_{l'l} = sqrt((2l+1)(2l'+1)/2) int_0^1 P_l'(2z-1) P_l(z) dz, the coefficient of Y_l0 in the
 * hemispherical harmonic of degree l', which is 0 below the horizon: matrix [max_from + 1][max_to +
 * 1], row l', filled by a Gauss-Legendre rule that is exact for all of them; absolute error 1e-13
 * up to degree 300. 0 for l < l', and sum_l M_{l'l}^2 = 1. */
pspec_status ps_half_range_matrix(size_t max_from, size_t max_to, double *matrix,
                                  ps_error *error) PS_MUST_CHECK;

#endif
