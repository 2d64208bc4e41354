/* What is said of a spectrum in a line: peak, effective Nyquist frequency, anisotropy. */
#ifndef PS_SPECTRA_SHAPE_FEATURES_H
#define PS_SPECTRA_SHAPE_FEATURES_H

#include "spectra/spectrum.h"

/* nan: there is no such thing. */
typedef struct ps_features {
    double peak, peak_error, peak_frequency; /* of the bin with the largest power */
    /* Half of the normalized frequency up to which the mean power of all frequencies is 0.1, the
     * last such one before it is 0.5: 1/2 of a square grid, 0 of white noise */
    double effective_nyquist;
    double anisotropy_db; /* of the mean of s^2 / P^2 over rings, by their counts */
} ps_features;
ps_features ps_features_find(const ps_spectrum *spectrum);

#endif
