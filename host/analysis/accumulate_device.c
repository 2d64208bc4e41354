#include "analysis/accumulate_device.h"

#include "base/memory.h"

#include <stdlib.h>

/* Frequencies that one work-item adds up: short enough to spread the largest ring over many
 * work-items, long enough that partial sums are few. Fixed: sums depend on it. */
enum { PIECE_MEMBERS = 64 };

struct ps_device_accumulator {
    ps_device *device;
    ps_accumulator_options options;
    size_t real_bytes, num_groups, num_pieces;
    cl_kernel modes, pieces, fold;
    ps_buffer members, piece_ranges, bin_ranges, piece_sums, bin_sums, state;
    void *host; /* staging for bin sums, and for the state of one part */
};

static double get_real(const ps_device_accumulator *self, const void *array, size_t i) {
    return self->real_bytes == sizeof(float) ? (double)((const float *)array)[i]
                                             : ((const double *)array)[i];
}

/* ---- create ------------------------------------------------------------------------------ */

static size_t count_pieces(const ps_bins *bins) {
    size_t count = 0;
    for (size_t b = 0; b < bins->num; b++) {
        count += (bins->bins[b].end - bins->bins[b].begin + PIECE_MEMBERS - 1) / PIECE_MEMBERS;
    }
    return count;
}

/* Slots of the members, the pieces [first, last) of every bin, and the pieces of each bin. */
static void fill_ranges(const ps_device_accumulator *self, uint32_t *members, uint32_t (*pieces)[2],
                        uint32_t (*bin_pieces)[2]) {
    const ps_bins *bins = self->options.bins;
    size_t piece = 0;
    for (size_t i = 0; i < bins->num_members; i++) {
        members[i] = self->options.slots[bins->members[i]];
    }
    for (size_t b = 0; b < bins->num; b++) {
        bin_pieces[b][0] = (uint32_t)piece;
        for (size_t i = bins->bins[b].begin; i < bins->bins[b].end; i += PIECE_MEMBERS) {
            const size_t rest = bins->bins[b].end - i;
            pieces[piece][0] = (uint32_t)i;
            pieces[piece][1] = (uint32_t)(i + (rest < PIECE_MEMBERS ? rest : PIECE_MEMBERS));
            piece++;
        }
        bin_pieces[b][1] = (uint32_t)piece;
    }
}

static pspec_status upload(ps_device_accumulator *self, ps_buffer *buffer, const void *data,
                           size_t bytes, ps_error *error) {
    PS_TRY(ps_buffer_create(self->device, buffer, bytes, "bins", error));
    return ps_buffer_write(self->device, buffer, 0, data, bytes, error);
}

static pspec_status upload_ranges(ps_device_accumulator *self, ps_error *error) {
    const ps_bins *bins = self->options.bins;
    void *members = NULL;
    void *pieces = NULL;
    void *bin_pieces = NULL;
    pspec_status status = PSPEC_OK;
    const size_t range_bytes = 2 * sizeof(uint32_t);
    PS_TRY_OUT(status, ps_allocate(&members, bins->num_members, sizeof(uint32_t), "bins", error));
    PS_TRY_OUT(status, ps_allocate(&pieces, self->num_pieces, range_bytes, "bins", error));
    PS_TRY_OUT(status, ps_allocate(&bin_pieces, bins->num, range_bytes, "bins", error));
    fill_ranges(self, members, pieces, bin_pieces);
    PS_TRY_OUT(status,
               upload(self, &self->members, members, bins->num_members * sizeof(uint32_t), error));
    PS_TRY_OUT(status,
               upload(self, &self->piece_ranges, pieces, self->num_pieces * range_bytes, error));
    PS_TRY_OUT(status, upload(self, &self->bin_ranges, bin_pieces, bins->num * range_bytes, error));
out:
    free(members);
    free(pieces);
    free(bin_pieces);
    return status;
}

