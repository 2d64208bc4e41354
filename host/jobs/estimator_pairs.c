#include "jobs/estimator_private.h"

#include "base/memory.h"
#include "base/workers.h"
#include "engines/pairs/pairs_zonal.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Threads that take part have working memory each. */
enum { MOST_THREADS = 16 };

pspec_status ps_pair_sums_create(ps_pair_sums *out, const ps_frequencies *frequencies, size_t batch,
                                 uint64_t expected, ps_pair_observer observer, ps_error *error) {
    const size_t degrees = (size_t)frequencies->max_frequency + 1;
    *out = (ps_pair_sums){.frequencies = frequencies, .batch = batch, .observer = observer};
    PS_TRY(PS_NEW(&out->scales, batch, "scales", error));
    PS_TRY(ps_allocate_for(&out->zonal, batch, degrees * sizeof(double), "zonal sums", error));
    PS_TRY(ps_allocate_for(&out->c2, degrees, 2 * sizeof(double), "C_l^2", error));
    PS_TRY(ps_allocate(&out->scratch, batch < MOST_THREADS ? batch : MOST_THREADS,
                       ps_zonal_scratch(frequencies->max_frequency) * sizeof(double), "zonal sums",
                       error));
    return ps_running_sums_create(&out->sums, frequencies->num, expected, false, error);
}

void ps_pair_sums_free(ps_pair_sums *self) {
    free(self->scales);
    free(self->zonal);
    free(self->c2);
    free(self->scratch);
    ps_running_sums_free(&self->sums);
    *self = (ps_pair_sums){0};
}

void ps_pair_sums_reset(ps_pair_sums *self) {
    self->sums.count = 0;
}

typedef struct task {
    ps_pair_sums *self;
    const ps_batch *batch;
} task;

/* Realizations in turns. A thread beyond those that have memory does nothing, and the others its
 * share. */
static void sum_some(void *payload, unsigned index, unsigned count) {
    const task *shared = payload;
    ps_pair_sums *self = shared->self;
    const int32_t last = self->frequencies->max_frequency;
    const unsigned most = self->batch < MOST_THREADS ? (unsigned)self->batch : MOST_THREADS;
    const unsigned threads = count < most ? count : most;
    if (index >= threads) {
        return;
    }
    double *scratch = (double *)self->scratch + index * ps_zonal_scratch(last);
    for (size_t r = index; r < shared->batch->num_patterns; r += threads) {
        const int exponent = shared->batch->exponents != NULL ? shared->batch->exponents[r] : 0;
        ps_zonal_sums(&shared->batch->patterns[r], exponent, last, scratch,
                      self->zonal + r * ((size_t)last + 1));
    }
}

/* C_l^2 of realization r of the batch, whose powers are row. */
static void find_c2(ps_pair_sums *self, const double *row, const uint32_t *slots,
                    const double *zonal, double scale) {
    const ps_frequencies *set = self->frequencies;
    for (size_t i = 0; i < set->num; i++) {
        const size_t l = (size_t)set->vectors[i];
        const double rest = row[slots[i]] - zonal[l] * zonal[l] * scale;
        self->c2[l] = (2 * (double)l + 1) / PS_FOUR_PI * rest;
    }
}

static void tell_observer(ps_pair_sums *self, const double *zonal, double scale) {
    const size_t degrees = (size_t)self->frequencies->max_frequency + 1;
    const double unit = sqrt(scale); /* a power of two where there are weights */
    double *const scaled = self->c2 + degrees;
    for (size_t l = 0; l < degrees; l++) {
        scaled[l] = unit * zonal[l];
    }
    self->observer.tell(self->observer.payload, scaled, self->c2);
}

void ps_pair_sums_begin(ps_pair_sums *self, const ps_batch *batch) {
    const size_t degrees = (size_t)self->frequencies->max_frequency + 1;
    size_t work = 0;
    task all = {self, batch};
    memcpy(self->scales, batch->scales, batch->num_patterns * sizeof *self->scales);
    for (size_t r = 0; r < batch->num_patterns; r++) {
        work += batch->patterns[r].num_points * degrees;
    }
    ps_workers_share(work, sum_some, &all);
}

void ps_pair_sums_add(ps_pair_sums *self, const ps_rows *rows, const uint32_t *slots) {
    const ps_frequencies *set = self->frequencies;
    const size_t degrees = (size_t)set->max_frequency + 1;
    for (size_t r = 0; r < rows->num_rows; r++) {
        const double *const zonal = self->zonal + r * degrees;
        find_c2(self, rows->host + r * rows->stride, slots, zonal, self->scales[r]);
        ps_running_sums_add(&self->sums, self->c2, (const uint32_t *)set->vectors);
        if (self->observer.tell != NULL) {
            tell_observer(self, zonal, self->scales[r]);
        }
    }
}

void ps_pair_sums_finish(const ps_pair_sums *self, ps_mean *means) {
    for (size_t i = 0; i < self->frequencies->num; i++) {
        const ps_sums sums = ps_running_sums_get(&self->sums, i);
        ps_sums_finish(&sums, self->sums.count, &means[i].mean, &means[i].standard_error);
    }
}
