#include "engines/sphere/nufft/variants.h"

#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "sphere/nufft/numbers.h"

#include <math.h>
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
        bool is_there;
    } wanted[] = {
        {&self->turns, bytes.turns, "angles of points", true},
        {&self->weights, bytes.weights, "weights", true},
        {&self->offsets, (shape->together + 1) * sizeof(uint64_t), "offsets", true},
        {&self->keys, bytes.keys, "bands of points", bytes.keys > 0},
        {&self->sorted, bytes.turns, "sorted points", shape->is_sorted},
        {&self->heights, bytes.weights, "sorted weights", shape->is_sorted},
        {&self->starts, bytes.starts, "starts of bands", shape->is_sorted},
    };
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++) {
        if (wanted[i].is_there) {
            PS_TRY(ps_buffer_create(self->device, wanted[i].buffer, wanted[i].bytes, wanted[i].what,
                                    error));
        }
    }
    return ps_feed_create(&self->vectors, bytes.vectors, self->device, error);
}

static pspec_status make_room_for_weights(ps_sphere_places *self, ps_error *error) {
    return self->host_weights != NULL
               ? PSPEC_OK
               : ps_allocate(&self->host_weights, self->most_points, ps_real_bytes(self->precision),
                             "weights", error);
}

static void set_weight(ps_sphere_places *self, size_t at, double weight) {
    if (self->precision == PS_SINGLE) {
        ((float *)self->host_weights)[at] = (float)weight;
    } else {
        ((double *)self->host_weights)[at] = weight;
    }
}

/* They stay on the device until weights arrive; where points are sorted, on GPUs all of them,
 * nobody looks at them. */
static pspec_status upload_unit_weights(ps_sphere_places *self, ps_error *error) {
    self->has_unit_weights = true;
    if (self->shape->is_sorted || self->shape->route == PS_SPHERE_ON_GPU) {
        return PSPEC_OK;
    }
    PS_TRY(make_room_for_weights(self, error));
    for (size_t j = 0; j < self->most_points; j++) {
        set_weight(self, j, 1);
    }
    return ps_buffer_write(self->device, &self->weights, 0, self->host_weights,
                           self->most_points * ps_real_bytes(self->precision), error);
}

static uint64_t shift_of(const ps_sphere_shape *shape) {
    return (uint64_t)(((wide)shape->half_poles << 63) / shape->axis.n);
}

static pspec_status create_kernel(ps_sphere_places *self, const char *program, ps_error *error) {
    const ps_defines defines = ps_sphere_defines(self->shape, self->precision);
    return ps_kernel_get(self->device, &self->turn, program,
                         self->shape->is_sorted ? "sphere_orders_sort" : "sphere_orders_turns",
                         defines.text, error);
}

pspec_status ps_sphere_places_create(ps_sphere_places *out, const ps_sphere_shape *shape,
                                     const char *program, ps_precision precision, ps_device *device,
                                     ps_error *error) {
    *out = (ps_sphere_places){.device = device,
                              .precision = precision,
                              .shape = shape,
                              .most_points = shape->most_points,
                              .lanes = shape->lanes,
                              .shift = shift_of(shape)};
    PS_TRY(PS_NEW(&out->host_offsets, shape->together + 1, "offsets", error));
    PS_TRY(create_kernel(out, program, error));
    PS_TRY(create_buffers(out, error));
    return upload_unit_weights(out, error);
}

void ps_sphere_places_free(ps_sphere_places *points) {
    ps_feed_free(&points->vectors);
    PS_BUFFERS_RELEASE(&points->lent, &points->turns, &points->weights, &points->offsets,
                       &points->keys, &points->sorted, &points->heights, &points->starts);
    free(points->host_weights);
    free(points->host_offsets);
    *points = (ps_sphere_places){0};
}

/* ---- make -------------------------------------------------------------------------------- */

pspec_status ps_sphere_places_lend(ps_sphere_places *points, const pspec_pattern *pattern,
                                   ps_error *error) {
    const size_t bytes = pattern->num_points * PS_SPHERE_DIMENSION * sizeof(double);
    const ps_device_limits *limits = ps_device_get_limits(points->device);
    const bool are_made = pattern->points == NULL;
    if (are_made || !limits->has_unified_memory || bytes > limits->max_allocation_bytes) {
        return PSPEC_OK;
    }
    points->lent_points = pattern->points;
    return ps_buffer_share(points->device, &points->lent, pattern->points, bytes, "points", error);
}

