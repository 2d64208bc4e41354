#include "accumulate/blocks.h"
#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "spectra/accumulate/accumulate_device.h"

#include <math.h>
#include <stdlib.h>

/* One vector of weights by slots, 0 where a slot has no frequency. Times a power of two, so that
 * the largest is between 1/2 and 1: float has no room for what is 1e-40 at its largest. */
typedef struct vector {
    ps_buffer weights; /* a buffer each: none is larger than a row of powers */
    int exponent;      /* of the power of two that undoes it */
} vector;

struct ps_device_weighted {
    ps_device *device;
    ps_accumulator_options options; /* lanes: those of the kernel */
    size_t num_blocks;
    ps_kernel *kernel;
    vector *vectors; /* [num_weighted] */
    /* [num_weighted][groups of lanes realizations][block][high, low][lanes] */
    ps_buffer pieces;
    ps_readings pieces_read;
};

/* ---- create ------------------------------------------------------------------------------ */

static int scale_to_one(double *weights, size_t num) {
    double largest = 0;
    int exponent = 0;
    for (size_t i = 0; i < num; i++) {
        largest = fmax(largest, fabs(weights[i]));
    }
    frexp(largest, &exponent); /* 0 has 0 */
    for (size_t i = 0; i < num; i++) {
        weights[i] = ldexp(weights[i], -exponent);
    }
    return exponent;
}

static pspec_status upload_weights(ps_device_weighted *self, ps_error *error) {
    const ps_accumulator_options *options = &self->options;
    double *placed = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY(PS_NEW(&placed, options->stride, "weights", error));
    for (size_t w = 0; w < options->num_weighted && status == PSPEC_OK; w++) {
        const double *weights = options->weights + w * options->num_frequencies;
        for (size_t i = 0; i < options->num_frequencies; i++) {
            placed[options->slots[i]] = weights[i];
        }
        self->vectors[w].exponent = scale_to_one(placed, options->stride);
        status = ps_reals_upload(self->device, &self->vectors[w].weights, options->precision,
                                 placed, options->stride, "weights", error);
    }
    free(placed);
    return status;
}

static pspec_status create_kernel(ps_device_weighted *self, ps_error *error) {
    const ps_accumulator_options *options = &self->options;
    ps_defines defines = ps_defines_of(ps_real_bytes(options->precision), options->lanes);
    ps_defines_add(&defines, "-DSQUARES=%d", options->mean_only ? 0 : 1); /* as of the bins */
    return ps_kernel_get(self->device, &self->kernel, "accumulate/blocks.cl", "accumulate_weighted",
                         defines.text, error);
}

/* Numbers in the pieces of one weighted sum. */
static size_t count_pieces(const ps_device_weighted *self, size_t num_rows) {
    const size_t lanes = self->options.lanes;
    return ps_divide_up(num_rows, lanes) * self->num_blocks * 2 * lanes;
}

static pspec_status create_pieces(ps_device_weighted *self, ps_error *error) {
    const size_t num = self->options.num_weighted * count_pieces(self, self->options.batch);
    const size_t bytes = num * ps_real_bytes(self->options.precision);
    PS_TRY(ps_buffer_create(self->device, &self->pieces, bytes, "weighted sums", error));
    return ps_readings_create(self->device, &self->pieces_read, bytes, "weighted sums", error);
}

pspec_status ps_device_weighted_create(ps_device_weighted **out,
                                       const ps_accumulator_options *options, ps_device *device,
                                       ps_error *error) {
    *out = NULL;
    ps_device_weighted *self = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY(PS_NEW(&self, 1, "weighted sums", error));
    self->device = device;
    self->options = *options;
    self->options.lanes = ps_accumulate_lanes(options, ps_device_get_limits(device));
    self->num_blocks = ps_divide_up(options->stride, PS_ACCUMULATE_BLOCK);
    PS_TRY_OUT(status, create_kernel(self, error));
    PS_TRY_OUT(status, PS_NEW(&self->vectors, options->num_weighted, "weights", error));
    PS_TRY_OUT(status, upload_weights(self, error));
    PS_TRY_OUT(status, create_pieces(self, error));
    *out = self;
    self = NULL;
out:
    ps_device_weighted_destroy(self);
    return status;
}

