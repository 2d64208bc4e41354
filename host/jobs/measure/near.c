#include "jobs/measure/near.h"

#include "base/memory.h"
#include "base/round.h"
#include "engines/engine.h"
#include "math/neumaier.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct ps_near {
    ps_device *device;
    ps_kernel *kernel;
    unsigned dimension, lanes;
    bool on_sphere, has_windows;
    size_t room;            /* points that there is memory for */
    ps_buffer given, found; /* as the two arrays that follow */
    double *coordinates;    /* [dimension][capacity], then the first points of cells */
    double *distances;      /* [num], then shares [item][windows][2] and counts of items */
    uint32_t *cells;        /* of each point */
    /* of the set */
    size_t num;
    near_sizes sizes;
    near_lengths lengths;
    double counted[NEAR_BINS], shared[NEAR_WINDOWS];
};

/* ---- lengths ------------------------------------------------------------------------------- */

static double ball_volume(unsigned dimension) { /* of radius 1 */
    return pow(PS_PI, dimension / 2.0) / tgamma(dimension / 2.0 + 1);
}

double ps_near_reach(unsigned dimension, bool on_sphere) {
    const unsigned d = on_sphere ? 2 : dimension; /* of what the points lie on */
    return pow(PS_NEAR_MEAN / ball_volume(d), 1.0 / d);
}

static double unit_of_length(const ps_near *self) {
    const double num = (double)self->num;
    return self->on_sphere ? sqrt(PS_FOUR_PI / num) : pow(num, -1.0 / self->dimension);
}

/* Cells that are no shorter than their part of the reach, and not many more than points. A cell and
 * those about it are all different, or there is one. */
static void choose_cells(ps_near *self) {
    const double rounding = 1e-12; /* an edge is never shorter */
    const unsigned span = NEAR_SPAN(self->dimension);
    const unsigned fewest = 2 * span + 1;
    const double extent = self->on_sphere ? 2 : 1;
    const double reach = ps_near_reach(self->dimension, self->on_sphere) * unit_of_length(self);
    const double most = pow(2 * (double)self->num, 1.0 / self->dimension);
    const double side = floor(fmin(span * extent / reach * (1 - rounding), most));
    self->sizes.num_points = self->num;
    self->sizes.side = side < fewest ? 1 : (uint64_t)side;
    self->lengths = (near_lengths){.first = self->on_sphere ? -1 : 0,
                                   .cells = (double)self->sizes.side / extent,
                                   .bins = NEAR_BINS / reach};
    for (size_t w = 0; w < NEAR_WINDOWS; w++) {
        self->lengths.per_diameter[w] = NEAR_WINDOWS / (reach * (double)(w + 1));
    }
}

/* ---- memory -------------------------------------------------------------------------------- */

static size_t count_items(size_t num) {
    return ps_divide_up(num, NEAR_BLOCK);
}

static size_t most_cells(size_t num) {
    return 2 * num + 1;
}

static size_t find_capacity(const ps_near *self, size_t num) {
    return ps_round_up(num, self->lanes) + self->lanes;
}

static size_t num_shares(const ps_near *self, size_t num) {
    return self->has_windows ? count_items(num) * NEAR_WINDOWS * 2 : 0;
}

/* Doubles of `given`, and of `found`. */
static size_t count_given(const ps_near *self, size_t num) {
    const size_t words = most_cells(num) + 1;
    return self->dimension * find_capacity(self, num) + ps_divide_up(words, 2);
}

static size_t count_found(const ps_near *self, size_t num) {
    return num + num_shares(self, num) + count_items(num) * NEAR_COUNTS / 2;
}

static void release_room(ps_near *self) {
    PS_BUFFERS_RELEASE(&self->given, &self->found);
    free(self->coordinates);
    free(self->distances);
    free(self->cells);
    self->coordinates = self->distances = NULL;
    self->cells = NULL;
    self->room = 0;
}

