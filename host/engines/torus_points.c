#include "engines/torus_points.h"

#include "base/memory.h"
#include "engines/reals.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

__extension__ typedef unsigned __int128 wide; /* not in ISO C */

static uint64_t bits_of(double x) {
    uint64_t bits = 0;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* Without branches and conversions, since every point passes here: adding 1 leaves the upper 52 bits
 * of x in the mantissa; what that rounds off is below 2^-52, exact, and goes through the mantissa of
 * another sum, which rounds it to whole units of 2^-64. 1 + x may round up to 2: the upper part then
 * is 0, the rest negative, and the sum wraps as it should. */
uint64_t ps_fixed_point(double x) {
    enum { EXPONENT_BITS = 12 };
    const double two_to_64 = 18446744073709551616.0;
    const double rounder = 6755399441055744.0; /* 1.5 * 2^52: its last bit is a unit */
    const double upper = 1 + x;
    const double rest = (x - (upper - 1)) * two_to_64;
    return (bits_of(upper) << EXPONENT_BITS) + (bits_of(rest + rounder) - bits_of(rounder));
}

/* ---- create ------------------------------------------------------------------------------ */

static pspec_status create_host(ps_torus_points *out, ps_error *error) {
    void *memory = NULL;
    const size_t count = out->batch * out->slab;
    PS_TRY(ps_allocate(&memory, count, out->dimension * sizeof(uint64_t), "points", error));
    out->host_points = memory;
    PS_TRY(ps_allocate(&memory, count, ps_real_bytes(out->precision), "weights", error));
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
                           count * ps_real_bytes(points->precision), error);
}

pspec_status ps_torus_points_create(ps_torus_points *out, unsigned dimension, size_t batch,
                                    size_t slab, ps_precision precision, bool far_apart,
                                    ps_device *device, ps_error *error) {
    const size_t count = batch * slab;
    *out = (ps_torus_points){.dimension = dimension,
                             .batch = batch,
                             .slab = slab,
                             .precision = precision,
                             .far_apart = far_apart};
    PS_TRY(create_host(out, error));
    PS_TRY(ps_buffer_create(device, &out->points, count * dimension * sizeof(uint64_t), "points",
                            error));
    PS_TRY(ps_buffer_create(device, &out->weights, count * ps_real_bytes(precision), "weights",
                            error));
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

/* Fixed-point coordinates of count points, from point j on in steps; dimension is a constant in every
 * call, so that the inner loop unrolls. */
static inline void convert_points(uint64_t *out, const double *points, unsigned dimension,
                                  size_t count, uint64_t j, uint64_t step, uint64_t n) {
    for (size_t i = 0; i < count; i++) {
        for (unsigned axis = 0; axis < dimension; axis++) {
            out[i * dimension + axis] = ps_fixed_point(points[j * dimension + axis]);
        }
        j += step;
        j -= j >= n ? n : 0;
    }
}

/* Points first .. of a pattern, in the order of steps, to place `at` on; how many there were. */
static size_t convert_pattern(ps_torus_points *points, size_t at, const pspec_pattern *pattern,
                              int exponent, size_t first) {
    const uint64_t n = pattern->num_points;
    if (first >= n) {
        return 0;
    }
    const size_t count = n - first < points->slab ? (size_t)(n - first) : points->slab;
    const uint64_t step = points->far_apart ? ps_torus_point_step(n) : 1;
    uint64_t j = (uint64_t)((wide)first * step % n);
    uint64_t *out = points->host_points + at * points->dimension;
    switch (points->dimension) {
    case 1:
        convert_points(out, pattern->points, 1, count, j, step, n);
        break;
    case 2:
        convert_points(out, pattern->points, 2, count, j, step, n);
        break;
    case 3:
        convert_points(out, pattern->points, 3, count, j, step, n);
        break;
    default:
        convert_points(out, pattern->points, points->dimension, count, j, step, n);
    }
    for (size_t i = at; !points->has_unit_weights && i < at + count; i++) {
        set_weight(points, i, pattern->weights != NULL ? ldexp(pattern->weights[j], -exponent) : 1);
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
        at += convert_pattern(points, at, &batch->patterns[r],
                              batch->exponents != NULL ? batch->exponents[r] : 0, first);
    }
    points->host_offsets[batch->num_patterns] = at;
    *num_points = at;
    PS_TRY(ps_buffer_write(device, &points->points, 0, points->host_points,
                           at * points->dimension * sizeof(uint64_t), error));
    if (!points->has_unit_weights) {
        PS_TRY(ps_buffer_write(device, &points->weights, 0, points->host_weights,
                               at * ps_real_bytes(points->precision), error));
    }
    return ps_buffer_write(device, &points->offsets, 0, points->host_offsets,
                           (batch->num_patterns + 1) * sizeof(uint64_t), error);
}
