/* Variances by the profiles below and above a spectrum, in place of its powers. */
#ifndef PS_JOBS_VARIANCE_BOUNDS_H
#define PS_JOBS_VARIANCE_BOUNDS_H

#include "jobs/variance/prediction.h"
#include "spectra/shape/bound.h"

/* (1/N) sum of weights times the profile, the rigorous form of P15's bounds, over whole
 * frequencies (docs/mathematics/torus.md): up to the cut-off, and beyond it to where the profile is
 * flat, as far as there are two million frequencies or fewer. What lies beyond that has gamma in a
 * bound from above; in one from below the least that the profile has there, which is gamma where it
 * is flat. The spectrum says which frequencies there are, and N. */
pspec_status ps_bounds_variance(double *out, const ps_integrand *integrand,
                                const ps_spectrum *spectrum, bool over_shells,
                                const ps_point_way *way, const ps_bound *profile, bool is_below,
                                ps_error *error) PS_MUST_CHECK;

#endif
