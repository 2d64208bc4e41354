/* How a mean spectrum behaves towards frequency 0: by a power law, or as a plateau. The formulas
 * and what their errors are worth: docs/mathematics/statistics.md, Shapes.
 */
#ifndef PS_SPECTRA_SHAPE_LOW_END_H
#define PS_SPECTRA_SHAPE_LOW_END_H

#include "spectra/spectrum.h"

/* Fewer have standard errors that say too little of themselves. */
enum { PS_FEWEST_FITTED_REALIZATIONS = 8, PS_FEWEST_FITTED_BINS = 6 };

typedef enum ps_low_shape {
    PS_LOW_POWER_LAW, /* the power falls to 0, or rises without end */
    PS_LOW_PLATEAU,   /* it has a limit above 0 */
    PS_LOW_UNDECIDED, /* it may be either: more realizations would say */
    PS_LOW_NEITHER    /* its chi^2 tells it from what it is most like */
} ps_low_shape;

typedef struct ps_low_end {
    size_t num_bins; /* the first ones, which were fitted */
    double reach;    /* their last normalized frequency */
    ps_low_shape shape;
    /* P = factor nu^exponent exp(curvature nu^2), nu the normalized frequency, on the sphere
     * sqrt(l(l+1)/N), of which smooth correlations have even powers, too */
    double factor, exponent, exponent_error, curvature;
    /* P = plateau + square nu^2 + fourth nu^4 */
    double plateau, plateau_error, square, fourth;
    double law_chi2, plateau_chi2; /* of the two, each with */
    size_t degrees_of_freedom;
} ps_low_end;

/* PSPEC_ERROR_INPUT with a sentence where the spectrum does not say it: too few bins below half of
 * a normalized frequency (on the sphere sqrt(pi) times that), too few realizations, a power or a
 * standard error that is not above 0. */
pspec_status ps_low_end_fit(ps_low_end *out, const ps_spectrum *spectrum,
                            ps_error *error) PS_MUST_CHECK;
/* The fitted curve of its shape at a bin of the spectrum: the law for one that is undecided, that
 * with the smaller chi^2 for what is neither. */
double ps_low_end_power(const ps_low_end *self, const ps_spectrum *spectrum,
                        const ps_spectrum_bin *bin);

/* Normalized degrees per normalized frequency of the plane with as many points in its unit cell: 1
 * on the torus, sqrt(pi) on the sphere. */
double ps_shape_unit(const ps_spectrum *spectrum);
/* "ring", "degree" */
const char *ps_shape_bin_name(const ps_spectrum *spectrum);

#endif
