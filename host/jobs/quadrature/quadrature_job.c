#include "jobs/quadrature/quadrature_job.h"

#include "base/memory.h"
#include "jobs/quadrature/quadrature_looks.h"
#include "jobs/quadrature/quadrature_rules.h"
#include "math/pi.h"
#include "spectra/sums.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct job {
    const ps_quadrature_question *question;
    ps_quadrature_result *out;
    ps_rules rules;
    ps_rule_shape shape;
    ps_quadrature_setup setup;
    ps_estimator *estimator;
    double *block;        /* what the next four lie in */
    double *coefficients; /* [ps_num_coefficients(L)], unless sums are over pairs */
    double *c_l0, *c2;    /* [L + 1] */
    ps_sums *sums;        /* [L + 1][3] */
    ps_degree_error *degrees;
    size_t num_told; /* rules of the batch whose spectrum is there */
    pspec_status told_status;
    ps_error *error; /* of what is told */
    ps_sums squared, zonal, anisotropic, tail, weight_sum;
} job;

static ps_mean finish(const ps_sums *sum, uint64_t num) {
    ps_mean out;
    ps_sums_finish(sum, num, &out.mean, &out.standard_error);
    return out;
}

/* ---- one rule ------------------------------------------------------------------------------ */

static void add_degrees(job *of) {
    for (size_t l = 0; l <= of->setup.max_degree; l++) {
        const ps_degree_error *const degree = &of->degrees[l];
        ps_sums_add(&of->sums[3 * l], degree->d2);
        ps_sums_add(&of->sums[3 * l + 1], degree->c2);
        ps_sums_add(&of->sums[3 * l + 2], degree->e2);
    }
}

/* The next rule of the batch, whose spectrum is c_l0 and c2. */
static pspec_status take_rule(job *of, const double *c_l0, const double *c2, ps_error *error) {
    ps_quadrature_result *const out = of->out;
    const ps_weighted_rule *const rule = &of->rules.batch[of->num_told++];
    ps_spectral_error spectral;
    PS_TRY(ps_spectral_error_of(&of->setup.representer, of->setup.max_degree, c_l0, c2,
                                &rule->weight, of->degrees, &spectral, error));
    const uint64_t num = ++out->num_realizations;
    add_degrees(of);
    ps_sums_add(&of->squared, rule->kernel.squared);
    ps_sums_add(&of->zonal, spectral.zonal);
    ps_sums_add(&of->anisotropic, spectral.anisotropic);
    ps_sums_add(&of->tail, rule->kernel.squared - spectral.zonal - spectral.anisotropic);
    ps_sums_add(&of->weight_sum, rule->weight.sum);
    out->tail_model += (spectral.tail_model - out->tail_model) / (double)num;
    out->tail_bound += (spectral.tail_bound - out->tail_bound) / (double)num;
    out->numerical_bound = fmax(out->numerical_bound, rule->kernel.bound);
    out->weight_size = fmax(out->weight_size, rule->weight.size);
    return PSPEC_OK;
}

/* From sums over pairs. */
static void hear(void *payload, const double *zonal, const double *c2) {
    job *const of = payload;
    for (size_t l = 0; l <= of->setup.max_degree; l++) {
        of->c_l0[l] = sqrt((2 * (double)l + 1) / PS_FOUR_PI) * zonal[l];
    }
    if (of->told_status == PSPEC_OK) {
        of->told_status = take_rule(of, of->c_l0, c2, of->error);
    }
}

/* From coefficients. */
static pspec_status sum_coefficients(job *of, const pspec_pattern *pattern, ps_error *error) {
    const size_t last = of->setup.max_degree;
    PS_TRY(ps_estimator_coefficients(of->estimator, pattern, PS_SPHERICAL_HARMONICS,
                                     of->coefficients, error));
    for (size_t l = 0; l <= last; l++) {
        of->c_l0[l] = of->coefficients[2 * l];
        of->c2[l] = 0;
        for (size_t m = 1; m <= l; m++) {
            const double *const c = of->coefficients + 2 * (m * (2 * last + 1 - m) / 2 + l);
            of->c2[l] += 2 * (c[0] * c[0] + c[1] * c[1]);
        }
    }
    return take_rule(of, of->c_l0, of->c2, error);
}

