#include "engines/pairs/pairs_degrees.h"

#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "engines/error_units.h"

#include <math.h>
#include <stdlib.h>

/* Two blocks of kernels/pairs/walk.h. */
enum { DEGREES = 16 };

size_t ps_pairs_num_degrees(int32_t max_degree) {
    return ps_round_up((uint64_t)max_degree, DEGREES);
}

ps_defines ps_pairs_defines(const ps_problem *problem, ps_precision precision, unsigned lanes) {
    ps_defines defines = ps_defines_of(ps_real_bytes(precision), lanes);
    ps_defines_add(&defines, "-DCHUNK=%d -DRUN=%d -DONLY_EVEN=%d", PS_PAIRS_CHUNK,
                   PS_PAIRS_RUN_CHUNKS, problem->frequencies->degree_step == 2);
    return defines;
}

double ps_pairs_rounding(const ps_pairs_error_law *law, const ps_problem *problem,
                         double mean_power) {
    const double degree = problem->frequencies->max_frequency;
    const double share = fmin(1, fabs(mean_power) * ps_weight_share(problem));
    return hypot(law->begin, law->step * sqrt(degree)) + law->drift * degree * share;
}

static pspec_status create_fold(ps_pairs_degrees *self, const ps_problem *problem,
                                ps_error *error) {
    const ps_defines defines = ps_pairs_defines(problem, self->precision, self->lanes);
    return ps_kernel_get(self->device, &self->fold, "pairs/fold.cl", "pairs_fold", defines.text,
                         error);
}

/* 1 / l for l = 1 .. num_degrees. */
static pspec_status upload_inverses(ps_pairs_degrees *self, ps_error *error) {
    const size_t num = self->num_degrees;
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
    const ps_pairs_degrees *self = engine;
    const ps_frequencies *set = self->frequencies;
    for (size_t i = 0; i < set->num; i++) {
        const size_t high = (size_t)set->vectors[i] - 1;
        const double sum = ps_real_at(self->precision, sums, high) +
                           ps_real_at(self->precision, sums, high + self->num_degrees);
        row[i] = (square + 2 * sum) * scale;
    }
}

pspec_status ps_pairs_degrees_create(ps_pairs_degrees *out, const ps_problem *problem,
                                     ps_precision precision, unsigned lanes, size_t batch,
                                     ps_device *device, ps_error *error) {
    const size_t num_degrees = ps_pairs_num_degrees(problem->frequencies->max_frequency);
    *out = (ps_pairs_degrees){.device = device,
                              .frequencies = problem->frequencies,
                              .precision = precision,
                              .lanes = lanes,
                              .num_degrees = num_degrees,
                              .row_bytes = PS_PAIRS_PARTS * num_degrees * ps_real_bytes(precision)};
    PS_TRY(create_fold(out, problem, error));
    PS_TRY(upload_inverses(out, error));
    out->rows = (ps_late_rows){.engine = out,
                               .make = make_row,
                               .num = problem->frequencies->num,
                               .batch = batch,
                               .most = batch,
                               .sum_bytes = out->row_bytes};
    PS_TRY(ps_late_rows_create(&out->rows, device, error));
    return ps_buffer_create(device, &out->sums, batch * out->row_bytes, "sums of pairs", error);
}

void ps_pairs_degrees_free(ps_pairs_degrees *self) {
    ps_late_rows_free(&self->rows);
    ps_buffer_release(&self->inverses);
    ps_buffer_release(&self->sums);
    *self = (ps_pairs_degrees){0};
}

pspec_status ps_pairs_degrees_fold(ps_pairs_degrees *self, const ps_buffer *partials,
                                   size_t num_patterns, size_t num_runs, bool is_first,
                                   ps_error *error) {
    const double flops_per_degree = 8;
    const double rows = (double)(num_runs * num_patterns);
    const ps_range range = ps_range_heavy(
        self->device, self->num_degrees / self->lanes, num_patterns, 1,
        flops_per_degree * rows * (double)self->num_degrees, rows * (double)self->row_bytes);
    return PS_LAUNCH(self->device, self->fold, &range, error, PS_BUFFER(*partials),
                     PS_BUFFER(self->sums), PS_U64(num_runs), PS_U32(self->num_degrees),
                     PS_U32(is_first));
}

pspec_status ps_pairs_degrees_read(ps_pairs_degrees *self, const ps_pairs_points *points,
                                   const ps_batch *batch, ps_rows *rows, ps_error *error) {
    PS_TRY(ps_late_rows_read(&self->rows, &self->sums, 0, batch->num_patterns, batch->scales,
                             points->squares, error));
    *rows = ps_late_rows_give(&self->rows, batch->num_patterns);
    return PSPEC_OK;
}
