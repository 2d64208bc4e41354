#include "rules/kernel/kernel_product.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "rules/distance_split.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Points of a segment: some 20 microseconds of a work-item, and few enough segments for the host to
 * add up. */
enum { SEGMENT = 4096, AXES = 3, PARTS = 2 };
/* Strides are multiples of all numbers of lanes and of the kernel's BLOCK. */
enum { UNIT = 16 };

struct ps_kernel_product {
    ps_device *device;
    size_t most_sets;                        /* of distances; 1: of a product */
    size_t num_points, stride, num_segments; /* of the largest set */
    unsigned lanes;
    ps_kernel *kernel;
    ps_buffer points, x, power, partials;
    double *host;   /* [most_sets][num_segments][PARTS][stride] */
    double *padded; /* [most_sets][AXES][stride]: points, or x, and 0 beyond them */
};

static size_t stride_of(uint64_t num_points) {
    return ps_round_up((size_t)num_points, UNIT);
}

static size_t count_segments(size_t stride) {
    return (size_t)ps_divide_up(stride, SEGMENT);
}

bool ps_kernel_product_is_possible(const ps_device *device) {
    return device != NULL && ps_device_get_limits(device)->has_fp64;
}

uint64_t ps_kernel_product_bytes(uint64_t num_points) {
    enum { HOST_AND_DEVICE = 2 };
    const uint64_t stride = stride_of(num_points);
    const uint64_t columns =
        1 + HOST_AND_DEVICE * (AXES + PARTS * (uint64_t)count_segments((size_t)stride));
    return columns * stride * sizeof(double);
}

bool ps_kernel_product_is_on_gpu(const ps_device *device) {
    return ps_kernel_product_is_possible(device) &&
           ps_device_get_limits(device)->has_dedicated_local_memory;
}

bool ps_kernel_distances_pay(const ps_device *device, uint64_t num_points) {
    return ps_kernel_product_is_on_gpu(device) && num_points <= PS_DISTANCE_MOST_WHOLE;
}

size_t ps_kernel_distances_at_once(uint64_t num_points, uint64_t num_rules) {
    const double points = 1 << 18, pairs = 1 << 30; /* nothing stops a kernel */
    const double num = num_points > 0 ? (double)num_points : 1;
    const double fitting =
        fmin(fmin(points / num, pairs / num / num), num_rules > 0 ? (double)num_rules : points);
    return fitting > 1 ? (size_t)fitting : 1;
}

static pspec_status create_kernel(ps_kernel_product *self, double power, ps_error *error) {
    const double root = 0.5;
    ps_defines defines = ps_defines_of(sizeof(double), self->lanes);
    ps_defines_add(&defines, "-DROOT=%d", power == root);
    return ps_kernel_get(self->device, &self->kernel, "rules/product.cl", "kernel_product",
                         defines.text, error);
}

/* Coordinates in columns. */
static void pad_points(ps_kernel_product *self, size_t set, size_t num, const double *points) {
    for (size_t axis = 0; axis < AXES; axis++) {
        double *const to = self->padded + (AXES * set + axis) * self->stride;
        for (size_t j = 0; j < num; j++) {
            to[j] = points[AXES * j + axis];
        }
    }
}

/* Of so many sets, as they were padded. */
static pspec_status write_points(ps_kernel_product *self, size_t num_sets, ps_error *error) {
    return ps_buffer_write(self->device, &self->points, 0, self->padded,
                           num_sets * AXES * self->stride * sizeof(double), error);
}

static pspec_status fill(ps_kernel_product *self, double power, ps_error *error) {
    size_t num = 0;
    if (!ps_size_multiply(self->most_sets * self->num_segments * PARTS, self->stride, &num)) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "%zu points are too many for a product",
                       self->num_points);
    }
    const size_t row = self->most_sets * self->stride;
    PS_TRY(PS_NEW(&self->host, num, "sums of segments of points", error));
    PS_TRY(PS_NEW(&self->padded, AXES * row, "points", error));
    PS_TRY(create_kernel(self, power, error));
    PS_TRY(ps_buffer_create(self->device, &self->points, AXES * row * sizeof(double), "points",
                            error));
    PS_TRY(ps_reals_upload(self->device, &self->power, PS_DOUBLE, &power, 1, "a power", error));
    PS_TRY(ps_buffer_create(self->device, &self->x, row * sizeof(double), "a vector", error));
    return ps_buffer_create(self->device, &self->partials, num * sizeof(double),
                            "sums of segments of points", error);
}

static pspec_status create(ps_kernel_product **out, ps_device *device, double power,
                           size_t num_points, size_t most_sets, ps_error *error) {
    *out = NULL;
    ps_kernel_product *self = NULL;
    PS_TRY(PS_NEW(&self, 1, "a product", error));
    self->device = device;
    self->most_sets = most_sets;
    self->num_points = num_points;
    self->stride = stride_of(num_points);
    self->num_segments = count_segments(self->stride);
    self->lanes = ps_engine_lanes(ps_device_get_limits(device), PS_DOUBLE);
    *out = self;
    return fill(self, power, error);
}

pspec_status ps_kernel_product_create(ps_kernel_product **out, ps_device *device, double power,
                                      size_t num_points, const double *points, ps_error *error) {
    pspec_status status = create(out, device, power, num_points, 1, error);
    if (status == PSPEC_OK) {
        pad_points(*out, 0, num_points, points);
        status = write_points(*out, 1, error);
    }
    if (status != PSPEC_OK) {
        ps_kernel_product_destroy(*out);
        *out = NULL;
    }
    return status;
}

