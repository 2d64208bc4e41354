/* Inside of ps_power_job, for the files power_job*.c only. */
#ifndef PS_JOBS_SPECTRUM_POWER_JOB_PRIVATE_H
#define PS_JOBS_SPECTRUM_POWER_JOB_PRIVATE_H

#include "jobs/parts/runner.h"
#include "jobs/spectrum/power_job.h"
#include "jobs/spectrum/power_sets.h"

struct ps_power_job {
    const ps_power_question *question;
    ps_power_sets sets; /* of files, the first is read for planning */
    unsigned dimension;
    uint64_t num_points; /* of the first set */
    ps_frequencies frequencies;
    ps_needs needs;
    ps_sampler_request request; /* what is really sampled: without a shift nobody needs */
    uint64_t num_realizations;  /* that are computed; 0: unknown */
    ps_problem problem;
    ps_device *device;
    bool owns_device;
    ps_plan plan;
    ps_runner runner;
    ps_spectrum spectrum;
    double *coefficients;
    ps_mean *c2;
    ps_text description;
    ps_mean *means; /* [all bins] for looks at the standard error */
    ps_sequential_look look;
};

#endif
