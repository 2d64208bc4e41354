/* (E-13) of the paper: the variance as an integral over |k| of radial means, instead of the sum
 * over whole frequencies.
 *
 *     (1/N) S_d int_0^inf rho^(d-1) Pm(rho) PF(rho) d rho
 *
 * It is what is left of (V4) (docs/mathematics/torus.md#variance) without the last term, -P(0+)
 * f_0^2 / N, and too large by that.
 */
#ifndef PS_JOBS_VARIANCE_RADIAL_H
#define PS_JOBS_VARIANCE_RADIAL_H

#include "integrands/integrand.h"
#include "spectra/spectrum.h"

/* Pm is linear in rho^2 from the mean |k|^2 of a ring to that of the next, and so continued below
 * the first; beyond the last ring it is 1. The integrand is radial, and the spectrum is of the box
 * or ball of rings by rounding, enumerated. */
pspec_status ps_radial_variance(double *out, const ps_integrand *integrand,
                                const ps_spectrum *spectrum, ps_error *error) PS_MUST_CHECK;

#endif
