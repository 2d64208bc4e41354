#include "rules/kernel/kernel_chords.h"

#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "engines/pairs/pairs_points.h"

#include <stdlib.h>

/* A work-item has so many vectors of pairs, some 10 microseconds of work. */
enum { RUN_VECTORS = 4096, PARTS = 2 };

typedef struct chords {
    ps_device *device;
    ps_precision precision;
    unsigned lanes;
    size_t num_patterns;
    uint64_t num_runs;
    ps_pairs_points points;
    ps_kernel *kernel;
    ps_buffer power, partials;
    void *host_partials;
} chords;

static uint64_t most_points(const ps_batch *batch) {
    uint64_t most = 1;
    for (size_t r = 0; r < batch->num_patterns; r++) {
        most = batch->patterns[r].num_points > most ? batch->patterns[r].num_points : most;
    }
    return most;
}

static pspec_status create_kernel(chords *self, double power, ps_error *error) {
    const double root = 0.5;
    ps_defines defines = ps_defines_of(ps_real_bytes(self->precision), self->lanes);
    ps_defines_add(&defines, "-DROOT=%d", power == root);
    return ps_kernel_get(self->device, &self->kernel, "rules/chords.cl", "kernel_chords",
                         defines.text, error);
}

static double number_at(const chords *self, size_t i) {
    return self->precision == PS_SINGLE ? (double)((const float *)self->host_partials)[i]
                                        : ((const double *)self->host_partials)[i];
}

/* Run after run, lane after lane; each pair counts twice. */
static void add_up(const chords *self, double *sums) {
    const size_t num = self->num_runs * PARTS * self->lanes;
    for (size_t r = 0; r < self->num_patterns; r++) {
        long double sum = 0;
        for (size_t i = 0; i < num; i++) {
            sum += number_at(self, r * num + i);
        }
        sums[r] = (double)(2 * sum);
    }
}

static pspec_status sum_up(chords *self, double power, const ps_batch *batch, double *sums,
                           ps_error *error) {
    const uint64_t num_points = most_points(batch);
    self->num_runs = ps_divide_up(ps_pairs_vectors(num_points, self->lanes) + 1, RUN_VECTORS);
    const size_t row = self->num_runs * PARTS * self->lanes * ps_real_bytes(self->precision);
    const size_t num = batch->num_patterns;
    PS_TRY(ps_pairs_points_create(&self->points, num_points, num, self->precision, self->lanes,
                                  self->device, error));
    PS_TRY(create_kernel(self, power, error));
    PS_TRY(
        ps_reals_upload(self->device, &self->power, self->precision, &power, 1, "a power", error));
    PS_TRY(ps_allocate(&self->host_partials, num, row, "sums of runs of pairs", error));
    PS_TRY(
        ps_buffer_create(self->device, &self->partials, num * row, "sums of runs of pairs", error));
    PS_TRY(ps_pairs_points_upload(&self->points, batch, error));
    const double flops_per_pair = 20;
    const ps_range range = ps_range_heavy(
        self->device, self->num_runs, num, 1,
        flops_per_pair * (double)(self->num_runs * num * self->lanes) * RUN_VECTORS, 0);
    PS_TRY(PS_LAUNCH(self->device, self->kernel, &range, error,
                     PS_BUFFER(self->points.points.filled), PS_BUFFER(self->points.counts),
                     PS_BUFFER(self->power), PS_BUFFER(self->partials), PS_U64(self->points.stride),
                     PS_U64(RUN_VECTORS), PS_U64(self->num_runs)));
    PS_TRY(ps_buffer_read(self->device, &self->partials, 0, self->host_partials, num * row, error));
    add_up(self, sums);
    return PSPEC_OK;
}

pspec_status ps_kernel_chord_sums(ps_device *device, ps_precision precision, double power,
                                  const ps_batch *batch, double *sums, ps_error *error) {
    chords self = {.device = device,
                   .precision = precision,
                   .lanes = ps_engine_lanes(ps_device_get_limits(device), precision),
                   .num_patterns = batch->num_patterns};
    const pspec_status status = sum_up(&self, power, batch, sums, error);
    ps_pairs_points_free(&self.points);
    ps_buffer_release(&self.power);
    ps_buffer_release(&self.partials);
    free(self.host_partials);
    return status;
}
