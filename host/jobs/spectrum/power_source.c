/* Where the sets of a power job come from, and who asks while they come. */
#include "jobs/spectrum/power_job_private.h"

static void turn(ps_power_job *job) {
    if (job->question->is_turned) {
        ps_source_turn(job->sets.source);
    }
}

pspec_status ps_power_job_tell(void *payload, ps_error *error) {
    const ps_power_job *const job = payload;
    return ps_watch_tell(&job->question->watch, "realizations", job->runner.num_done,
                         ps_power_range_count(job), NULL, error);
}

bool ps_power_job_should_stop(void *payload) {
    return ps_power_job_tell(payload, NULL) != PSPEC_OK;
}

static int ask_while_sampling(const ps_watch_report *report, void *payload) {
    (void)report;
    return ps_power_job_should_stop(payload);
}

pspec_status ps_power_source_sampler(ps_power_job *job, ps_error *error) {
    const ps_power_question *question = job->question;
    job->request = *question->sampler;
    job->request.homogenize = question->sampler->homogenize && !job->needs.no_shift;
    job->num_realizations = job->needs.one_realization ? 1 : question->num_realizations;
    ps_sets_options options = ps_limits_sets(&question->limits, question->accuracy.no_skip);
    options.first = question->range.first;
    PS_TRY(ps_power_range_check(job, error));
    PS_TRY(ps_source_sampler(&job->sets.source, &job->request, ps_power_range_count(job), &options,
                             &(ps_watch){ask_while_sampling, job}, error));
    turn(job);
    return PSPEC_OK;
}

/* A quarter of a limit that was typed leaves room for what computes with the points. */
static uint64_t choose_whole_bytes(const ps_power_question *question) {
    const uint64_t limit = question->limits.constraints.memory_limit / 4;
    const uint64_t asked =
        question->whole_bytes > 0 ? question->whole_bytes : PS_SOURCE_WHOLE_BYTES;
    return limit > 0 && limit < asked ? limit : asked;
}

static pspec_status open_files(ps_power_job *job, ps_error *error) {
    const ps_power_question *question = job->question;
    const uint64_t whole_bytes = choose_whole_bytes(question);
    ps_source_options options = {.points = question->point_options,
                                 .whole_bytes = whole_bytes,
                                 .kept_bytes = whole_bytes,
                                 .should_stop = ps_power_job_should_stop,
                                 .payload = job};
    options.points.may_lend = !question->is_turned;
    job->num_realizations = question->num_sets;
    job->sets.source = question->source;
    job->sets.is_borrowed = question->source != NULL;
    if (!job->sets.is_borrowed) {
        PS_TRY(ps_source_files(&job->sets.source, question->paths, question->num_paths, &options,
                               error));
    }
    turn(job);
    return PSPEC_OK;
}

/* A set alone has ways of its own. Nobody waits for a second set of a stream that is not kept, nor
 * for a second file. */
static pspec_status count_sets(ps_power_job *job, ps_error *error) {
    const ps_power_question *question = job->question;
    bool is_last = false;
    if (job->num_realizations == 0) {
        job->num_realizations = ps_source_num_sets(job->sets.source);
    }
    if (job->num_realizations == 0 && question->source == NULL && question->num_paths == 1 &&
        ps_source_can_rewind(job->sets.source)) {
        PS_TRY(ps_power_sets_is_last(&job->sets, &is_last, error));
        job->num_realizations = is_last ? 1 : 0;
    }
    return PSPEC_OK;
}

pspec_status ps_power_source_begin(ps_power_job *job, ps_error *error) {
    const ps_power_question *question = job->question;
    bool has_set = false;
    job->sets.keeps_first = question->keeps_first;
    if (question->sampler != NULL) {
        job->dimension = question->sampler->dimension;
        job->num_points = question->sampler->num_points;
        job->most_points = ps_sampler_most_points(question->sampler);
        return PSPEC_OK;
    }
    PS_TRY(open_files(job, error));
    PS_TRY(ps_power_sets_peek(&job->sets, &has_set, error));
    job->sets.looks_at_axes = !question->on_sphere && job->sets.next.box.num_axes == 0;
    if (!has_set) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "there are no point sets to take a spectrum of");
    }
    job->dimension = job->sets.next.dimension;
    job->num_points = ps_power_sets_next_points(&job->sets);
    job->most_points = job->num_points;
    return count_sets(job, error);
}

/* ---- the next of them ------------------------------------------------------------------------ */

pspec_status ps_power_job_add(ps_power_job *job, uint64_t most, size_t *num, ps_error *error) {
    ps_power_sets *const sets = &job->sets;
    ps_estimator *const estimator = job->runner.estimator;
    *num = 0;
    if (most == 0) {
        return PSPEC_OK;
    }
    if (ps_power_job_leaves_points(job)) {
        return ps_power_device_sets_give(job, most, num, error);
    }
    PS_TRY(ps_power_sets_fill(sets, ps_estimator_can_stream(estimator), most, num, error));
    if (*num == 0 && sets->has_next) {
        *num = 1;
        return ps_power_sets_stream(sets, estimator, job->question->normalization, error);
    }
    return ps_estimator_add(estimator, sets->patterns, *num, error);
}

/* What the device makes depends on the number of a realization, which the estimator counts. */
pspec_status ps_power_job_pass(ps_power_job *job, uint64_t num, ps_passed_sets *passed,
                               ps_error *error) {
    *passed = (ps_passed_sets){.num = num};
    return ps_power_job_leaves_points(job)
               ? PSPEC_OK
               : ps_power_sets_skip(&job->sets, num, ps_power_job_tell, job, passed, error);
}
