#include "jobs/quadrature/quadrature_job.h"

#include "base/memory.h"
#include "math/pi.h"
#include "rules/distance_split.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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
                                  .observer = {ps_quadrature_hear, payload},
                                  .should_stop = should_stop,
                                  .payload = payload};
}

static pspec_status pass(void *payload, uint64_t num, uint64_t *passed, ps_error *error) {
    ps_quadrature_job *const job = payload;
    ps_passed_sets sets = {0};
    PS_TRY(ps_power_sets_skip(&job->rules.sets, num, tell, job, &sets, error));
    job->rules.num_read += sets.num;
    *passed = sets.num;
    return sets.longest > 0 ? ps_estimator_expect(job->runner.estimator, sets.longest, error)
                            : PSPEC_OK;
}

/* What decides on another plan is the largest of all rules, whoever has summed them. */
static pspec_status measure(void *payload, double *numbers, ps_error *error) {
    return ps_estimator_measure(((const ps_quadrature_job *)payload)->runner.estimator, numbers,
                                error);
}

static void take_largest(void *payload, const double *numbers) {
    ps_estimator_take_measured(((const ps_quadrature_job *)payload)->runner.estimator, numbers);
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

/* Members of a team have rows of all rules; a rule alone is done by each. */
static pspec_status begin_rows(ps_quadrature_job *job, ps_error *error) {
    const ps_quadrature_setup *const setup = &job->setup;
    ps_row_stream *const stream = &job->stream;
    ps_row_stream_free(stream);
    *stream = (ps_row_stream){.job = job,
                              .make = ps_quadrature_make_rows,
                              .pass = pass,
                              .row_bytes = ps_quadrature_row_bytes(job),
                              .batch = job->rules.capacity,
                              .total = setup->num_realizations,
                              .are_sampled = job->question->sampler != NULL,
                              .device = setup->device,
                              .chosen = setup->plan.chosen};
    if (setup->by_pairs) {
        stream->measure = measure;
        stream->take_largest = take_largest;
        stream->num_largest = PS_NUM_MEASURED;
    }
    ps_row_stream_join(stream,
                       setup->num_realizations == 1 ? NULL : &job->question->limits.checkpoint);
    return ps_row_stream_begin(stream, 0, error);
}

/* Nothing is averaged yet. */
static pspec_status begin(void *payload, ps_error *error) {
    ps_quadrature_job *const job = payload;
    ps_quadrature_degree *const degrees = job->result.degrees;
    free(job->result.weights);
    job->num_summed = 0;
    job->result = (ps_quadrature_result){.degrees = degrees};
    job->of_rules = (ps_rule_sums){0};
    if (job->question->observer.begin != NULL) {
        job->question->observer.begin(job->question->observer.payload, job);
    }
    memset(job->sums, 0, PS_RULE_SUMS * (job->setup.max_degree + 1) * sizeof(ps_sums));
    PS_TRY(ps_rules_allocate(&job->rules, choose_batch(job), error));
    return begin_rows(job, error);
}

static pspec_status give(void *payload, uint64_t most, size_t *num, ps_error *error) {
    ps_quadrature_job *const job = payload;
    PS_TRY(ps_row_stream_next(&job->stream, most, num, error));
    for (size_t i = 0; i < *num; i++) {
        ps_quadrature_take_row(job, ps_row_stream_row(&job->stream, i));
    }
    return PSPEC_OK;
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
    job->num_summed = ps_estimator_num_realizations(job->runner.estimator);
    return ps_row_stream_begin(&job->stream, num, error);
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
    PS_TRY(ps_row_stream_walk(&job->stream, snapshot, error));
    PS_TRY(job->question->observer.walk != NULL
               ? job->question->observer.walk(job->question->observer.payload, snapshot, error)
               : PSPEC_OK);
    return ps_rule_facts_walk(&job->result.facts, snapshot, error);
}

/* Sums over pairs are those of a batch, whose rules may not all have been heard of. */
static bool count(void *payload, uint64_t *num) {
    const ps_quadrature_job *const job = payload;
    *num = job->result.num_realizations;
    return !job->setup.by_pairs ||
           job->num_summed == ps_estimator_num_realizations(job->runner.estimator);
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
    return PS_NEW(&job->result.degrees, num, "degrees", error);
}

static pspec_status prepare(ps_quadrature_job *job, ps_error *error) {
    const ps_quadrature_question *const question = job->question;
    PS_TRY(ps_quadrature_setup_begin(&job->setup, question, error));
    PS_TRY(ps_rules_open(&job->rules, &job->shape, error));
    PS_TRY(ps_quadrature_setup_make(&job->setup, question, &job->shape, error));
    const ps_row_tape *const tape = question->limits.checkpoint.tape;
    return tape == NULL || job->setup.num_realizations != 1
               ? PSPEC_OK
               : ps_range_refuse_one(&tape->range, job->setup.needs.one_realization, error);
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
    ps_row_stream_free(&job->stream);
    ps_rules_free(&job->rules);
    free(job->block);
    job->block = NULL;
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
