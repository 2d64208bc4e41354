#include "spectra/accumulate/accumulate_device.h"

#include "base/memory.h"
#include "base/round.h"
#include "base/workers.h"
#include "device/reals.h"

#include <math.h>
#include <stdlib.h>

struct ps_device_accumulator {
    ps_device *device;
    ps_accumulator_options options; /* lanes: those of the accumulator */
    size_t real_bytes, num_groups, num_blocks, num_pieces;
    bool is_gpu;
    ps_kernel *blocks, *fold;
    ps_buffer first_rings, rings, members, bin_pieces, piece_sums, bin_sums;
    ps_device_states states; /* of frequencies, where they are wanted */
    ps_readings bins_read;
};

/* ---- create ------------------------------------------------------------------------------ */

static size_t block_bytes(unsigned lanes, size_t real_bytes) {
    return PS_ACCUMULATE_BLOCK * lanes * real_bytes;
}

/* Rows are whole vectors, and an engine may have had fewer lanes than suit the device. For few
 * realizations a vector that they do not fill costs memory and time; one that they fill by more
 * than a quarter is faster than a shorter one. */
unsigned ps_accumulate_lanes(const ps_accumulator_options *options,
                             const ps_device_limits *limits) {
    const size_t real_bytes = ps_real_bytes(options->precision);
    unsigned lanes = options->lanes;
    while (lanes > 1 && (options->stride % lanes != 0 || lanes >= 4 * options->batch ||
                         block_bytes(lanes, real_bytes) > limits->local_bytes)) {
        lanes /= 2;
    }
    return lanes;
}

static pspec_status upload_blocks(ps_device_accumulator *self, ps_error *error) {
    ps_accumulate_blocks blocks = {0};
    pspec_status status = PSPEC_OK;
    PS_TRY(ps_accumulate_blocks_create(&blocks, self->options.bins, self->options.slots,
                                       self->options.stride, error));
    self->num_blocks = blocks.num_blocks;
    self->num_pieces = blocks.num_pieces;
    PS_TRY_OUT(status, ps_buffer_upload(self->device, &self->first_rings, blocks.first_rings,
                                        (blocks.num_blocks + 1) * sizeof *blocks.first_rings,
                                        "bins", error));
    PS_TRY_OUT(status, ps_buffer_upload(self->device, &self->rings, blocks.rings,
                                        blocks.num_pieces * sizeof *blocks.rings, "bins", error));
    PS_TRY_OUT(status,
               ps_buffer_upload(self->device, &self->members, blocks.members,
                                blocks.num_members * sizeof *blocks.members, "bins", error));
    PS_TRY_OUT(status,
               ps_buffer_upload(self->device, &self->bin_pieces, blocks.bin_pieces,
                                blocks.num_bins * sizeof *blocks.bin_pieces, "bins", error));
out:
    ps_accumulate_blocks_free(&blocks);
    return status;
}

/* Work-groups of CPUs add frequencies and bins in one pass over the rows. */
static bool has_strips(const ps_device_accumulator *self) {
    return self->options.want_frequencies && self->is_gpu;
}

static pspec_status create_kernels(ps_device_accumulator *self, ps_error *error) {
    ps_defines defines = ps_defines_of(self->real_bytes, self->options.lanes);
    ps_defines_add(&defines, "-DSQUARES=%d", self->options.mean_only ? 0 : 1);
    PS_TRY(ps_kernel_get(self->device, &self->fold, "accumulate/blocks.cl", "accumulate_fold",
                         defines.text, error));
    return ps_kernel_get(self->device, &self->blocks, "accumulate/blocks.cl",
                         self->options.want_frequencies && !self->is_gpu
                             ? "accumulate_bins_and_frequencies"
                             : "accumulate_bins",
                         defines.text, error);
}

/* Every bin is one piece (none is empty, spectra/bins.h), as in one dimension: nothing to add
 * up. */
static bool is_whole(const ps_device_accumulator *self) {
    return self->num_pieces == self->options.bins->num;
}

static pspec_status create_buffers(ps_device_accumulator *self, ps_error *error) {
    const ps_accumulator_options *options = &self->options;
    const size_t pair_bytes = self->num_groups * 2 * options->lanes * self->real_bytes;
    const size_t bin_entries = self->num_groups * 2 * options->lanes * options->bins->num;
    PS_TRY(ps_buffer_create(self->device, &self->piece_sums, pair_bytes * self->num_pieces,
                            "sums of bins", error));
    if (!is_whole(self)) {
        PS_TRY(ps_buffer_create(self->device, &self->bin_sums, bin_entries * self->real_bytes,
                                "sums of bins", error));
    }
    PS_TRY(ps_readings_create(self->device, &self->bins_read, bin_entries * self->real_bytes,
                              "sums of bins", error));
    return options->want_frequencies
               ? ps_device_states_create(&self->states, options, self->device, error)
               : PSPEC_OK;
}

