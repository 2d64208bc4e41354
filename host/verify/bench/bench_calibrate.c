/* How long engines take on this device against the built-in cost model. */
#include "verify/bench/bench_private.h"

#include <math.h>

/* In the middle of what engines of each precision are asked for. The referee has none. */
static const double tolerances[] = {1e-4, 1e-10, 1};

/* What a factor may be: host/store/figures_file.c does not take others. */
static const double least_scale = 1e-3, most_scale = 1e3;

enum { MOST_CASES = 32 };

/* Seconds over predicted ones, the middle of the runs of every round: what a job usually takes
 * here. 0: not measured. */
typedef double ratios[MOST_CASES][PS_FIGURES_ENGINES][PS_FIGURES_PRECISIONS][PS_BENCH_ROUNDS];

typedef struct calibration {
    const ps_bench_options *options;
    ps_device *device;
    ps_device_limits limits; /* figures: launches, none of engines: those of the built-in model */
    ps_figures *figures;
    ratios found;
    size_t round;
} calibration;

static pspec_status measure_candidate(calibration *self, ps_bench_sets *sets,
                                      const ps_problem *problem, const ps_candidate *candidate,
                                      ps_error *error) {
    ps_bench_time time = {0};
    ps_engine_figure *const row = ps_figures_row(self->figures, candidate->engine->name);
    const double predicted = candidate->seconds / (double)problem->num_realizations;
    if (row == NULL) {
        return ps_fail(error, PSPEC_ERROR_DEVICE, "there are more than %d engines",
                       (int)PS_FIGURES_ENGINES);
    }
    const size_t at = (size_t)(row - self->figures->engines);
    PS_TRY(ps_bench_measure_round(sets, problem, candidate, self->device, self->options, &time,
                                  error));
    double *const found = self->found[sets->what - ps_bench_cases][at][candidate->precision];
    found[self->round] = ps_bench_median(time.seconds, time.num) / predicted;
    return PSPEC_OK;
}

static pspec_status measure_precision(calibration *self, ps_bench_sets *sets,
                                      const ps_stress_sample *sample, ps_precision precision,
                                      ps_error *error) {
    const ps_plan_constraints constraints = {.precision = (int)precision};
    ps_problem problem = ps_bench_problem(sets->what, sample, &self->limits);
    ps_plan plan;
    problem.tolerance = tolerances[precision];
    PS_TRY(ps_plan_make(&plan, &problem, &self->limits, &constraints, error));
    for (size_t i = 0; i < plan.num_candidates; i++) {
        const ps_candidate *candidate = &plan.candidates[i];
        if (candidate->is_feasible && ps_bench_is_affordable(self->options, candidate, &problem)) {
            PS_TRY(ps_bench_go_on(self->options, error));
            PS_TRY(measure_candidate(self, sets, &problem, candidate, error));
        }
    }
    return PSPEC_OK;
}

static pspec_status measure_case(calibration *self, const ps_bench_case *what, ps_error *error) {
    ps_stress_sample sample;
    ps_bench_sets sets = {0};
    PS_TRY(ps_stress_sample_create(&sample, &what->what, error));
    pspec_status status = ps_bench_sets_create(
        &sets, what, ps_bench_problem(what, &sample, &self->limits).num_realizations, error);
    for (int precision = PS_SINGLE; precision <= PS_EXTENDED && status == PSPEC_OK; precision++) {
        status = measure_precision(self, &sets, &sample, (ps_precision)precision, error);
    }
    ps_bench_sets_free(&sets);
    ps_stress_sample_free(&sample);
    return status;
}

/* The geometric mean over the cases; 0 without any. */
static double mean_of(calibration *self, size_t engine, size_t precision) {
    const size_t num_rounds = ps_bench_num_rounds(self->options);
    double sum = 0;
    unsigned num = 0;
    for (size_t i = 0; i < MOST_CASES; i++) {
        const double ratio = ps_bench_median(self->found[i][engine][precision], num_rounds);
        sum += ratio > 0 ? log(ratio) : 0;
        num += ratio > 0;
    }
    return num > 0 ? exp(sum / num) : 0;
}

static void take_means(calibration *self) {
    for (size_t i = 0; i < self->figures->num_engines; i++) {
        for (size_t p = 0; p < PS_FIGURES_PRECISIONS; p++) {
            const double mean = mean_of(self, i, p);
            self->figures->engines[i].scales[p] =
                mean > 0 ? fmin(fmax(mean, least_scale), most_scale) : 0;
        }
    }
}

static pspec_status measure_peaks(calibration *self, ps_error *error) {
    ps_device_peaks peaks;
    PS_TRY(ps_device_peaks_measure(self->device, &peaks, error));
    self->figures->flops[PS_SINGLE] = peaks.flops[PS_SINGLE];
    self->figures->flops[PS_DOUBLE] = peaks.flops[PS_DOUBLE];
    self->figures->copied_bytes = peaks.copied_bytes;
    self->figures->sent_bytes = peaks.sent_bytes;
    self->figures->launches = peaks.launches;
    return PSPEC_OK;
}

/* All cases once. */
static pspec_status measure_round(calibration *self, size_t *done, size_t total, ps_error *error) {
    const ps_bench_options *options = self->options;
    for (const ps_bench_case *what = ps_bench_cases; what->what.name != NULL; what++) {
        if (ps_bench_wants_case(options, what)) {
            if (options->advance != NULL) {
                options->advance(options->payload, *done, total);
            }
            PS_TRY(measure_case(self, what, error));
            (*done)++;
        }
    }
    return PSPEC_OK;
}

pspec_status ps_bench_calibrate(const ps_bench_options *options, ps_device *device,
                                ps_figures *figures, ps_error *error) {
    calibration self = {.options = options,
                        .device = device,
                        .limits = *ps_device_get_limits(device),
                        .figures = figures};
    const size_t num_rounds = ps_bench_num_rounds(options);
    size_t total = 0;
    size_t done = 0;
    self.limits.figures = figures;
    *figures = (ps_figures){.is_measured = true};
    PS_TRY(measure_peaks(&self, error));
    for (const ps_bench_case *what = ps_bench_cases; what->what.name != NULL; what++) {
        total += ps_bench_wants_case(options, what) ? num_rounds : 0;
    }
    for (self.round = 0; self.round < num_rounds; self.round++) {
        PS_TRY(measure_round(&self, &done, total, error));
    }
    take_means(&self);
    return PSPEC_OK;
}
