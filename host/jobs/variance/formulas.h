/* Variances by other formulas than the sum over whole frequencies of a spectrum's powers. */
#ifndef PS_JOBS_VARIANCE_FORMULAS_H
#define PS_JOBS_VARIANCE_FORMULAS_H

#include "jobs/variance/prediction.h"
#include "spectra/shape/bound.h"

/* By the profiles below and above the spectrum, in place of its powers: (1/N) sum of weights times
 * the profile, the rigorous form of P15's bounds, over whole
 * frequencies (docs/mathematics/torus.md): up to the cut-off, and beyond it to where the profile is
 * flat, as far as there are two million frequencies or fewer. What lies beyond that has gamma in a
 * bound from above; in one from below the least that the profile has there, which is gamma where it
 * is flat. The spectrum says which frequencies there are, and N. */
pspec_status ps_bounds_variance(double *out, const ps_integrand *integrand,
                                const ps_spectrum *spectrum, bool over_shells,
                                const ps_point_way *way, const ps_bound *profile, bool is_below,
                                ps_error *error) PS_MUST_CHECK;

/* (E-13) of the paper: the variance as an integral over |k| of radial means, instead of the sum
 * over whole frequencies.
 *
 *     (1/N) S_d int_0^inf rho^(d-1) Pm(rho) PF(rho) d rho
 *
 * It is what is left of (V4) (docs/mathematics/torus.md#variance) without the last term, -P(0+)
 * f_0^2 / N, and too large by that.
 *
 * Pm is linear in rho^2 from the mean |k|^2 of a ring to that of the next, and so continued below
 * the first; beyond the last ring it is 1. The integrand is radial, and the spectrum is of the box
 * or ball of rings by rounding, enumerated. */
pspec_status ps_radial_variance(double *out, const ps_integrand *integrand,
                                const ps_spectrum *spectrum, ps_error *error) PS_MUST_CHECK;

#endif
