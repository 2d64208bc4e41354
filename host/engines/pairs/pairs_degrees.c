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
    PS_TRY(ps_allocate(&out->host_sums, batch, out->row_bytes, "sums of pairs", error));
    PS_TRY(PS_NEW(&out->power, batch * problem->frequencies->num, "the powers of a batch", error));
    return ps_buffer_create(device, &out->sums, batch * out->row_bytes, "sums of pairs", error);
}

void ps_pairs_degrees_free(ps_pairs_degrees *self) {
    free(self->power);
    free(self->host_sums);
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

static double sum_at(const ps_pairs_degrees *self, size_t realization, int32_t degree) {
    const size_t high = PS_PAIRS_PARTS * self->num_degrees * realization + (size_t)degree - 1;
    const size_t low = high + self->num_degrees;
    if (self->precision == PS_SINGLE) {
        const float *sums = self->host_sums;
        return (double)sums[high] + sums[low];
    }
    const double *sums = self->host_sums;
    return sums[high] + sums[low];
}

pspec_status ps_pairs_degrees_read(ps_pairs_degrees *self, const ps_pairs_points *points,
                                   const ps_batch *batch, ps_rows *rows, ps_error *error) {
    const ps_frequencies *set = self->frequencies;
    PS_TRY(ps_buffer_read(self->device, &self->sums, 0, self->host_sums,
                          batch->num_patterns * self->row_bytes, error));
    for (size_t r = 0; r < batch->num_patterns; r++) {
        for (size_t i = 0; i < set->num; i++) {
            const double sum = sum_at(self, r, set->vectors[i]);
            self->power[r * set->num + i] = (points->squares[r] + 2 * sum) * batch->scales[r];
        }
    }
    *rows = (ps_rows){.num_rows = batch->num_patterns,
                      .stride = set->num,
                      .precision = PS_DOUBLE,
                      .host = self->power};
    return PSPEC_OK;
}
