#include "jobs/spectrum/power_job_private.h"

#include "base/memory.h"
#include "files/input_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- plan -------------------------------------------------------------------------------- */

static pspec_status open_device(ps_power_job *job, ps_error *error) {
    const ps_power_question *const question = job->question;
    return ps_limits_open_device(&question->limits, question->open_device,
                                 question->may_lack_device, &job->device, &job->owns_device, error);
}

/* Names that can be wrong are looked at before anything that takes long: sets are read, and rings
 * counted, in seconds. */
static pspec_status check_names(ps_power_job *job, ps_error *error) {
    const ps_power_question *question = job->question;
    PS_TRY(ps_plan_check_engine(question->limits.constraints.engine,
                                question->on_sphere ? PS_ON_SPHERE : PS_ON_TORUS, error));
    PS_TRY(ps_points_check(question->paths, question->num_paths, &question->point_options, error));
    PS_TRY(ps_input_check(question->weights.path, error));
    PS_TRY(ps_input_check(question->frequencies.path, error));
    return question->limits.device != NULL ? open_device(job, error) : PSPEC_OK;
}

/* The plan counts one set in the making; more are made at a time where the limit leaves room. */
static pspec_status plan(void *payload, ps_error *error) {
    ps_power_job *const job = payload;
    PS_TRY(ps_power_needs_plan(job, error));
    if (job->question->sampler != NULL && job->plan.chosen != NULL) {
        const double others = job->plan.chosen->bytes - job->problem.making_bytes;
        ps_source_leave(job->sets.source, others > 0 ? (uint64_t)others : 0);
    }
    return PSPEC_OK;
}

static pspec_status prepare(ps_power_job *job, ps_error *error) {
    const ps_power_question *question = job->question;
    PS_TRY(check_names(job, error));
    PS_TRY(ps_power_source_begin(job, error));
    if (question->weights.path != NULL) {
        PS_TRY(
            ps_power_sets_read_weights(&job->sets, question->weights.path, job->num_points, error));
    }
    PS_TRY(ps_power_frequencies(&job->frequencies, question, job->dimension,
                                (size_t)job->num_points, &job->sets.next.box, error));
    ps_power_needs_find(job);
    if (question->sampler != NULL) {
        PS_TRY(ps_power_source_sampler(job, error));
    }
    PS_TRY(ps_power_rows_check(job, error));
    const bool has_only_block_set = /* nothing tells beforehand that it is */
        question->on_sphere && !question->keeps_sets && question->harmonics != PS_NO_HARMONICS &&
        question->sampler == NULL && !job->sets.part.is_whole;
    job->problem = (ps_problem){
        .frequencies = &job->frequencies,
        .num_points = job->most_points,
        .planned_points = job->num_points,
        .num_realizations = has_only_block_set ? 1 : ps_power_needs_realizations(job),
        .harmonics = question->harmonics,
        .keeps_coefficients = question->keeps_sets || question->harmonics == PS_EXPONENTIALS,
        .fills_boxes = question->fills_boxes,
        .keeps_sums = question->keeps_sums,
        .has_weights = job->sets.next.has_weights || job->sets.weights != NULL,
        .block_points =
            question->sampler == NULL && !job->sets.part.is_whole ? job->sets.part.block_points : 0,
        .measure = question->wants_pair_sums ? PS_OF_PAIR_SUMS : PS_OF_AMPLITUDES,
        .floor = question->wants_pair_sums ? question->accuracy.floor : 0,
        .tolerance = ps_power_needs_tolerance(question),
        .num_weighted = question->num_weighted,
        .making_bytes = question->sampler != NULL ? ps_sampler_work_bytes(question->sampler) : 0,
    };
    PS_TRY(open_device(job, error));
    return plan(job, error);
}

