/* The shape of a spectrum: its low end and the profiles about it, or why there are none. */
#ifndef PS_SPECTRA_SHAPE_SHAPE_H
#define PS_SPECTRA_SHAPE_SHAPE_H

#include "spectra/shape/bound.h"
#include "spectra/shape/low_end.h"
#include "spectra/spectrum.h"

/* What could not be found has a reason of another status than PSPEC_OK. */
typedef struct ps_shape {
    ps_low_end low;
    ps_bound above, below;
    ps_error low_reason, above_reason, below_reason;
} ps_shape;

/* Profiles of that exponent; nan: the whole number nearest to that of the low end, or 0 below it.
 * Fails for want of memory alone. */
pspec_status ps_shape_find(ps_shape *out, const ps_spectrum *spectrum, double exponent,
                           ps_error *error) PS_MUST_CHECK;

/* What is said of a spectrum in a line: peak, effective Nyquist frequency, anisotropy. nan:
 * there is no such thing. */
typedef struct ps_features {
    double peak, peak_error, peak_frequency; /* of the bin with the largest power */
    /* Half of the normalized frequency up to which the mean power of all frequencies is 0.1, the
     * last such one before it is 0.5: 1/2 of a square grid, 0 of white noise */
    double effective_nyquist;
    double anisotropy_db; /* of the mean of s^2 / P^2 over rings, by their counts */
} ps_features;
ps_features ps_features_find(const ps_spectrum *spectrum);

/* How fast variances of integration fall as N grows, as far as the low end of a spectrum says it:
 * Var ~ N^-r, if spectra of more points are the same function of the normalized frequency.
 * docs/mathematics/statistics.md, Shapes. */
typedef enum ps_convergence_kind {
    PS_CONVERGENCE_UNKNOWN, /* plateau or law, nobody knows */
    PS_CONVERGENCE_UNFIT,   /* neither fits */
    PS_CONVERGENCE_FAINT,   /* a plateau far below the first ring or degree: as good as its model */
    PS_CONVERGENCE_MIXED,   /* the power depends on the direction, and rings are means of it */
    PS_CONVERGENCE_WHITE,   /* r = 1: a plateau */
    PS_CONVERGENCE_FAST,    /* more */
    PS_CONVERGENCE_SLOW     /* less: the power rises without end */
} ps_convergence_kind;

typedef struct ps_convergence {
    ps_convergence_kind kind;
    /* r of integrands whose frequencies end somewhere, and of those with a jump; errors of 0: the
     * same for all exponents that are within three standard errors. nan where nothing is known */
    double smooth, smooth_error, jump, jump_error;
    double most_plateau; /* of a law: the power at frequency 0 that there may be all the same */
    /* s^2/P^2 of the rings that were fitted, but for the first one, without what few realizations
     * make of it; nan: there are none, as on the sphere */
    double anisotropy;
} ps_convergence;

ps_convergence ps_convergence_find(const ps_low_end *low, const ps_spectrum *spectrum);
/* What N^(1/d) has for d: 2 on the sphere. */
unsigned ps_convergence_dimension(const ps_spectrum *spectrum);

#endif
