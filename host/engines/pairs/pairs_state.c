#include "engines/pairs/pairs_state.h"

#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "engines/error_units.h"

#include <math.h>
#include <stdlib.h>

/* Two blocks of kernels/pairs/walk.h. */
enum { DEGREES = 16 };

static uint64_t points_of(const ps_problem *problem) {
    return problem->num_points > 0 ? problem->num_points : 1;
}

ps_pairs_layout ps_pairs_layout_of(const ps_problem *problem, const ps_device_limits *limits,
                                   ps_precision precision) {
    const double real_bytes = (double)ps_real_bytes(precision);
    ps_pairs_layout out = {.lanes = ps_engine_lanes(limits, precision),
                           .num_degrees =
                               ps_round_up((uint64_t)problem->frequencies->max_frequency, DEGREES)};
    out.stride = ps_pairs_stride(points_of(problem), out.lanes);
    out.row_bytes = (double)(PS_PAIRS_PARTS * out.num_degrees) * real_bytes;
    out.points_bytes = (double)(PS_PAIRS_ARRAYS * out.stride) * real_bytes;
    return out;
}

void ps_pairs_layout_cut(ps_pairs_layout *layout, const ps_problem *problem, uint64_t run_vectors,
                         double run_bytes, double slab_bytes) {
    const uint64_t num_vectors = ps_pairs_vectors(points_of(problem), layout->lanes);
    const double fit = slab_bytes / run_bytes;
    layout->run_vectors = run_vectors;
    layout->num_runs = num_vectors > 0 ? ps_divide_up(num_vectors, run_vectors) : 1;
    layout->slab = fit < (double)layout->num_runs ? (size_t)fmax(fit, 1) : (size_t)layout->num_runs;
}

double ps_pairs_rounding(const ps_pairs_error_law *law, const ps_problem *problem,
                         double mean_power) {
    const double degree = problem->frequencies->max_frequency;
    const double share = fmin(1, fabs(mean_power) * ps_weight_share(problem));
    return hypot(law->begin, law->step * sqrt(degree)) + law->drift * degree * share;
}

ps_defines ps_pairs_defines(const ps_pairs_state *self) {
    ps_defines defines = ps_defines_of(ps_real_bytes(self->precision), self->layout.lanes);
    ps_defines_add(&defines, "-DCHUNK=%d -DRUN=%d -DONLY_EVEN=%d", PS_PAIRS_CHUNK,
                   PS_PAIRS_RUN_CHUNKS, self->problem.frequencies->degree_step == 2);
    return defines;
}

/* 1 / l for l = 1 .. num_degrees. */
static pspec_status upload_inverses(ps_pairs_state *self, ps_error *error) {
    const size_t num = self->layout.num_degrees;
    double *inverses = NULL;
    PS_TRY(PS_NEW(&inverses, num, "reciprocals of degrees", error));
    for (size_t l = 1; l <= num; l++) {
        inverses[l - 1] = 1 / (double)l;
    }
    const pspec_status status = ps_reals_upload(self->device, &self->inverses, self->precision,
                                                inverses, num, "reciprocals of degrees", error);
    free(inverses);
    return status;
}

static void make_row(const void *engine, const void *sums, double scale, double square,
                     double *row) {
    const ps_pairs_state *self = engine;
    const ps_frequencies *set = self->problem.frequencies;
    for (size_t i = 0; i < set->num; i++) {
        const size_t high = (size_t)set->vectors[i] - 1;
        const double sum = ps_real_at(self->precision, sums, high) +
                           ps_real_at(self->precision, sums, high + self->layout.num_degrees);
        row[i] = (square + 2 * sum) * scale;
    }
}

static pspec_status create_points(ps_pairs_state *self, size_t batch, ps_error *error) {
    size_t num = 0;
    if (!ps_size_multiply(batch, PS_PAIRS_ARRAYS * self->layout.stride, &num)) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "%zu realizations of %zu points are too many",
                       batch, self->layout.stride);
    }
    PS_TRY(PS_NEW(&self->host_counts, batch, "numbers of points", error));
    PS_TRY(PS_NEW(&self->squares, batch, "sums of weights", error));
    PS_TRY(
        ps_feed_create(&self->points, num * ps_real_bytes(self->precision), self->device, error));
    return ps_buffer_create(self->device, &self->counts, batch * sizeof(uint64_t),
                            "numbers of points", error);
}