pspec_status ps_power_job_create(ps_power_job **out, const ps_power_question *question,
                                 ps_error *error) {
    *out = NULL;
    ps_power_job *job = NULL;
    PS_TRY(PS_NEW(&job, 1, "a job", error));
    job->question = question;
    const pspec_status status = prepare(job, error);
    if (status != PSPEC_OK) {
        ps_power_job_destroy(job);
        return status;
    }
    *out = job;
    return PSPEC_OK;
}

void ps_power_job_release(ps_power_job *job) {
    ps_runner_free(&job->runner);
    ps_row_stream_free(&job->stream);
    ps_power_sets_release(&job->sets);
}

/* Results that every job has; what else there may be is of one run. */
static void free_results(ps_power_job *job) {
    ps_spectrum_free(&job->spectrum);
    ps_text_free(&job->description);
    free(job->c2);
    job->c2 = NULL;
}

void ps_power_job_destroy(ps_power_job *job) {
    if (job == NULL) {
        return;
    }
    ps_power_job_release(job);
    ps_device_sets_destroy(job->device_sets);
    free_results(job);
    free(job->coefficients);
    free(job->kept);
    free(job->weights);
    free(job->weighted);
    free(job->weighted_blocks);
    free(job->means);
    ps_frequencies_free(&job->frequencies);
    ps_power_sets_free(&job->sets);
    if (job->owns_device) {
        ps_device_close(job->device);
    }
    free(job);
}

/* ---- run --------------------------------------------------------------------------------- */

static ps_estimator_options choose_options(void *payload) {
    const ps_power_job *const job = payload;
    const ps_power_question *const question = job->question;
    const bool are_bins_enough = ps_power_rows_are_enough(job);
    return (ps_estimator_options){
        /* anisotropy needs them, too */
        .want_frequencies = !question->on_sphere && !are_bins_enough,
        .forms_bins = are_bins_enough,
        .makes_rows = ps_power_rows_are_shared(job),
        .no_frequency_errors = job->needs.no_frequency_errors,
        .self_check = !question->accuracy.no_self_check,
        .is_range = question->range.end > 0,
        .first = question->range.first,
        .normalization = question->normalization,
        .coefficients = job->coefficients,
        .keep = job->problem.keeps_coefficients ? ps_power_coefficients_keep : NULL,
        .want_c2 = question->wants_pair_sums,
        .weights = job->weights,
        .num_weighted = question->num_weighted,
        .should_stop = ps_power_job_should_stop,
        .payload = payload,
    };
}

static pspec_status look_at_errors(void *payload, double *largest, ps_error *error) {
    ps_power_job *const job = payload;
    const ps_bins *bins = ps_estimator_bins(job->runner.estimator);
    if (job->means == NULL) {
        PS_TRY(PS_NEW(&job->means, bins->num, "means of bins", error));
    }
    PS_TRY(ps_estimator_bin_means(job->runner.estimator, job->means, error));
    job->look =
        ps_sequential_find(bins, job->means, job->question->accuracy.floor, job->runner.num_done);
    job->has_look = true;
    *largest = job->look.corrected;
    return PSPEC_OK;
}

static pspec_status begin(void *payload, ps_error *error) {
    ps_power_job *const job = payload;
    job->num_kept = 0;
    PS_TRY(ps_power_range_begin(job, error));
    PS_TRY(ps_power_sets_allocate(&job->sets, ps_estimator_batch(job->runner.estimator), error));
    PS_TRY(ps_power_device_sets_begin(job, error));
    return ps_power_rows_are_shared(job) ? ps_power_rows_begin(job, 0, error) : PSPEC_OK;
}

static pspec_status give(void *payload, uint64_t most, size_t *num, ps_error *error) {
    ps_power_job *const job = payload;
    const uint64_t asked = ps_power_range_count(job);
    const uint64_t left = asked > 0 ? asked - job->runner.num_done : UINT64_MAX;
    most = most < left ? most : left;
    if (ps_power_rows_are_shared(job)) {
        return ps_power_rows_give(job, most, num, error);
    }
    PS_TRY(ps_power_job_add(job, most, num, error));
    return ps_power_coefficients_check(job, job->runner.num_done + *num, error);
}

