#include "verify/bench/bench_private.h"

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
        return ps_fail(
            error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no case \"%s\"%s", options->case_name,
            ps_text_suggest(options->case_name, nearest,
                            ps_text_distance(options->case_name, nearest), "; the nearest is ", "")
                .text);
    }
    nearest = NULL;
    for (const ps_engine *const *engine = ps_engines; options->engine != NULL && *engine != NULL;
         engine++) {
        ps_text_keep_nearest(options->engine, (*engine)->name, &nearest);
    }
    if (nearest != NULL && strcmp(options->engine, nearest) != 0) {
        return ps_fail(
            error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no engine \"%s\"%s", options->engine,
            ps_text_suggest(options->engine, nearest, ps_text_distance(options->engine, nearest),
                            "; the nearest is ", "")
                .text);
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

/* What a row was planned as, and what was measured of it. */
typedef struct planned {
    ps_problem problem;
    ps_candidate candidate;
    ps_bench_time time;
    size_t num_shares;
    double shares[PS_BENCH_ROUNDS]; /* of the peak */
} planned;

typedef struct bench {
    const ps_bench_options *options;
    ps_device *device;
    double copied_bytes;
    ps_peak peaks[2]; /* measured anew beside every round of a row */
    const ps_bench_case *what;
    ps_stress_sample sample;
    ps_bench_sets sets;
    size_t num_rows;
    ps_bench_row rows[MOST_ROWS];
    planned planned[MOST_ROWS];
} bench;

/* Points read and powers written, once each. */
static double least_bytes(const ps_problem *problem, ps_precision precision) {
    const double real_bytes = precision == PS_SINGLE ? sizeof(float) : sizeof(double);
    const unsigned dimension = problem->frequencies->dimension;
    return (double)problem->num_points * dimension * sizeof(double) +
           (double)problem->frequencies->num * real_bytes;
}

/* The share of the peak is that of a round: both change with what else the machine does. */
static pspec_status measure_round(bench *self, planned *row, ps_error *error) {
    const ps_candidate *candidate = &row->candidate;
    const size_t before = row->time.num;
    double peak = 0;
    PS_TRY(ps_bench_go_on(self->options, error));
    PS_TRY(ps_bench_measure_round(&self->sets, &row->problem, candidate, self->device,
                                  self->options, &row->time, error));
    if (candidate->engine->needs_device) {
        PS_TRY(ps_peak_run(&self->peaks[candidate->precision], &peak, error));
        const double seconds = ps_bench_median(row->time.seconds + before, row->time.num - before);
        row->shares[row->num_shares++] = row->time.flops / seconds / peak;
    }
    return PSPEC_OK;
}

static pspec_status finish_row(bench *self, planned *plan, ps_bench_row *row, ps_error *error) {
    const ps_problem *problem = &plan->problem;
    const ps_candidate *candidate = &plan->candidate;
    const bool on_device = candidate->engine->needs_device;
    double bound = 0;
    *row = (ps_bench_row){
        .what = self->what,
        .engine = candidate->engine,
        .precision = candidate->precision,
        .tolerance = problem->tolerance,
        .seconds = ps_bench_median(plan->time.seconds, plan->time.num),
        .predicted_seconds = candidate->seconds / (double)problem->num_realizations,
        .predicted_error = candidate->error,
        .fraction_of_peak =
            on_device ? ps_bench_median(plan->shares, plan->num_shares) : (double)NAN};
    row->fraction_of_bandwidth =
        on_device ? least_bytes(problem, row->precision) / row->seconds / self->copied_bytes
                  : (double)NAN;
    return ps_stress_measure(&self->sample, problem, row->engine, row->precision, self->device,
                             &row->error, &bound, error);
}

/* A tighter tolerance has led to the same. */
static bool is_planned(const bench *self, const ps_candidate *candidate) {
    for (size_t i = 0; i < self->num_rows; i++) {
        const ps_candidate *other = &self->planned[i].candidate;
        if (other->engine == candidate->engine && other->precision == candidate->precision &&
            other->seconds == candidate->seconds && other->error == candidate->error) {
            return true;
        }
    }
    return false;
}

static pspec_status plan_tolerance(bench *self, double tolerance, ps_error *error) {
    const ps_device_limits *limits = ps_device_get_limits(self->device);
    const ps_plan_constraints anything = {.precision = -1};
    ps_problem problem = ps_bench_problem(self->what, &self->sample, limits);
    ps_plan plan;
    problem.tolerance = tolerance;
    PS_TRY(ps_plan_make(&plan, &problem, limits, &anything, error));
    for (size_t i = 0; i < plan.num_candidates; i++) {
        const ps_candidate *candidate = &plan.candidates[i];
        if (candidate->is_feasible && ps_bench_wants(self->options, candidate) &&
            !is_planned(self, candidate) &&
            ps_bench_is_affordable(self->options, candidate, &problem)) {
            self->planned[self->num_rows++] =
                (planned){.problem = problem, .candidate = *candidate};
        }
    }
    return PSPEC_OK;
}

static pspec_status measure_rows(bench *self, ps_error *error) {
    const ps_bench_options *options = self->options;
    for (size_t round = 0; round < ps_bench_num_rounds(options); round++) {
        for (size_t i = 0; i < self->num_rows; i++) {
            PS_TRY(measure_round(self, &self->planned[i], error));
        }
    }
    PS_TRY(ps_stress_sample_judge(&self->sample, options->should_stop, options->payload, error));
    for (size_t i = 0; i < self->num_rows; i++) {
        PS_TRY(finish_row(self, &self->planned[i], &self->rows[i], error));
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
        status = plan_tolerance(self, tolerances[i], error);
    }
    if (status == PSPEC_OK) {
        status = measure_rows(self, error);
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

static pspec_status run_cases(bench *self, ps_error *error) {
    const ps_bench_options *options = self->options;
    const size_t total = count_cases(options);
    size_t done = 0;
    for (self->what = ps_bench_cases; self->what->what.name != NULL; self->what++) {
        if (!is_chosen(options, self->what)) {
            continue;
        }
        if (options->advance != NULL) {
            options->advance(options->payload, done, total);
        }
        PS_TRY(run_case(self, error));
        done++;
    }
    return PSPEC_OK;
}

pspec_status ps_bench_run(const ps_bench_options *options, ps_device *device, double copied_bytes,
                          ps_error *error) {
    bench *self = NULL;
    PS_TRY(PS_NEW(&self, 1, "a benchmark", error));
    *self = (bench){.options = options, .device = device, .copied_bytes = copied_bytes};
    pspec_status status = ps_peak_create(&self->peaks[PS_SINGLE], device, PS_SINGLE, error);
    if (status == PSPEC_OK && ps_device_get_limits(device)->has_fp64) {
        status = ps_peak_create(&self->peaks[PS_DOUBLE], device, PS_DOUBLE, error);
    }
    if (status == PSPEC_OK) {
        status = run_cases(self, error);
    }
    ps_peak_destroy(&self->peaks[PS_SINGLE]);
    ps_peak_destroy(&self->peaks[PS_DOUBLE]);
    free(self);
    return status;
}
