/* A range of the realizations of a job: planned as the whole job, and merged with others. */
#include "base/memory.h"
#include "jobs/spectrum/power_job_private.h"

/* The engine that the whole job has there: one for the largest set so far. */
static pspec_status pass(ps_power_job *job, uint64_t num, ps_passed_sets *passed, ps_error *error) {
    PS_TRY(ps_power_sets_pass(&job->sets, num, ps_power_job_tell, job, passed, error));
    return ps_estimator_expect(job->runner.estimator, passed->longest, error);
}

/* Sets of samplers begin there. */
pspec_status ps_power_range_begin(ps_power_job *job, ps_error *error) {
    const uint64_t first = job->question->range.first;
    ps_passed_sets passed = {0};
    if (first == 0 || job->question->sampler != NULL) {
        return PSPEC_OK;
    }
    PS_TRY(pass(job, first, &passed, error));
    return passed.num == first ? PSPEC_OK : ps_power_range_check_end(job, passed.num, error);
}

pspec_status ps_power_range_end(ps_power_job *job, ps_error *error) {
    ps_passed_sets behind = {0};
    job->num_all = job->num_realizations;
    if (job->question->range.end == 0 || job->question->sampler != NULL) {
        return PSPEC_OK;
    }
    PS_TRY(pass(job, UINT64_MAX, &behind, error));
    job->runner.accuracy = ps_estimator_accuracy(job->runner.estimator);
    job->num_all = job->question->range.first + job->runner.num_done + behind.num;
    return ps_power_range_check_end(job, job->num_all, error);
}

static pspec_status find(ps_power_job *job, const ps_spectrum_sums *sums, ps_error *error) {
    PS_TRY(ps_spectrum_sums_finish(sums, ps_estimator_bins(job->runner.estimator), &job->spectrum,
                                   error));
    if (sums->c2 == NULL) {
        return PSPEC_OK;
    }
    PS_TRY(PS_NEW(&job->c2, sums->frequencies.num, "C_l^2", error));
    ps_spectrum_sums_c2(sums, job->c2);
    return PSPEC_OK;
}

pspec_status ps_power_range_finish(ps_power_job *job, ps_error *error) {
    ps_spectrum_sums sums;
    PS_TRY(ps_estimator_sums(job->runner.estimator, &sums, error));
    const pspec_status status = find(job, &sums, error);
    ps_spectrum_sums_free(&sums);
    return status;
}
