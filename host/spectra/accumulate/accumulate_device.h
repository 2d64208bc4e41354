/* The device half of accumulate.h: sums over rows that stay in device memory. */
#ifndef PS_SPECTRA_ACCUMULATE_ACCUMULATE_DEVICE_H
#define PS_SPECTRA_ACCUMULATE_ACCUMULATE_DEVICE_H

#include "spectra/accumulate/accumulate.h"

typedef struct ps_device_accumulator ps_device_accumulator;

/* Lanes of the kernels that take rows of options' stride and batch: realizations side by side.
 * Results do not depend on it. */
unsigned ps_accumulate_lanes(const ps_accumulator_options *options, const ps_device_limits *limits);

/* options->slots must outlive the accumulator. mean_only is about frequencies here: powers of bins
 * go to the host. */
pspec_status ps_device_accumulator_create(ps_device_accumulator **out,
                                          const ps_accumulator_options *options, ps_device *device,
                                          ps_error *error) PS_MUST_CHECK;
void ps_device_accumulator_destroy(ps_device_accumulator *accumulator);
/* Adds the rows, for which nobody waits; PSPEC_ERROR_MEMORY: it has added nothing. At most two
 * calls are ahead of their `take`. */
pspec_status ps_device_accumulator_add(ps_device_accumulator *accumulator, const ps_rows *rows,
                                       ps_error *error) PS_MUST_CHECK;
/* bin_powers[num_rows][num_bins] receives the means over bins of the rows of the earliest call of
 * `add` that was not taken yet. */
pspec_status ps_device_accumulator_take(ps_device_accumulator *accumulator, size_t num_rows,
                                        double *bin_powers, ps_error *error) PS_MUST_CHECK;
void ps_device_accumulator_forget(ps_device_accumulator *accumulator); /* what was not taken */
void ps_device_accumulator_reset(ps_device_accumulator *accumulator);
/* Only with want_frequencies: [num_frequencies] */
pspec_status ps_device_accumulator_sums(ps_device_accumulator *accumulator, ps_sums *sums,
                                        ps_error *error) PS_MUST_CHECK;
pspec_status ps_device_accumulator_frequencies(ps_device_accumulator *accumulator, ps_mean *means,
                                               ps_error *error) PS_MUST_CHECK;

#endif
