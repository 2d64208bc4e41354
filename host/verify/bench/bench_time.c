/* How long an engine takes for a realization. */
#include "verify/bench/bench_private.h"

#include "base/clock.h"
#include "base/memory.h"
#include "engines/error_units.h"
#include "verify/stress_shapes.h"

#include <math.h>
#include <stdlib.h>

/* A run lasts so long, if one realization is not longer: enough for the clock and for batches to
 * weigh little. */
static const double run_seconds = 0.04, quick_run_seconds = 0.03;
/* A realization that takes longer than this is not timed: of the device, and of the referee. */
static const double most_device_seconds = 2, most_host_seconds = 0.5, quick_most_host_seconds = 0.1;

/* ---- realizations -------------------------------------------------------------------------- */

pspec_status ps_bench_sets_create(ps_bench_sets *out, const ps_stress_case *what, uint64_t num,
                                  ps_error *error) {
    *out = (ps_bench_sets){.what = what, .capacity = (size_t)num};
    PS_TRY(PS_NEW(&out->patterns, out->capacity, "realizations", error));
    const pspec_status status = PS_NEW(&out->scales, out->capacity, "realizations", error);
    if (status != PSPEC_OK) {
        ps_bench_sets_free(out);
    }
    return status;
}

void ps_bench_sets_free(ps_bench_sets *sets) {
    for (size_t r = 0; r < sets->num; r++) {
        ps_stress_pattern_free(&sets->patterns[r]);
    }
    free(sets->patterns);
    free(sets->scales);
    *sets = (ps_bench_sets){0};
}

static pspec_status make_sets(ps_bench_sets *sets, size_t num, ps_error *error) {
    while (sets->num < num) {
        PS_TRY(ps_stress_points_make(sets->what, sets->num, &sets->patterns[sets->num], error));
        sets->scales[sets->num] = 1 / (double)sets->patterns[sets->num].num_points;
        sets->num++;
    }
    return PSPEC_OK;
}

/* ---- runs ---------------------------------------------------------------------------------- */

/* One engine, ready to run num realizations. */
typedef struct timing {
    const ps_bench_sets *sets;
    const ps_engine *engine;
    ps_device *device;
    void *state;
    size_t num, batch;
    bool (*should_stop)(void *payload);
    void *payload;
} timing;

static pspec_status run_once(const timing *self, double *seconds, ps_error *error) {
    const double begin = ps_clock_seconds();
    ps_rows rows = {0};
    for (size_t done = 0; done < self->num; done += self->batch) {
        const size_t rest = self->num - done;
        const ps_batch batch = {.num_patterns = rest < self->batch ? rest : self->batch,
                                .patterns = self->sets->patterns + done,
                                .scales = self->sets->scales + done,
                                .should_stop = self->should_stop,
                                .payload = self->payload};
        PS_TRY(self->engine->run(self->state, &batch, &rows, error));
    }
    PS_TRY(ps_rows_wait(&rows, error));
    PS_TRY(ps_device_finish(self->device, error));
    *seconds = ps_clock_seconds() - begin;
    return PSPEC_OK;
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return x < y ? -1 : x > y;
}

double ps_bench_median(double *numbers, size_t num) {
    qsort(numbers, num, sizeof *numbers, compare);
    return numbers[num / 2];
}

/* The first run builds kernels and touches memory; on the host there is nothing of that. */
static pspec_status run_round(const timing *self, ps_bench_time *out, ps_error *error) {
    const double realizations = (double)self->num;
    double seconds = 0;
    if (self->engine->needs_device) {
        PS_TRY(run_once(self, &seconds, error));
    }
    const double flops = ps_device_launched_flops(self->device);
    for (size_t i = 0; i < PS_BENCH_RUNS; i++) {
        PS_TRY(run_once(self, &seconds, error));
        out->seconds[out->num++] = seconds / realizations;
    }
    out->flops = (ps_device_launched_flops(self->device) - flops) / PS_BENCH_RUNS / realizations;
    return PSPEC_OK;
}

/* ---- how much of it ------------------------------------------------------------------------ */

static double predicted(const ps_candidate *candidate, const ps_problem *problem) {
    return candidate->seconds / (double)problem->num_realizations;
}

bool ps_bench_is_affordable(const ps_suite_options *options, const ps_candidate *candidate,
                            const ps_problem *problem) {
    const double most = candidate->engine->needs_device ? most_device_seconds
                        : options->quick                ? quick_most_host_seconds
                                                        : most_host_seconds;
    return predicted(candidate, problem) <= most;
}

/* As many as make a run long enough; where batches share work, as many as want to. */
static size_t choose_num(const ps_suite_options *options, const ps_candidate *candidate,
                         const ps_problem *problem) {
    const double wanted = options->quick ? quick_run_seconds : run_seconds;
    const double num = ceil(wanted / predicted(candidate, problem));
    if (!candidate->engine->needs_device) {
        return 1;
    }
    return num < (double)problem->num_realizations ? (size_t)fmax(num, 1)
                                                   : (size_t)problem->num_realizations;
}

pspec_status ps_bench_measure_round(ps_bench_sets *sets, const ps_problem *problem,
                                    const ps_candidate *candidate, ps_device *device,
                                    const ps_suite_options *options, ps_bench_time *out,
                                    ps_error *error) {
    const ps_problem own = ps_engine_problem(candidate->engine, problem);
    timing self = {.sets = sets,
                   .engine = candidate->engine,
                   .device = device,
                   .num = choose_num(options, candidate, problem),
                   .should_stop = options->should_stop,
                   .payload = options->payload};
    PS_TRY(make_sets(sets, self.num, error));
    self.batch = candidate->batch < self.num ? candidate->batch : self.num;
    pspec_status status = ps_engine_create(self.engine, &self.state, &own, candidate->precision,
                                           self.batch, device, error);
    if (status == PSPEC_OK) {
        status = run_round(&self, out, error);
    }
    ps_engine_destroy(self.engine, self.state);
    return status;
}
