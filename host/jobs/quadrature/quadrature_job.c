#include "jobs/quadrature/quadrature_job.h"

#include "base/memory.h"
#include "math/pi.h"
#include "rules/distance_split.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- one rule ------------------------------------------------------------------------------ */

static void add_degrees(ps_quadrature_job *job) {
    for (size_t l = 0; l <= job->setup.max_degree; l++) {
        const ps_degree_error *const degree = &job->degrees[l];
        ps_sums_add(&job->sums[PS_RULE_SUMS * l + PS_RULE_D2], degree->d2);
        ps_sums_add(&job->sums[PS_RULE_SUMS * l + PS_RULE_C2], degree->c2);
        ps_sums_add(&job->sums[PS_RULE_SUMS * l + PS_RULE_E2], degree->e2);
    }
}

/* The next rule of the batch, whose spectrum is c_l0 and c2. */
static pspec_status take_rule(ps_quadrature_job *job, const double *c_l0, const double *c2,
                              ps_error *error) {
    ps_quadrature_result *const out = &job->result;
    ps_rule_sums *const sums = &job->of_rules;
    const ps_rule_observer *const observer = &job->question->observer;
    const size_t r = job->num_told++;
    const ps_weighted_rule *const rule = &job->rules.batch[r];
    ps_spectral_error spectral;
    PS_TRY(ps_spectral_error_of(&job->setup.representer, job->setup.max_degree, c_l0, c2,
                                &rule->weight, job->degrees, &spectral, error));
    PS_TRY(observer->hear == NULL ? PSPEC_OK
                                  : observer->hear(observer->payload, out->num_realizations,
                                                   &job->rules.sets.patterns[r], job->degrees,
                                                   job->setup.max_degree, error));
    ps_rules_add_facts(&job->rules, r);
    const uint64_t num = ++out->num_realizations;
    add_degrees(job);
    ps_sums_add(&sums->squared, rule->kernel.squared);
    ps_sums_add(&sums->zonal, spectral.zonal);
    ps_sums_add(&sums->anisotropic, spectral.anisotropic);
    ps_sums_add(&sums->tail, rule->kernel.squared - spectral.zonal - spectral.anisotropic);
    ps_sums_add(&sums->weight_sum, rule->weight.sum);
    out->tail_model += (spectral.tail_model - out->tail_model) / (double)num;
    out->tail_bound += (spectral.tail_bound - out->tail_bound) / (double)num;
    out->numerical_bound = fmax(out->numerical_bound, rule->kernel.bound);
    out->weight_size = fmax(out->weight_size, rule->weight.size);
    return PSPEC_OK;
}

