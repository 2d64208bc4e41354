#include "job/bench_private.h"

#include "base/memory.h"
#include "base/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* From tight to loose: what a looser one computes just as well is left out. */
static const double tolerances[] = {1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2};
enum { NUM_TOLERANCES = sizeof tolerances / sizeof tolerances[0] };

/* Where a batch of the cases would not fill a GPU. */
enum { GPU_REALIZATIONS = 16 };

enum { MOST_ROWS = NUM_TOLERANCES * PS_MAX_CANDIDATES };

/* ---- what is chosen ------------------------------------------------------------------------ */

bool ps_bench_wants_case(const ps_bench_options *options, const ps_bench_case *what) {
    return options->case_name != NULL ? strcmp(options->case_name, what->what.name) == 0
                                      : what->what.is_quick || !options->quick;
}

static unsigned domain_of(const ps_bench_case *what) {
    return what->what.kind == PS_STRESS_TORUS ? PS_ON_TORUS : PS_ON_SPHERE;
}

static bool wants_engine(const ps_bench_options *options, const ps_engine *engine, int precision) {
    return (options->engine == NULL || strcmp(options->engine, engine->name) == 0) &&
           (options->precision < 0 || options->precision == precision);
}

bool ps_bench_wants(const ps_bench_options *options, const ps_candidate *candidate) {
    return wants_engine(options, candidate->engine, (int)candidate->precision);
}

static pspec_status check_names(const ps_bench_options *options, ps_error *error) {
    const char *nearest = NULL;
    for (const ps_bench_case *what = ps_bench_cases;
         options->case_name != NULL && what->what.name != NULL; what++) {
        ps_text_keep_nearest(options->case_name, what->what.name, &nearest);
    }
    if (nearest != NULL && strcmp(options->case_name, nearest) != 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "there is no case \"%s\"; the nearest is %s", options->case_name, nearest);
    }
    nearest = NULL;
    for (const ps_engine *const *engine = ps_engines; options->engine != NULL && *engine != NULL;
         engine++) {
        ps_text_keep_nearest(options->engine, (*engine)->name, &nearest);
    }
    if (nearest != NULL && strcmp(options->engine, nearest) != 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "there is no engine \"%s\"; the nearest is %s", options->engine, nearest);
    }
    return PSPEC_OK;
}

/* Engines that sum over pairs have no other cases. */
static bool may_try(const ps_bench_case *what, const ps_engine *engine) {
    return (engine->domains & domain_of(what)) != 0 &&
           (!engine->sums_pairs || what->what.kind == PS_STRESS_PAIRS);
}

static bool is_chosen(const ps_bench_options *options, const ps_bench_case *what) {
    for (const ps_engine *const *engine = ps_engines; *engine != NULL; engine++) {
        for (int precision = PS_SINGLE; precision <= PS_EXTENDED; precision++) {
            if (may_try(what, *engine) && (*engine)->has_precision[precision] &&
                wants_engine(options, *engine, precision)) {
                return ps_bench_wants_case(options, what);
            }
        }
    }
    return false;
}

static size_t count_cases(const ps_bench_options *options) {
    size_t num = 0;
    for (const ps_bench_case *what = ps_bench_cases; what->what.name != NULL; what++) {
        num += is_chosen(options, what) ? 1 : 0;
    }
    return num;
}

pspec_status ps_bench_check(const ps_bench_options *options, ps_error *error) {
    PS_TRY(check_names(options, error));
    return count_cases(options) > 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "no case is left: none of those asked for has that engine and precision");
}

pspec_status ps_bench_go_on(const ps_bench_options *options, ps_error *error) {
    return options->should_stop != NULL && options->should_stop(options->payload)
               ? ps_fail(error, PSPEC_ERROR_CANCELLED, "cancelled")
               : PSPEC_OK;
}

ps_problem ps_bench_problem(const ps_bench_case *what, const ps_stress_sample *sample,
                            const ps_device_limits *limits) {
    const bool is_pairs = what->what.kind == PS_STRESS_PAIRS;
    const uint64_t times = limits->has_dedicated_local_memory ? GPU_REALIZATIONS : 1;
    return (ps_problem){.frequencies = &sample->frequencies,
                        .num_points = what->what.num_points,
                        .planned_points = what->what.num_points,
                        .num_realizations = what->num_realizations * times,
                        .measure = is_pairs ? PS_OF_PAIR_SUMS : PS_OF_AMPLITUDES};
}

/* ---- a case -------------------------------------------------------------------------------- */

typedef struct bench {
    const ps_bench_options *options;
    ps_device *device;
    ps_device_peaks peaks; /* of arithmetic: measured beside the case */
    const ps_bench_case *what;
    ps_stress_sample sample;
    ps_bench_sets sets;
    size_t num_rows;
    ps_bench_row rows[MOST_ROWS];
    ps_candidate tried[MOST_ROWS]; /* what the rows were planned as */
} bench;

/* Points read and powers written, once each. */
static double least_bytes(const ps_problem *problem, ps_precision precision) {
    const double real_bytes = precision == PS_SINGLE ? sizeof(float) : sizeof(double);
    const unsigned dimension = problem->frequencies->dimension;
    return (double)problem->num_points * dimension * sizeof(double) +
           (double)problem->frequencies->num * real_bytes;
}

