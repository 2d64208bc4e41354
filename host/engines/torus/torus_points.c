#include "engines/torus/torus_points.h"

#include "base/memory.h"
#include "base/workers.h"
#include "device/reals.h"
#include "math/divisor.h"
#include "shared/fixed_point.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

__extension__ typedef unsigned __int128 wide; /* not in ISO C */

uint64_t ps_fixed_point(double x) {
    return fixed_point(x);
}

/* ---- create ------------------------------------------------------------------------------ */

static pspec_status create_host(ps_torus_points *out, ps_error *error) {
    void *memory = NULL;
    const size_t count = out->batch * out->slab;
    PS_TRY(ps_allocate(&memory, count, ps_real_bytes(out->precision), "weights", error));
    out->host_weights = memory;
    PS_TRY(PS_NEW(&out->host_offsets, out->batch + 1, "offsets", error));
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
    PS_TRY(ps_buffer_create(device, &out->weights, count * ps_real_bytes(precision), "weights",
                            error));
    PS_TRY(
        ps_buffer_create(device, &out->offsets, (batch + 1) * sizeof(uint64_t), "offsets", error));
    PS_TRY(upload_unit_weights(out, device, error));
    return ps_feed_create(&out->feed, count * dimension * sizeof(uint64_t), device, error);
}

void ps_torus_points_free(ps_torus_points *points) {
    free(points->host_weights);
    free(points->host_offsets);
    ps_feed_free(&points->feed);
    ps_buffer_release(&points->weights);
    ps_buffer_release(&points->offsets);
    *points = (ps_torus_points){0};
}

/* ---- upload ------------------------------------------------------------------------------ */

uint64_t ps_torus_point_step(uint64_t n) {
    const double golden = 0.6180339887498949;
    uint64_t step = (uint64_t)((double)n * golden);
    while (step > 1 && ps_common_divisor(step, n) != 1) {
        step--;
    }
    return step > 0 ? step : 1;
}

/* The sign bit says that x is in [0,1), without a branch: bits are in the order of numbers, and
 * those of 1 taken off wrap around below 1; -0 + 0 is 0. */
static inline uint64_t is_inside(double x) {
    const uint64_t bits = FIXED_POINT_BITS(x + 0.0);
    return (bits - FIXED_POINT_BITS(1)) & ~bits;
}

/* Fixed-point coordinates of count points, from point j on in steps; dimension is a constant in
 * every call, so that the inner loop unrolls. The sign bit says whether all are in [0,1): checked
 * here since points of large sets come from memory, where a second reading would take as long. */
static inline uint64_t convert_points(uint64_t *out, const double *points, unsigned dimension,
                                      size_t count, uint64_t j, uint64_t step, uint64_t n) {
    uint64_t inside = UINT64_MAX;
    for (size_t i = 0; i < count; i++) {
        for (unsigned axis = 0; axis < dimension; axis++) {
            const double x = points[j * dimension + axis];
            out[i * dimension + axis] = fixed_point(x);
            inside &= is_inside(x);
        }
        j += step;
        j -= j >= n ? n : 0;
    }
    return inside;
}

/* Numbers in their order, which the compiler makes vectors of. */
static uint64_t convert_numbers(uint64_t *restrict out, const double *restrict x, size_t num) {
    uint64_t inside = UINT64_MAX;
    for (size_t i = 0; i < num; i++) {
        out[i] = fixed_point(x[i]);
        inside &= is_inside(x[i]);
    }
    return inside;
}

static uint64_t convert_coordinates(uint64_t *out, const pspec_pattern *pattern, size_t count,
                                    uint64_t j, uint64_t step) {
    const uint64_t n = pattern->num_points;
    const unsigned dimension = pattern->dimension;
    if (step == 1 && count <= n - j) {
        return convert_numbers(out, pattern->points + j * dimension, count * dimension);
    }
    switch (dimension) {
    case 1:
        return convert_points(out, pattern->points, 1, count, j, step, n);
    case 2:
        return convert_points(out, pattern->points, 2, count, j, step, n);
    case 3:
        return convert_points(out, pattern->points, 3, count, j, step, n);
    default:
        return convert_points(out, pattern->points, dimension, count, j, step, n);
    }
}

/* Points from `first` on that there is room for. */
static size_t count_points(const ps_torus_points *points, const pspec_pattern *pattern,
                           size_t first) {
    const size_t rest = pattern->num_points > first ? pattern->num_points - first : 0;
    return rest < points->slab ? rest : points->slab;
}

/* Points first .. of a pattern, in the order of steps, to place `at` on. The sign bit of *inside
 * stays where all are in [0,1). */