pspec_status ps_pairs_create(ps_pairs_state *self, const char *program, const ps_problem *problem,
                             ps_precision precision, const ps_pairs_layout *layout, size_t batch,
                             ps_device *device, ps_error *error) {
    const size_t row_bytes = (size_t)layout->row_bytes;
    *self = (ps_pairs_state){
        .device = device, .problem = *problem, .precision = precision, .layout = *layout};
    PS_TRY(create_points(self, batch, error));
    PS_TRY(ps_kernel_get(device, &self->fold, program, "pairs_fold", ps_pairs_defines(self).text,
                         error));
    PS_TRY(upload_inverses(self, error));
    self->rows = (ps_late_rows){.engine = self,
                                .make = make_row,
                                .num = problem->frequencies->num,
                                .batch = batch,
                                .most = batch,
                                .sum_bytes = row_bytes};
    PS_TRY(ps_late_rows_create(&self->rows, device, error));
    return ps_buffer_create(device, &self->sums, batch * row_bytes, "sums of pairs", error);
}

void ps_pairs_free(void *state) {
    ps_pairs_state *const self = state;
    ps_feed_free(&self->points);
    ps_late_rows_free(&self->rows);
    PS_BUFFERS_RELEASE(&self->counts, &self->partials, &self->inverses, &self->sums);
    free(self->host_counts);
    free(self->squares);
}

/* Runs of the largest pattern; at least 1. */
static uint64_t count_runs(const ps_pairs_state *self, const ps_batch *batch) {
    uint64_t most = 0;
    for (size_t r = 0; r < batch->num_patterns; r++) {
        const uint64_t vectors =
            ps_pairs_vectors(batch->patterns[r].num_points, self->layout.lanes);
        most = vectors > most ? vectors : most;
    }
    return most > 0 ? ps_divide_up(most, self->layout.run_vectors) : 1;
}

pspec_status ps_pairs_run(ps_pairs_state *self, const ps_batch *batch, ps_pairs_add *add_slab,
                          ps_error *error) {
    const uint64_t num_runs = count_runs(self, batch);
    const size_t slab = self->layout.slab;
    PS_TRY(ps_pairs_upload(self, batch, error));
    for (uint64_t first = 0; first < num_runs; first += slab) {
        const uint64_t rest = num_runs - first;
        PS_TRY(first == 0 ? ps_batch_go_on(batch, error)
                          : ps_batch_go_on_after(batch, self->device, error));
        PS_TRY(
            add_slab(self, batch->num_patterns, first, rest < slab ? (size_t)rest : slab, error));
    }
    return PSPEC_OK;
}

pspec_status ps_pairs_fold(ps_pairs_state *self, const ps_buffer *partials, size_t num_patterns,
                           size_t num_runs, bool is_first, ps_error *error) {
    const double flops_per_degree = 8;
    const double rows = (double)(num_runs * num_patterns);
    const ps_range range = ps_range_heavy(
        self->device, self->layout.num_degrees / self->layout.lanes, num_patterns, 1,
        flops_per_degree * rows * (double)self->layout.num_degrees, rows * self->layout.row_bytes);
    return PS_LAUNCH(self->device, self->fold, &range, error, PS_BUFFER(*partials),
                     PS_BUFFER(self->sums), PS_U64(num_runs), PS_U32(self->layout.num_degrees),
                     PS_U32(PS_PAIRS_PARTS), PS_U32(is_first));
}

pspec_status ps_pairs_read(ps_pairs_state *self, const ps_batch *batch, ps_rows *rows,
                           ps_error *error) {
    PS_TRY(ps_late_rows_read(&self->rows, &self->sums, 0, batch->num_patterns, batch->scales,
                             self->squares, error));
    *rows = ps_late_rows_give(&self->rows, batch->num_patterns);
    return PSPEC_OK;
}
