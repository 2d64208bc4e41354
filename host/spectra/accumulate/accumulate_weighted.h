/* Weighted sums of powers over rows that stay in device memory. */
#ifndef PS_SPECTRA_ACCUMULATE_ACCUMULATE_WEIGHTED_H
#define PS_SPECTRA_ACCUMULATE_ACCUMULATE_WEIGHTED_H

#include "spectra/accumulate/accumulate.h"

typedef struct ps_device_weighted ps_device_weighted;

/* Of options' weights and slots a copy goes to the device. */
pspec_status ps_device_weighted_create(ps_device_weighted **out,
                                       const ps_accumulator_options *options, ps_device *device,
                                       ps_error *error) PS_MUST_CHECK;
void ps_device_weighted_destroy(ps_device_weighted *weighted);
/* values[num_rows][num_weighted] receives the sums of every realization. */
pspec_status ps_device_weighted_sums(ps_device_weighted *weighted, const ps_rows *rows,
                                     double *values, ps_error *error) PS_MUST_CHECK;

#endif
