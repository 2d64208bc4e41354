#include "jobs/variance/measurement.h"

#include "base/memory.h"
#include "base/round.h"
#include "math/random/rotation.h"
#include "spectra/sums.h"
#include "trials/trials.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Points of a batch together: some megabytes, which keep a device busy and caches warm. Values of
 * one call: half a second of a processor, after which somebody may stop the work. */
enum { BATCH_POINTS = 1 << 18, BATCH_TRIALS = 1 << 18, MOST_BATCH = 256, CALL_VALUES = 1 << 24 };

typedef struct measurement {
    const ps_measurement_plan *plan;
    size_t batch; /* sets at a time; 1 where the shifts of one are several calls */
    size_t trials_of_call, num_calls;
    ps_source *source;
    ps_point_set *sets;      /* [batch] */
    pspec_pattern *patterns; /* [batch] */
    ps_trials **trials;      /* [num_integrands] */
    double *moves;           /* [batch][num_calls][trials_of_call][numbers of a move] */
    double *estimates;       /* [batch][num_calls][trials_of_call] */
    uint64_t seed;           /* of moves */
    ps_sums *sums;           /* [num_integrands] of the means of squares of a set */
} measurement;

/* ---- room ---------------------------------------------------------------------------------- */

static size_t move_numbers(const measurement *self) {
    return ps_trials_move_numbers(self->plan->integrands[0]);
}

static size_t least(size_t a, size_t b) {
    return a < b ? a : b;
}

static size_t divide(size_t a, size_t b) { /* at least 1 */
    return a > b ? a / b : 1;
}

static void choose_sizes(measurement *self) {
    const ps_measurement_plan *const plan = self->plan;
    const size_t points = ps_sampler_most_points(plan->sampler);
    const size_t num_shifts = (size_t)plan->num_shifts;
    self->trials_of_call = least(num_shifts, divide(CALL_VALUES, points));
    self->num_calls = ps_divide_up(num_shifts, self->trials_of_call);
    const size_t fit = least(divide(BATCH_POINTS, points), divide(BATCH_TRIALS, num_shifts));
    const size_t quick = divide(CALL_VALUES, points * self->trials_of_call);
    const size_t most = self->num_calls > 1 ? 1 : least(least(fit, quick), MOST_BATCH);
    self->batch = plan->num_sets < most ? (size_t)plan->num_sets : most;
}

static ps_precision choose_precision(const ps_device *device) {
    return device != NULL && ps_device_get_limits(device)->has_fp64 ? PS_DOUBLE : PS_SINGLE;
}

static pspec_status create_trials(measurement *self, ps_error *error) {
    const ps_measurement_plan *const plan = self->plan;
    const ps_trials_options options = {.precision = choose_precision(plan->device),
                                       .batch = self->batch,
                                       .most_points = ps_sampler_most_points(plan->sampler),
                                       .num_trials = self->trials_of_call};
    PS_TRY(PS_NEW(&self->trials, plan->num_integrands, "trials", error));
    for (size_t i = 0; i < plan->num_integrands; i++) {
        PS_TRY(
            ps_trials_create(&self->trials[i], plan->integrands[i], &options, plan->device, error));
    }
    return PSPEC_OK;
}

static pspec_status allocate(measurement *self, ps_error *error) {
    const ps_measurement_plan *const plan = self->plan;
    const size_t num_trials = self->batch * self->num_calls * self->trials_of_call;
    PS_TRY(PS_NEW(&self->sets, self->batch, "point sets", error));
    PS_TRY(PS_NEW(&self->patterns, self->batch, "point sets", error));
    PS_TRY(PS_NEW(&self->moves, num_trials * move_numbers(self), "shifts", error));
    PS_TRY(PS_NEW(&self->estimates, num_trials, "estimates", error));
    PS_TRY(PS_NEW(&self->sums, plan->num_integrands, "sums", error));
    return create_trials(self, error);
}

static void release(measurement *self) {
    for (size_t i = 0; self->sets != NULL && i < self->batch; i++) {
        ps_point_set_free(&self->sets[i]);
    }
    for (size_t i = 0; self->trials != NULL && i < self->plan->num_integrands; i++) {
        ps_trials_destroy(self->trials[i]);
    }
    free(self->sets);
    free(self->patterns);
    free(self->trials);
    free(self->moves);
    free(self->estimates);
    free(self->sums);
    ps_source_destroy(self->source);
}

/* ---- trials -------------------------------------------------------------------------------- */

/* Samplers and numbers of points have moves of their own, so that answers beside each other are
 * independent. */
static pspec_status choose_moves(measurement *self, ps_error *error) {
    const ps_sampler_request *const sampler = self->plan->sampler;
    ps_text text = {0};
    ps_sampler_identify(sampler, &text);
    ps_text_append(&text, "lift %d\n", (int)sampler->lift);
    const pspec_status status = ps_text_check(&text, error);
    self->seed = ps_random_seed_of(sampler->seed, PS_STREAM_TRIALS, ps_text_string(&text));
    ps_text_free(&text);
    return status;
}