/* ---- preparation --------------------------------------------------------------------------- */

static pspec_status allocate(job *of, ps_error *error) {
    enum { SUMS = 3, NUMBERS = sizeof(ps_sums) / sizeof(double) };
    const size_t num = of->setup.max_degree + 1;
    const size_t num_coefficients =
        of->setup.by_pairs ? 0 : ps_num_coefficients((int32_t)of->setup.max_degree);
    void *block = NULL;
    void *degrees = NULL;
    void *results = NULL;
    PS_TRY(ps_allocate(&block, num_coefficients + (2 + SUMS * NUMBERS) * num, sizeof(double),
                       "coefficients", error));
    of->block = block;
    of->coefficients = of->block;
    of->c_l0 = of->coefficients + num_coefficients;
    of->c2 = of->c_l0 + num;
    of->sums = (ps_sums *)(void *)(of->c2 + num);
    PS_TRY(ps_allocate(&degrees, num, sizeof(ps_degree_error), "degrees", error));
    of->degrees = degrees;
    PS_TRY(ps_allocate(&results, num, sizeof(ps_quadrature_degree), "degrees", error));
    of->out->degrees = results;
    return PSPEC_OK;
}

static pspec_status report_progress(const job *of, ps_error *error) {
    return ps_watch_tell(&of->question->watch, "realizations", of->out->num_realizations,
                         of->setup.num_realizations, NULL, error);
}

static bool should_stop(void *payload) {
    return report_progress(payload, NULL) != PSPEC_OK;
}

static pspec_status create_estimator(job *of, ps_error *error) {
    const ps_candidate *const chosen = of->setup.plan.chosen;
    const ps_estimator_options options = {.problem = of->setup.problem,
                                          .engine = chosen->engine,
                                          .precision = chosen->precision,
                                          .batch = of->setup.by_pairs ? chosen->batch : 1,
                                          .normalization = of->setup.by_pairs
                                                               ? PSPEC_NORMALIZATION_PAIRS
                                                               : PSPEC_NORMALIZATION_EFFECTIVE,
                                          .want_c2 = of->setup.by_pairs,
                                          .observer = {hear, of},
                                          .should_stop = should_stop,
                                          .payload = of};
    return ps_estimator_create(&of->estimator, &options, of->setup.device, error);
}

/* Sets of a batch are in memory all at once. */
static size_t choose_batch(const job *of) {
    enum { MOST_BYTES = 64 << 20, NUMBERS = 5 }; /* coordinates, weight, kappa */
    const size_t most = MOST_BYTES / (NUMBERS * sizeof(double)) / of->shape.num_points + 1;
    const size_t batch =
        of->question->batch > 0 ? of->question->batch : ps_estimator_batch(of->estimator);
    return batch < most ? batch : most;
}

/* ---- all rules ----------------------------------------------------------------------------- */

static pspec_status do_batch(job *of, ps_error *error) {
    of->num_told = 0;
    if (of->setup.by_pairs) {
        of->error = error;
        PS_TRY(ps_estimator_add(of->estimator, of->rules.patterns, of->rules.num, error));
        return of->told_status;
    }
    for (size_t r = 0; r < of->rules.num; r++) {
        PS_TRY(sum_coefficients(of, &of->rules.patterns[r], error));
    }
    return PSPEC_OK;
}

/* e_l^2 matters where it is above the tolerance, and so does E^2. */
static void look_at_errors(job *of) {
    enum { E2 = 2, SUMS = 3 }; /* of a degree */
    ps_quadrature_result *const out = of->out;
    const ps_quadrature_sums sums = {of->setup.max_degree + 1, of->sums + E2, SUMS, &of->squared};
    const double unit = of->setup.representer.constant * out->weight_size * out->weight_size;
    out->has_look = true;
    out->look = ps_quadrature_look(&sums, of->question->tolerance * unit, out->num_realizations);
}