static pspec_status measure_row(bench *self, const ps_problem *problem,
                                const ps_candidate *candidate, ps_bench_row *row, ps_error *error) {
    const ps_bench_options *options = self->options;
    const ps_engine *engine = candidate->engine;
    const double nan_rate = (double)NAN;
    ps_bench_time time = {0};
    double bound = 0;
    PS_TRY(ps_stress_sample_judge(&self->sample, options->should_stop, options->payload, error));
    PS_TRY(ps_bench_measure_time(&self->sets, problem, candidate, self->device, options, &time,
                                 error));
    *row =
        (ps_bench_row){.what = self->what,
                       .engine = engine,
                       .precision = candidate->precision,
                       .tolerance = problem->tolerance,
                       .seconds = time.seconds,
                       .predicted_seconds = candidate->seconds / (double)problem->num_realizations,
                       .predicted_error = candidate->error,
                       .fraction_of_peak = nan_rate,
                       .fraction_of_bandwidth = nan_rate};
    if (engine->needs_device) {
        row->fraction_of_peak = time.flops / time.seconds / self->peaks.flops[row->precision];
        row->fraction_of_bandwidth =
            least_bytes(problem, row->precision) / time.seconds / self->peaks.copied_bytes;
    }
    return ps_stress_measure(&self->sample, problem, engine, candidate->precision, self->device,
                             &row->error, &bound, error);
}

/* A tighter tolerance has led to the same. */
static bool was_tried(const bench *self, const ps_candidate *candidate) {
    for (size_t i = 0; i < self->num_rows; i++) {
        const ps_candidate *other = &self->tried[i];
        if (other->engine == candidate->engine && other->precision == candidate->precision &&
            other->seconds == candidate->seconds && other->error == candidate->error) {
            return true;
        }
    }
    return false;
}

static pspec_status try_tolerance(bench *self, double tolerance, ps_error *error) {
    const ps_device_limits *limits = ps_device_get_limits(self->device);
    const ps_plan_constraints anything = {.precision = -1};
    ps_problem problem = ps_bench_problem(self->what, &self->sample, limits);
    ps_plan plan;
    problem.tolerance = tolerance;
    PS_TRY(ps_plan_make(&plan, &problem, limits, &anything, error));
    for (size_t i = 0; i < plan.num_candidates; i++) {
        const ps_candidate *candidate = &plan.candidates[i];
        if (!candidate->is_feasible || !ps_bench_wants(self->options, candidate) ||
            was_tried(self, candidate) ||
            !ps_bench_is_affordable(self->options, candidate, &problem)) {
            continue;
        }
        PS_TRY(ps_bench_go_on(self->options, error));
        PS_TRY(measure_row(self, &problem, candidate, &self->rows[self->num_rows], error));
        self->tried[self->num_rows++] = *candidate;
    }
    return PSPEC_OK;
}

static pspec_status run_case(bench *self, ps_error *error) {
    const ps_device_limits *limits = ps_device_get_limits(self->device);
    self->num_rows = 0;
    PS_TRY(ps_stress_sample_create(&self->sample, &self->what->what, error));
    pspec_status status = ps_bench_sets_create(
        &self->sets, self->what,
        ps_bench_problem(self->what, &self->sample, limits).num_realizations, error);
    for (size_t i = 0; i < NUM_TOLERANCES && status == PSPEC_OK; i++) {
        status = try_tolerance(self, tolerances[i], error);
    }
    ps_bench_sets_free(&self->sets);
    ps_stress_sample_free(&self->sample);
    PS_TRY(status);
    ps_bench_mark_pareto(self->rows, self->num_rows);
    return self->options->report != NULL
               ? self->options->report(self->options->payload, self->rows, self->num_rows, error)
               : PSPEC_OK;
}

/* ---- all of them --------------------------------------------------------------------------- */

static bool is_beaten(const ps_bench_row *row, const ps_bench_row *by) {
    return by->seconds <= row->seconds && by->error <= row->error &&
           (by->seconds < row->seconds || by->error < row->error);
}

void ps_bench_mark_pareto(ps_bench_row *rows, size_t num) {
    for (size_t i = 0; i < num; i++) {
        rows[i].is_pareto = true;
        for (size_t j = 0; j < num && rows[i].is_pareto; j++) {
            rows[i].is_pareto = rows[i].what != rows[j].what || !is_beaten(&rows[i], &rows[j]);
        }
    }
}

pspec_status ps_bench_run(const ps_bench_options *options, ps_device *device,
                          const ps_device_peaks *peaks, ps_error *error) {
    void *memory = NULL;
    const size_t total = count_cases(options);
    size_t done = 0;
    PS_TRY(ps_allocate(&memory, 1, sizeof(bench), "a benchmark", error));
    bench *self = memory;
    *self = (bench){.options = options, .device = device, .peaks = *peaks};
    pspec_status status = PSPEC_OK;
    for (self->what = ps_bench_cases; self->what->what.name != NULL && status == PSPEC_OK;
         self->what++) {
        if (is_chosen(options, self->what)) {
            if (options->advance != NULL) {
                options->advance(options->payload, done, total);
            }
            if (done > 0) { /* the first ones were measured just now */
                status = ps_device_flops_measure(device, &self->peaks, error);
            }
            if (status == PSPEC_OK) {
                status = run_case(self, error);
            }
            done++;
        }
    }
    free(memory);
    return status;
}
