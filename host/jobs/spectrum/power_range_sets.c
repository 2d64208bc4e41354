/* A range of the realizations of a job: planned as the whole job, and merged with others. */
#include "base/memory.h"
#include "jobs/spectrum/power_job_private.h"

/* Sets of samplers begin there. */
pspec_status ps_power_range_begin(ps_power_job *job, ps_error *error) {
    const uint64_t first = job->question->range.first;
    uint64_t passed = 0;
    if (job->question->sampler == NULL && first > 0) {
        PS_TRY(ps_power_sets_pass(&job->sets, first, ps_power_job_tell, job, &passed, error));
    }
    return passed == first || job->question->sampler != NULL
               ? PSPEC_OK
               : ps_power_range_check_end(job, passed, error);
}

pspec_status ps_power_range_end(ps_power_job *job, ps_error *error) {
    uint64_t behind = 0;
    job->num_all = job->num_realizations;
    if (job->question->range.end == 0 || job->question->sampler != NULL) {
        return PSPEC_OK;
    }
    PS_TRY(ps_power_sets_pass(&job->sets, UINT64_MAX, ps_power_job_tell, job, &behind, error));
    job->num_all = job->question->range.first + job->runner.num_done + behind;
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
