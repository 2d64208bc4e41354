#include "engines/sphere/nufft/places.h"

#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "sphere/nufft/numbers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

__extension__ typedef unsigned __int128 wide; /* not in ISO C */

/* ---- create ------------------------------------------------------------------------------ */

static pspec_status create_buffers(ps_sphere_places *self, ps_error *error) {
    const ps_sphere_shape *shape = self->shape;
    const ps_sphere_bytes bytes = ps_sphere_bytes_of(shape, ps_real_bytes(self->precision));
    const struct {
        ps_buffer *buffer;
        size_t bytes;
        const char *what;
        bool is_of_sorted;
    } wanted[] = {
        {&self->vectors, bytes.vectors, "points", false},
        {&self->turns, bytes.turns, "angles of points", false},
        {&self->weights, bytes.weights, "weights", false},
        {&self->offsets, (shape->together + 1) * sizeof(uint64_t), "offsets", false},
        {&self->keys, bytes.keys, "bands of points", true},
        {&self->sorted, bytes.turns, "sorted points", true},
        {&self->heights, bytes.weights, "sorted weights", true},
        {&self->starts, bytes.starts, "starts of bands", true},
    };
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++) {
        if (!wanted[i].is_of_sorted || shape->is_sorted) {
            PS_TRY(ps_buffer_create(self->device, wanted[i].buffer, wanted[i].bytes, wanted[i].what,
                                    error));
        }
    }
    return PSPEC_OK;
}

static void set_weight(ps_sphere_places *self, size_t at, double weight) {
    if (self->precision == PS_SINGLE) {
        ((float *)self->host_weights)[at] = (float)weight;
    } else {
        ((double *)self->host_weights)[at] = weight;
    }
}

/* They stay on the device until weights arrive. */
static pspec_status upload_unit_weights(ps_sphere_places *self, ps_error *error) {
    for (size_t j = 0; j < self->most_points; j++) {
        set_weight(self, j, 1);
    }
    self->has_unit_weights = true;
    return ps_buffer_write(self->device, &self->weights, 0, self->host_weights,
                           self->most_points * ps_real_bytes(self->precision), error);
}

static uint64_t shift_of(const ps_sphere_shape *shape) {
    return (uint64_t)(((wide)shape->half_poles << 63) / shape->axis.n);
}

pspec_status ps_sphere_places_create(ps_sphere_places *out, const ps_sphere_shape *shape,
                                     ps_precision precision, ps_device *device, ps_error *error) {
    char options[64];
    void *memory = NULL;
    *out = (ps_sphere_places){.device = device,
                              .precision = precision,
                              .shape = shape,
                              .most_points = shape->most_points,
                              .lanes = shape->lanes,
                              .shift = shift_of(shape)};
    PS_TRY(ps_allocate(&memory, out->most_points, ps_real_bytes(precision), "weights", error));
    out->host_weights = memory;
    PS_TRY(PS_NEW(&out->host_offsets, shape->together + 1, "offsets", error));
    snprintf(options, sizeof options, "-DPRECISION=%u -DLANES=%u",
             precision == PS_SINGLE ? 32u : 64u, out->lanes);
    PS_TRY(ps_kernel_create(
        device, &out->turn,
        shape->is_sorted ? "sphere/nufft/orders_sort.cl" : "sphere/nufft/orders_turns.cl",
        shape->is_sorted ? "sphere_orders_sort" : "sphere_orders_turns", options, error));
    PS_TRY(create_buffers(out, error));
    return upload_unit_weights(out, error);
}

void ps_sphere_places_free(ps_sphere_places *points) {
    if (points->turn != NULL) {
        clReleaseKernel(points->turn);
    }
    ps_buffer_release(&points->vectors);
    ps_buffer_release(&points->turns);
    ps_buffer_release(&points->weights);
    ps_buffer_release(&points->offsets);
    ps_buffer_release(&points->keys);
    ps_buffer_release(&points->sorted);
    ps_buffer_release(&points->heights);
    ps_buffer_release(&points->starts);
    free(points->host_weights);
    free(points->host_offsets);
    *points = (ps_sphere_places){0};
}

/* ---- make -------------------------------------------------------------------------------- */

