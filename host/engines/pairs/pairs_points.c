#include "engines/pairs/pairs_state.h"

#include "base/round.h"
#include "base/workers.h"
#include "device/reals.h"

#include <math.h>

enum { LOW = 3, WEIGHT = 6, OWN_WEIGHT = 7 };

size_t ps_pairs_stride(uint64_t num_points, unsigned lanes) {
    return ps_round_up(num_points, lanes) + ps_round_up(num_points / 2, lanes);
}

uint64_t ps_pairs_vectors(uint64_t num_points, unsigned lanes) {
    return num_points / 2 * ps_divide_up(num_points, lanes);
}

/* What is filled. */
typedef struct task {
    ps_pairs_state *pairs;
    const ps_batch *batch;
    void *out;
} task;

static void put(const task *shared, size_t at, double value) {
    if (shared->pairs->precision == PS_SINGLE) {
        ((float *)shared->out)[at] = (float)value;
    } else {
        ((double *)shared->out)[at] = value;
    }
}

/* A number as working precision has it, and what that leaves. */
static void put_parts(const task *shared, size_t at, long double value) {
    const ps_pairs_state *self = shared->pairs;
    const double high = self->precision == PS_SINGLE ? (double)(float)value : (double)value;
    put(shared, at, high);
    put(shared, at + LOW * self->layout.stride, (double)(value - high));
}

/* Point j of a pattern to place `at` of its arrays. */
static void put_point(const task *shared, size_t first, size_t at, const pspec_pattern *pattern,
                      size_t j, int exponent) {
    const size_t stride = shared->pairs->layout.stride;
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

static void count_weights(ps_pairs_state *self, size_t r, const pspec_pattern *pattern,
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
    ps_pairs_state *self = shared->pairs;
    for (size_t r = index; r < shared->batch->num_patterns; r += count) {
        const pspec_pattern *pattern = &shared->batch->patterns[r];
        const int exponent = shared->batch->exponents != NULL ? shared->batch->exponents[r] : 0;
        const size_t first = r * PS_PAIRS_ARRAYS * self->layout.stride;
        const size_t num = ps_pairs_stride(pattern->num_points, self->layout.lanes);
        for (size_t at = 0; at < num; at++) {
            put_point(shared, first, at, pattern, at % pattern->num_points, exponent);
        }
        self->host_counts[r] = pattern->num_points;
        count_weights(self, r, pattern, exponent);
    }
}

pspec_status ps_pairs_upload(ps_pairs_state *self, const ps_batch *batch, ps_error *error) {
    const size_t bytes = batch->num_patterns * PS_PAIRS_ARRAYS * self->layout.stride *
                         ps_real_bytes(self->precision);
    task shared = {self, batch, NULL};
    PS_TRY(ps_feed_begin(&self->points, &shared.out, error));
    ps_workers_share(batch->num_patterns * self->layout.stride, put_some, &shared);
    PS_TRY(ps_feed_end(&self->points, bytes, error));
    return ps_buffer_write(self->device, &self->counts, 0, self->host_counts,
                           batch->num_patterns * sizeof(uint64_t), error);
}
