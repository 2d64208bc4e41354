/* Bins of frequencies: rings or shells of the integer lattice by the rule of the frequencies
 * (frequencies/bin_rule.h), or single degrees of the sphere.
 *
 * What belongs to no reported bin (corners of a box, a list of frequencies that was not drawn from
 * rings) forms one more bin at the end, so that the power of a realization over all frequencies is
 * always known. DC, which only a list can hold, belongs to no bin at all.
 */
#ifndef PS_SPECTRA_BINS_H
#define PS_SPECTRA_BINS_H

#include "frequencies/frequencies.h"

typedef struct ps_bin {
    int64_t key;       /* ring number, |k|^2 of a shell, or degree */
    size_t begin, end; /* members[begin .. end - 1], half-lattice frequencies, one at least */
    uint64_t num_frequencies; /* half-lattice frequencies that it has; members may be a subset */
    /* frequencies of both signs that it has, or the 2l + 1 orders of a degree */
    uint64_t num_modes;
    double mean_frequency; /* mean |k| of all of them, or the degree */
} ps_bin;

/* Modes that were computed: of both signs, or all orders. */
uint64_t ps_bin_num_computed(const ps_bin *bin);

typedef struct ps_bins {
    size_t num; /* all bins, the unreported one included */
    size_t num_reported;
    ps_bin *bins;      /* ascending key */
    uint32_t *members; /* indices of frequencies, bin by bin */
    size_t num_members;
} ps_bins;

/* frequencies must be enumerated; a list is put into the unreported bin as a whole, unless it was
 * drawn from rings or shells: its rule must then be what it was drawn from, else
 * PSPEC_ERROR_INPUT. */
pspec_status ps_bins_create(ps_bins *out, const ps_frequencies *frequencies,
                            ps_error *error) PS_MUST_CHECK;
void ps_bins_free(ps_bins *bins);

#endif