/* The next batch, up to the next look. *ends: there are no more rules, or there are enough. */
static pspec_status run_batch(job *of, bool *ends, ps_error *error) {
    const double wanted = of->question->standard_error;
    ps_rules *const rules = &of->rules;
    const uint64_t done = of->out->num_realizations;
    rules->until = of->setup.needs.sequential ? ps_sequential_next_look(done) : UINT64_MAX;
    PS_TRY(ps_rules_next(rules, &of->setup.representer, error));
    if (rules->num == 0) {
        *ends = true;
        if (wanted > 0 && done > 1) {
            look_at_errors(of);
        }
        return PSPEC_OK;
    }
    PS_TRY(do_batch(of, error));
    if (of->out->num_realizations == rules->until) {
        look_at_errors(of);
        *ends = of->out->look.corrected <= wanted;
    }
    return PSPEC_OK;
}

/* The looks, and so what ends a job, do not depend on batches. */
static pspec_status run_batches(job *of, ps_error *error) {
    bool ends = false;
    PS_TRY(ps_rules_allocate(&of->rules, choose_batch(of), error));
    for (;;) {
        PS_TRY(run_batch(of, &ends, error));
        if (ends) {
            return PSPEC_OK;
        }
        PS_TRY(report_progress(of, error));
    }
}

static pspec_status collect(job *of, ps_error *error) {
    ps_quadrature_result *const out = of->out;
    const uint64_t num = out->num_realizations;
    ps_text text = {0};
    for (size_t l = 0; l <= out->max_degree; l++) {
        out->degrees[l] = (ps_quadrature_degree){
            of->setup.representer.a[l], of->setup.representer.b[l], finish(&of->sums[3 * l], num),
            finish(&of->sums[3 * l + 1], num), finish(&of->sums[3 * l + 2], num)};
    }
    out->squared = finish(&of->squared, num);
    out->zonal = finish(&of->zonal, num);
    out->anisotropic = finish(&of->anisotropic, num);
    out->tail = finish(&of->tail, num);
    out->weight_sum = finish(&of->weight_sum, num);
    out->num_dropped = of->rules.num_dropped;
    out->num_duplicates = of->rules.num_duplicates;
    out->is_ill_conditioned = of->rules.is_ill_conditioned;
    out->has_matrices = of->rules.has_matrices;
    ps_rules_name_weights(&of->rules, out->weights_by, sizeof out->weights_by);
    out->largest_condition =
        of->rules.largest_condition > 0 ? of->rules.largest_condition : (double)NAN;
    ps_estimator_describe(of->estimator, &text);
    const pspec_status status = ps_text_check(&text, error);
    snprintf(out->engine, sizeof out->engine, "%s", ps_text_string(&text));
    ps_text_free(&text);
    return status;
}

/* What the header says of the setup. */
static pspec_status describe(job *of, ps_error *error) {
    ps_quadrature_result *const out = of->out;
    const ps_quadrature_setup *const setup = &of->setup;
    ps_text skips = {0};
    out->num_points = of->shape.num_points;
    out->max_degree = setup->max_degree;
    out->precision = ps_precision_name(setup->plan.chosen->precision);
    snprintf(out->device, sizeof out->device, "%s",
             setup->device != NULL ? ps_device_get_limits(setup->device)->name : "none");
    snprintf(out->degrees_note, sizeof out->degrees_note, "%s", setup->degrees_note);
    ps_needs_describe(&setup->needs, &skips);
    const pspec_status status = ps_text_check(&skips, error);
    snprintf(out->skipped, sizeof out->skipped, "%s", ps_text_string(&skips));
    ps_text_free(&skips);
    return status;
}

/* Engines that sum squares are off by more where powers are larger than was expected. */
static bool missed_tolerance(const job *of) {
    return of->setup.by_pairs &&
           !(ps_estimator_accuracy(of->estimator).error <= of->setup.problem.tolerance);
}

static void tell_profile(const job *of) {
    const ps_quadrature_question *const question = of->question;
    if (question->tell_profile != NULL && of->setup.device != NULL) {
        size_t num = 0;
        const ps_profile_row *const rows = ps_device_profile(of->setup.device, &num);
        question->tell_profile(question->payload, rows, num);
    }
}

