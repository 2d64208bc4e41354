#include "engines/torus_points.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

static const double two_to_64 = 18446744073709551616.0;

uint64_t ps_fixed_point(double x) {
    return (uint64_t)rint(x * two_to_64); /* x <= 1 - 2^-53, so the product stays below 2^64 */
}

static size_t real_bytes(ps_precision precision) {
    return precision == PS_SINGLE ? sizeof(float) : sizeof(double);
}

static pspec_status create_host(ps_torus_points *out, ps_error *error) {
    void *memory = NULL;
    const size_t count = out->batch * out->slab;
    PS_TRY(ps_allocate(&memory, count, out->dimension * sizeof(uint64_t), "points", error));
    out->host_points = memory;
    PS_TRY(ps_allocate(&memory, count, real_bytes(out->precision), "weights", error));
    out->host_weights = memory;
    PS_TRY(ps_allocate(&memory, out->batch + 1, sizeof(uint64_t), "offsets", error));
    out->host_offsets = memory;
    return PSPEC_OK;
}

pspec_status ps_torus_points_create(ps_torus_points *out, unsigned dimension, size_t batch,
                                    size_t slab, ps_precision precision, ps_device *device,
                                    ps_error *error) {
    const size_t count = batch * slab;
    *out = (ps_torus_points){
        .dimension = dimension, .batch = batch, .slab = slab, .precision = precision};
    PS_TRY(create_host(out, error));
    PS_TRY(ps_buffer_create(device, &out->points, count * dimension * sizeof(uint64_t), "points",
                            error));
    PS_TRY(ps_buffer_create(device, &out->weights, count * real_bytes(precision), "weights",
                            error));
    return ps_buffer_create(device, &out->offsets, (batch + 1) * sizeof(uint64_t), "offsets",
                            error);
}

void ps_torus_points_free(ps_torus_points *points) {
    free(points->host_points);
    free(points->host_weights);
    free(points->host_offsets);
    ps_buffer_release(&points->points);
    ps_buffer_release(&points->weights);
    ps_buffer_release(&points->offsets);
    *points = (ps_torus_points){0};
}

static void convert_weights(ps_torus_points *points, size_t at, const double *weights,
                            size_t count) {
    for (size_t j = 0; j < count; j++) {
        const double weight = weights != NULL ? weights[j] : 1.0;
        if (points->precision == PS_SINGLE) {
            ((float *)points->host_weights)[at + j] = (float)weight;
        } else {
            ((double *)points->host_weights)[at + j] = weight;
        }
    }
}

static size_t convert_pattern(ps_torus_points *points, size_t at, const pspec_pattern *pattern,
                              size_t first) {
    if (first >= pattern->num_points) {
        return 0;
    }
    const size_t rest = pattern->num_points - first;
    const size_t count = rest < points->slab ? rest : points->slab;
    const double *source = pattern->points + first * points->dimension;
    uint64_t *target = points->host_points + at * points->dimension;
    for (size_t i = 0; i < count * points->dimension; i++) {
        target[i] = ps_fixed_point(source[i]);
    }
    convert_weights(points, at, pattern->weights != NULL ? pattern->weights + first : NULL, count);
    return count;
}

pspec_status ps_torus_points_upload(ps_torus_points *points, ps_device *device,
                                    const ps_batch *batch, size_t first, size_t *num_points,
                                    ps_error *error) {
    size_t at = 0;
    for (size_t r = 0; r < batch->num_patterns; r++) {
        points->host_offsets[r] = at;
        at += convert_pattern(points, at, &batch->patterns[r], first);
    }
    points->host_offsets[batch->num_patterns] = at;
    *num_points = at;
    PS_TRY(ps_buffer_write(device, &points->points, 0, points->host_points,
                           at * points->dimension * sizeof(uint64_t), error));
    PS_TRY(ps_buffer_write(device, &points->weights, 0, points->host_weights,
                           at * real_bytes(points->precision), error));
    return ps_buffer_write(device, &points->offsets, 0, points->host_offsets,
                           (batch->num_patterns + 1) * sizeof(uint64_t), error);
}
