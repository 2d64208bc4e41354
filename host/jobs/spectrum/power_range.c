/* Which realizations are those of a range. */
#include "jobs/spectrum/power_job_private.h"

#include <stdio.h>

static bool is_range(const ps_power_job *job) {
    return job->question->range.end > 0;
}

static pspec_status fail(const ps_power_job *job, const char *why, ps_error *error) {
    const ps_realization_range *const range = &job->question->range;
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "--range %llu:%llu %s",
                   (unsigned long long)range->first, (unsigned long long)range->end, why);
}

pspec_status ps_power_range_check_end(const ps_power_job *job, uint64_t all, ps_error *error) {
    enum { BYTES = 128 };
    char why[BYTES];
    const uint64_t end = job->question->range.end;
    if (end > all) {
        snprintf(why, sizeof why, "goes beyond the realizations, of which there %s %llu%s",
                 all == 1 ? "is" : "are", (unsigned long long)all,
                 job->question->sampler != NULL ? " (--realizations)" : "");
        return fail(job, why, error);
    }
    if (end % PS_SUM_BLOCK != 0 && end != all) {
        snprintf(why, sizeof why, "must end at a multiple of %d or with the last realization, %llu",
                 PS_SUM_BLOCK, (unsigned long long)all);
        return fail(job, why, error);
    }
    return PSPEC_OK;
}

pspec_status ps_power_range_check(const ps_power_job *job, ps_error *error) {
    if (!is_range(job)) {
        return PSPEC_OK;
    }
    return job->needs.one_realization
               ? fail(job,
                      "has no use: all realizations of the sampler have the same powers, and one "
                      "stands for all (--no-skip computes them)",
                      error)
               : ps_power_range_check_end(job, job->num_realizations, error);
}

uint64_t ps_power_range_count(const ps_power_job *job) {
    const ps_realization_range *const range = &job->question->range;
    return is_range(job) ? range->end - range->first : job->num_realizations;
}
