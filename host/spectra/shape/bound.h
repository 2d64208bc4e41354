/* P15's profiles that a spectrum lies below or above. The formulas:
 * docs/mathematics/statistics.md, Shapes. */
#ifndef PS_SPECTRA_SHAPE_BOUND_H
#define PS_SPECTRA_SHAPE_BOUND_H

#include "spectra/spectrum.h"

/* gamma (nu / alpha)^exponent below alpha, gamma from there on, nu the normalized frequency;
 * constant where the exponent is 0, and alpha is then 0. */
typedef struct ps_bound {
    double gamma, alpha, exponent;
} ps_bound;
double ps_bound_power(const ps_bound *self, double normalized_frequency);

/* The profile of that exponent, 0 or more, with the least gamma and, for it, the largest alpha that
 * is nowhere below P + 3 standard errors. Fails with a sentence where bins have no standard errors.
 */
pspec_status ps_bound_above(ps_bound *out, const ps_spectrum *spectrum, double exponent,
                            ps_error *error) PS_MUST_CHECK;
/* That with the largest gamma and the least alpha that is nowhere above P - 3 standard errors. For
 * exponents above 0 gamma is that of normalized frequencies from 0.6 on, on the sphere sqrt(pi)
 * times that. Fails with a sentence where that is 0 or less. */
pspec_status ps_bound_below(ps_bound *out, const ps_spectrum *spectrum, double exponent,
                            ps_error *error) PS_MUST_CHECK;

#endif