pspec_status ps_sphere_places_return(ps_sphere_places *points, ps_error *error) {
    if (points->lent.memory == NULL) {
        return PSPEC_OK;
    }
    const pspec_status status = ps_device_finish(points->device, error);
    ps_buffer_release(&points->lent);
    return status;
}

static const ps_buffer *vectors_of(const ps_sphere_places *self) {
    return self->lent.memory != NULL ? &self->lent : &self->vectors.filled;
}

/* Some of the lent points stay where they are. */
static pspec_status look_at_lent(ps_sphere_places *self, const pspec_pattern *some,
                                 ps_error *error) {
    const size_t num_offsets_of_one = 2;
    self->first_point = (size_t)(some->points - self->lent_points) / PS_SPHERE_DIMENSION;
    self->host_offsets[0] = 0;
    self->host_offsets[1] = some->num_points;
    return self->first_point > 0 /* nobody asks for more of them where points are sorted */
               ? PSPEC_OK
               : ps_buffer_write(self->device, &self->offsets, 0, self->host_offsets,
                                 num_offsets_of_one * sizeof(uint64_t), error);
}

static void set_offsets(ps_sphere_places *self, const ps_batch *batch) {
    uint64_t at = 0;
    for (size_t r = 0; r < batch->num_patterns; r++) {
        self->host_offsets[r] = at;
        at += batch->patterns[r].num_points;
    }
    self->host_offsets[batch->num_patterns] = at;
}

static void copy_points(const ps_sphere_places *self, double *vectors, const ps_batch *batch) {
    for (size_t r = 0; r < batch->num_patterns; r++) {
        const pspec_pattern *pattern = &batch->patterns[r];
        memcpy(vectors + self->host_offsets[r] * PS_SPHERE_DIMENSION, pattern->points,
               pattern->num_points * PS_SPHERE_DIMENSION * sizeof(double));
    }
}

/* The device makes the points itself; patterns are whole sets, or one is a part of a set. */
static pspec_status make_points(ps_sphere_places *self, const ps_batch *batch, ps_error *error) {
    const sampler_range range = {.realization = batch->realization,
                                 .num_realizations = batch->num_patterns,
                                 .begin = batch->first_point,
                                 .step = 1,
                                 .count = batch->patterns[0].num_points};
    ps_feed_leave(&self->vectors);
    return ps_device_sets_write(batch->sets, &range, &self->vectors.filled, error);
}

static pspec_status copy_all(ps_sphere_places *self, const ps_batch *batch, ps_error *error) {
    void *vectors = NULL;
    PS_TRY(ps_feed_begin(&self->vectors, &vectors, error));
    copy_points(self, vectors, batch);
    return ps_feed_end(
        &self->vectors,
        self->host_offsets[batch->num_patterns] * PS_SPHERE_DIMENSION * sizeof(double), error);
}

/* All patterns in one go: a write of its own for each woke a thread of the driver for each, which
 * took as long as the transforms of 256 points. */
static pspec_status upload_points(ps_sphere_places *self, const ps_batch *batch, ps_error *error) {
    if (self->lent.memory != NULL) {
        return look_at_lent(self, batch->patterns, error);
    }
    self->first_point = 0;
    set_offsets(self, batch);
    PS_TRY(batch->sets != NULL ? make_points(self, batch, error) : copy_all(self, batch, error));
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
    PS_TRY(make_room_for_weights(self, error));
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
    const orders_sort_numbers numbers = {.first_point = self->first_point,
                                         .num_points = self->num_points,
                                         .part_points = PS_SPHERE_PART_POINTS,
                                         .shift = self->shift,
                                         .n = shape->axis.n,
                                         .width = shape->axis.window.width,
                                         .bands = shape->bands,
                                         .tiles = shape->tiles,
                                         .has_weights = !self->has_unit_weights};
    return PS_LAUNCH(self->device, self->turn, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(*vectors_of(self)), PS_BUFFER(self->weights), PS_BUFFER(self->turns),
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
    return PS_LAUNCH(points->device, points->turn, &range, error, PS_BUFFER(points->vectors.filled),
                     PS_BUFFER(points->turns), PS_U64(num), PS_U64(points->shift));
}
