#include "spectra/accumulate/accumulate_device.h"

#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static size_t num_states(const ps_device_states *self) {
    return self->mean_only ? PS_STATE_SQUARE : PS_NUM_STATES;
}

static size_t rows_bytes(const ps_device_states *self, size_t num_rows) {
    return num_rows * self->stride * self->real_bytes;
}

/* ---- create ------------------------------------------------------------------------------ */

static pspec_status create_strips(ps_device_states *self, size_t batch, ps_error *error) {
    static const char file[] = "accumulate/strips.cl";
    ps_defines defines = ps_defines_of(self->real_bytes, self->lanes);
    ps_defines_add(&defines, "-DSQUARES=%d", self->mean_only ? 0 : 1);
    self->num_strips = most_strips(batch);
    PS_TRY(
        ps_kernel_get(self->device, &self->strips, file, "accumulate_strips", defines.text, error));
    return ps_kernel_get(self->device, &self->merge, file, "accumulate_merge", defines.text, error);
}

/* A larger buffer, with what was in the old one. */
static pspec_status grow(const ps_device_states *self, ps_buffer *buffer, size_t bytes,
                         ps_error *error) {
    ps_buffer grown = {0};
    pspec_status status =
        ps_buffer_create(self->device, &grown, bytes, "sums of frequencies", error);
    if (status == PSPEC_OK && buffer->bytes > 0) {
        const ps_rectangle all = {.row_bytes = buffer->bytes,
                                  .num_rows = 1,
                                  .from_pitch = buffer->bytes,
                                  .to_pitch = buffer->bytes};
        status = ps_buffer_copy_rectangle(self->device, buffer, &grown, &all, error);
    }
    ps_buffer *const released = status == PSPEC_OK ? buffer : &grown;
    const ps_buffer kept = status == PSPEC_OK ? grown : *buffer;
    ps_buffer_release(released);
    *buffer = kept;
    return status;
}

pspec_status ps_device_states_reserve(ps_device_states *states, uint64_t count, ps_error *error) {
    const unsigned levels = sum_levels(count);
    void *host = NULL;
    if (states->host != NULL && levels <= states->levels) {
        return PSPEC_OK;
    }
    for (size_t i = 0; i < num_states(states); i++) {
        PS_TRY(grow(states, &states->buffers[i],
                    rows_bytes(states, 1 + levels + states->num_strips), error));
    }
    PS_TRY(ps_allocate(&host, num_states(states), rows_bytes(states, 1 + levels),
                       "sums of frequencies", error));
    free(states->host);
    states->host = host;
    states->levels = levels;
    return PSPEC_OK;
}

pspec_status ps_device_states_create(ps_device_states *out, const ps_accumulator_options *options,
                                     ps_device *device, ps_error *error) {
    *out = (ps_device_states){.device = device,
                              .stride = options->stride,
                              .real_bytes = ps_real_bytes(options->precision),
                              .lanes = options->lanes,
                              .mean_only = options->mean_only};
    if (ps_device_get_limits(device)->has_dedicated_local_memory) {
        PS_TRY(create_strips(out, options->batch, error));
    }
    return ps_device_states_reserve(out, options->expected, error);
}

void ps_device_states_free(ps_device_states *states) {
    for (size_t i = 0; i < PS_NUM_STATES; i++) {
        ps_buffer_release(&states->buffers[i]);
    }
    free(states->host);
    *states = (ps_device_states){0};
}

/* ---- add --------------------------------------------------------------------------------- */

