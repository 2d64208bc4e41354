/* Sums over realizations, streamed: memory does not grow with their number.
 *
 * Per frequency: sum and sum of squares of the power, in pairs (on the device where the rows are).
 * Per bin: the mean over the bin is formed for each realization first, then summed in the same way;
 * so a bin's standard error catches correlations between its frequencies
 * (docs/mathematics/statistics.md#standard-errors). All sums over realizations have the order of
 * kernels/accumulate/sums.h, whatever the batches were and wherever the rows are.
 *
 * Weighted sums, sum over frequencies of weight * power, are formed for each realization likewise:
 * their standard errors have the correlations of all frequencies
 * (docs/mathematics/statistics.md#weighted-sums).
 *
 * Where every bin has one member, as in one dimension, sums of bins are those of frequencies: on a
 * device only these are formed, unless realizations are to be handed on.
 */
#ifndef PS_SPECTRA_ACCUMULATE_ACCUMULATE_H
#define PS_SPECTRA_ACCUMULATE_ACCUMULATE_H

#include "engines/engine.h"
#include "spectra/bins.h"
#include "spectra/sums.h"

typedef struct ps_accumulator ps_accumulator;

/* Mean and standard error of the mean, nan when there was only one realization or with
 * mean_only. */
typedef struct ps_mean {
    double mean, standard_error;
} ps_mean;

/* Is handed each realization, in order, instead of it being added (ps_accumulator_add_one). */
typedef struct ps_accumulator_observer {
    void (*tell)(void *payload, const double *bins, const double *weighted); /* NULL: none */
    void *payload;
} ps_accumulator_observer;

typedef struct ps_accumulator_options {
    const ps_bins *bins; /* kept: must outlive the accumulator */
    size_t num_frequencies;
    const uint32_t *slots; /* [num_frequencies] places in a row, copied */
    size_t stride, batch;  /* of the rows; batch is the largest number of rows at a time */
    uint64_t expected; /* realizations in all, or 0: more than were expected take memory later */
    bool is_on_device;
    ps_precision precision;   /* of the rows */
    unsigned lanes;           /* of device rows */
    bool want_frequencies;    /* keep sums per frequency */
    bool mean_only;           /* no sums of squares: standard errors are nan */
    bool no_frequency_errors; /* no sums of squares of single frequencies: theirs are nan */
    /* Powers of all bins are formed for each realization, also of single members. Sums, and what is
     * handed on, are of them and of weighted sums alone: not with want_frequencies */
    bool forms_bins;
    ps_accumulator_observer observer;
    /* [num_weighted][num_frequencies], kept: must outlive the accumulator; NULL where there are
     * none. The largest of a vector is 0 or between 1e-140 and 1e140 in size, so that squares of
     * sums are numbers. A frequency of weight 0 is left out, whatever its power is. On the device
     * weights are rounded to the precision of the rows, relative to the largest. */
    const double *weights;
    size_t num_weighted;
} ps_accumulator_options;

pspec_status ps_accumulator_create(ps_accumulator **out, const ps_accumulator_options *options,
                                   ps_device *device, ps_error *error) PS_MUST_CHECK;
void ps_accumulator_destroy(ps_accumulator *accumulator);

/* Memory for so many realizations in all, which the next ones will not ask for then. */
pspec_status ps_accumulator_reserve(ps_accumulator *accumulator, uint64_t count,
                                    ps_error *error) PS_MUST_CHECK;
/* Adds the rows of one batch; allocates nothing unless there are more realizations than were
 * expected. Nobody waits for rows on the device: what they come to on the host is added by the next
 * call, or by ps_accumulator_settle. units[num_rows], copied, are what powers of each realization
 * are counted in for ps_accumulator_largest; NULL: 1. After PSPEC_ERROR_MEMORY nothing was added,
 * and fewer rows may be tried. */
pspec_status ps_accumulator_add(ps_accumulator *accumulator, const ps_rows *rows,
                                const double *units, ps_error *error) PS_MUST_CHECK;
/* Adds one realization that this accumulator, or another of the same options, has handed on:
 * bins[bins->num], weighted[num_weighted]. The sums have the bits of ps_accumulator_add. */
pspec_status ps_accumulator_add_one(ps_accumulator *accumulator, const double *bins,
                                    const double *weighted, double unit,
                                    ps_error *error) PS_MUST_CHECK;
/* Waits until all that was added is in the sums; what follows but ps_accumulator_reset needs that,
 * and does it where it has a status. */
pspec_status ps_accumulator_settle(ps_accumulator *accumulator, ps_error *error) PS_MUST_CHECK;
/* The largest mean power, in its unit, over all members of bins of a realization; nan where one
 * is. */
double ps_accumulator_largest(const ps_accumulator *accumulator);

/* Forgets every realization; allocates nothing. */
void ps_accumulator_reset(ps_accumulator *accumulator);

/* All state of what was added, to a checkpoint or from one, into an accumulator of the same
 * options. */
pspec_status ps_accumulator_walk(ps_accumulator *accumulator, ps_snapshot *snapshot,
                                 ps_error *error) PS_MUST_CHECK;

/* The sums themselves: bins[bins->num], frequencies[num_frequencies] or NULL when nobody asks. With
 * mean_only their squares are nan. */
pspec_status ps_accumulator_sums(ps_accumulator *accumulator, ps_sums *bins, ps_sums *frequencies,
                                 ps_error *error) PS_MUST_CHECK;
/* means[num_bins] */
pspec_status ps_accumulator_bins(ps_accumulator *accumulator, ps_mean *means,
                                 ps_error *error) PS_MUST_CHECK;
/* means[num_frequencies]; only with want_frequencies. */
pspec_status ps_accumulator_frequencies(ps_accumulator *accumulator, ps_mean *means,
                                        ps_error *error) PS_MUST_CHECK;
/* Of the weighted sums: means[num_weighted], in the units of weight times power of a row; standard
 * errors over realizations, as those of bins. */
void ps_accumulator_weighted(const ps_accumulator *accumulator, ps_mean *means);
/* The same by blocks of realizations, [num_weighted], until the next call. */
const ps_block_sums *ps_accumulator_weighted_blocks(const ps_accumulator *accumulator);

/* ---- rows, of which ranges of realizations are put together (spectra/sum_nodes.h) --------- */

/* Settles, and brings rows of a device to the host, where the next two find them. */
pspec_status ps_accumulator_read_rows(ps_accumulator *accumulator, ps_error *error) PS_MUST_CHECK;
/* Row 0 is the open block, 1 + k level k, of those that realizations since the last restart have:
 * bins[bins->num], frequencies[num_frequencies] or NULL. */
void ps_accumulator_get_row(const ps_accumulator *accumulator, unsigned row, ps_sums *bins,
                            ps_sums *frequencies);
/* Which of them are in pairs of single precision. */
void ps_accumulator_find_singles(const ps_accumulator *accumulator, bool *bins, bool *frequencies);
/* Begins sums of bins and frequencies with no realization, all else goes on; after read_rows. */
void ps_accumulator_restart(ps_accumulator *accumulator);

#endif
