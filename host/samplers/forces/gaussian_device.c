#include "samplers/forces/gaussian_device.h"

#include "samplers/forces/gaussian_sums.h"
#include "samplers/forces/need_doubles.h"

#define PRECISION 64
#include "samplers/gaussian.h"

enum { SPACE = 3 };
/* Operations of a pair, pairs of a point at sigma = 1, and points of a launch, between two of which
 * the watch hears of it: 50 ms of a core in space. */
static const double PAIR_FLOPS = 40;
static const double PAIRS_IN_PLANE = 310;
static const double PAIRS_IN_SPACE = 4500;
enum { POINTS_AT_ONCE = 1 << 13 };

pspec_status ps_gaussian_device_create(ps_gaussian_device *d, ps_device *device,
                                       const ps_gaussian_sums *shape, ps_error *error) {
    ps_defines defines = ps_defines_of(sizeof(double), 0);
    *d = (ps_gaussian_device){.device = device};
    PS_TRY(ps_forces_need_doubles(ps_device_get_limits(device), "gaussian-blue-noise", error));
    ps_defines_add(&defines, "-DDIMENSION=%u", shape->dimension);
    PS_TRY(ps_kernel_get(device, &d->kernel, "samplers/gaussian.cl", "gaussian_sums", defines.text,
                         error));
    PS_TRY(ps_buffer_create(device, &d->points, shape->dimension * shape->stride * sizeof(double),
                            "points by cells", error));
    PS_TRY(ps_buffer_create(device, &d->begins, (shape->num_cells + 1) * sizeof(uint32_t),
                            "cells of points", error));
    return ps_buffer_create(device, &d->sums,
                            (1 + shape->dimension) * shape->stride * sizeof(double),
                            "forces on points", error);
}

void ps_gaussian_device_destroy(ps_gaussian_device *d) {
    ps_buffer_release(&d->points);
    ps_buffer_release(&d->begins);
    ps_buffer_release(&d->sums);
}

static pspec_status launch(ps_gaussian_device *d, const ps_gaussian_sums *s, size_t first,
                           size_t num, ps_error *error) {
    const gaussian_grid grid = {s->reach, s->exponent, s->num, s->stride, s->dimension, s->cells};
    const double pairs = s->dimension == SPACE ? PAIRS_IN_SPACE : PAIRS_IN_PLANE;
    ps_range range =
        ps_range_heavy(d->device, num, 1, 1, (double)num * pairs * PAIR_FLOPS, (double)num);
    range.offset[0] = first;
    return PS_LAUNCH(d->device, d->kernel, &range, error, PS_STRUCT(grid), PS_BUFFER(d->points),
                     PS_BUFFER(d->begins), PS_BUFFER(d->sums));
}

/* Rounded up, a launch may make some sums of the next, which are the same. */
pspec_status ps_gaussian_device_sum(ps_gaussian_device *d, const ps_gaussian_sums *s,
                                    const ps_watch *watch, ps_error *error) {
    PS_TRY(ps_buffer_write(d->device, &d->points, 0, s->points, d->points.bytes, error));
    PS_TRY(ps_buffer_write(d->device, &d->begins, 0, s->begins, d->begins.bytes, error));
    for (size_t first = 0; first < s->num; first += POINTS_AT_ONCE) {
        const size_t left = s->num - first;
        PS_TRY(launch(d, s, first, left < POINTS_AT_ONCE ? left : POINTS_AT_ONCE, error));
        if (left > POINTS_AT_ONCE) {
            PS_TRY(ps_device_finish(d->device, error));
            PS_TRY(ps_watch_tell(watch, "sampler: gaussian-blue-noise, points of a step",
                                 first + POINTS_AT_ONCE, s->num, NULL, error));
        }
    }
    return ps_buffer_read(d->device, &d->sums, 0, s->sums, d->sums.bytes, error);
}
