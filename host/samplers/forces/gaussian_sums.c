#include "samplers/forces/gaussian.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PRECISION 64
#include "samplers/gaussian.h"
#include "samplers/forces/loan.h"

/* Gaussians end at so many of their widths, where they are 2e-16: a term of a sum that is never
 * less than 1 has no bit left. */
static const double REACH = 8.5;
/* Side of a cell in units of N^(-1/d): with smaller ones runs of points are short, with larger ones
 * more points are out of reach. The device takes 1.17, 0.96, 0.89, 0.82 and 0.84 us a point at 1,
 * 1.5, 2, 2.5 and 3 in the plane, 18, 11.5, 10.7, 10.3 and 10.9 in space (one core of an EPYC with
 * AVX-512, PoCL 3.1, 2026-11); the host is even to a tenth. */
static const double CELL_SIDE = 2.5;
/* Points between two looks at the watch: 40 ms in space, 5 ms in the plane. */
enum { PLANE = 2, SPACE = 3, POINTS_AT_A_TIME = 1 << 12 };

/* Newton's method, from above: it falls until rounding stops it. */
static double cube_root(double a) {
    double x = a > 1 ? a : 1;
    for (;;) {
        const double next = (2 * x + a / (x * x)) / 3;
        if (!(next < x)) {
            return x;
        }
        x = next;
    }
}

double ps_gaussian_unit(size_t num, unsigned dimension) {
    return 1 / (dimension == PLANE ? sqrt((double)num) : cube_root((double)num));
}

static uint32_t count_cells(double unit) {
    const double cells = floor(1 / (CELL_SIDE * unit));
    return cells < 1 ? 1 : (uint32_t)cells;
}

double ps_gaussian_sums_bytes(size_t num, unsigned dimension) {
    const double side = count_cells(ps_gaussian_unit(num, dimension));
    const double cells = side * side * (dimension == SPACE ? side : 1);
    return (double)num * (double)((1 + 2 * dimension) * sizeof(double) + sizeof(uint32_t)) +
           cells * (double)sizeof(uint32_t);
}

pspec_status ps_gaussian_sums_create(ps_gaussian_sums *s, size_t num, unsigned dimension,
                                     double sigma, ps_error *error) {
    const double unit = ps_gaussian_unit(num, dimension);
    const double width = sigma * unit;
    const uint32_t cells = count_cells(unit);
    *s = (ps_gaussian_sums){.num = num,
                            .dimension = dimension,
                            .reach = REACH * width,
                            .exponent = -TWO_TO_LOG2E / (2 * width * width),
                            .cells = cells,
                            .stride = num + GAUSSIAN_LANES,
                            .num_cells = (size_t)cells * cells * (dimension == SPACE ? cells : 1)};
    PS_TRY(PS_NEW(&s->begins, s->num_cells + 1, "cells of points", error));
    PS_TRY(PS_NEW(&s->place, num, "cells of points", error));
    PS_TRY(PS_NEW(&s->points, dimension * s->stride, "points by cells", error));
    return PS_NEW(&s->sums, (1 + dimension) * s->stride, "forces on points", error);
}

void ps_gaussian_sums_destroy(ps_gaussian_sums *s) {
    free(s->begins);
    free(s->place);
    free(s->points);
    free(s->sums);
}

static size_t cell_of(const ps_gaussian_sums *s, const double *x) {
    size_t cell = 0;
    for (unsigned axis = s->dimension; axis-- > 0;) {
        const uint32_t at = (uint32_t)(x[axis] * s->cells);
        cell = cell * s->cells + (at < s->cells ? at : s->cells - 1);
    }
    return cell;
}

/* By cells, in their own order within a cell. */
static void sort(ps_gaussian_sums *s, const double *x) {
    memset(s->begins, 0, (s->num_cells + 1) * sizeof *s->begins);
    for (size_t i = 0; i < s->num; i++) {
        s->begins[cell_of(s, x + i * s->dimension) + 1]++;
    }
    for (size_t c = 1; c <= s->num_cells; c++) {
        s->begins[c] += s->begins[c - 1];
    }
    for (size_t i = 0; i < s->num; i++) {
        s->place[i] = s->begins[cell_of(s, x + i * s->dimension)]++;
        for (unsigned axis = 0; axis < s->dimension; axis++) {
            s->points[axis * s->stride + s->place[i]] = x[i * s->dimension + axis];
        }
    }
    for (size_t c = s->num_cells; c > 0; c--) { /* each is now the beginning of the next one */
        s->begins[c] = s->begins[c - 1];
    }
    s->begins[0] = 0;
}

static void sum_points(const ps_gaussian_sums *s, size_t first, size_t end) {
    const gaussian_grid grid = {s->reach, s->exponent, s->num, s->stride, s->dimension, s->cells};
    for (size_t i = first; i < end; i++) {
        real own[GAUSSIAN_SUMS];
        if (s->dimension == PLANE) {
            gaussian_point(&grid, PLANE, s->points, s->begins, i, own);
        } else {
            gaussian_point(&grid, SPACE, s->points, s->begins, i, own);
        }
        for (unsigned k = 0; k < 1 + s->dimension; k++) {
            s->sums[k * s->stride + i] = own[k];
        }
    }
}

/* ---- on a device ----------------------------------------------------------------------------- */

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
    const ps_wanted_buffer wanted[] = {
        {&d->points, shape->dimension * shape->stride * sizeof(double), "points by cells"},
        {&d->begins, (shape->num_cells + 1) * sizeof(uint32_t), "cells of points"},
        {&d->sums, (1 + shape->dimension) * shape->stride * sizeof(double), "forces on points"}};
    return PS_BUFFERS_CREATE(device, wanted, error);
}

void ps_gaussian_device_destroy(ps_gaussian_device *d) {
    PS_BUFFERS_RELEASE(&d->points, &d->begins, &d->sums);
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

/* s->sums of s->points, which are sorted. Rounded up, a launch may make some sums of the next,
 * which are the same. */
static pspec_status sum_on_device(ps_gaussian_device *d, const ps_gaussian_sums *s,
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

/* ---- all ------------------------------------------------------------------------------------- */

/* Every pair was counted twice, and every point with itself. */
static double gather(const ps_gaussian_sums *s, double *force) {
    double sum = 0;
    for (size_t i = 0; i < s->num; i++) {
        sum += s->sums[s->place[i]] - 1;
        for (unsigned axis = 0; axis < s->dimension; axis++) {
            force[i * s->dimension + axis] = s->sums[(1 + axis) * s->stride + s->place[i]];
        }
    }
    return sum / 2;
}

pspec_status ps_gaussian_sums_find(ps_gaussian_sums *s, const double *x, const ps_watch *watch,
                                   double *energy, double *force, ps_error *error) {
    sort(s, x);
    if (s->device != NULL) {
        PS_TRY(sum_on_device(s->device, s, watch, error));
    }
    for (size_t first = 0; first < s->num && s->device == NULL; first += POINTS_AT_A_TIME) {
        const size_t left = s->num - first;
        if (first > 0) {
            PS_TRY(ps_watch_tell(watch, "sampler: gaussian-blue-noise, points of a step", first,
                                 s->num, NULL, error));
        }
        sum_points(s, first, first + (left < POINTS_AT_A_TIME ? left : POINTS_AT_A_TIME));
    }
    *energy = gather(s, force);
    return PSPEC_OK;
}
