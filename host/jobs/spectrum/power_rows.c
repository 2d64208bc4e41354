/* Realizations of a job that a team shares: rows of the powers of their bins (jobs/rows). */
#include "jobs/spectrum/power_job_private.h"

bool ps_power_rows_are_enough(const ps_power_job *job) {
    const ps_power_question *const question = job->question;
    return question->bins_alone && question->frequencies.per_ring == 0 &&
           (question->on_sphere || job->dimension > 1);
}

bool ps_power_rows_are_shared(const ps_power_job *job) {
    const ps_checkpoint_spec *const spec = &job->question->limits.checkpoint;
    return ps_power_rows_are_enough(job) && (spec->team != NULL || spec->tape != NULL) &&
           job->num_realizations != 1;
}

pspec_status ps_power_rows_check(const ps_power_job *job, ps_error *error) {
    const ps_row_tape *const tape = job->question->limits.checkpoint.tape;
    if (tape == NULL || ps_power_rows_are_shared(job)) {
        return PSPEC_OK;
    }
    return job->num_realizations == 1
               ? ps_range_refuse_one(&tape->range, job->needs.one_realization, error)
               : ps_range_refuse(&tape->range,
                                 "is of sums over bins, and in one dimension there are none",
                                 error);
}

/* ---- what the stream asks -------------------------------------------------------------------- */

static pspec_status make(void *payload, uint64_t first, size_t most, void *rows, size_t *num,
                         ps_error *error) {
    ps_power_job *const job = payload;
    const uint64_t all = job->num_realizations;
    const uint64_t left = all > 0 ? all - first : UINT64_MAX;
    ps_estimator_begin_rows(job->runner.estimator, first, rows);
    PS_TRY(ps_power_job_add(job, left < most ? left : most, num, error));
    return ps_estimator_settle(job->runner.estimator, error);
}

static pspec_status pass(void *payload, uint64_t num, uint64_t *passed, ps_error *error) {
    ps_power_job *const job = payload;
    ps_passed_sets sets;
    PS_TRY(ps_power_job_pass(job, num, &sets, error));
    *passed = sets.num;
    return sets.longest > 0 ? ps_estimator_expect(job->runner.estimator, sets.longest, error)
                            : PSPEC_OK;
}

static pspec_status measure(void *payload, double *numbers, ps_error *error) {
    return ps_estimator_measure(((const ps_power_job *)payload)->runner.estimator, numbers, error);
}

static void take_largest(void *payload, const double *numbers) {
    ps_estimator_take_measured(((const ps_power_job *)payload)->runner.estimator, numbers);
}

/* ---- what the runner asks -------------------------------------------------------------------- */

pspec_status ps_power_rows_begin(ps_power_job *job, uint64_t num, ps_error *error) {
    ps_row_stream *const stream = &job->stream;
    ps_row_stream_free(stream);
    *stream = (ps_row_stream){.job = job,
                              .make = make,
                              .pass = pass,
                              .measure = measure,
                              .take_largest = take_largest,
                              .num_largest = PS_NUM_MEASURED,
                              .row_bytes = ps_estimator_row_bytes(job->runner.estimator),
                              .batch = job->sets.capacity,
                              .total = job->num_realizations,
                              .are_sampled = job->question->sampler != NULL,
                              .keeps_first = !job->question->accuracy.no_self_check,
                              .device = job->device,
                              .chosen = job->plan.chosen};
    ps_row_stream_join(stream, &job->question->limits.checkpoint);
    return ps_row_stream_begin(stream, num, error);
}

pspec_status ps_power_rows_give(ps_power_job *job, uint64_t most, size_t *num, ps_error *error) {
    PS_TRY(ps_row_stream_next(&job->stream, most, num, error));
    for (size_t i = 0; i < *num; i++) {
        PS_TRY(ps_estimator_take_row(job->runner.estimator, ps_row_stream_row(&job->stream, i),
                                     error));
    }
    return PSPEC_OK;
}