pspec_status ps_device_accumulator_create(ps_device_accumulator **out,
                                          const ps_accumulator_options *options, ps_device *device,
                                          ps_error *error) {
    *out = NULL;
    ps_device_accumulator *self = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY(PS_NEW(&self, 1, "an accumulator", error));
    self->device = device;
    self->options = *options;
    self->real_bytes = ps_real_bytes(options->precision);
    self->options.lanes = ps_accumulate_lanes(options, ps_device_get_limits(device));
    self->num_groups = ps_divide_up(options->batch, self->options.lanes);
    self->is_gpu = ps_device_get_limits(device)->has_dedicated_local_memory;
    PS_TRY_OUT(status, create_kernels(self, error));
    PS_TRY_OUT(status, upload_blocks(self, error));
    PS_TRY_OUT(status, create_buffers(self, error));
    *out = self;
    self = NULL;
out:
    ps_device_accumulator_destroy(self);
    return status;
}

void ps_device_accumulator_destroy(ps_device_accumulator *accumulator) {
    if (accumulator == NULL) {
        return;
    }
    PS_BUFFERS_RELEASE(&accumulator->first_rings, &accumulator->rings, &accumulator->members,
                       &accumulator->bin_pieces, &accumulator->piece_sums, &accumulator->bin_sums);
    ps_device_states_free(&accumulator->states);
    ps_readings_release(&accumulator->bins_read);
    free(accumulator);
}

/* ---- add --------------------------------------------------------------------------------- */

/* Operations on one power: a sum in a bin, a sum and a sum of squares of a frequency. */
enum { BIN_FLOPS = 7, SUM_FLOPS = 7, SQUARE_FLOPS = 9, FOLD_FLOPS = 8 };

static double power_flops(const ps_accumulator_options *options) {
    return BIN_FLOPS + (options->want_frequencies ? SUM_FLOPS : 0) +
           (options->want_frequencies && !options->mean_only ? SQUARE_FLOPS : 0);
}

#define BLOCK_ARGUMENTS(self, rows)                                                                \
    PS_BUFFER((rows)->device), PS_BUFFER((self)->first_rings), PS_BUFFER((self)->rings),           \
        PS_BUFFER((self)->members), PS_BUFFER((self)->piece_sums)

/* Realizations of a work-group on GPUs: one of 512 slots is a group for each, a launch is to have
 * hundreds of groups. */
enum { GPU_VECTORS_AT_ONCE = 8, GPU_ITEMS = 128 };

/* Groups of CPUs go through all realizations, as frequencies want it there. */
static ps_range blocks_range(const ps_device_accumulator *self, size_t num_rows, size_t at_once,
                             double flops, double bytes) {
    return self->is_gpu ? ps_range_shared(self->device, GPU_ITEMS, self->num_blocks,
                                          ps_divide_up(num_rows, at_once), flops, bytes)
                        : ps_range_heavy(self->device, 1, self->num_blocks, 1, flops, bytes);
}

static pspec_status sum_blocks(ps_device_accumulator *self, const ps_rows *rows,
                               const blocks_numbers *numbers, ps_error *error) {
    const double powers = (double)(rows->num_rows * rows->stride);
    const ps_range range =
        blocks_range(self, rows->num_rows, numbers->at_once, power_flops(&self->options) * powers,
                     powers * (double)self->real_bytes);
    const ps_argument block = PS_LOCAL(block_bytes(self->options.lanes, self->real_bytes));
    if (!self->options.want_frequencies || has_strips(self)) {
        return PS_LAUNCH(self->device, self->blocks, &range, error, PS_STRUCT(*numbers),
                         BLOCK_ARGUMENTS(self, rows), block);
    }
    return PS_LAUNCH(self->device, self->blocks, &range, error, PS_STRUCT(*numbers),
                     BLOCK_ARGUMENTS(self, rows), PS_STATE_ARGUMENTS(&self->states), block);
}

static pspec_status fold(ps_device_accumulator *self, size_t num_groups, ps_error *error) {
    const size_t num_bins = self->options.bins->num;
    const double sums = (double)(num_groups * self->options.lanes * self->num_pieces);
    const ps_range range = ps_range_light(self->device, num_bins, num_groups, 1, FOLD_FLOPS * sums,
                                          2 * sums * (double)self->real_bytes);
    return PS_LAUNCH(self->device, self->fold, &range, error, PS_BUFFER(self->piece_sums),
                     PS_BUFFER(self->bin_pieces), PS_BUFFER(self->bin_sums), PS_U64(num_bins),
                     PS_U64(self->num_pieces));
}

static pspec_status finish_bins(ps_device_accumulator *self, size_t num_rows, ps_error *error) {
    const size_t num_groups = ps_divide_up(num_rows, self->options.lanes);
    const size_t row = 2 * self->options.lanes * self->options.bins->num * self->real_bytes;
    PS_TRY(is_whole(self) ? PSPEC_OK : fold(self, num_groups, error));
    return ps_readings_begin(&self->bins_read, is_whole(self) ? &self->piece_sums : &self->bin_sums,
                             num_groups * row, error);
}

/* On GPUs sums of frequencies change by the last launch; on CPUs by the first, after which nobody
 * may try again with fewer realizations. */
