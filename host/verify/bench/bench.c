#include "verify/bench/bench_private.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* From tight to loose: what a looser one computes just as well is left out. */
static const double tolerances[] = {1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2};
enum { NUM_TOLERANCES = sizeof tolerances / sizeof tolerances[0] };

/* Of a calibration, in the middle of what engines of each precision are asked for. The referee has
 * none. */
static const double usual_tolerances[PS_FIGURES_PRECISIONS] = {1e-4, 1e-10, 1};

/* What a factor may be: host/store/figures_file.c does not take others. */
static const double least_scale = 1e-3, most_scale = 1e3;

/* Where a batch of the cases would not fill a GPU. */
enum { GPU_REALIZATIONS = 16 };

enum { MOST_ROWS = NUM_TOLERANCES * PS_MAX_CANDIDATES };

/* Engines that sum over pairs have no other cases. */
static bool takes(const ps_engine *engine, ps_stress_kind kind) {
    return !engine->sums_pairs || kind == PS_STRESS_PAIRS;
}

const ps_suite ps_bench_suite = {ps_bench_cases, takes, ""};

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
    const ps_suite_options *options;
    ps_device *device;
    ps_device_limits limits; /* that are planned with */
    double copied_bytes;
    ps_peak peaks[2];    /* measured anew beside every round of a row */
    ps_figures *figures; /* that are measured: a calibration, without peaks and errors; else NULL */
    /* of all cases so far, of seconds over predicted ones */
    double logarithms[PS_FIGURES_ENGINES][PS_FIGURES_PRECISIONS];
    unsigned counts[PS_FIGURES_ENGINES][PS_FIGURES_PRECISIONS];
    const ps_stress_case *what;
    ps_stress_sample sample;
    ps_bench_sets sets;
    size_t num_rows;
    ps_bench_row rows[MOST_ROWS];
    planned planned[MOST_ROWS];
} bench;

/* What a user would ask: all realizations of the case. The tolerance is the caller's. */
static ps_problem problem_of(const bench *self) {
    const bool is_pairs = self->what->kind == PS_STRESS_PAIRS;
    const uint64_t times = self->limits.has_dedicated_local_memory ? GPU_REALIZATIONS : 1;
    return (ps_problem){.frequencies = &self->sample.frequencies,
                        .num_points = self->what->num_points,
                        .planned_points = self->what->num_points,
                        .num_realizations = self->what->num_realizations * times,
                        .measure = is_pairs ? PS_OF_PAIR_SUMS : PS_OF_AMPLITUDES};
}

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
    PS_TRY(ps_suite_go_on(self->options, error));
    PS_TRY(ps_bench_measure_round(&self->sets, &row->problem, candidate, self->device,
                                  self->options, &row->time, error));
    if (candidate->engine->needs_device && self->figures == NULL) {
        PS_TRY(ps_peak_run(&self->peaks[candidate->precision], &peak, error));
        const double seconds = ps_bench_median(row->time.seconds + before, row->time.num - before);
        row->shares[row->num_shares++] = row->time.flops / seconds / peak;
    }
    return PSPEC_OK;
}