/* The measured powers make the error larger than the tolerance, and there is a plan for them. */
static pspec_status rewind_sets(void *payload, ps_error *error) {
    ps_power_job *const job = payload;
    const ps_accuracy *const accuracy = &job->runner.accuracy;
    enum { BYTES = 160 };
    char why[BYTES];
    snprintf(why, sizeof why,
             "these sets have a mean power of %.3g, so what was planned has an error of %.2g, "
             "above the tolerance %g",
             accuracy->largest_mean_power, accuracy->error, job->problem.tolerance);
    PS_TRY(ps_source_check_rewind(job->sets.source, why, error));
    return ps_power_sets_rewind(&job->sets, error);
}

static pspec_status skip(void *payload, uint64_t num, ps_error *error) {
    ps_power_job *const job = payload;
    ps_passed_sets passed;
    if (ps_power_rows_are_shared(job)) {
        return ps_power_rows_begin(job, num, error);
    }
    PS_TRY(ps_power_job_pass(job, num, &passed, error));
    return ps_checkpoint_check_sets(passed.num, num, error);
}

/* There is nothing else that they change. */
static bool count(void *payload, uint64_t *num) {
    const ps_power_job *const job = payload;
    *num = ps_estimator_num_realizations(job->runner.estimator);
    return true;
}

static pspec_status walk(void *payload, ps_snapshot *snapshot, ps_error *error) {
    ps_power_job *const job = payload;
    return ps_power_rows_are_shared(job) ? ps_row_stream_walk(&job->stream, snapshot, error)
                                         : PSPEC_OK;
}

static const ps_runner_kind kind = {.plan = plan,
                                    .options = choose_options,
                                    .begin = begin,
                                    .tell = ps_power_job_tell,
                                    .give = give,
                                    .look = look_at_errors,
                                    .rewind = rewind_sets,
                                    .skip = skip,
                                    .walk = walk,
                                    .count = count};

static pspec_status find_c2(ps_power_job *job, ps_error *error) {
    const size_t num = job->frequencies.num;
    if (!job->question->wants_pair_sums) {
        return PSPEC_OK;
    }
    PS_TRY(PS_NEW(&job->c2, num, "C_l^2", error));
    ps_estimator_c2(job->runner.estimator, job->c2);
    for (size_t i = 0; job->needs.one_realization && i < num; i++) {
        job->c2[i].standard_error = 0;
    }
    return PSPEC_OK;
}

static pspec_status weigh(ps_power_job *job, ps_error *error) {
    const ps_power_question *const question = job->question;
    const size_t num = question->num_weighted;
    if (num == 0) {
        return PSPEC_OK;
    }
    PS_TRY(PS_NEW(&job->weights, num * job->frequencies.num, "weights of frequencies", error));
    PS_TRY(PS_NEW(&job->weighted, num, "weighted sums", error));
    PS_TRY(PS_NEW(&job->weighted_blocks, num, "weighted sums", error));
    return question->weigh(question->weigh_payload, &job->frequencies, job->weights, error);
}

static pspec_status find_weighted(ps_power_job *job, ps_error *error) {
    const size_t num = job->question->num_weighted;
    if (num == 0) {
        return PSPEC_OK;
    }
    PS_TRY(ps_estimator_weighted(job->runner.estimator, job->weighted, error));
    memcpy(job->weighted_blocks, ps_estimator_weighted_blocks(job->runner.estimator),
           num * sizeof *job->weighted_blocks);
    for (size_t i = 0; job->needs.one_realization && i < num; i++) {
        job->weighted[i].standard_error = 0;
    }
    return PSPEC_OK;
}

/* Realizations that a deterministic one stands for: all, or as few as a standard error takes. */
static uint64_t count_repeats(const ps_power_question *question) {
    const uint64_t all = question->num_realizations;
    return question->accuracy.standard_error > 0 && all > PS_LEAST_REALIZATIONS
               ? PS_LEAST_REALIZATIONS
               : all;
}