/* The spectral form may not exceed the kernel form, nor the rest its rigorous bound, by more than rounding. */
static pspec_status check_forms(const job *of, ps_error *error) {
    const ps_quadrature_result *const result = of->out;
    const double slack = result->numerical_bound + of->question->tolerance *
                                                       of->setup.representer.constant *
                                                       result->weight_size * result->weight_size;
    if (result->tail.mean >= -slack && result->tail.mean <= result->tail_bound + slack) {
        return PSPEC_OK;
    }
    return ps_fail(error, PSPEC_ERROR_CHECK,
                   "E^2 is %.17g by the kernel and %.17g to degree %zu by the spectrum: the rest, "
                   "%.3g, is outside 0 .. %.3g",
                   result->squared.mean, result->zonal.mean + result->anisotropic.mean,
                   result->max_degree, result->tail.mean, result->tail_bound);
}

/* mean_power, largest_share: 0, or what the run before has measured. *again: to be run once more with what this has. */
static pspec_status run_once(job *of, double mean_power, double largest_share, bool *again,
                             ps_error *error) {
    const ps_quadrature_question *const question = of->question;
    *again = false;
    PS_TRY(ps_quadrature_setup_begin(&of->setup, question, error));
    PS_TRY(ps_rules_open(&of->rules, &of->shape, error));
    of->shape.mean_power = mean_power;
    of->shape.largest_share = largest_share;
    PS_TRY(ps_quadrature_setup_make(&of->setup, question, &of->shape, error));
    if (question->tell_plan != NULL) {
        question->tell_plan(question->payload, &of->setup.plan);
    }
    PS_TRY(ps_plan_require(&of->setup.plan, &of->setup.problem, error));
    of->rules.most = of->setup.needs.one_realization ? 1 : UINT64_MAX;
    PS_TRY(describe(of, error));
    PS_TRY(allocate(of, error));
    PS_TRY(create_estimator(of, error));
    of->rules.device = of->setup.device;
    PS_TRY(run_batches(of, error));
    tell_profile(of);
    *again = missed_tolerance(of);
    PS_TRY(*again ? PSPEC_OK : collect(of, error));
    PS_TRY(*again ? PSPEC_OK : check_forms(of, error));
    if (*again && !ps_source_can_rewind(of->rules.source)) {
        return ps_fail(error, PSPEC_ERROR_TOLERANCE,
                       "these rules have larger coefficients than was planned for, and standard "
                       "input cannot be read twice: give a file, or --engine pairs_direct");
    }
    return PSPEC_OK;
}

static void release(job *of) {
    ps_estimator_destroy(of->estimator);
    ps_rules_free(&of->rules);
    free(of->block);
    free(of->degrees);
    of->out->representer = of->setup.representer; /* it is the result's from here on */
    of->setup.representer = (ps_representer){0};
    ps_quadrature_setup_free(&of->setup);
}

pspec_status ps_quadrature_run(ps_quadrature_result *out, const ps_quadrature_question *question,
                               ps_error *error) {
    enum { MOST_RUNS = 3 };
    double mean_power = 0;
    double largest_share = 0;
    bool again = true;
    *out = (ps_quadrature_result){0};
    for (int i = 0; i < MOST_RUNS && again; i++) {
        ps_quadrature_free(out);
        *out = (ps_quadrature_result){.largest_condition = NAN, .was_replanned = i > 0};
        job of = {.question = question, .out = out, .rules = {.question = question}};
        const pspec_status status = run_once(&of, mean_power, largest_share, &again, error);
        if (status == PSPEC_OK && again) {
            const ps_accuracy found = ps_estimator_accuracy(of.estimator);
            mean_power = found.largest_mean_power;
            largest_share = found.largest_share;
        }
        release(&of);
        PS_TRY(status);
    }
    return again ? ps_fail(error, PSPEC_ERROR_TOLERANCE,
                           "no plan meets the tolerance %g with the powers that were measured",
                           question->tolerance)
                 : PSPEC_OK;
}

void ps_quadrature_free(ps_quadrature_result *result) {
    free(result->degrees);
    ps_representer_destroy(&result->representer);
    *result = (ps_quadrature_result){0};
}