static pspec_status sum_rows(ps_device_accumulator *self, const ps_rows *rows,
                             const blocks_numbers *numbers, ps_error *error) {
    PS_TRY(sum_blocks(self, rows, numbers, error));
    const pspec_status status = finish_bins(self, rows->num_rows, error);
    if (self->options.want_frequencies && !has_strips(self)) {
        return status == PSPEC_ERROR_MEMORY ? PSPEC_ERROR_DEVICE : status;
    }
    return status == PSPEC_OK && has_strips(self)
               ? ps_device_states_add(&self->states, rows, numbers, error)
               : status;
}

pspec_status ps_device_accumulator_add(ps_device_accumulator *accumulator, const ps_rows *rows,
                                       ps_error *error) {
    ps_device_accumulator *self = accumulator;
    const size_t all = ps_round_up(rows->num_rows, self->options.lanes);
    const size_t some = GPU_VECTORS_AT_ONCE * (size_t)self->options.lanes;
    const blocks_numbers numbers = {.stride = rows->stride,
                                    .num_pieces = self->num_pieces,
                                    .done = self->states.count,
                                    .num_realizations = (uint32_t)rows->num_rows,
                                    .at_once = (uint32_t)(self->is_gpu ? some : all)};
    if (self->options.want_frequencies) {
        PS_TRY(ps_device_states_reserve(&self->states, self->states.count + rows->num_rows, error));
    }
    PS_TRY(sum_rows(self, rows, &numbers, error));
    self->states.count += rows->num_rows;
    return PSPEC_OK;
}

pspec_status ps_device_accumulator_take(ps_device_accumulator *accumulator, size_t num_rows,
                                        double *bin_powers, ps_error *error) {
    const ps_device_accumulator *self = accumulator;
    const ps_bins *bins = self->options.bins;
    const size_t lanes = self->options.lanes;
    const void *sums = NULL;
    PS_TRY(ps_readings_take(&accumulator->bins_read, &sums, error));
    for (size_t r = 0; r < num_rows; r++) {
        for (size_t b = 0; b < bins->num; b++) {
            const size_t high = ((r / lanes * bins->num + b) * 2) * lanes + r % lanes;
            const double sum = ps_real_at(self->options.precision, sums, high) +
                               ps_real_at(self->options.precision, sums, high + lanes);
            bin_powers[r * bins->num + b] = sum / (double)(bins->bins[b].end - bins->bins[b].begin);
        }
    }
    return PSPEC_OK;
}

void ps_device_accumulator_reset(ps_device_accumulator *accumulator) {
    accumulator->states.count = 0;
}

pspec_status ps_device_accumulator_walk(ps_device_accumulator *accumulator, ps_snapshot *snapshot,
                                        ps_error *error) {
    PS_TRY(ps_snapshot_counts(snapshot, "device_count", &accumulator->states.count, 1, error));
    return accumulator->options.want_frequencies
               ? ps_device_states_walk(&accumulator->states, snapshot, error)
               : PSPEC_OK;
}

void ps_device_accumulator_forget(ps_device_accumulator *accumulator) {
    ps_readings_forget(&accumulator->bins_read);
}

static ps_sums get_sums(const ps_device_accumulator *self, size_t frequency) {
    return ps_device_states_get(&self->states, self->options.slots[frequency]);
}

pspec_status ps_device_accumulator_read(ps_device_accumulator *accumulator, ps_error *error) {
    return accumulator->options.want_frequencies
               ? ps_device_states_read(&accumulator->states, error)
               : PSPEC_OK;
}

ps_sums ps_device_accumulator_row(const ps_device_accumulator *accumulator, unsigned row,
                                  size_t frequency) {
    return ps_device_states_row(&accumulator->states, row, accumulator->options.slots[frequency]);
}

typedef struct state_sums {
    const ps_device_accumulator *accumulator;
    ps_sums *sums;
} state_sums;

static void get_some_sums(void *payload, unsigned index, unsigned count) {
    const state_sums *work = payload;
    const size_t num = work->accumulator->options.num_frequencies;
    const size_t end = ps_share_begin(num, index + 1, count);
    for (size_t i = ps_share_begin(num, index, count); i < end; i++) {
        work->sums[i] = get_sums(work->accumulator, i);
    }
}

pspec_status ps_device_accumulator_sums(ps_device_accumulator *accumulator, ps_sums *sums,
                                        ps_error *error) {
    const size_t num = accumulator->options.num_frequencies;
    state_sums work = {accumulator, sums};
    PS_TRY(ps_device_states_read(&accumulator->states, error));
    ps_workers_share(num, get_some_sums, &work);
    return PSPEC_OK;
}

pspec_status ps_device_accumulator_frequencies(ps_device_accumulator *accumulator, ps_mean *means,
                                               ps_error *error) {
    PS_TRY(ps_device_states_read(&accumulator->states, error));
    for (size_t i = 0; i < accumulator->options.num_frequencies; i++) {
        const ps_sums sums = get_sums(accumulator, i);
        ps_sums_finish(&sums, accumulator->states.count, &means[i].mean, &means[i].standard_error);
    }
    return PSPEC_OK;
}
