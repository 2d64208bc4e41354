/* The measures that the table of measures.c names. Private to jobs/measure. */
#ifndef PS_JOBS_MEASURE_MEASURE_ROWS_H
#define PS_JOBS_MEASURE_MEASURE_ROWS_H

#include "jobs/measure/measures.h"

#define PS_MEASURE_OF_SET(name)                                                                    \
    pspec_status ps_measure_##name(const ps_measured_set *set, double *value, ps_error *error)
#define PS_MEASURE_OF_SPECTRUM(name)                                                               \
    ps_mean ps_measure_##name(ps_spectrum *spectrum, const ps_shape *shape)

/* of_sets.c */
PS_MEASURE_OF_SET(least_distance);
PS_MEASURE_OF_SET(mean_distance);
PS_MEASURE_OF_SET(coincident_points);
PS_MEASURE_OF_SET(separation);
PS_MEASURE_OF_SET(number_variance);
PS_MEASURE_OF_SET(capacity_error);
PS_MEASURE_OF_SET(star_discrepancy);
PS_MEASURE_OF_SET(periodic_discrepancy);
PS_MEASURE_OF_SET(stolarsky_sum);
PS_MEASURE_OF_SET(cap_discrepancy);

/* of_spectra.c */
PS_MEASURE_OF_SPECTRUM(low_exponent);
PS_MEASURE_OF_SPECTRUM(hyperuniformity_index);
PS_MEASURE_OF_SPECTRUM(peak_power);
PS_MEASURE_OF_SPECTRUM(effective_nyquist);
PS_MEASURE_OF_SPECTRUM(oscillation);

#endif
