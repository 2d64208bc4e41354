/* The shape of a spectrum: its low end and the profiles about it, or why there are none. */
#ifndef PS_SPECTRA_SHAPE_SHAPE_H
#define PS_SPECTRA_SHAPE_SHAPE_H

#include "spectra/shape/bound.h"
#include "spectra/shape/low_end.h"

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

#endif