pspec_status ps_kernel_distances_create(ps_kernel_product **out, ps_device *device, double power,
                                        size_t most_points, size_t most_sets, ps_error *error) {
    const pspec_status status = create(out, device, power, most_points, most_sets, error);
    if (status != PSPEC_OK) {
        ps_kernel_product_destroy(*out);
        *out = NULL;
    }
    return status;
}

size_t ps_kernel_distances_most_points(const ps_kernel_product *product) {
    return product != NULL ? product->num_points : 0;
}

void ps_kernel_product_destroy(ps_kernel_product *self) {
    if (self == NULL) {
        return;
    }
    PS_BUFFERS_RELEASE(&self->points, &self->x, &self->power, &self->partials);
    free(self->host);
    free(self->padded);
    free(self);
}

size_t ps_kernel_distances_most_rules(const ps_kernel_product *product) {
    return product->most_sets;
}

/* Point i of a set: segment after segment, high parts first where both are of one segment. */
static long double add_up(const ps_kernel_product *self, size_t set, size_t i) {
    const size_t rows = self->num_segments * PARTS;
    long double sum = 0;
    for (size_t row = 0; row < rows; row++) {
        sum += self->host[(set * rows + row) * self->stride + i];
    }
    return sum;
}

/* So many vectors of points, from the first on, with all points. */
static pspec_status launch(ps_kernel_product *self, size_t first, size_t num, size_t num_sets,
                           ps_error *error) {
    const double flops_per_pair = 12;
    const double pairs = (double)num * self->lanes * (double)self->stride * (double)num_sets;
    ps_range range =
        ps_range_heavy(self->device, num, self->num_segments, num_sets, flops_per_pair * pairs, 0);
    range.offset[0] = first;
    PS_TRY(PS_LAUNCH(self->device, self->kernel, &range, error, PS_BUFFER(self->points),
                     PS_BUFFER(self->x), PS_BUFFER(self->power), PS_BUFFER(self->partials),
                     PS_U64(self->stride), PS_U64(SEGMENT)));
    return ps_device_finish(self->device, error);
}

/* Launches take about a tenth of a second, and between them the watch is told. What the last
 * work-group of a launch rounds up to, the next launch does again, which gives the same bits. */
static pspec_status launch_all(ps_kernel_product *self, const ps_watch *watch, ps_error *error) {
    const double first_pairs = 1 << 26; /* some hundredths of a second of two cores */
    const double enough =
        0.05; /* seconds; a launch of half as many pairs may be followed by a whole one */
    const size_t num_vectors = self->stride / self->lanes;
    size_t num = (size_t)(first_pairs / (double)self->lanes / (double)self->stride) + UNIT;
    for (size_t first = 0; first < num_vectors;) {
        const size_t left = num_vectors - first;
        const double begin = ps_clock_seconds();
        PS_TRY(ps_watch_tell(watch, "points", first * self->lanes, self->num_points, NULL, error));
        PS_TRY(launch(self, first, num < left ? num : left, 1, error));
        first += num < left ? num : left;
        num *= ps_clock_seconds() - begin < enough ? 2 : 1;
    }
    return PSPEC_OK;
}

pspec_status ps_kernel_product_apply(ps_kernel_product *self, const double *x, double *out,
                                     const ps_watch *watch, ps_error *error) {
    const size_t bytes = self->stride * sizeof(double);
    memcpy(self->padded, x, self->num_points * sizeof *x);
    memset(self->padded + self->num_points, 0,
           (self->stride - self->num_points) * sizeof *self->padded);
    PS_TRY(ps_buffer_write(self->device, &self->x, 0, self->padded, bytes, error));
    PS_TRY(launch_all(self, watch, error));
    PS_TRY(ps_buffer_read(self->device, &self->partials, 0, self->host,
                          self->num_segments * PARTS * bytes, error));
    for (size_t i = 0; i < self->num_points; i++) {
        out[i] = (double)add_up(self, 0, i);
    }
    return PSPEC_OK;
}

/* ---- distances ----------------------------------------------------------------------------- */

static pspec_status write_rules(ps_kernel_product *self, const ps_rule *rules, size_t num,
                                ps_error *error) {
    const size_t row = num * self->stride;
    for (size_t r = 0; r < num; r++) {
        pad_points(self, r, rules[r].num_points, rules[r].points);
    }
    PS_TRY(write_points(self, num, error));
    memset(self->padded, 0, row * sizeof *self->padded);
    for (size_t r = 0; r < num; r++) {
        memcpy(self->padded + r * self->stride, rules[r].weights,
               rules[r].num_points * sizeof *self->padded);
    }
    return ps_buffer_write(self->device, &self->x, 0, self->padded, row * sizeof(double), error);
}

pspec_status ps_kernel_distances_sum(ps_kernel_product *self, const ps_rule *rules, size_t num,
                                     double *sums, ps_error *error) {
    const size_t numbers = num * self->num_segments * PARTS * self->stride;
    PS_TRY(write_rules(self, rules, num, error));
    PS_TRY(launch(self, 0, self->stride / self->lanes, num, error));
    PS_TRY(ps_buffer_read(self->device, &self->partials, 0, self->host, numbers * sizeof(double),
                          error));
    for (size_t r = 0; r < num; r++) {
        long double sum = 0;
        for (size_t i = 0; i < rules[r].num_points; i++) {
            sum += rules[r].weights[i] * add_up(self, r, i);
        }
        sums[r] = (double)sum;
    }
    return PSPEC_OK;
}
