/* Rows of rules: made of points and weights, and added up. */
#include "jobs/quadrature/quadrature_job.h"

#include "base/memory.h"
#include "math/pi.h"

#include <math.h>
#include <string.h>

/* What a rule has, which degrees[L + 1] and the row of the observer follow. */
typedef struct rule_row {
    ps_kernel_error kernel;
    double zonal, anisotropic, tail_model, tail_bound;
    double weight_sum, weight_size;
    ps_rule_facts facts;
    ps_degree_error degrees[];
} rule_row;

size_t ps_quadrature_row_bytes(const ps_quadrature_job *job) {
    return sizeof(rule_row) + (job->setup.max_degree + 1) * sizeof(ps_degree_error) +
           job->question->observer.row_bytes;
}

static void *observed(const ps_quadrature_job *job, const rule_row *row) {
    return (void *)(row->degrees + job->setup.max_degree + 1);
}

/* ---- made ---------------------------------------------------------------------------------- */

/* Of the next rule of the batch, whose spectrum is c_l0 and c2. */
static pspec_status make_row(ps_quadrature_job *job, const double *c_l0, const double *c2,
                             ps_error *error) {
    const ps_rule_observer *const observer = &job->question->observer;
    const size_t last = job->setup.max_degree;
    const size_t r = job->num_told++;
    const ps_weighted_rule *const rule = &job->rules.batch[r];
    rule_row *const row = (void *)(job->rows + r * ps_quadrature_row_bytes(job));
    ps_spectral_error spectral;
    PS_TRY(ps_spectral_error_of(&job->setup.representer, last, c_l0, c2, &rule->weight,
                                row->degrees, &spectral, error));
    row->kernel = rule->kernel;
    row->zonal = spectral.zonal;
    row->anisotropic = spectral.anisotropic;
    row->tail_model = spectral.tail_model;
    row->tail_bound = spectral.tail_bound;
    row->weight_sum = rule->weight.sum;
    row->weight_size = rule->weight.size;
    row->facts = rule->facts;
    return observer->hear != NULL
               ? observer->hear(observer->payload, job->first + r, &job->rules.sets.patterns[r],
                                row->degrees, last, observed(job, row), error)
               : PSPEC_OK;
}

/* From sums over pairs. */
void ps_quadrature_hear(void *payload, const double *zonal, const double *c2) {
    ps_quadrature_job *const job = payload;
    for (size_t l = 0; l <= job->setup.max_degree; l++) {
        job->c_l0[l] = sqrt((2 * (double)l + 1) / PS_FOUR_PI) * zonal[l];
    }
    if (job->told_status == PSPEC_OK) {
        job->told_status = make_row(job, job->c_l0, c2, job->error);
    }
}

/* From coefficients. */
static pspec_status sum_coefficients(ps_quadrature_job *job, const pspec_pattern *pattern,
                                     ps_error *error) {
    const size_t last = job->setup.max_degree;
    PS_TRY(ps_estimator_coefficients(job->runner.estimator, pattern, PS_SPHERICAL_HARMONICS,
                                     job->coefficients, error));
    for (size_t l = 0; l <= last; l++) {
        job->c_l0[l] = job->coefficients[2 * l];
        job->c2[l] = 0;
        for (size_t m = 1; m <= l; m++) {
            const double *const c = job->coefficients + 2 * (m * (2 * last + 1 - m) / 2 + l);
            job->c2[l] += 2 * (c[0] * c[0] + c[1] * c[1]);
        }
    }
    return make_row(job, job->c_l0, job->c2, error);
}

static pspec_status sum_batch(ps_quadrature_job *job, ps_error *error) {
    ps_estimator *const estimator = job->runner.estimator;
    job->num_told = 0;
    if (job->setup.by_pairs) {
        ps_estimator_go_to(estimator, job->first);
        job->error = error;
        PS_TRY(ps_estimator_add(estimator, job->rules.sets.patterns, job->rules.num, error));
        job->num_summed = ps_estimator_num_realizations(estimator);
        return job->told_status;
    }
    for (size_t r = 0; r < job->rules.num; r++) {
        PS_TRY(sum_coefficients(job, &job->rules.sets.patterns[r], error));
    }
    return PSPEC_OK;
}

/* Of the points as they were given: those that were dropped have none. */
static pspec_status keep_weights(ps_quadrature_job *job, ps_error *error) {
    const ps_rules *const rules = &job->rules;
    const ps_weighted_rule *const rule = &rules->batch[0];
    if (!job->question->keeps_weights) {
        return PSPEC_OK;
    }
    PS_TRY(PS_NEW(&job->result.weights, rules->num_given, "weights", error));
    job->result.num_weights = rules->num_given;
    for (size_t j = 0; j < rules->sets.sets[0].num_points; j++) {
        job->result.weights[rules->places[j]] = rule->weights[j];
    }
    return PSPEC_OK;
}

pspec_status ps_quadrature_make_rows(void *payload, uint64_t first, size_t most, void *rows,
                                     size_t *num, ps_error *error) {
    ps_quadrature_job *const job = payload;
    job->first = first;
    job->rows = rows;
    PS_TRY(ps_rules_next(&job->rules, &job->setup.representer, most, error));
    *num = job->rules.num;
    PS_TRY(*num > 0 ? keep_weights(job, error) : PSPEC_OK);
    return *num > 0 ? sum_batch(job, error) : PSPEC_OK;
}

/* ---- added up ------------------------------------------------------------------------------ */

static void add_degrees(ps_quadrature_job *job, const ps_degree_error *degrees) {
    for (size_t l = 0; l <= job->setup.max_degree; l++) {
        ps_sums *const sums = &job->sums[PS_RULE_SUMS * l];
        ps_sums_add(&sums[PS_RULE_D2], degrees[l].d2);
        ps_sums_add(&sums[PS_RULE_C2], degrees[l].c2);
        ps_sums_add(&sums[PS_RULE_E2], degrees[l].e2);
    }
}

void ps_quadrature_take_row(ps_quadrature_job *job, const void *rule) {
    const rule_row *const row = rule;
    const ps_rule_observer *const observer = &job->question->observer;
    const double squared = row->kernel.squared;
    ps_quadrature_result *const out = &job->result;
    ps_rule_sums *const sums = &job->of_rules;
    const uint64_t num = ++out->num_realizations;
    ps_rule_facts_join(&out->facts, &row->facts);
    add_degrees(job, row->degrees);
    ps_sums_add(&sums->squared, squared);
    ps_sums_add(&sums->zonal, row->zonal);
    ps_sums_add(&sums->anisotropic, row->anisotropic);
    ps_sums_add(&sums->tail, squared - row->zonal - row->anisotropic);
    ps_sums_add(&sums->weight_sum, row->weight_sum);
    out->tail_model += (row->tail_model - out->tail_model) / (double)num;
    out->tail_bound += (row->tail_bound - out->tail_bound) / (double)num;
    out->numerical_bound = fmax(out->numerical_bound, row->kernel.bound);
    out->weight_size = fmax(out->weight_size, row->weight_size);
    if (observer->take != NULL) {
        observer->take(observer->payload, observed(job, row));
    }
}
