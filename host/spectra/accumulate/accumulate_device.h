/* The device half of accumulate.h: sums over rows that stay in device memory. */
#ifndef PS_SPECTRA_ACCUMULATE_ACCUMULATE_DEVICE_H
#define PS_SPECTRA_ACCUMULATE_ACCUMULATE_DEVICE_H

#include "spectra/accumulate/accumulate.h"
#include "accumulate/blocks.h"

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

/* Sums over realizations of every frequency, in device memory: the rows of ps_running_sums
 * (spectra/sums.h), by slots. Kernels of CPUs add to them while they form bins (blocks.cl); on GPUs
 * it is done here, by kernels/accumulate/strips.cl.
 */
/* Sums, and sums of squares, in pairs. */
enum { PS_STATE_SUM, PS_STATE_SUM_LOW, PS_STATE_SQUARE, PS_STATE_SQUARE_LOW, PS_NUM_STATES };

typedef struct ps_device_states {
    ps_device *device;
    size_t stride, real_bytes;
    unsigned lanes;
    bool mean_only;            /* the last two are not there */
    ps_kernel *strips, *merge; /* on GPUs */
    size_t num_strips;         /* rows that they need behind the others */
    unsigned levels;
    uint64_t count; /* of realizations */
    ps_buffer buffers[PS_NUM_STATES];
    void *host; /* copies, one behind the other */
} ps_device_states;

/* For options->expected realizations, or more by ps_device_states_reserve. */
pspec_status ps_device_states_create(ps_device_states *out, const ps_accumulator_options *options,
                                     ps_device *device, ps_error *error) PS_MUST_CHECK;
void ps_device_states_free(ps_device_states *states); /* {0} is allowed */
/* Room for so many realizations in all. */
pspec_status ps_device_states_reserve(ps_device_states *states, uint64_t count,
                                      ps_error *error) PS_MUST_CHECK;

/* On GPUs: adds rows of which numbers tells. */
pspec_status ps_device_states_add(ps_device_states *states, const ps_rows *rows,
                                  const blocks_numbers *numbers, ps_error *error) PS_MUST_CHECK;

/* Arguments of a kernel. It wants a buffer in every place: without squares, those of the sums,
 * which are not touched there. */
#define PS_STATE_ARGUMENTS(states)                                                                 \
    PS_BUFFER((states)->buffers[PS_STATE_SUM]), PS_BUFFER((states)->buffers[PS_STATE_SUM_LOW]),    \
        PS_BUFFER((states)->buffers[(states)->mean_only ? PS_STATE_SUM : PS_STATE_SQUARE]),        \
        PS_BUFFER((states)->buffers[(states)->mean_only ? PS_STATE_SUM_LOW : PS_STATE_SQUARE_LOW])

/* Brings the sums to the host, where ps_device_states_get finds them. */
pspec_status ps_device_states_read(ps_device_states *states, ps_error *error) PS_MUST_CHECK;
ps_sums ps_device_states_get(const ps_device_states *states, size_t slot);

/* Weighted sums of powers over rows that stay in device memory. */
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
