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
/* What is asked for. */
typedef struct ps_bounds_spec {
    bool is_wanted;
    bool is_given; /* these, else those of the spectrum that is found */
    ps_bound below, above;
} ps_bounds_spec;
double ps_bound_power(const ps_bound *self, double normalized_frequency);

/* A normalized frequency, 0 or more, at which the profile below is above the other one; -1: there
 * is none. */
double ps_bounds_find_crossed(const ps_bounds_spec *self);

/* Variances of integration fall like N^-rate, by the profile as N grows: of integrands whose
 * frequencies end somewhere (infinite of a step), and of those with a jump, where an exponent 1 has
 * a logarithm besides. */
typedef struct ps_bound_rates {
    double smooth, jump;
} ps_bound_rates;
ps_bound_rates ps_bound_find_rates(const ps_bound *self, unsigned dimension);

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
