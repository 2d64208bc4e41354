/* Sums by their rows: what ranges of realizations are put together from. */
#include "spectra/accumulate/accumulate_private.h"

pspec_status ps_accumulator_read_rows(ps_accumulator *accumulator, ps_error *error) {
    PS_TRY(ps_accumulator_settle(accumulator, error));
    return accumulator->on_device != NULL
               ? ps_device_accumulator_read(accumulator->on_device, error)
               : PSPEC_OK;
}

static ps_sums get_frequency(const ps_accumulator *self, unsigned row, size_t i) {
    return self->on_device != NULL ? ps_device_accumulator_row(self->on_device, row, i)
                                   : self->frequency_sums.rows[row * self->frequency_sums.num + i];
}

/* Single members have the sums of their frequencies. */
static ps_sums get_bin(const ps_accumulator *self, unsigned row, size_t b) {
    const ps_bins *const bins = self->options.bins;
    return self->formed == bins ? self->bin_sums.rows[row * self->bin_sums.num + b]
                                : get_frequency(self, row, bins->members[bins->bins[b].begin]);
}

void ps_accumulator_get_row(const ps_accumulator *accumulator, unsigned row, ps_sums *bins,
                            ps_sums *frequencies) {
    for (size_t b = 0; b < accumulator->options.bins->num; b++) {
        bins[b] = get_bin(accumulator, row, b);
    }
    for (size_t i = 0; frequencies != NULL && i < accumulator->options.num_frequencies; i++) {
        frequencies[i] = get_frequency(accumulator, row, i);
    }
}

void ps_accumulator_find_singles(const ps_accumulator *accumulator, bool *bins, bool *frequencies) {
    *frequencies = accumulator->on_device != NULL && accumulator->options.precision == PS_SINGLE;
    *bins = *frequencies && accumulator->formed != accumulator->options.bins;
}

void ps_accumulator_restart(ps_accumulator *accumulator) {
    accumulator->bin_sums.count = 0;
    accumulator->frequency_sums.count = 0;
    if (accumulator->on_device != NULL) {
        ps_device_accumulator_reset(accumulator->on_device);
    }
}