static pspec_status allocate(ps_near *self, size_t num, ps_error *error) {
    const size_t given = count_given(self, num);
    const size_t found = count_found(self, num);
    PS_TRY(PS_NEW(&self->coordinates, given, "points", error));
    PS_TRY(PS_NEW(&self->cells, num, "cells of points", error));
    PS_TRY(PS_NEW(&self->distances, found, "distances", error));
    const ps_wanted_buffer wanted[] = {{&self->given, given * sizeof(double), "points"},
                                       {&self->found, found * sizeof(double), "distances"}};
    return PS_BUFFERS_CREATE(self->device, wanted, error);
}

static pspec_status make_room(ps_near *self, size_t num, ps_error *error) {
    if (num <= self->room) {
        return PSPEC_OK;
    }
    release_room(self);
    PS_TRY(allocate(self, num, error));
    self->room = num;
    return PSPEC_OK;
}

pspec_status ps_near_create(ps_near **out, unsigned dimension, bool on_sphere, bool with_windows,
                            ps_device *device, ps_error *error) {
    ps_near *self = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&self, 1, "pairs of near points", error));
    self->device = device;
    self->dimension = dimension;
    self->on_sphere = on_sphere;
    self->has_windows = with_windows;
    self->lanes = ps_engine_lanes(ps_device_get_limits(device), PS_DOUBLE);
    ps_defines defines = ps_defines_of(sizeof(double), self->lanes);
    ps_defines_add(&defines, "-DDIMENSION=%u -DPERIODIC=%d", dimension, !on_sphere);
    ps_defines_add(&defines, "-DWINDOWS=%d", self->has_windows ? NEAR_WINDOWS : 0);
    const pspec_status status = ps_kernel_get(device, &self->kernel, "measures/near.cl",
                                              "measure_near", defines.text, error);
    if (status != PSPEC_OK) {
        ps_near_destroy(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

void ps_near_destroy(ps_near *near) {
    if (near != NULL) {
        release_room(near);
    }
    free(near);
}

/* ---- a set --------------------------------------------------------------------------------- */

/* As the kernel finds it. */
static uint32_t cell_of(const ps_near *self, const double *point) {
    const uint32_t side = (uint32_t)self->sizes.side;
    uint32_t cell = 0;
    for (unsigned axis = 0; axis < self->dimension; axis++) {
        const double at = (point[axis] - self->lengths.first) * self->lengths.cells;
        const uint32_t own = at > 0 ? (uint32_t)at : 0;
        cell = cell * side + (own < side ? own : side - 1);
    }
    return cell;
}

/* Counts, then places: a stable sort by cells. */
static void sort_points(ps_near *self, const double *points) {
    const size_t capacity = self->sizes.capacity;
    uint32_t *const firsts = (uint32_t *)(self->coordinates + self->dimension * capacity);
    size_t num_cells = 1;
    for (unsigned axis = 0; axis < self->dimension; axis++) {
        num_cells *= self->sizes.side;
    }
    memset(firsts, 0, (num_cells + 1) * sizeof *firsts);
    for (size_t j = 0; j < self->num; j++) {
        self->cells[j] = cell_of(self, points + j * self->dimension);
        firsts[self->cells[j] + 1]++;
    }
    for (size_t c = 0; c < num_cells; c++) {
        firsts[c + 1] += firsts[c];
    }
    for (size_t j = 0; j < self->num; j++) {
        const size_t at = firsts[self->cells[j]]++;
        for (unsigned axis = 0; axis < self->dimension; axis++) {
            self->coordinates[axis * capacity + at] = points[j * self->dimension + axis];
        }
    }
    memmove(firsts + 1, firsts, num_cells * sizeof *firsts);
    firsts[0] = 0;
}

static pspec_status launch(ps_near *self, ps_error *error) {
    const size_t items = count_items(self->num);
    const double pairs = (double)self->num * PS_NEAR_MEAN;
    const double flops = pairs * (3 * self->dimension + (self->has_windows ? 20.0 : 0));
    const ps_range range = ps_range_heavy(self->device, items, 1, 1, flops, pairs);
    return PS_LAUNCH(self->device, self->kernel, &range, error, PS_STRUCT(self->sizes),
                     PS_STRUCT(self->lengths), PS_BUFFER(self->given), PS_BUFFER(self->found));
}

static void add_items(ps_near *self) {
    const size_t items = count_items(self->num);
    const double *const shares = self->distances + self->num;
    const uint32_t *const counts = (const uint32_t *)(shares + num_shares(self, self->num));
    memset(self->counted, 0, sizeof self->counted);
    for (size_t i = 0; i < items; i++) {
        for (size_t b = 0; b < NEAR_BINS; b++) {
            self->counted[b] += counts[i * NEAR_COUNTS + b]; /* whole numbers below 2^53 */
        }
    }
    for (size_t w = 0; self->has_windows && w < NEAR_WINDOWS; w++) {
        ps_neumaier sum = {0, 0};
        for (size_t i = 0; i < items; i++) {
            const double *const pair = shares + 2 * (i * NEAR_WINDOWS + w);
            ps_neumaier_add(&sum, pair[0]);
            ps_neumaier_add(&sum, pair[1]);
        }
        self->shared[w] = ps_neumaier_value(&sum);
    }
}

/* Of a point that has none in the cells about it: among all. */
static double search(const ps_near *self, size_t i) {
    const size_t capacity = self->sizes.capacity;
    double least = INFINITY;
    for (size_t j = 0; j < self->num; j++) {
        double square = j == i ? INFINITY : 0;
        for (unsigned axis = 0; axis < self->dimension; axis++) {
            const double *const x = self->coordinates + axis * capacity;
            const double apart = x[j] - x[i];
            const double nearest = self->on_sphere ? apart : apart - rint(apart);
            square += nearest * nearest;
        }
        least = fmin(least, square);
    }
    return least;
}

/* What is farther than the reach may have a nearer one beyond those looked at. */
static void finish_distances(ps_near *self) {
    const double reach = NEAR_BINS / self->lengths.bins;
    for (size_t i = 0; i < self->num; i++) {
        double square = self->distances[i];
        square = self->sizes.side > 1 && !(square < reach * reach) ? search(self, i) : square;
        self->distances[i] = sqrt(square);
    }
}

pspec_status ps_near_look(ps_near *near, const double *points, size_t num, ps_error *error) {
    PS_TRY(make_room(near, num, error));
    near->num = num;
    near->sizes.capacity = find_capacity(near, num);
    choose_cells(near);
    sort_points(near, points);
    PS_TRY(ps_buffer_write(near->device, &near->given, 0, near->coordinates,
                           count_given(near, num) * sizeof(double), error));
    PS_TRY(launch(near, error));
    PS_TRY(ps_buffer_read(near->device, &near->found, 0, near->distances,
                          count_found(near, num) * sizeof(double), error));
    add_items(near);
    finish_distances(near);
    return PSPEC_OK;
}

/* ---- what it says -------------------------------------------------------------------------- */

const double *ps_near_distances(const ps_near *near) {
    return near->distances;
}

/* A ball of this radius, in units of the whole; nan: it meets itself. */
static double share_of_ball(const ps_near *self, double radius) {
    const double half = 0.5;
    if (self->on_sphere) {
        return radius > 2 ? (double)NAN : radius * radius / 4;
    }
    return radius > half ? (double)NAN
                         : ball_volume(self->dimension) * pow(radius, self->dimension);
}

double ps_near_correlation(const ps_near *near, size_t bin) {
    const double low = (double)bin / near->lengths.bins;
    const double high = (double)(bin + 1) / near->lengths.bins;
    const double pairs = (double)near->num * ((double)near->num - 1);
    return near->num < 2 ? (double)NAN
                         : near->counted[bin] /
                               (pairs * (share_of_ball(near, high) - share_of_ball(near, low)));
}

/* <n^2> = sum_ij |B(x_i) intersected with B(x_j)| over all centres, <n> = N |B|. */
double ps_near_number_variance(const ps_near *near, size_t window, bool over_mean) {
    const double diameter = 1 / near->lengths.per_diameter[window];
    const double num = (double)near->num;
    if (!near->has_windows || isnan(share_of_ball(near, diameter))) {
        return NAN;
    }
    const double volume = share_of_ball(near, diameter / 2);
    const double over = 2 * near->shared[window] / num + 1 - num * volume;
    return over_mean ? over : num * volume * over;
}
