/* Inside of ps_accumulator, for the files accumulate*.c only. */
#ifndef PS_SPECTRA_ACCUMULATE_ACCUMULATE_PRIVATE_H
#define PS_SPECTRA_ACCUMULATE_ACCUMULATE_PRIVATE_H

#include "spectra/accumulate/accumulate_device.h"

struct ps_accumulator {
    ps_accumulator_options options;
    uint32_t *slots;
    ps_device_accumulator *on_device; /* NULL: rows are on the host */
    ps_device_weighted *weighted;     /* NULL: that, or no weights */
    ps_bin all;                       /* members of all bins in one, */
    ps_bins one;                      /* and that alone */
    /* bins whose powers are formed for each realization: all of them, or that one */
    const ps_bins *formed;
    double *bin_powers; /* [batch][formed->num] */
    double *units;      /* [batch], of the batch that is pending */
    size_t num_pending; /* rows of it; 0: none is */
    double largest;     /* mean power, in its unit */
    uint64_t num_realizations;
    ps_running_sums bin_sums;       /* none of single members: those of frequencies are theirs */
    ps_running_sums frequency_sums; /* host rows only */
    double *weighted_powers;        /* [batch][num_weighted] */
    ps_running_sums weighted_sums;
    ps_block_sums *weighted_blocks; /* the same */
};

#endif
