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

#include <stdbool.h>
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

/* Of light with these P_F(l) [num_powers], and none beyond, instead of the a_l of a space: the mean
 * square over all orientations, sum_l P_F(l) (b_l - b'_l)^2, for L = 0 .. max_degree. */
pspec_status ps_truncation_of_light(const ps_brdf *brdf, bool is_hemispherical, size_t max_degree,
                                    const double *powers, size_t num_powers, double *squares,
                                    ps_error *error) PS_MUST_CHECK;

/* Hemispherical harmonics written in spherical ones
 * (docs/mathematics/quadrature.md#hemispherical-harmonics). */

/* M_{l'l} = sqrt((2l+1)(2l'+1)/2) int_0^1 P_l'(2z-1) P_l(z) dz, the coefficient of Y_l0 in the
 * hemispherical harmonic of degree l', which is 0 below the horizon: matrix [max_from + 1][max_to +
 * 1], row l', filled by a Gauss-Legendre rule that is exact for all of them; absolute error 1e-13
 * up to degree 300. 0 for l < l', and sum_l M_{l'l}^2 = 1. */
pspec_status ps_half_range_matrix(size_t max_from, size_t max_to, double *matrix,
                                  ps_error *error) PS_MUST_CHECK;

/* How many points of a good rule have the error of a truncated product: N with E_SF(N) = E(L), E_SF
 * the worst-case error of equal-weight spherical Fibonacci points of the hemisphere morphed to the
 * lobe (docs/mathematics/quadrature.md#truncation). */

/* 2^0 .. 2^15 points are the ladder; the last rung takes 5e8 pairs. */
enum { PS_EQUAL_ERROR_RUNGS = 16, PS_EQUAL_ERROR_MOST = 1 << (PS_EQUAL_ERROR_RUNGS - 1) };

/* Begins as {.representer = .., .morph = ..}, or {.error_of = .., .payload = ..} for another error
 * E_SF; remembers the errors of its ladder. */
typedef struct ps_equal_error {
    const ps_representer *representer;
    ps_morph morph;
    pspec_status (*error_of)(void *payload, size_t num_points, double *out, ps_error *error);
    void *payload;
    double ladder[PS_EQUAL_ERROR_RUNGS]; /* E_SF(2^i), 0 until it is known */
} ps_equal_error;

/* Its points, [num_points][3], freed by the caller. */
pspec_status ps_fibonacci_rule(double **out, size_t num_points, ps_morph morph,
                               ps_error *error) PS_MUST_CHECK;
/* E_SF(num_points). */
pspec_status ps_fibonacci_error(const ps_representer *representer, const ps_morph *morph,
                                size_t num_points, double *out, ps_error *error) PS_MUST_CHECK;

/* The smallest N of the ladder with E_SF(N) <= target, made finer by interpolation of the
 * logarithms; nan where more than PS_EQUAL_ERROR_MOST points are needed, and 1 where one is
 * enough. */
pspec_status ps_equal_error_points(ps_equal_error *equal_error, double target, double *num_points,
                                   ps_error *error) PS_MUST_CHECK;

#endif