static pspec_status finish(ps_power_job *job, ps_error *error) {
    ps_estimator_describe(job->runner.estimator, &job->description);
    PS_TRY(ps_text_check(&job->description, error));
    if (job->question->range.end > 0) {
        return ps_power_range_finish(job, error);
    }
    PS_TRY(ps_estimator_spectrum(job->runner.estimator, &job->spectrum, error));
    PS_TRY(find_c2(job, error));
    PS_TRY(find_weighted(job, error));
    if (job->needs.one_realization) {
        ps_spectrum_repeat(&job->spectrum, count_repeats(job->question));
    }
    return PSPEC_OK;
}

pspec_status ps_power_job_run(ps_power_job *job, ps_error *error) {
    PS_TRY(ps_plan_require(&job->plan, &job->problem, error));
    PS_TRY(ps_frequencies_enumerate(&job->frequencies, error));
    PS_TRY(ps_power_coefficients_begin(job, error));
    PS_TRY(weigh(job, error));
    const bool keeps_more = /* of every set, than a checkpoint has */
        job->problem.keeps_coefficients || job->coefficients != NULL;
    job->runner = (ps_runner){.kind = &kind,
                              .estimator = job->runner.estimator,
                              .job = job,
                              .problem = &job->problem,
                              .plan = &job->plan,
                              .device = job->device,
                              .standard_error = job->question->accuracy.standard_error,
                              .is_sequential = job->needs.sequential,
                              .spec = keeps_more ? NULL : &job->question->limits.checkpoint,
                              .is_part = job->question->range.end > 0,
                              .replan = job->question->replan};
    PS_TRY(ps_runner_run(&job->runner, error));
    PS_TRY(ps_power_range_end(job, error));
    return finish(job, error);
}

pspec_status ps_power_job_sums(ps_power_job *job, ps_spectrum_sums *out, ps_error *error) {
    PS_TRY(ps_estimator_sums(job->runner.estimator, out, error));
    out->num_equal = job->needs.one_realization ? job->spectrum.num_realizations : 0;
    out->num_all = job->question->range.end > 0 ? job->num_all : 0;
    out->tolerance = job->problem.tolerance;
    out->planned = (ps_replan){job->runner.num_replans, job->problem.expected_power,
                               job->problem.weight_share, job->problem.num_points};
    return PSPEC_OK;
}

/* ---- again ------------------------------------------------------------------------------- */

/* Nothing that was measured, or that a range has passed over, has changed the plan or the engine,
 * and sets are all that is read. The question that the job had may be gone. */
static bool can_renew(const ps_power_job *job, const ps_power_question *question) {
    return job->runner.estimator != NULL && job->runner.num_replans == 0 &&
           job->runner.accuracy.largest_points <= job->most_points &&
           question->harmonics == PS_NO_HARMONICS && !question->keeps_first &&
           question->range.end == 0 && question->num_weighted == 0 &&
           question->weights.path == NULL &&
           ps_given_sets_are_all(&question->point_options.given, question->paths,
                                 question->num_paths);
}

pspec_status ps_power_job_renew(ps_power_job *job, const ps_power_question *question,
                                bool *is_ready, ps_error *error) {
    const unsigned dimension = job->dimension;
    const uint64_t num_points = job->num_points;
    const uint64_t num_realizations = job->num_realizations;
    *is_ready = false;
    if (!can_renew(job, question)) {
        return PSPEC_OK;
    }
    free_results(job);
    ps_power_sets_free(&job->sets);
    job->question = question;
    PS_TRY(ps_power_source_begin(job, error));
    *is_ready = job->dimension == dimension && job->num_points == num_points &&
                job->num_realizations == num_realizations && job->sets.part.is_whole &&
                job->sets.next.has_weights == job->problem.has_weights &&
                job->problem.block_points == 0;
    return PSPEC_OK;
}
