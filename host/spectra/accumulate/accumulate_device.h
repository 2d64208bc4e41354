/* The device half of accumulate.h: sums over rows that stay in device memory. */
#ifndef PS_SPECTRA_ACCUMULATE_ACCUMULATE_DEVICE_H
#define PS_SPECTRA_ACCUMULATE_ACCUMULATE_DEVICE_H

#include "spectra/accumulate/accumulate.h"
#include "accumulate/blocks.h"
#include "spectra/bins.h"

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
/* State of what was taken, to a checkpoint or from one. */
pspec_status ps_device_accumulator_walk(ps_device_accumulator *accumulator, ps_snapshot *snapshot,
                                        ps_error *error) PS_MUST_CHECK;
/* Only with want_frequencies: [num_frequencies] */
pspec_status ps_device_accumulator_sums(ps_device_accumulator *accumulator, ps_sums *sums,
                                        ps_error *error) PS_MUST_CHECK;
/* The rows of these sums, which read brings to the host. */
pspec_status ps_device_accumulator_read(ps_device_accumulator *accumulator,
                                        ps_error *error) PS_MUST_CHECK;
ps_sums ps_device_accumulator_row(const ps_device_accumulator *accumulator, unsigned row,
                                  size_t frequency);
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
/* One row as it is; those that states->count does not have are left from before. */
ps_sums ps_device_states_row(const ps_device_states *states, unsigned row, size_t slot);
ps_sums ps_device_states_get(const ps_device_states *states, size_t slot);
/* Rows that there are of count realizations, to a checkpoint or from one. */
pspec_status ps_device_states_walk(ps_device_states *states, ps_snapshot *snapshot,
                                   ps_error *error) PS_MUST_CHECK;

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

/* Members of bins by blocks of slots: what kernels/accumulate/blocks.cl walks through. */

/* Slots of a block, as in the kernel. */
enum { PS_ACCUMULATE_BLOCK = 512 };
/* Members of a piece at most, so that one item of a GPU does not add up long ones while others
 * wait. Sums depend on it. */
enum { PS_ACCUMULATE_PIECE = 16 };

/* Successive members of one bin in one block; their sum is a piece of the bin. */
typedef struct ps_block_ring {
    uint32_t first, end, piece;
} ps_block_ring;

typedef struct ps_accumulate_blocks {
    size_t num_blocks, num_pieces, num_members, num_bins; /* as many rings as pieces */
    uint32_t *first_rings;                                /* [num_blocks + 1] */
    ps_block_ring *rings;                                 /* block by block */
    uint16_t *members;                                    /* ring by ring, slots within the block */
    uint32_t (*bin_pieces)[2];                            /* [num_bins]: first, one past the last */
} ps_accumulate_blocks;

/* slots: of the frequencies that are members of bins, below stride. */
pspec_status ps_accumulate_blocks_create(ps_accumulate_blocks *out, const ps_bins *bins,
                                         const uint32_t *slots, size_t stride,
                                         ps_error *error) PS_MUST_CHECK;
void ps_accumulate_blocks_free(ps_accumulate_blocks *blocks);

#endif