static void convert_pattern(ps_torus_points *points, uint64_t *out, size_t at,
                            const pspec_pattern *pattern, int exponent, size_t first,
                            uint64_t *inside) {
    const uint64_t n = pattern->num_points;
    const size_t count = count_points(points, pattern, first);
    if (count == 0) {
        return;
    }
    const uint64_t step = points->far_apart ? ps_torus_point_step(n) : 1;
    uint64_t j = (uint64_t)((wide)first * step % n);
    *inside &= convert_coordinates(out + at * points->dimension, pattern, count, j, step);
    for (size_t i = at; !points->has_unit_weights && i < at + count; i++) {
        set_weight(points, i, pattern->weights != NULL ? ldexp(pattern->weights[j], -exponent) : 1);
        j += step;
        j -= j >= n ? n : 0;
    }
}

typedef struct conversion {
    ps_torus_points *points;
    uint64_t *out;
    const ps_batch *batch;
    size_t first;
    uint64_t inside[PS_WORKERS_MOST];
} conversion;

static void convert_some(void *payload, unsigned index, unsigned count) {
    conversion *work = payload;
    const ps_batch *batch = work->batch;
    const size_t end = ps_share_begin(batch->num_patterns, index + 1, count);
    uint64_t inside = UINT64_MAX;
    for (size_t r = ps_share_begin(batch->num_patterns, index, count); r < end; r++) {
        convert_pattern(work->points, work->out, work->points->host_offsets[r], &batch->patterns[r],
                        batch->exponents != NULL ? batch->exponents[r] : 0, work->first, &inside);
    }
    work->inside[index] = inside;
}

/* Parts of a large set of so many points, for which the device waits, are worth threads; batches of
 * small sets are converted while it has others. */
static const size_t least_part = 1 << 17;

/* Returns the number of points of all patterns. */
static size_t set_offsets(ps_torus_points *points, const ps_batch *batch, size_t first) {
    size_t at = 0;
    for (size_t r = 0; r < batch->num_patterns; r++) {
        points->host_offsets[r] = at;
        at += count_points(points, &batch->patterns[r], first);
    }
    points->host_offsets[batch->num_patterns] = at;
    return at;
}

/* All patterns, to memory of the host or of a buffer. */
static pspec_status convert(ps_torus_points *points, uint64_t *out, const ps_batch *batch,
                            size_t first, size_t *num_points, ps_error *error) {
    conversion all = {points, out, batch, first, {0}};
    uint64_t inside = UINT64_MAX;
    memset(all.inside, 0xff, sizeof all.inside); /* of threads that are not there */
    for (size_t r = 0; r < batch->num_patterns; r++) {
        points->has_unit_weights = points->has_unit_weights && batch->patterns[r].weights == NULL;
    }
    *num_points = set_offsets(points, batch, first);
    if (batch->num_patterns > 1 && batch->patterns[0].num_points >= least_part) {
        ps_workers_share(*num_points, convert_some, &all);
    } else {
        convert_some(&all, 0, 1);
    }
    for (size_t i = 0; i < PS_WORKERS_MOST; i++) {
        inside &= all.inside[i];
    }
    return inside >> 63 != 0 ? PSPEC_OK
                             : ps_fail(error, PSPEC_ERROR_INPUT, "a coordinate is outside [0,1)");
}

static pspec_status fill(ps_torus_points *points, const ps_batch *batch, size_t first,
                         size_t *num_points, ps_error *error) {
    void *data = NULL;
    PS_TRY(ps_feed_begin(&points->feed, &data, error));
    PS_TRY(convert(points, data, batch, first, num_points, error));
    return ps_feed_end(&points->feed, *num_points * points->dimension * sizeof(uint64_t), error);
}

/* The device makes the points itself. */
static pspec_status make(ps_torus_points *points, ps_device *device, const ps_batch *batch,
                         size_t first, size_t *num_points, ps_error *error) {
    const uint64_t n = ps_device_sets_points(batch->sets);
    const uint64_t step = points->far_apart ? ps_torus_point_step(n) : 1;
    const uint64_t num = batch->is_one_set ? 1 : batch->num_patterns;
    *num_points = set_offsets(points, batch, first);
    const sampler_range range = {.realization = batch->realization,
                                 .num_realizations = num,
                                 .begin = (uint64_t)((wide)(batch->first_point + first) * step % n),
                                 .step = step,
                                 .count = *num_points / num};
    ps_feed_leave(&points->feed);
    if (!points->has_unit_weights) {
        PS_TRY(upload_unit_weights(points, device, error));
    }
    return ps_device_sets_write(batch->sets, &range, &points->feed.filled, error);
}

pspec_status ps_torus_points_upload(ps_torus_points *points, ps_device *device,
                                    const ps_batch *batch, size_t first, size_t *num_points,
                                    ps_error *error) {
    PS_TRY(batch->sets != NULL ? make(points, device, batch, first, num_points, error)
                               : fill(points, batch, first, num_points, error));
    points->points = points->feed.filled;
    if (!points->has_unit_weights) {
        PS_TRY(ps_buffer_write(device, &points->weights, 0, points->host_weights,
                               *num_points * ps_real_bytes(points->precision), error));
    }
    return ps_buffer_write(device, &points->offsets, 0, points->host_offsets,
                           (batch->num_patterns + 1) * sizeof(uint64_t), error);
}
