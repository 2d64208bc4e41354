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
/* As those of ps_device_accumulator: sums of every realization are formed, and
 * values[num_rows][num_weighted] receives them later. */
pspec_status ps_device_weighted_add(ps_device_weighted *weighted, const ps_rows *rows,
                                    ps_error *error) PS_MUST_CHECK;
pspec_status ps_device_weighted_take(ps_device_weighted *weighted, size_t num_rows, double *values,
                                     ps_error *error) PS_MUST_CHECK;
void ps_device_weighted_forget(ps_device_weighted *weighted);

#endif
