/* The state of an accumulator, to a checkpoint or from one. */
#include "spectra/accumulate/accumulate_private.h"

#include <stdio.h>

static pspec_status walk_blocks(ps_accumulator *self, ps_snapshot *snapshot, ps_error *error) {
    for (size_t w = 0; w < self->options.num_weighted; w++) {
        char name[48];
        snprintf(name, sizeof name, "blocks_%zu", w);
        PS_TRY(ps_block_sums_walk(&self->weighted_blocks[w], snapshot, name, error));
    }
    return PSPEC_OK;
}

pspec_status ps_accumulator_walk(ps_accumulator *accumulator, ps_snapshot *snapshot,
                                 ps_error *error) {
    ps_accumulator *const self = accumulator;
    PS_TRY(ps_accumulator_settle(self, error));
    PS_TRY(ps_snapshot_doubles(snapshot, "largest", &self->largest, 1, error));
    PS_TRY(ps_snapshot_counts(snapshot, "accumulated", &self->num_realizations, 1, error));
    PS_TRY(ps_running_sums_walk(&self->bin_sums, snapshot, "bins", error));
    PS_TRY(ps_running_sums_walk(&self->frequency_sums, snapshot, "frequencies", error));
    PS_TRY(ps_running_sums_walk(&self->weighted_sums, snapshot, "weighted", error));
    PS_TRY(walk_blocks(self, snapshot, error));
    return self->on_device != NULL ? ps_device_accumulator_walk(self->on_device, snapshot, error)
                                   : PSPEC_OK;
}
