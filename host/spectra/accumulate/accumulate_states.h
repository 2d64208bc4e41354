/* Sums over realizations of every frequency, in device memory: the rows of ps_running_sums
 * (spectra/sums.h), by slots. Kernels of CPUs add to them while they form bins (blocks.cl); on GPUs
 * it is done here, by kernels/accumulate/strips.cl.
 */
#ifndef PS_SPECTRA_ACCUMULATE_ACCUMULATE_STATES_H
#define PS_SPECTRA_ACCUMULATE_ACCUMULATE_STATES_H

#include "accumulate/blocks.h"
#include "spectra/accumulate/accumulate.h"

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

#endif
