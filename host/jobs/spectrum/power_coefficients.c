/* Coefficients that a job is asked for: c_lm of the only set on the sphere, S(k) of every set on
 * the torus. */
#include "base/memory.h"
#include "engines/engine.h"
#include "jobs/spectrum/power_job_private.h"

#include <string.h>

/* Doubles of S(0), which is kept before the frequencies of the torus. */
static size_t dc_numbers(const ps_power_job *job) {
    return job->question->on_sphere ? 0 : 2;
}

/* Doubles of a realization that is kept. */
static size_t kept_numbers(const ps_power_job *job) {
    return dc_numbers(job) + ps_num_coefficients_at(&job->frequencies);
}

/* The plan counts the sets of a sampler, but of files only the first. */
static pspec_status require_memory(const ps_power_job *job, uint64_t num_sets, ps_error *error) {
    const uint64_t limit = job->question->limits.constraints.memory_limit;
    const double bytes = (double)num_sets * (double)kept_numbers(job) * sizeof(double);
    const double planned = job->plan.chosen->bytes;
    return limit == 0 || job->problem.num_realizations > 0 || planned + bytes <= (double)limit
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_MEMORY,
                         "coefficients of %llu sets take %.3g bytes; with the %.3g of the engine "
                         "that is above the memory limit of %.3g",
                         (unsigned long long)num_sets, bytes, planned, (double)limit);
}

static pspec_status keep(ps_power_job *job, size_t num_sets, ps_error *error) {
    void *memory = job->kept;
    PS_TRY(require_memory(job, num_sets, error));
    PS_TRY(ps_grow(&memory, &job->kept_room, num_sets, kept_numbers(job) * sizeof(double),
                   "coefficients", error));
    job->kept = memory;
    return PSPEC_OK;
}

pspec_status ps_power_coefficients_keep(void *payload, const double *coefficients,
                                        double weight_sum, ps_error *error) {
    ps_power_job *const job = payload;
    PS_TRY(keep(job, job->num_kept + 1, error));
    double *const out = job->kept + job->num_kept * kept_numbers(job);
    const size_t before = dc_numbers(job);
    if (before > 0) {
        out[0] = weight_sum;
        out[1] = 0;
    }
    memcpy(out + before, coefficients, (kept_numbers(job) - before) * sizeof *coefficients);
    job->num_kept++;
    return PSPEC_OK;
}

/* What can be refused is refused before the work: how many sets files have is not known yet. */
pspec_status ps_power_coefficients_begin(ps_power_job *job, ps_error *error) {
    if (job->question->harmonics == PS_NO_HARMONICS) {
        return PSPEC_OK;
    }
    if (!job->problem.keeps_coefficients && job->num_realizations > 1) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "coefficients are of one set, but there are %llu realizations",
                       (unsigned long long)job->num_realizations);
    }
    PS_TRY(PS_NEW(&job->coefficients, ps_num_coefficients_at(&job->frequencies), "the coefficients",
                  error));
    return !job->problem.keeps_coefficients || job->num_realizations == 0
               ? PSPEC_OK
               : keep(job, (size_t)job->num_realizations, error);
}

pspec_status ps_power_coefficients_check(const ps_power_job *job, uint64_t num_sets,
                                         ps_error *error) {
    return job->coefficients == NULL || job->problem.keeps_coefficients || num_sets <= 1
               ? PSPEC_OK
               : ps_fail(
                     error, PSPEC_ERROR_INVALID_ARGUMENT,
                     "coefficients are of one set, but there are more; --select-sets chooses one");
}