/* From sums over pairs. */
static void hear(void *payload, const double *zonal, const double *c2) {
    ps_quadrature_job *const job = payload;
    for (size_t l = 0; l <= job->setup.max_degree; l++) {
        job->c_l0[l] = sqrt((2 * (double)l + 1) / PS_FOUR_PI) * zonal[l];
    }
    if (job->told_status == PSPEC_OK) {
        job->told_status = take_rule(job, job->c_l0, c2, job->error);
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
    return take_rule(job, job->c_l0, job->c2, error);
}

/* ---- what the runner asks ------------------------------------------------------------------ */

static pspec_status tell(void *payload, ps_error *error) {
    const ps_quadrature_job *const job = payload;
    return ps_watch_tell(&job->question->watch, "realizations", job->result.num_realizations,
                         job->setup.num_realizations, NULL, error);
}

static bool should_stop(void *payload) {
    return tell(payload, NULL) != PSPEC_OK;
}

static pspec_status plan_again(void *payload, ps_error *error) {
    ps_quadrature_job *const job = payload;
    return ps_quadrature_setup_plan_again(&job->setup, job->question, ps_runner_held(&job->runner),
                                          error);
}

static ps_estimator_options choose_options(void *payload) {
    const ps_quadrature_job *const job = payload;
    const bool by_pairs = job->setup.by_pairs;
    return (ps_estimator_options){.batch = by_pairs ? 0 : 1,
                                  .normalization = by_pairs ? PSPEC_NORMALIZATION_PAIRS
                                                            : PSPEC_NORMALIZATION_EFFECTIVE,
                                  .want_c2 = by_pairs,
                                  .observer = {hear, payload},
                                  .should_stop = should_stop,
                                  .payload = payload};
}

/* Sets of a batch are in memory all at once; and a checkpoint comes between two batches, of which
 * the factors of optimal weights take some seconds at most, unless one takes longer. */
static size_t choose_batch(const ps_quadrature_job *job) {
    enum { MOST_BYTES = 64 << 20, NUMBERS = 5 }; /* coordinates, weight, kappa */
    const double most_steps = 1e11;
    const double num_points = (double)job->shape.num_points;
    const bool is_optimal = job->question->weights.kind == PS_WEIGHTS_OPTIMAL;
    const double factors = is_optimal ? most_steps / (num_points * num_points * num_points) : 1e9;
    const double fit = fmin(MOST_BYTES / (NUMBERS * sizeof(double)) / num_points, factors) + 1;
    const size_t batch =
        job->question->batch > 0 ? job->question->batch : ps_estimator_batch(job->runner.estimator);
    return (double)batch < fit ? batch : (size_t)fit;
}

/* Nothing is averaged yet. */
static pspec_status begin(void *payload, ps_error *error) {
    ps_quadrature_job *const job = payload;
    ps_quadrature_degree *const degrees = job->result.degrees;
    free(job->result.weights);
    job->result = (ps_quadrature_result){.degrees = degrees};
    job->of_rules = (ps_rule_sums){0};
    if (job->question->observer.begin != NULL) {
        job->question->observer.begin(job->question->observer.payload, job);
    }
    memset(job->sums, 0, PS_RULE_SUMS * (job->setup.max_degree + 1) * sizeof(ps_sums));
    return ps_rules_allocate(&job->rules, choose_batch(job), error);
}

static pspec_status sum_batch(ps_quadrature_job *job, ps_error *error) {
    job->num_told = 0;
    if (job->setup.by_pairs) {
        job->error = error;
        PS_TRY(ps_estimator_add(job->runner.estimator, job->rules.sets.patterns, job->rules.num,
                                error));
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

static pspec_status give(void *payload, uint64_t most, size_t *num, ps_error *error) {
    ps_quadrature_job *const job = payload;
    PS_TRY(ps_rules_next(&job->rules, &job->setup.representer, most, error));
    *num = job->rules.num;
    PS_TRY(*num > 0 ? keep_weights(job, error) : PSPEC_OK);
    return *num > 0 ? sum_batch(job, error) : PSPEC_OK;
}

/* e_l^2 matters where it is above the tolerance, and so does E^2. */
static pspec_status look_at_errors(void *payload, double *largest, ps_error *error) {
    ps_quadrature_job *const job = payload;
    ps_quadrature_result *const out = &job->result;
    const ps_quadrature_sums sums = {job->setup.max_degree + 1, job->sums + PS_RULE_E2,
                                     PS_RULE_SUMS, &job->of_rules.squared};
    const double unit = job->setup.representer.constant * out->weight_size * out->weight_size;
    (void)error;
    out->has_look = true;
    out->look =
        ps_quadrature_look(&sums, job->question->accuracy.tolerance * unit, out->num_realizations);
    *largest = out->look.corrected;
    return PSPEC_OK;
}

static pspec_status rewind_rules(void *payload, ps_error *error) {
    ps_quadrature_job *const job = payload;
    PS_TRY(ps_source_check_rewind(job->rules.sets.source,
                                  "these rules have larger coefficients than was planned for",
                                  error));
    return ps_rules_rewind(&job->rules, error);
}

static pspec_status skip(void *payload, uint64_t num, ps_error *error) {
    ps_quadrature_job *const job = payload;
    job->rules.num_read = num;
    return ps_power_sets_skip(&job->rules.sets, num, tell, job, error);
}

/* Numbers of the result, as far as they are not made of the sums. */
static pspec_status walk_result(ps_quadrature_result *out, ps_snapshot *snapshot, ps_error *error) {
    double *const numbers[] = {&out->tail_model, &out->tail_bound, &out->numerical_bound,
                               &out->weight_size};
    PS_TRY(ps_snapshot_counts(snapshot, "rules", &out->num_realizations, 1, error));
    return ps_snapshot_gather(snapshot, "result", numbers, sizeof numbers / sizeof numbers[0],
                              error);
}

static pspec_status walk(void *payload, ps_snapshot *snapshot, ps_error *error) {
    ps_quadrature_job *const job = payload;
    enum { NUMBERS = sizeof(ps_sums) / sizeof(double) };
    PS_TRY(walk_result(&job->result, snapshot, error));
    PS_TRY(ps_snapshot_doubles(snapshot, "rule_sums", (double *)&job->of_rules,
                               sizeof job->of_rules / sizeof(double), error));
    PS_TRY(ps_snapshot_doubles(snapshot, "degree_sums", (double *)job->sums,
                               NUMBERS * PS_RULE_SUMS * (job->setup.max_degree + 1), error));
    PS_TRY(job->question->observer.walk != NULL
               ? job->question->observer.walk(job->question->observer.payload, snapshot, error)
               : PSPEC_OK);
    return ps_rules_walk(&job->rules, snapshot, error);
}

/* Sums over pairs are those of a batch, whose rules may not all have been heard of. */
static bool count(void *payload, uint64_t *num) {
    const ps_quadrature_job *const job = payload;
    *num = job->result.num_realizations;
    return !job->setup.by_pairs || *num == ps_estimator_num_realizations(job->runner.estimator);
}

static const ps_runner_kind kind = {.plan = plan_again,
                                    .options = choose_options,
                                    .begin = begin,
                                    .tell = tell,
                                    .give = give,
                                    .look = look_at_errors,
                                    .rewind = rewind_rules,
                                    .skip = skip,
                                    .walk = walk,
                                    .count = count};

/* ---- all of it ---------------------------------------------------------------------------- */

static pspec_status allocate(ps_quadrature_job *job, ps_error *error) {
    enum { NUMBERS = sizeof(ps_sums) / sizeof(double) };
    const size_t num = job->setup.max_degree + 1;
    const size_t num_coefficients =
        job->setup.by_pairs ? 0 : ps_num_coefficients((int32_t)job->setup.max_degree);
    PS_TRY(PS_NEW(&job->block, num_coefficients + (2 + PS_RULE_SUMS * NUMBERS) * num,
                  "coefficients", error));
    job->coefficients = job->block;
    job->c_l0 = job->coefficients + num_coefficients;
    job->c2 = job->c_l0 + num;
    job->sums = (ps_sums *)(void *)(job->c2 + num);
    PS_TRY(PS_NEW(&job->degrees, num, "degrees", error));
    return PS_NEW(&job->result.degrees, num, "degrees", error);
}

static pspec_status prepare(ps_quadrature_job *job, ps_error *error) {
    const ps_quadrature_question *const question = job->question;
    PS_TRY(ps_quadrature_setup_begin(&job->setup, question, error));
    PS_TRY(ps_rules_open(&job->rules, &job->shape, error));
    return ps_quadrature_setup_make(&job->setup, question, &job->shape, error);
}

pspec_status ps_quadrature_job_create(ps_quadrature_job **out,
                                      const ps_quadrature_question *question, ps_error *error) {
    ps_quadrature_job *job = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&job, 1, "a job", error));
    job->question = question;
    job->rules.question = question;
    const pspec_status status = prepare(job, error);
    if (status != PSPEC_OK) {
        ps_quadrature_job_destroy(job);
        return status;
    }
    *out = job;
    return PSPEC_OK;
}

/* Points that lie together leave more pairs than those of samplers: where they are known they are
 * counted. */
static pspec_status count_distances(ps_quadrature_job *job, ps_error *error) {
    const ps_point_set *const set = &job->rules.sets.next;
    if (!job->rules.sets.has_next || set->dimension != PS_SPHERE_DIMENSION) {
        return PSPEC_OK;
    }
    const ps_rule rule = {.num_points = set->num_points, .points = set->points};
    return ps_distance_count_of(&rule, &job->setup.num_distances, error);
}

pspec_status ps_quadrature_job_rate(ps_quadrature_job *job, ps_error *error) {
    PS_TRY(count_distances(job, error));
    return ps_quadrature_setup_rate(&job->setup, job->question, error);
}

/* Errors of coefficients do not depend on powers: it is sums of squares that are off by more where
 * powers are larger than was expected. */
pspec_status ps_quadrature_job_run(ps_quadrature_job *job, ps_error *error) {
    ps_quadrature_setup *const setup = &job->setup;
    if (job->question->keeps_weights && job->shape.num_sets != 1) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "the weights of one rule are to be kept, but there are several sets");
    }
    PS_TRY(ps_plan_require(&setup->plan, &setup->problem, error));
    job->rules.most = setup->needs.one_realization ? 1 : UINT64_MAX;
    job->rules.device = setup->device;
    PS_TRY(allocate(job, error));
    job->runner = (ps_runner){
        .kind = &kind,
        .job = job,
        .problem = &setup->problem,
        .plan = &setup->plan,
        .device = setup->device,
        .standard_error = job->question->accuracy.standard_error,
        .is_sequential = setup->needs.sequential,
        .has_no_accuracy = !setup->by_pairs,
        .spec = job->question->keeps_weights ? NULL : &job->question->limits.checkpoint};
    PS_TRY(ps_runner_run(&job->runner, error));
    if (job->question->observer.end != NULL) {
        job->question->observer.end(job->question->observer.payload);
    }
    return ps_quadrature_collect(job, error);
}

void ps_quadrature_job_release(ps_quadrature_job *job) {
    ps_runner_free(&job->runner);
    ps_rules_free(&job->rules);
    free(job->block);
    free(job->degrees);
    job->block = NULL;
    job->degrees = NULL;
}

void ps_quadrature_job_destroy(ps_quadrature_job *job) {
    if (job == NULL) {
        return;
    }
    ps_quadrature_job_release(job);
    ps_text_free(&job->description);
    free(job->result.degrees);
    free(job->result.weights);
    ps_quadrature_setup_free(&job->setup);
    free(job);
}
