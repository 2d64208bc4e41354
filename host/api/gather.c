#include "api/gather.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* Enough for thousands of patterns of a thousand points. Where a batch needs more, a single pattern
 * is so large that the engine has work enough with fewer. */
enum { MOST_BYTES = 64 << 20 };

struct ps_gather {
    ps_gather_options options;
    size_t batch;           /* patterns at most */
    size_t num;             /* pending */
    pspec_pattern *pending; /* [batch], pointing into numbers */
    ps_pattern_sums *sums;  /* [batch] */
    double *numbers;        /* [capacity] coordinates and weights */
    size_t capacity, used;
};

/* Numbers for a batch of patterns with weights, within bounds. */
static size_t find_capacity(const ps_gather_options *options, size_t batch) {
    const size_t most = MOST_BYTES / sizeof(double);
    const size_t columns = options->dimension + 1;
    size_t numbers = 0;
    return ps_size_multiply(options->num_points, batch * columns, &numbers) && numbers < most
               ? numbers
               : most;
}

static pspec_status allocate(ps_gather *self, ps_error *error) {
    PS_TRY(PS_NEW(&self->pending, self->batch, "pending patterns", error));
    PS_TRY(PS_NEW(&self->sums, self->batch, "pending patterns", error));
    PS_TRY(PS_NEW(&self->numbers, self->capacity, "pending patterns", error));
    return PSPEC_OK;
}

pspec_status ps_gather_create(ps_gather **out, const ps_gather_options *options, ps_error *error) {
    *out = NULL;
    ps_gather *self = NULL;
    PS_TRY(PS_NEW(&self, 1, "pending patterns", error));
    self->options = *options;
    self->batch = ps_estimator_batch(options->estimator);
    self->capacity = find_capacity(options, self->batch);
    const pspec_status status = allocate(self, error);
    if (status != PSPEC_OK) {
        ps_gather_destroy(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

void ps_gather_destroy(ps_gather *gather) {
    if (gather != NULL) {
        free(gather->pending);
        free(gather->sums);
        free(gather->numbers);
        free(gather);
    }
}

/* sums NULL: not checked yet */
static pspec_status run(ps_gather *self, const pspec_pattern *patterns, const ps_pattern_sums *sums,
                        size_t num_patterns, ps_error *error) {
    const ps_gather_options *options = &self->options;
    PS_TRY(ps_estimator_add(options->estimator, patterns, sums, num_patterns, error));
    return options->after_batch != NULL ? options->after_batch(options->payload, error) : PSPEC_OK;
}

pspec_status ps_gather_flush(ps_gather *gather, ps_error *error) {
    if (gather->num == 0) {
        return PSPEC_OK;
    }
    PS_TRY(run(gather, gather->pending, gather->sums, gather->num, error));
    ps_gather_reset(gather);
    return PSPEC_OK;
}

void ps_gather_reset(ps_gather *gather) {
    gather->num = 0;
    gather->used = 0;
}

static const double *copy_numbers(ps_gather *self, const double *numbers, size_t count) {
    double *copy = self->numbers + self->used;
    memcpy(copy, numbers, count * sizeof(double));
    self->used += count;
    return copy;
}

/* Checks one pattern and keeps a copy; one that is larger than all the room runs by itself. */
static pspec_status add_one(ps_gather *self, const pspec_pattern *pattern, ps_error *error) {
    const ps_gather_options *options = &self->options;
    const uint64_t number = ps_estimator_num_realizations(options->estimator) + self->num;
    ps_pattern_sums sums = {0};
    PS_TRY(ps_estimator_check(options->estimator, pattern, number, &sums, error));
    const size_t coordinates = pattern->num_points * pattern->dimension;
    const size_t needed = coordinates + (pattern->weights != NULL ? pattern->num_points : 0);
    if (needed > self->capacity - self->used) {
        PS_TRY(ps_gather_flush(self, error));
    }
    if (needed > self->capacity) {
        return run(self, pattern, &sums, 1, error);
    }
    pspec_pattern *kept = &self->pending[self->num];
    *kept = *pattern;
    kept->points = copy_numbers(self, pattern->points, coordinates);
    if (pattern->weights != NULL) {
        kept->weights = copy_numbers(self, pattern->weights, pattern->num_points);
    }
    self->sums[self->num] = sums;
    self->num++;
    return self->num == self->batch ? ps_gather_flush(self, error) : PSPEC_OK;
}

pspec_status ps_gather_add(ps_gather *gather, const pspec_pattern *patterns, size_t num_patterns,
                           ps_error *error) {
    for (size_t i = 0; i < num_patterns;) {
        if (gather->num == 0 && num_patterns - i >= gather->batch) {
            PS_TRY(run(gather, patterns + i, NULL, gather->batch, error));
            i += gather->batch;
        } else {
            PS_TRY(add_one(gather, &patterns[i], error));
            i++;
        }
    }
    return PSPEC_OK;
}