pspec_status ps_device_states_add(ps_device_states *states, const ps_rows *rows,
                                  const blocks_numbers *numbers, ps_error *error) {
    const double flops_per_power = 16; /* a sum and a sum of squares in pairs */
    const size_t vectors = ps_divide_up(rows->stride, states->lanes);
    const size_t num_strips =
        ps_divide_up(numbers->done + rows->num_rows, SUM_BLOCK) - numbers->done / SUM_BLOCK;
    const double powers = (double)(rows->num_rows * rows->stride);
    const ps_range add =
        ps_range_light(states->device, vectors, num_strips, 1, flops_per_power * powers,
                       powers * (double)states->real_bytes);
    const ps_range merge = ps_range_light(states->device, vectors, 1, 1, 0, 0);
    const uint32_t first_strip = 1 + states->levels;
    PS_TRY(PS_LAUNCH(states->device, states->strips, &add, error, PS_STRUCT(*numbers),
                     PS_BUFFER(rows->device), PS_STATE_ARGUMENTS(states), PS_U32(first_strip)));
    return PS_LAUNCH(states->device, states->merge, &merge, error, PS_STRUCT(*numbers),
                     PS_STATE_ARGUMENTS(states), PS_U32(first_strip));
}

/* ---- get --------------------------------------------------------------------------------- */

pspec_status ps_device_states_read(ps_device_states *states, ps_error *error) {
    const size_t bytes = rows_bytes(states, 1 + (size_t)states->levels);
    for (size_t i = 0; i < num_states(states); i++) {
        PS_TRY(ps_buffer_read(states->device, &states->buffers[i], 0,
                              (char *)states->host + i * bytes, bytes, error));
    }
    return PSPEC_OK;
}

ps_sums ps_device_states_row(const ps_device_states *states, unsigned row, size_t slot) {
    const double none = states->mean_only ? NAN : 0;
    double state[PS_NUM_STATES] = {0, 0, none, none};
    for (size_t i = 0; i < num_states(states); i++) {
        const size_t at = (i * (1 + (size_t)states->levels) + row) * states->stride + slot;
        state[i] = states->real_bytes == sizeof(float) ? (double)((const float *)states->host)[at]
                                                       : ((const double *)states->host)[at];
    }
    return (ps_sums){state[PS_STATE_SUM], state[PS_STATE_SUM_LOW], state[PS_STATE_SQUARE],
                     state[PS_STATE_SQUARE_LOW]};
}

ps_sums ps_device_states_get(const ps_device_states *states, size_t slot) {
    ps_sums sums = states->mean_only ? PS_SUMS_MEAN_ONLY : (ps_sums){0};
    for (unsigned row = 0; row <= states->levels; row++) {
        if (ps_running_has_row(states->count, row)) {
            const ps_sums part = ps_device_states_row(states, row, slot);
            ps_sums_merge(&sums, &part, 1);
        }
    }
    if (states->real_bytes == sizeof(float) && states->count > 0) {
        ps_sums_drop_rounding(&sums, states->count);
    }
    return sums;
}

/* ---- checkpoints ------------------------------------------------------------------------- */

static pspec_status walk_row(const ps_device_states *self, ps_snapshot *snapshot, unsigned row,
                             ps_error *error) {
    const size_t bytes = rows_bytes(self, 1);
    for (size_t i = 0; i < num_states(self); i++) {
        char name[64];
        char *const from = self->host;
        snprintf(name, sizeof name, "device_%u_%zu", row, i);
        PS_TRY(ps_snapshot_bytes(
            snapshot, name, from + (i * (1 + (size_t)self->levels) + row) * bytes, bytes, error));
    }
    return PSPEC_OK;
}

static pspec_status write_rows(ps_device_states *self, ps_error *error) {
    const size_t bytes = rows_bytes(self, 1 + (size_t)self->levels);
    for (size_t i = 0; i < num_states(self); i++) {
        PS_TRY(ps_buffer_write(self->device, &self->buffers[i], 0,
                               (const char *)self->host + i * bytes, bytes, error));
    }
    return PSPEC_OK;
}

pspec_status ps_device_states_walk(ps_device_states *states, ps_snapshot *snapshot,
                                   ps_error *error) {
    const bool is_read = ps_snapshot_is_read(snapshot);
    PS_TRY(is_read ? ps_device_states_reserve(states, states->count, error)
                   : ps_device_states_read(states, error));
    for (unsigned row = 0; row <= states->levels; row++) {
        PS_TRY(ps_running_has_row(states->count, row) ? walk_row(states, snapshot, row, error)
                                                      : PSPEC_OK);
    }
    return is_read ? write_rows(states, error) : PSPEC_OK;
}