void ps_device_weighted_destroy(ps_device_weighted *weighted) {
    if (weighted == NULL) {
        return;
    }
    for (size_t w = 0; weighted->vectors != NULL && w < weighted->options.num_weighted; w++) {
        ps_buffer_release(&weighted->vectors[w].weights);
    }
    ps_buffer_release(&weighted->pieces);
    free(weighted->vectors);
    ps_readings_release(&weighted->pieces_read);
    free(weighted);
}

/* ---- sums -------------------------------------------------------------------------------- */

/* Operations on one power: a product, what it is rounded by, and a sum in a pair. */
enum { PRODUCT_FLOPS = 4, SUM_FLOPS = 7 };

static pspec_status launch(ps_device_weighted *self, const ps_rows *rows, size_t index,
                           ps_error *error) {
    const double powers = (double)(rows->num_rows * rows->stride);
    const ps_range range = ps_range_heavy(self->device, self->num_blocks,
                                          ps_divide_up(rows->num_rows, self->options.lanes), 1,
                                          (PRODUCT_FLOPS + SUM_FLOPS) * powers,
                                          powers * (double)ps_real_bytes(self->options.precision));
    const blocks_numbers numbers = {.stride = rows->stride,
                                    .num_pieces = self->num_blocks,
                                    .num_realizations = (uint32_t)rows->num_rows};
    return PS_LAUNCH(self->device, self->kernel, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(rows->device), PS_BUFFER(self->vectors[index].weights),
                     PS_BUFFER(self->pieces), PS_U64(index));
}

/* Of realization r, in the order of blocks. */
static double add_pieces(const ps_device_weighted *self, const void *pieces, size_t first,
                         size_t r) {
    const ps_precision precision = self->options.precision;
    const size_t lanes = self->options.lanes;
    size_t at = first + r / lanes * self->num_blocks * 2 * lanes + r % lanes;
    long double sum = 0;
    for (size_t b = 0; b < self->num_blocks; b++, at += 2 * lanes) {
        sum += (long double)ps_real_at(precision, pieces, at) +
               ps_real_at(precision, pieces, at + lanes);
    }
    return (double)sum;
}

pspec_status ps_device_weighted_add(ps_device_weighted *weighted, const ps_rows *rows,
                                    ps_error *error) {
    const size_t num_weighted = weighted->options.num_weighted;
    for (size_t w = 0; w < num_weighted; w++) {
        PS_TRY(launch(weighted, rows, w, error));
    }
    return ps_readings_begin(&weighted->pieces_read, &weighted->pieces,
                             num_weighted * count_pieces(weighted, rows->num_rows) *
                                 ps_real_bytes(weighted->options.precision),
                             error);
}

pspec_status ps_device_weighted_take(ps_device_weighted *weighted, size_t num_rows, double *values,
                                     ps_error *error) {
    const size_t num_weighted = weighted->options.num_weighted;
    const size_t num_pieces = count_pieces(weighted, num_rows);
    const void *pieces = NULL;
    PS_TRY(ps_readings_take(&weighted->pieces_read, &pieces, error));
    for (size_t r = 0; r < num_rows; r++) {
        for (size_t w = 0; w < num_weighted; w++) {
            const double sum = add_pieces(weighted, pieces, w * num_pieces, r);
            values[r * num_weighted + w] = ldexp(sum, weighted->vectors[w].exponent);
        }
    }
    return PSPEC_OK;
}

void ps_device_weighted_forget(ps_device_weighted *weighted) {
    ps_readings_forget(&weighted->pieces_read);
}
