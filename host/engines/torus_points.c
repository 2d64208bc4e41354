#include "engines/torus_points.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

__extension__ typedef unsigned __int128 wide; /* not in ISO C */

static size_t real_bytes(ps_precision precision) {
    return precision == PS_SINGLE ? sizeof(float) : sizeof(double);
}

/* From the bits of the double: x = mantissa 2^(exponent - 1075), so X is the mantissa shifted by
 * exponent - 1011. Twice as fast as rint() and a conversion, which matters for small sets. */
uint64_t ps_fixed_point(double x) {
    enum { MANTISSA_BITS = 52, ZERO_SHIFT = 1011, LONGEST_SHIFT = 54 };
    const uint64_t one = 1;
    uint64_t bits = 0;
    memcpy(&bits, &x, sizeof bits);
    const int shift = (int)(bits >> MANTISSA_BITS) - ZERO_SHIFT;
    const uint64_t mantissa = (bits & ((one << MANTISSA_BITS) - 1)) | one << MANTISSA_BITS;
    if (shift >= 0) {
        return mantissa << shift;
    }
    return shift < -LONGEST_SHIFT ? 0 : (mantissa + (one << (-shift - 1))) >> -shift;
}

/* ---- create ------------------------------------------------------------------------------ */

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

static void set_weight(ps_torus_points *points, size_t at, double weight) {
    if (points->precision == PS_SINGLE) {
        ((float *)points->host_weights)[at] = (float)weight;
    } else {
        ((double *)points->host_weights)[at] = weight;
    }
}

/* Unit weights are on the device from the start and stay there until weights arrive. */
static pspec_status upload_unit_weights(ps_torus_points *points, ps_device *device,
                                        ps_error *error) {
    const size_t count = points->batch * points->slab;
    for (size_t j = 0; j < count; j++) {
        set_weight(points, j, 1);
    }
    points->has_unit_weights = true;
    return ps_buffer_write(device, &points->weights, 0, points->host_weights,
                           count * real_bytes(points->precision), error);
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
    PS_TRY(
        ps_buffer_create(device, &out->weights, count * real_bytes(precision), "weights", error));
    PS_TRY(
        ps_buffer_create(device, &out->offsets, (batch + 1) * sizeof(uint64_t), "offsets", error));
    return upload_unit_weights(out, device, error);
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

/* ---- upload ------------------------------------------------------------------------------ */

static uint64_t greatest_common_divisor(uint64_t a, uint64_t b) {
    while (b != 0) {
        const uint64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

uint64_t ps_torus_point_step(uint64_t n) {
    const double golden = 0.6180339887498949;
    uint64_t step = (uint64_t)((double)n * golden);
    while (step > 1 && greatest_common_divisor(step, n) != 1) {
        step--;
    }
    return step > 0 ? step : 1;
}

/* Points first .. of a pattern, in the order of steps, to place `at` on; how many there were. */
static size_t convert_pattern(ps_torus_points *points, size_t at, const pspec_pattern *pattern,
                              size_t first) {
    const uint64_t n = pattern->num_points;
    if (first >= n) {
        return 0;
    }
    const size_t count = n - first < points->slab ? (size_t)(n - first) : points->slab;
    const uint64_t step = ps_torus_point_step(n);
    uint64_t j = (uint64_t)((wide)first * step % n);
    for (size_t i = at; i < at + count; i++) {
        for (unsigned axis = 0; axis < points->dimension; axis++) {
            points->host_points[i * points->dimension + axis] =
                ps_fixed_point(pattern->points[j * points->dimension + axis]);
        }
        if (!points->has_unit_weights) {
            set_weight(points, i, pattern->weights != NULL ? pattern->weights[j] : 1);
        }
        j += step;
        j -= j >= n ? n : 0;
    }
    return count;
}

pspec_status ps_torus_points_upload(ps_torus_points *points, ps_device *device,
                                    const ps_batch *batch, size_t first, size_t *num_points,
                                    ps_error *error) {
    size_t at = 0;
    for (size_t r = 0; r < batch->num_patterns; r++) {
        points->has_unit_weights = points->has_unit_weights && batch->patterns[r].weights == NULL;
    }
    for (size_t r = 0; r < batch->num_patterns; r++) {
        points->host_offsets[r] = at;
        at += convert_pattern(points, at, &batch->patterns[r], first);
    }
    points->host_offsets[batch->num_patterns] = at;
    *num_points = at;
    PS_TRY(ps_buffer_write(device, &points->points, 0, points->host_points,
                           at * points->dimension * sizeof(uint64_t), error));
    if (!points->has_unit_weights) {
        PS_TRY(ps_buffer_write(device, &points->weights, 0, points->host_weights,
                               at * real_bytes(points->precision), error));
    }
    return ps_buffer_write(device, &points->offsets, 0, points->host_offsets,
                           (batch->num_patterns + 1) * sizeof(uint64_t), error);
}