static pspec_status finish_row(bench *self, planned *plan, ps_bench_row *row, ps_error *error) {
    const ps_problem *problem = &plan->problem;
    const ps_candidate *candidate = &plan->candidate;
    double bound = 0;
    *row =
        (ps_bench_row){.what = self->what,
                       .engine = candidate->engine,
                       .precision = candidate->precision,
                       .tolerance = problem->tolerance,
                       .seconds = ps_bench_median(plan->time.seconds, plan->time.num),
                       .predicted_seconds = candidate->seconds / (double)problem->num_realizations,
                       .predicted_error = candidate->error,
                       .fraction_of_peak = NAN,
                       .fraction_of_bandwidth = NAN};
    if (plan->num_shares > 0) {
        row->fraction_of_peak = ps_bench_median(plan->shares, plan->num_shares);
        row->fraction_of_bandwidth =
            least_bytes(problem, row->precision) / row->seconds / self->copied_bytes;
    }
    return self->figures != NULL
               ? PSPEC_OK
               : ps_stress_measure(&self->sample, problem, row->engine, row->precision,
                                   self->device, &row->error, &bound, error);
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

static pspec_status plan_tolerance(bench *self, double tolerance, int precision, ps_error *error) {
    const ps_plan_constraints constraints = {.precision = precision};
    ps_problem problem = problem_of(self);
    ps_plan plan;
    problem.tolerance = tolerance;
    PS_TRY(ps_plan_make(&plan, &problem, &self->limits, &constraints, error));
    for (size_t i = 0; i < plan.num_candidates; i++) {
        const ps_candidate *candidate = &plan.candidates[i];
        if (candidate->is_feasible &&
            ps_suite_wants(self->options, candidate->engine->name, (int)candidate->precision) &&
            !is_planned(self, candidate) &&
            ps_bench_is_affordable(self->options, candidate, &problem)) {
            self->planned[self->num_rows++] =
                (planned){.problem = problem, .candidate = *candidate};
        }
    }
    return PSPEC_OK;
}

static pspec_status plan_rows(bench *self, ps_error *error) {
    const bool calibrates = self->figures != NULL;
    const int num = calibrates ? PS_FIGURES_PRECISIONS : NUM_TOLERANCES;
    self->num_rows = 0;
    for (int i = 0; i < num; i++) {
        PS_TRY(plan_tolerance(self, calibrates ? usual_tolerances[i] : tolerances[i],
                              calibrates ? i : -1, error));
    }
    return PSPEC_OK;
}

static pspec_status measure_rows(bench *self, ps_error *error) {
    const ps_suite_options *options = self->options;
    for (size_t round = 0; round < ps_bench_num_rounds(options); round++) {
        for (size_t i = 0; i < self->num_rows; i++) {
            PS_TRY(measure_round(self, &self->planned[i], error));
        }
    }
    if (self->figures == NULL) {
        PS_TRY(
            ps_stress_sample_judge(&self->sample, options->should_stop, options->payload, error));
    }
    for (size_t i = 0; i < self->num_rows; i++) {
        PS_TRY(finish_row(self, &self->planned[i], &self->rows[i], error));
    }
    return PSPEC_OK;
}

static pspec_status add_ratios(bench *self, ps_error *error) {
    for (size_t i = 0; i < self->num_rows; i++) {
        const ps_bench_row *const row = &self->rows[i];
        const ps_engine_figure *const figure = ps_figures_row(self->figures, row->engine->name);
        if (figure == NULL) {
            return ps_fail(error, PSPEC_ERROR_DEVICE, "there are more than %d engines",
                           (int)PS_FIGURES_ENGINES);
        }
        const size_t at = (size_t)(figure - self->figures->engines);
        self->logarithms[at][row->precision] += log(row->seconds / row->predicted_seconds);
        self->counts[at][row->precision]++;
    }
    return PSPEC_OK;
}

static pspec_status tell_rows(bench *self, ps_error *error) {
    if (self->figures != NULL) {
        return add_ratios(self, error);
    }
    ps_bench_mark_pareto(self->rows, self->num_rows);
    return self->options->report_rows != NULL
               ? self->options->report_rows(self->options->payload, self->rows, self->num_rows,
                                            error)
               : PSPEC_OK;
}

static pspec_status run_case(void *payload, const ps_stress_case *what, ps_error *error) {
    bench *const self = payload;
    self->what = what;
    PS_TRY(ps_stress_sample_create(&self->sample, what, error));
    pspec_status status =
        ps_bench_sets_create(&self->sets, what, problem_of(self).num_realizations, error);
    if (status == PSPEC_OK) {
        status = plan_rows(self, error);
    }
    if (status == PSPEC_OK) {
        status = measure_rows(self, error);
    }
    ps_bench_sets_free(&self->sets);
    ps_stress_sample_free(&self->sample);
    PS_TRY(status);
    return tell_rows(self, error);
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

pspec_status ps_bench_run(const ps_suite_options *options, ps_device *device, double copied_bytes,
                          ps_error *error) {
    bench *self = NULL;
    PS_TRY(PS_NEW(&self, 1, "a benchmark", error));
    *self = (bench){.options = options,
                    .device = device,
                    .limits = *ps_device_get_limits(device),
                    .copied_bytes = copied_bytes};
    pspec_status status = ps_peak_create(&self->peaks[PS_SINGLE], device, PS_SINGLE, error);
    if (status == PSPEC_OK && self->limits.has_fp64) {
        status = ps_peak_create(&self->peaks[PS_DOUBLE], device, PS_DOUBLE, error);
    }
    if (status == PSPEC_OK) {
        status = ps_suite_run(&ps_bench_suite, options, run_case, self, error);
    }
    ps_peak_destroy(&self->peaks[PS_SINGLE]);
    ps_peak_destroy(&self->peaks[PS_DOUBLE]);
    free(self);
    return status;
}

/* ---- calibration --------------------------------------------------------------------------- */

static void take_means(bench *self) {
    for (size_t i = 0; i < self->figures->num_engines; i++) {
        for (size_t p = 0; p < PS_FIGURES_PRECISIONS; p++) {
            const double mean = exp(self->logarithms[i][p] / self->counts[i][p]);
            self->figures->engines[i].scales[p] =
                self->counts[i][p] > 0 ? fmin(fmax(mean, least_scale), most_scale) : 0;
        }
    }
}

pspec_status ps_bench_calibrate(const ps_suite_options *options, ps_device *device,
                                ps_figures *figures, ps_error *error) {
    bench *self = NULL;
    PS_TRY(ps_device_peaks_measure(device, figures, error));
    PS_TRY(PS_NEW(&self, 1, "a calibration", error));
    *self = (bench){.options = options,
                    .device = device,
                    .limits = *ps_device_get_limits(device),
                    .figures = figures};
    self->limits.figures = figures; /* launches, and no engine yet: the built-in model */
    const pspec_status status = ps_suite_run(&ps_bench_suite, options, run_case, self, error);
    if (status == PSPEC_OK) {
        take_means(self);
    }
    free(self);
    return status;
}
