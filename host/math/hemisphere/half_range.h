/* Hemispherical harmonics written in spherical ones
 * (docs/mathematics/quadrature.md#hemispherical-harmonics). */
#ifndef PS_MATH_HALF_RANGE_H
#define PS_MATH_HALF_RANGE_H

#include "base/status.h"

#include <stddef.h>

/* M_{l'l} = sqrt((2l+1)(2l'+1)/2) int_0^1 P_l'(2z-1) P_l(z) dz, the coefficient of Y_l0 in the
 * hemispherical harmonic of degree l', which is 0 below the horizon: matrix [max_from + 1][max_to +
 * 1], row l', filled by a Gauss-Legendre rule that is exact for all of them; absolute error 1e-13
 * up to degree 300. 0 for l < l', and sum_l M_{l'l}^2 = 1. */
pspec_status ps_half_range_matrix(size_t max_from, size_t max_to, double *matrix,
                                  ps_error *error) PS_MUST_CHECK;

#endif