static void copy_points(ps_sphere_places *self, double *vectors, const ps_batch *batch) {
    size_t at = 0;
    for (size_t r = 0; r < batch->num_patterns; r++) {
        const pspec_pattern *pattern = &batch->patterns[r];
        self->host_offsets[r] = at;
        memcpy(vectors + at * PS_SPHERE_DIMENSION, pattern->points,
               pattern->num_points * PS_SPHERE_DIMENSION * sizeof(double));
        at += pattern->num_points;
    }
    self->host_offsets[batch->num_patterns] = at;
}

/* All patterns in one go: a write of its own for each woke a thread of the driver for each, which
 * took as long as the transforms of 256 points. */
static pspec_status upload_points(ps_sphere_places *self, const ps_batch *batch, ps_error *error) {
    ps_mapping mapping = {0};
    PS_TRY(ps_mapping_begin(self->device, &mapping, &self->vectors, error));
    const pspec_status status = ps_mapping_wait(&mapping, error);
    if (status != PSPEC_OK) {
        ps_mapping_abandon(self->device, &mapping);
        return status;
    }
    copy_points(self, mapping.data, batch);
    PS_TRY(ps_mapping_end(self->device, &mapping, error));
    return ps_buffer_write(self->device, &self->offsets, 0, self->host_offsets,
                           (batch->num_patterns + 1) * sizeof(uint64_t), error);
}

static pspec_status upload_weights(ps_sphere_places *self, const ps_batch *batch, ps_error *error) {
    for (size_t r = 0; r < batch->num_patterns; r++) {
        self->has_unit_weights = self->has_unit_weights && batch->patterns[r].weights == NULL;
    }
    if (self->has_unit_weights) {
        return PSPEC_OK;
    }
    for (size_t r = 0; r < batch->num_patterns; r++) {
        const pspec_pattern *pattern = &batch->patterns[r];
        const int exponent = batch->exponents != NULL ? batch->exponents[r] : 0;
        for (size_t j = 0; j < pattern->num_points; j++) {
            set_weight(self, self->host_offsets[r] + j,
                       pattern->weights != NULL ? ldexp(pattern->weights[j], -exponent) : 1);
        }
    }
    return ps_buffer_write(self->device, &self->weights, 0, self->host_weights,
                           self->host_offsets[batch->num_patterns] * ps_real_bytes(self->precision),
                           error);
}

static pspec_status sort_points(ps_sphere_places *self, ps_error *error) {
    const ps_sphere_shape *shape = self->shape;
    const double flops_per_point = 1000; /* work-groups of one work-item on CPUs */
    const size_t parts = ps_divide_up(self->num_points, PS_SPHERE_PART_POINTS);
    const ps_range range =
        ps_range_heavy(self->device, parts, 1, 1, flops_per_point * (double)self->num_points, 0);
    const orders_sort_numbers numbers = {.num_points = self->num_points,
                                         .part_points = PS_SPHERE_PART_POINTS,
                                         .shift = self->shift,
                                         .n = shape->axis.n,
                                         .width = shape->axis.window.width,
                                         .bands = shape->bands,
                                         .tiles = shape->tiles,
                                         .has_weights = !self->has_unit_weights};
    return PS_LAUNCH(self->device, self->turn, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(self->vectors), PS_BUFFER(self->weights), PS_BUFFER(self->turns),
                     PS_BUFFER(self->keys), PS_BUFFER(self->sorted), PS_BUFFER(self->heights),
                     PS_BUFFER(self->starts));
}

pspec_status ps_sphere_places_make(ps_sphere_places *points, const ps_batch *batch,
                                   ps_error *error) {
    const double flops_per_point = 300;
    PS_TRY(upload_points(points, batch, error));
    PS_TRY(upload_weights(points, batch, error));
    points->num_points = points->host_offsets[batch->num_patterns];
    if (points->shape->is_sorted) {
        return sort_points(points, error);
    }
    const uint64_t num = points->num_points;
    const ps_range range = ps_range_light(points->device, ps_divide_up(num, points->lanes), 1, 1,
                                          flops_per_point * (double)num, 0);
    return PS_LAUNCH(points->device, points->turn, &range, error, PS_BUFFER(points->vectors),
                     PS_BUFFER(points->turns), PS_U64(num), PS_U64(points->shift));
}
