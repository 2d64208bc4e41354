#include "engines/pairs/pairs_degrees.h"

#include "base/memory.h"
#include "base/round.h"
#include "base/workers.h"
#include "device/reals.h"

#include <math.h>
#include <stdlib.h>

enum { LOW = 3, WEIGHT = 6, OWN_WEIGHT = 7 };

size_t ps_pairs_stride(uint64_t num_points, unsigned lanes) {
    return ps_round_up(num_points, lanes) + ps_round_up(num_points / 2, lanes);
}

uint64_t ps_pairs_vectors(uint64_t num_points, unsigned lanes) {
    return num_points / 2 * ps_divide_up(num_points, lanes);
}

uint64_t ps_pairs_count_runs(const ps_batch *batch, unsigned lanes, uint64_t run_vectors) {
    uint64_t most = 0;
    for (size_t r = 0; r < batch->num_patterns; r++) {
        const uint64_t vectors = ps_pairs_vectors(batch->patterns[r].num_points, lanes);
        most = vectors > most ? vectors : most;
    }
    return most > 0 ? ps_divide_up(most, run_vectors) : 1;
}

static pspec_status allocate(ps_pairs_points *self, ps_error *error) {
    size_t num = 0;
    if (!ps_size_multiply(self->batch, PS_PAIRS_ARRAYS * self->stride, &num)) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "%zu realizations of %zu points are too many",
                       self->batch, self->stride);
    }
    PS_TRY(PS_NEW(&self->host_counts, self->batch, "numbers of points", error));
    PS_TRY(PS_NEW(&self->squares, self->batch, "sums of weights", error));
    PS_TRY(ps_feed_create(&self->points, num * ps_real_bytes(self->precision), "points",
                          self->device, error));
    return ps_buffer_create(self->device, &self->counts, self->batch * sizeof(uint64_t),
                            "numbers of points", error);
}

pspec_status ps_pairs_points_create(ps_pairs_points *out, uint64_t num_points, size_t batch,
                                    ps_precision precision, unsigned lanes, ps_device *device,
                                    ps_error *error) {
    *out = (ps_pairs_points){.device = device,
                             .precision = precision,
                             .lanes = lanes,
                             .stride = ps_pairs_stride(num_points, lanes),
                             .batch = batch};
    return allocate(out, error);
}

void ps_pairs_points_free(ps_pairs_points *self) {
    free(self->host_counts);
    free(self->squares);
    ps_feed_free(&self->points);
    ps_buffer_release(&self->counts);
    *self = (ps_pairs_points){0};
}

/* What is filled. */
typedef struct task {
    ps_pairs_points *points;
    const ps_batch *batch;
    void *out;
} task;

static void put(const task *shared, size_t at, double value) {
    if (shared->points->precision == PS_SINGLE) {
        ((float *)shared->out)[at] = (float)value;
    } else {
        ((double *)shared->out)[at] = value;
    }
}

/* A number as working precision has it, and what that leaves. */
static void put_parts(const task *shared, size_t at, long double value) {
    const ps_pairs_points *self = shared->points;
    const double high = self->precision == PS_SINGLE ? (double)(float)value : (double)value;
    put(shared, at, high);
    put(shared, at + LOW * self->stride, (double)(value - high));
}

/* Point j of a pattern to place `at` of its arrays. */
static void put_point(const task *shared, size_t first, size_t at, const pspec_pattern *pattern,
                      size_t j, int exponent) {
    const size_t stride = shared->points->stride;
    const double *u = pattern->points + j * PS_SPHERE_DIMENSION;
    const long double x = u[0], y = u[1], z = u[2];
    const long double length = sqrtl(x * x + y * y + z * z);
    const double weight = ldexp(pattern->weights != NULL ? pattern->weights[j] : 1, -exponent);
    put_parts(shared, first + at, x / length);
    put_parts(shared, first + stride + at, y / length);
    put_parts(shared, first + 2 * stride + at, z / length);
    put(shared, first + WEIGHT * stride + at, weight);
    put(shared, first + OWN_WEIGHT * stride + at, at < pattern->num_points ? weight : 0);
}

static void count_weights(ps_pairs_points *self, size_t r, const pspec_pattern *pattern,
                          int exponent) {
    long double squares = 0;
    for (size_t j = 0; j < pattern->num_points; j++) {
        const long double weight =
            ldexpl(pattern->weights != NULL ? pattern->weights[j] : 1, -exponent);
        squares += weight * weight;
    }
    self->squares[r] = (double)squares;
}

/* The points of some realizations, which go on with the first ones again. */
static void put_some(void *payload, unsigned index, unsigned count) {
    const task *shared = payload;
    ps_pairs_points *self = shared->points;
    for (size_t r = index; r < shared->batch->num_patterns; r += count) {
        const pspec_pattern *pattern = &shared->batch->patterns[r];
        const int exponent = shared->batch->exponents != NULL ? shared->batch->exponents[r] : 0;
        const size_t first = r * PS_PAIRS_ARRAYS * self->stride;
        const size_t num = ps_pairs_stride(pattern->num_points, self->lanes);
        for (size_t at = 0; at < num; at++) {
            put_point(shared, first, at, pattern, at % pattern->num_points, exponent);
        }
        self->host_counts[r] = pattern->num_points;
        count_weights(self, r, pattern, exponent);
    }
}

pspec_status ps_pairs_points_upload(ps_pairs_points *self, const ps_batch *batch, ps_error *error) {
    const size_t bytes =
        batch->num_patterns * PS_PAIRS_ARRAYS * self->stride * ps_real_bytes(self->precision);
    task shared = {self, batch, NULL};
    PS_TRY(ps_feed_begin(&self->points, &shared.out, error));
    ps_workers_share(batch->num_patterns * self->stride, put_some, &shared);
    PS_TRY(ps_feed_end(&self->points, bytes, error));
    return ps_buffer_write(self->device, &self->counts, 0, self->host_counts,
                           batch->num_patterns * sizeof(uint64_t), error);
}