static pspec_status create_kernels(ps_device_accumulator *self, ps_error *error) {
    ps_text options = {0};
    pspec_status status = PSPEC_OK;
    ps_text_append(&options, "-DPRECISION=%zu -DLANES=%u", self->real_bytes * 8,
                   self->options.lanes);
    PS_TRY_OUT(status, ps_text_check(&options, error));
    const char *text = ps_text_string(&options);
    PS_TRY_OUT(status, ps_kernel_create(self->device, &self->pieces, "accumulate/bins.cl",
                                        "accumulate_bin_pieces", text, error));
    PS_TRY_OUT(status, ps_kernel_create(self->device, &self->fold, "accumulate/bins.cl",
                                        "accumulate_bin_fold", text, error));
    if (self->options.want_frequencies) {
        PS_TRY_OUT(status, ps_kernel_create(self->device, &self->modes, "accumulate/modes.cl",
                                            "accumulate_modes", text, error));
    }
out:
    ps_text_free(&options);
    return status;
}

static pspec_status create_buffers(ps_device_accumulator *self, ps_error *error) {
    const ps_accumulator_options *options = &self->options;
    const size_t pair_bytes = self->num_groups * 2 * options->lanes * self->real_bytes;
    const size_t bin_entries = self->num_groups * 2 * options->lanes * options->bins->num;
    size_t staging = bin_entries;
    PS_TRY(ps_buffer_create(self->device, &self->piece_sums, pair_bytes * self->num_pieces,
                            "sums of bins", error));
    PS_TRY(ps_buffer_create(self->device, &self->bin_sums, bin_entries * self->real_bytes,
                            "sums of bins", error));
    if (options->want_frequencies) {
        PS_TRY(ps_buffer_create(self->device, &self->state, 4 * options->stride * self->real_bytes,
                                "sums of frequencies", error));
        PS_TRY(ps_buffer_clear(self->device, &self->state, error));
        staging = staging > 4 * options->stride ? staging : 4 * options->stride;
    }
    return ps_allocate(&self->host, staging, self->real_bytes, "sums of bins", error);
}

