/* Which realizations are those of a range. */
#include "jobs/spectrum/power_job_private.h"

#include <stdio.h>

static bool is_range(const ps_power_job *job) {
    return job->question->range.end > 0;
}

pspec_status ps_power_range_check_end(const ps_power_job *job, uint64_t all, ps_error *error) {
    enum { BYTES = 128 };
    char why[BYTES];
    const ps_realization_range *const range = &job->question->range;
    const uint64_t end = range->end;
    PS_TRY(ps_range_check_end(range, all, job->question->sampler != NULL, error));
    if (end % PS_SUM_BLOCK != 0 && end != all) {
        snprintf(why, sizeof why, "must end at a multiple of %d or with the last realization, %llu",
                 PS_SUM_BLOCK, (unsigned long long)all);
        return ps_range_refuse(range, why, error);
    }
    return PSPEC_OK;
}

pspec_status ps_power_range_check(const ps_power_job *job, ps_error *error) {
    if (!is_range(job)) {
        return PSPEC_OK;
    }
    return job->needs.one_realization ? ps_range_refuse_one(&job->question->range, true, error)
                                      : ps_power_range_check_end(job, job->num_realizations, error);
}

uint64_t ps_power_range_count(const ps_power_job *job) {
    const ps_realization_range *const range = &job->question->range;
    return is_range(job) ? range->end - range->first : job->num_realizations;
}