/* Moves of a realization depend on its number, whatever the batches are. Those behind the last
 * shift are 0. */
static void make_moves(const measurement *self, uint64_t realization, double *moves) {
    const ps_measurement_plan *const plan = self->plan;
    const size_t numbers = move_numbers(self);
    ps_random random = ps_random_init(self->seed, PS_STREAM_TRIALS, realization);
    for (uint64_t s = 0; s < plan->num_shifts; s++) {
        double *const move = moves + s * numbers;
        if (plan->integrands[0]->place.where != PS_SAMPLES_TORUS) {
            const ps_rotation rotation = ps_rotation_random(&random);
            memcpy(move, rotation.matrix, sizeof rotation.matrix);
            continue;
        }
        for (size_t axis = 0; axis < numbers; axis++) {
            move[axis] = ps_random_uniform(&random);
        }
    }
}

static pspec_status fill_batch(measurement *self, uint64_t first, size_t num, ps_error *error) {
    const size_t numbers = self->num_calls * self->trials_of_call * move_numbers(self);
    for (size_t i = 0; i < num; i++) {
        ps_point_set *const set = &self->sets[i];
        ps_source_part part;
        bool has_set = false;
        PS_TRY(ps_source_next(self->source, set, &part, &has_set, error));
        self->patterns[i] = (pspec_pattern){
            .dimension = set->dimension, .num_points = set->num_points, .points = set->points};
        make_moves(self, first + i, self->moves + i * numbers);
    }
    return PSPEC_OK;
}

static double mean_square(const double *estimates, size_t num, double exact) {
    long double sum = 0;
    for (size_t s = 0; s < num; s++) {
        const long double off = (long double)estimates[s] - exact;
        sum += off * off;
    }
    return (double)(sum / num);
}

/* All trials of the batch, of one integrand. */
static pspec_status estimate(measurement *self, size_t integrand, uint64_t done, size_t num,
                             ps_error *error) {
    const ps_measurement_plan *const plan = self->plan;
    const size_t numbers = self->trials_of_call * move_numbers(self);
    for (size_t call = 0; call < self->num_calls; call++) {
        const double *const moves = plan->is_moved ? self->moves + call * numbers : NULL;
        PS_TRY(ps_trials_run(self->trials[integrand], self->patterns, num, moves,
                             self->estimates + call * self->trials_of_call, error));
        PS_TRY(
            ps_watch_tell(plan->watch, "realizations measured", done, plan->num_sets, NULL, error));
    }
    return PSPEC_OK;
}

static pspec_status run_batch(measurement *self, uint64_t done, size_t num, ps_error *error) {
    const ps_measurement_plan *const plan = self->plan;
    const size_t stride = self->num_calls * self->trials_of_call;
    for (size_t i = 0; i < plan->num_integrands; i++) {
        const double exact = ps_integrand_integral(plan->integrands[i]);
        PS_TRY(estimate(self, i, done, num, error));
        for (size_t r = 0; r < num; r++) {
            ps_sums_add(&self->sums[i],
                        mean_square(self->estimates + r * stride, (size_t)plan->num_shifts, exact));
        }
    }
    return PSPEC_OK;
}

static pspec_status run_all(measurement *self, ps_error *error) {
    const ps_measurement_plan *const plan = self->plan;
    for (uint64_t done = 0; done < plan->num_sets; done += self->batch) {
        const uint64_t left = plan->num_sets - done;
        const size_t num = left < self->batch ? (size_t)left : self->batch;
        PS_TRY(fill_batch(self, plan->first + done, num, error));
        PS_TRY(run_batch(self, done, num, error));
        PS_TRY(ps_watch_tell(plan->watch, "realizations measured", done + num, plan->num_sets, NULL,
                             error));
    }
    return PSPEC_OK;
}

pspec_status ps_measurement_run(const ps_measurement_plan *plan, ps_mean *variances,
                                ps_error *error) {
    measurement self = {.plan = plan};
    choose_sizes(&self);
    ps_sets_options sets = plan->sets;
    sets.first = plan->first;
    pspec_status status = allocate(&self, error);
    PS_TRY_OUT(status, choose_moves(&self, error));
    PS_TRY_OUT(status, status);
    PS_TRY_OUT(status, ps_source_sampler(&self.source, plan->sampler, plan->num_sets, &sets,
                                         plan->watch, error));
    PS_TRY_OUT(status, run_all(&self, error));
    for (size_t i = 0; i < plan->num_integrands; i++) {
        ps_sums_finish(&self.sums[i], plan->num_sets, &variances[i].mean,
                       &variances[i].standard_error);
    }
out:
    release(&self);
    return status;
}