pspec_status ps_device_accumulator_create(ps_device_accumulator **out,
                                          const ps_accumulator_options *options, ps_device *device,
                                          ps_error *error) {
    void *memory = NULL;
    *out = NULL;
    PS_TRY(ps_allocate(&memory, 1, sizeof(ps_device_accumulator), "an accumulator", error));
    ps_device_accumulator *self = memory;
    self->device = device;
    self->options = *options;
    self->real_bytes = options->precision == PS_SINGLE ? sizeof(float) : sizeof(double);
    self->num_groups = (options->batch + options->lanes - 1) / options->lanes;
    self->num_pieces = count_pieces(options->bins);
    pspec_status status = create_kernels(self, error);
    if (status == PSPEC_OK) {
        status = upload_ranges(self, error);
    }
    if (status == PSPEC_OK) {
        status = create_buffers(self, error);
    }
    if (status != PSPEC_OK) {
        ps_device_accumulator_destroy(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

void ps_device_accumulator_destroy(ps_device_accumulator *accumulator) {
    if (accumulator == NULL) {
        return;
    }
    cl_kernel *const kernels[] = {&accumulator->modes, &accumulator->pieces, &accumulator->fold};
    ps_buffer *const buffers[] = {&accumulator->members,    &accumulator->piece_ranges,
                                  &accumulator->bin_ranges, &accumulator->piece_sums,
                                  &accumulator->bin_sums,   &accumulator->state};
    for (size_t i = 0; i < sizeof kernels / sizeof kernels[0]; i++) {
        if (*kernels[i] != NULL) {
            clReleaseKernel(*kernels[i]);
        }
    }
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++) {
        ps_buffer_release(buffers[i]);
    }
    free(accumulator->host);
    free(accumulator);
}

/* ---- add --------------------------------------------------------------------------------- */

static pspec_status sum_bins(ps_device_accumulator *self, const ps_rows *rows, size_t num_groups,
                             ps_error *error) {
    const ps_bins *bins = self->options.bins;
    const double entries = (double)(num_groups * self->options.lanes * bins->num_members);
    const ps_range pieces = ps_range_light(self->device, self->num_pieces, num_groups, 1,
                                           7 * entries, entries * (double)self->real_bytes);
    PS_TRY(PS_LAUNCH(self->device, self->pieces, &pieces, error, PS_BUFFER(rows->device),
                     PS_BUFFER(self->members), PS_BUFFER(self->piece_ranges),
                     PS_BUFFER(self->piece_sums), PS_U64(self->num_pieces), PS_U64(rows->stride)));
    const double sums = (double)(num_groups * self->options.lanes * self->num_pieces);
    const ps_range fold = ps_range_light(self->device, bins->num, num_groups, 1, 8 * sums,
                                         2 * sums * (double)self->real_bytes);
    return PS_LAUNCH(self->device, self->fold, &fold, error, PS_BUFFER(self->piece_sums),
                     PS_BUFFER(self->bin_ranges), PS_BUFFER(self->bin_sums), PS_U64(bins->num),
                     PS_U64(self->num_pieces));
}

static pspec_status read_bins(ps_device_accumulator *self, const ps_rows *rows, size_t num_groups,
                              double *bin_powers, ps_error *error) {
    const ps_bins *bins = self->options.bins;
    const size_t lanes = self->options.lanes;
    PS_TRY(ps_buffer_read(self->device, &self->bin_sums, 0, self->host,
                          num_groups * bins->num * 2 * lanes * self->real_bytes, error));
    for (size_t r = 0; r < rows->num_rows; r++) {
        for (size_t b = 0; b < bins->num; b++) {
            const size_t high = ((r / lanes * bins->num + b) * 2) * lanes + r % lanes;
            const double sum =
                get_real(self, self->host, high) + get_real(self, self->host, high + lanes);
            bin_powers[r * bins->num + b] = sum / (double)(bins->bins[b].end - bins->bins[b].begin);
        }
    }
    return PSPEC_OK;
}

pspec_status ps_device_accumulator_add(ps_device_accumulator *accumulator, const ps_rows *rows,
                                       double *bin_powers, ps_error *error) {
    ps_device_accumulator *self = accumulator;
    const size_t lanes = self->options.lanes;
    const size_t num_groups = (rows->num_rows + lanes - 1) / lanes;
    PS_TRY(sum_bins(self, rows, num_groups, error));
    if (self->options.want_frequencies) {
        const double entries = (double)(rows->num_rows * rows->stride);
        const ps_range range = ps_range_light(self->device, rows->stride / lanes, 1, 1,
                                              15 * entries, entries * (double)self->real_bytes);
        PS_TRY(PS_LAUNCH(self->device, self->modes, &range, error, PS_BUFFER(rows->device),
                         PS_BUFFER(self->state), PS_U32(rows->num_rows), PS_U64(rows->stride)));
    }
    return read_bins(self, rows, num_groups, bin_powers, error);
}

pspec_status ps_device_accumulator_reset(ps_device_accumulator *accumulator, ps_error *error) {
    return accumulator->options.want_frequencies
               ? ps_buffer_clear(accumulator->device, &accumulator->state, error)
               : PSPEC_OK;
}

/* Brings the sums per frequency into the staging memory. */
static pspec_status read_state(const ps_device_accumulator *self, ps_error *error) {
    return ps_buffer_read(self->device, &self->state, 0, self->host,
                          4 * self->options.stride * self->real_bytes, error);
}

static ps_sums get_sums(const ps_device_accumulator *self, size_t frequency) {
    const size_t stride = self->options.stride;
    const size_t slot = self->options.slots[frequency];
    return (ps_sums){get_real(self, self->host, slot), get_real(self, self->host, stride + slot),
                     get_real(self, self->host, 2 * stride + slot),
                     get_real(self, self->host, 3 * stride + slot)};
}

pspec_status ps_device_accumulator_sums(ps_device_accumulator *accumulator, ps_sums *sums,
                                        ps_error *error) {
    PS_TRY(read_state(accumulator, error));
    for (size_t i = 0; i < accumulator->options.num_frequencies; i++) {
        sums[i] = get_sums(accumulator, i);
    }
    return PSPEC_OK;
}

pspec_status ps_device_accumulator_frequencies(ps_device_accumulator *accumulator,
                                               uint64_t num_realizations, ps_mean *means,
                                               ps_error *error) {
    PS_TRY(read_state(accumulator, error));
    for (size_t i = 0; i < accumulator->options.num_frequencies; i++) {
        const ps_sums sums = get_sums(accumulator, i);
        ps_sums_finish(&sums, num_realizations, &means[i].mean, &means[i].standard_error);
    }
    return PSPEC_OK;
}
