#include "engines/sphere/sphere_points.h"

#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static pspec_status create_prepare(ps_sphere_points *self, ps_error *error) {
    const ps_sphere_layout *layout = self->layout;
    ps_defines defines = {""};
    ps_defines_add(&defines, "-DLANES=%u -DOUT_PRECISION=%zu -DONLY_EVEN=%d", layout->prepare_lanes,
                   8 * layout->real_bytes, layout->only_even);
    return ps_kernel_get(self->device, &self->prepare, "sphere/prepare.cl", "sphere_prepare",
                         defines.text, error);
}

static pspec_status allocate_on_host(ps_sphere_points *self, ps_error *error) {
    const size_t capacity = self->capacity;
    PS_TRY(PS_NEW(&self->host_weights, capacity, "weights", error));
    PS_TRY(PS_NEW(&self->host_offsets, self->batch + 1, "offsets", error));
    if (self->prepare == NULL) {
        PS_TRY(ps_allocate(&self->host_values, capacity,
                           PS_SPHERE_ARRAYS * self->layout->real_bytes, "directions", error));
        PS_TRY(PS_NEW(&self->host_turns, capacity, "azimuths", error));
    }
    return PSPEC_OK;
}

pspec_status ps_sphere_points_create(ps_sphere_points *out, const ps_sphere_layout *layout,
                                     size_t batch, ps_device *device, ps_error *error) {
    *out = (ps_sphere_points){.layout = layout, .device = device, .batch = batch};
    if (!ps_size_multiply(batch, layout->slab, &out->capacity)) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "%zu realizations of %zu points are too many",
                       batch, layout->slab);
    }
    const size_t capacity = out->capacity;
    if (ps_device_get_limits(device)->has_fp64) {
        PS_TRY(create_prepare(out, error));
    }
    PS_TRY(allocate_on_host(out, error));
    PS_TRY(ps_feed_create(&out->points, capacity * PS_SPHERE_DIMENSION * sizeof(double), device,
                          error));
    const ps_wanted_buffer wanted[] = {
        {&out->values, capacity * PS_SPHERE_ARRAYS * layout->real_bytes, "directions"},
        {&out->turns, capacity * sizeof(uint64_t), "azimuths"},
        {&out->weights, capacity * layout->real_bytes, "weights"},
        {&out->offsets, (batch + 1) * sizeof(uint64_t), "offsets"}};
    return PS_BUFFERS_CREATE(device, wanted, error);
}

void ps_sphere_points_free(ps_sphere_points *self) {
    free(self->host_weights);
    free(self->host_offsets);
    free(self->host_values);
    free(self->host_turns);
    ps_feed_free(&self->points);
    PS_BUFFERS_RELEASE(&self->values, &self->turns, &self->weights, &self->offsets);
    *self = (ps_sphere_points){0};
}

/* Points of a pattern from first on, to place `at` of all and filled up to whole vectors; returns
 * how many. */
static size_t copy_pattern(ps_sphere_points *self, double *all, size_t at,
                           const pspec_pattern *pattern, int exponent, size_t first) {
    static const double pole[PS_SPHERE_DIMENSION] = {0, 0, 1};
    const size_t rest = pattern->num_points > first ? pattern->num_points - first : 0;
    const size_t num = rest < self->layout->slab ? rest : self->layout->slab;
    const size_t padded = ps_round_up(num, self->layout->lanes);
    double *points = all + at * PS_SPHERE_DIMENSION;
    if (num > 0) {
        memcpy(points, pattern->points + first * PS_SPHERE_DIMENSION,
               num * PS_SPHERE_DIMENSION * sizeof(double));
    }
    for (size_t j = 0; j < num; j++) {
        self->host_weights[at + j] = pattern->weights != NULL
                                         ? ldexp(pattern->weights[first + j], -exponent)
                                         : ldexp(1, -exponent);
    }
    for (size_t j = num; j < padded; j++) {
        memcpy(points + j * PS_SPHERE_DIMENSION, pole, sizeof pole);
        self->host_weights[at + j] = 0;
    }
    return padded;
}

static pspec_status prepare_on_host(ps_sphere_points *self, const double *points, size_t num,
                                    ps_error *error) {
    const ps_sphere_layout *layout = self->layout;
    ps_sphere_prepare(points, num, layout->only_even, layout->precision, self->capacity,
                      self->host_values, self->host_turns);
    PS_TRY(ps_buffer_write(self->device, &self->values, 0, self->host_values,
                           self->capacity * PS_SPHERE_ARRAYS * layout->real_bytes, error));
    return ps_buffer_write(self->device, &self->turns, 0, self->host_turns, num * sizeof(uint64_t),
                           error);
}

/* On the device, whose vectors of doubles are no longer than those of the sums. */
static pspec_status prepare_on_device(ps_sphere_points *self, size_t num, ps_error *error) {
    /* Counted in the source: 22 + 40 fused operations and five divisions or roots of about ten. */
    const double flops_per_point = 2 * 62 + 50;
    const size_t vectors = num / self->layout->prepare_lanes;
    const ps_range range = ps_range_heavy(
        self->device, vectors, 1, 1, flops_per_point * (double)num,
        (double)num * (4 * sizeof(double) + PS_SPHERE_ARRAYS * (double)self->layout->real_bytes));
    PS_TRY(ps_feed_end(&self->points, num * PS_SPHERE_DIMENSION * sizeof(double), error));
    return PS_LAUNCH(self->device, self->prepare, &range, error, PS_BUFFER(self->points.filled),
                     PS_BUFFER(self->values), PS_BUFFER(self->turns), PS_U64(vectors),
                     PS_U64(self->capacity));
}

pspec_status ps_sphere_points_upload(ps_sphere_points *self, const ps_batch *batch, size_t first,
                                     ps_error *error) {
    void *points = NULL;
    size_t at = 0;
    PS_TRY(ps_feed_begin(&self->points, &points, error));
    for (size_t r = 0; r < batch->num_patterns; r++) {
        self->host_offsets[r] = at / self->layout->lanes;
        at += copy_pattern(self, points, at, &batch->patterns[r],
                           batch->exponents != NULL ? batch->exponents[r] : 0, first);
    }
    self->host_offsets[batch->num_patterns] = self->num_vectors = at / self->layout->lanes;
    PS_TRY(ps_reals_write(self->device, &self->weights, self->layout->precision, self->host_weights,
                          at, error));
    PS_TRY(ps_buffer_write(self->device, &self->offsets, 0, self->host_offsets,
                           (batch->num_patterns + 1) * sizeof(uint64_t), error));
    return self->prepare != NULL ? prepare_on_device(self, at, error)
                                 : prepare_on_host(self, points, at, error);
}
