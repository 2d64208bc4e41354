/* Sets of cheap samplers whose points the device makes (sets/device_sets.h). */
#include "jobs/spectrum/power_job_private.h"

/* Nobody else looks at the points: no picture of the first set, no weights, no coefficients. */
bool ps_power_job_leaves_points(const ps_power_job *job) {
    const ps_power_question *const question = job->question;
    const ps_candidate *const chosen = job->plan.chosen;
    return question->sampler != NULL && chosen != NULL && chosen->engine->takes_sets &&
           !question->keeps_first && question->harmonics == PS_NO_HARMONICS &&
           !question->keeps_sets && !question->wants_pair_sums && !question->is_turned &&
           job->sets.weights == NULL &&
           ps_device_sets_serve(&job->request, ps_device_get_limits(job->device));
}

pspec_status ps_power_device_sets_begin(ps_power_job *job, ps_error *error) {
    if (!ps_power_job_leaves_points(job)) {
        return PSPEC_OK;
    }
    if (job->device_sets == NULL) {
        PS_TRY(ps_device_sets_create(&job->device_sets, &job->request, job->device, error));
    }
    for (size_t i = 0; i < job->sets.capacity; i++) {
        job->sets.patterns[i] = (pspec_pattern){.dimension = job->request.dimension,
                                                .num_points = job->request.num_points};
    }
    return ps_estimator_use_sets(job->runner.estimator, job->device_sets, error);
}

pspec_status ps_power_device_sets_give(ps_power_job *job, uint64_t most, size_t *num,
                                       ps_error *error) {
    const size_t capacity = job->sets.capacity;
    *num = most < capacity ? (size_t)most : capacity;
    return ps_estimator_add(job->runner.estimator, job->sets.patterns, *num, error);
}
