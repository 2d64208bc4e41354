#include "jobs/variance/measurement.h"

#include "base/memory.h"
#include "base/process/memory_limit.h"
#include "base/round.h"
#include "jobs/rows/set_loop.h"
#include "jobs/variance/variance_sets.h"
#include "math/random/rotation.h"
#include "spectra/sums.h"
#include "trials/trials.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Points of a batch together: some megabytes, which keep a device busy and caches warm. Values of
 * one call: half a second of a processor, after which somebody may stop the work. */
enum { BATCH_POINTS = 1 << 18, BATCH_TRIALS = 1 << 18, MOST_BATCH = 256, CALL_VALUES = 1 << 24 };

/* Of a GPU: a batch waits some tenths of a millisecond for its copies, in which an H200 has a
 * million values (counted, not measured). */
enum { GPU_BATCH_POINTS = 1 << 22, GPU_MOST_BATCH = 1 << 12, GPU_CALL_VALUES = 1 << 26 };

typedef struct measurement {
    const ps_measurement_plan *plan;
    size_t batch; /* sets at a time; 1 where the shifts of one are several calls */
    size_t trials_of_call, num_calls;
    ps_point_set *sets;      /* [batch] */
    pspec_pattern *patterns; /* [batch] */
    ps_trials **trials;      /* [num_integrands] */
    ps_device_sets *made;    /* NULL: sets have the points */
    double *moves;           /* [batch][num_calls][trials_of_call][numbers of a move] */
    double *estimates;       /* [batch][num_calls][trials_of_call] */
    ps_sums *sums;           /* [num_integrands] of rows */
    ps_block_sums *blocks;   /* the same */
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

static bool is_on_gpu(const measurement *self) {
    const ps_device *const device = self->plan->device;
    return device != NULL && ps_device_get_limits(device)->has_dedicated_local_memory;
}

/* Values that are sums cost as much as so many others. */
static size_t values_of_call(const measurement *self) {
    double most = 1;
    for (size_t i = 0; i < self->plan->num_integrands; i++) {
        most = fmax(most, ps_integrand_steps(self->plan->integrands[i]));
    }
    return divide(is_on_gpu(self) ? GPU_CALL_VALUES : CALL_VALUES, (size_t)most);
}

static void choose_calls(measurement *self, size_t trials_of_call) {
    self->trials_of_call = trials_of_call;
    self->num_calls = ps_divide_up((size_t)self->plan->num_shifts, trials_of_call);
}

static void choose_sizes(measurement *self) {
    const ps_measurement_plan *const plan = self->plan;
    const size_t points = plan->most_points;
    const size_t num_shifts = (size_t)plan->num_shifts;
    const size_t batch_points = is_on_gpu(self) ? GPU_BATCH_POINTS : BATCH_POINTS;
    const size_t most_batch = is_on_gpu(self) ? GPU_MOST_BATCH : MOST_BATCH;
    choose_calls(self, least(num_shifts, divide(values_of_call(self), points)));
    const size_t fit = least(divide(batch_points, points), divide(BATCH_TRIALS, num_shifts));
    const size_t quick = divide(values_of_call(self), points * self->trials_of_call);
    const size_t most = self->num_calls > 1 ? 1 : least(least(fit, quick), most_batch);
    self->batch = plan->num_sets < most ? (size_t)plan->num_sets : most;
}

static ps_precision choose_precision(const ps_device *device) {
    return device != NULL && ps_device_get_limits(device)->has_fp64 ? PS_DOUBLE : PS_SINGLE;
}

static ps_trials_options choose_options(const measurement *self) {
    return (ps_trials_options){.precision = choose_precision(self->plan->device),
                               .batch = self->batch,
                               .most_points = self->plan->most_points,
                               .num_trials = self->trials_of_call,
                               .makes_points = self->plan->made != NULL};
}

bool ps_measurement_may_make(const ps_measurement_plan *plan, const ps_sampler_request *sampler) {
    const ps_device *const device = plan->device;
    for (size_t i = 0; device != NULL && i < plan->num_integrands; i++) {
        if (!ps_trials_fit_device(plan->integrands[i], choose_precision(device), device)) {
            return false;
        }
    }
    return device != NULL && !plan->is_one_set &&
           ps_device_sets_serve(sampler, ps_device_get_limits(device));
}

/* Of all that allocate takes, with weights, and of the sets. */
static double count_bytes(const measurement *self) {
    const ps_measurement_plan *const plan = self->plan;
    const ps_trials_options options = choose_options(self);
    const double numbers = plan->integrands[0]->place.dimension + 1;
    const double sets = plan->made != NULL ? 0 : plan->is_one_set ? 1 : (double)self->batch;
    const double trials = (double)self->batch * (double)(self->num_calls * self->trials_of_call);
    double sum =
        sets * (double)plan->most_points * numbers + trials * (double)(move_numbers(self) + 1);
    sum *= (double)sizeof(double);
    sum += plan->making_bytes;
    for (size_t i = 0; i < plan->num_integrands; i++) {
        sum += ps_trials_bytes(plan->integrands[i], &options, plan->device);
    }
    return sum;
}

/* Fewer sets at a time, then fewer trials. Numbers do not depend on it. */
static pspec_status fit_memory(measurement *self, ps_error *error) {
    const ps_measurement_plan *const plan = self->plan;
    ps_memory_room room = {plan->memory_limit, "the limit of --memory"};
    char needed[PS_SIZE_TEXT];
    char left[PS_SIZE_TEXT];
    uint64_t held = 0; /* and counted */
    for (size_t i = 0; i < plan->num_integrands; i++) {
        held += ps_integrand_table_bytes(plan->integrands[i]);
    }
    if (plan->memory_limit == 0) {
        ps_memory_room_find(&room, held);
    }
    const double limit = (double)room.bytes;
    while (self->batch > 1 && count_bytes(self) > limit) {
        self->batch = (self->batch + 1) / 2;
    }
    while (self->trials_of_call > 1 && count_bytes(self) > limit) {
        choose_calls(self, (self->trials_of_call + 1) / 2);
    }
    return count_bytes(self) <= limit
               ? PSPEC_OK
               : ps_fail(
                     error, PSPEC_ERROR_MEMORY,
                     "measuring sets of %zu points, %llu shifts each, needs %s of memory, above "
                     "%s, %s; --shifts 0 only predicts",
                     plan->most_points, (unsigned long long)plan->num_shifts,
                     ps_size_show(needed, count_bytes(self)), ps_size_show(left, limit),
                     plan->memory_limit > 0 ? room.by : "what is free");
}

pspec_status ps_measurement_bytes(const ps_measurement_plan *plan, double *bytes, ps_error *error) {
    measurement self = {.plan = plan};
    choose_sizes(&self);
    PS_TRY(fit_memory(&self, error));
    *bytes = count_bytes(&self);
    return PSPEC_OK;
}

static pspec_status create_trials(measurement *self, ps_error *error) {
    const ps_measurement_plan *const plan = self->plan;
    const ps_trials_options options = choose_options(self);
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
    if (plan->made != NULL) {
        PS_TRY(ps_device_sets_create(&self->made, plan->made, plan->device, error));
    }
    return create_trials(self, error);
}

static void release(measurement *self) {
    for (size_t i = 0; self->sets != NULL && i < self->batch; i++) {
        ps_point_set_free(&self->sets[i]);
    }
    for (size_t i = 0; self->trials != NULL && i < self->plan->num_integrands; i++) {
        ps_trials_destroy(self->trials[i]);
    }
    ps_device_sets_destroy(self->made);
    free(self->sets);
    free(self->patterns);
    free(self->trials);
    free(self->moves);
    free(self->estimates);
    free(self->sums);
}

/* ---- trials -------------------------------------------------------------------------------- */

/* Moves of a realization depend on its number, whatever the batches are. Those behind the last
 * shift are 0. */
static void make_moves(const measurement *self, uint64_t realization, double *moves) {
    const ps_measurement_plan *const plan = self->plan;
    const size_t numbers = move_numbers(self);
    ps_random random = ps_random_init(plan->seed, PS_STREAM_TRIALS, realization);
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

/* Set i of the batch; of a single set there is one, read once. */
static pspec_status read_set(measurement *self, size_t i, ps_error *error) {
    const ps_measurement_plan *const plan = self->plan;
    if (plan->made != NULL) {
        self->patterns[i] = (pspec_pattern){.dimension = plan->made->dimension,
                                            .num_points = plan->made->num_points};
        return PSPEC_OK;
    }
    ps_point_set *const set = &self->sets[plan->is_one_set ? 0 : i];
    if (!plan->is_one_set || set->num_points == 0) {
        PS_TRY(ps_variance_sets_next(plan->source, set, error));
    }
    const double *const own = set->has_weights ? set->weights : NULL;
    self->patterns[i] = (pspec_pattern){set->dimension, set->num_points, set->points,
                                        plan->weights != NULL ? plan->weights : own};
    return PSPEC_OK;
}

static pspec_status fill_batch(measurement *self, uint64_t first, size_t num, ps_error *error) {
    const size_t numbers = self->num_calls * self->trials_of_call * move_numbers(self);
    for (size_t i = 0; i < num; i++) {
        PS_TRY(read_set(self, i, error));
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
static pspec_status estimate(measurement *self, size_t integrand, uint64_t first, size_t num,
                             ps_error *error) {
    const ps_measurement_plan *const plan = self->plan;
    const size_t numbers = self->trials_of_call * move_numbers(self);
    const ps_batch batch = {.num_patterns = num,
                            .patterns = self->patterns,
                            .sets = self->made,
                            .realization = plan->first + first};
    for (size_t call = 0; call < self->num_calls; call++) {
        const double *const moves = plan->is_moved ? self->moves + call * numbers : NULL;
        PS_TRY(ps_trials_run(self->trials[integrand], &batch, moves,
                             self->estimates + call * self->trials_of_call, error));
        PS_TRY(ps_watch_tell(plan->watch, "realizations measured", first, plan->num_sets, NULL,
                             error));
    }
    return PSPEC_OK;
}

/* rows[num][num_integrands], means over the trials of a set */
static pspec_status run_batch(measurement *self, uint64_t first, size_t num, double *rows,
                              ps_error *error) {
    const ps_measurement_plan *const plan = self->plan;
    const size_t stride = self->num_calls * self->trials_of_call;
    for (size_t i = 0; i < plan->num_integrands; i++) {
        const double exact = ps_integrand_integral(plan->integrands[i]);
        PS_TRY(estimate(self, i, first, num, error));
        for (size_t r = 0; r < num; r++) {
            rows[r * plan->num_integrands + i] =
                mean_square(self->estimates + r * stride, (size_t)plan->num_shifts, exact);
        }
    }
    return PSPEC_OK;
}

/* ---- all sets ------------------------------------------------------------------------------ */

static pspec_status make(void *payload, uint64_t first, size_t most, void *rows, size_t *num,
                         ps_error *error) {
    measurement *const self = payload;
    const ps_measurement_plan *const plan = self->plan;
    const uint64_t left = plan->num_sets - first;
    *num = left < most ? (size_t)left : most;
    PS_TRY(ps_watch_tell(plan->watch, "realizations measured", first, plan->num_sets, NULL, error));
    if (*num > 0) {
        PS_TRY(fill_batch(self, plan->first + first, *num, error));
        PS_TRY(run_batch(self, first, *num, rows, error));
    }
    return PSPEC_OK;
}

static void take(void *payload, uint64_t number, const void *row) {
    measurement *const self = payload;
    const double *const squares = row;
    (void)number;
    for (size_t i = 0; i < self->plan->num_integrands; i++) {
        ps_sums_add(&self->sums[i], squares[i]);
        ps_block_sums_add(&self->blocks[i], squares[i]);
    }
}

static pspec_status pass(void *payload, uint64_t num, uint64_t *passed, ps_error *error) {
    const ps_measurement_plan *const plan = ((const measurement *)payload)->plan;
    *passed = num;
    return plan->is_one_set || plan->made != NULL
               ? PSPEC_OK
               : ps_source_pass(plan->source, num, plan->watch, passed, error);
}

static pspec_status walk(void *payload, ps_snapshot *snapshot, ps_error *error) {
    measurement *const self = payload;
    const size_t num = self->plan->num_integrands;
    enum { NUMBERS = sizeof(ps_sums) / sizeof(double) };
    PS_TRY(ps_snapshot_doubles(snapshot, "squares", (double *)self->sums, NUMBERS * num, error));
    for (size_t i = 0; i < num; i++) {
        char name[32];
        snprintf(name, sizeof name, "blocks_%zu", i);
        PS_TRY(ps_block_sums_walk(&self->blocks[i], snapshot, name, error));
    }
    return PSPEC_OK;
}

pspec_status ps_measurement_run(const ps_measurement_plan *plan, uint64_t *num_sets,
                                ps_mean *variances, ps_block_sums *blocks, ps_error *error) {
    measurement self = {.plan = plan, .blocks = blocks};
    ps_set_loop loop = {.stream = {.job = &self,
                                   .make = make,
                                   .pass = pass,
                                   .row_bytes = plan->num_integrands * sizeof(double),
                                   .total = plan->num_sets,
                                   .is_clipped = true,
                                   .device = plan->device},
                        .take = take,
                        .walk = walk,
                        .spec = plan->checkpoint};
    choose_sizes(&self);
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, fit_memory(&self, error));
    loop.stream.batch = self.batch;
    PS_TRY_OUT(status, allocate(&self, error));
    PS_TRY_OUT(status, ps_set_loop_run(&loop, error));
    *num_sets = loop.num_done;
    for (size_t i = 0; i < plan->num_integrands && loop.num_done > 0; i++) {
        ps_sums_finish(&self.sums[i], loop.num_done, &variances[i].mean,
                       &variances[i].standard_error);
    }
out:
    release(&self);
    return status;
}
