/* Inside of ps_power_job, for the files power_job*.c only. */
#ifndef PS_JOBS_SPECTRUM_POWER_JOB_PRIVATE_H
#define PS_JOBS_SPECTRUM_POWER_JOB_PRIVATE_H

#include "jobs/runner.h"
#include "jobs/spectrum/power_job.h"
#include "jobs/spectrum/power_sets.h"

struct ps_power_job {
    const ps_power_question *question;
    ps_power_sets sets;          /* of files, the first is read for planning */
    ps_device_sets *device_sets; /* instead, where the device makes them; else NULL */
    unsigned dimension;
    uint64_t num_points;  /* of the first set, or that a sampler is asked for */
    uint64_t most_points; /* of any set, as far as it is known */
    ps_frequencies frequencies;
    ps_needs needs;
    char useless[48];           /* the skip of frequencies that do not matter; "": there is none */
    ps_sampler_request request; /* what is really sampled: without a shift nobody needs */
    uint64_t num_realizations;  /* that are computed; 0: unknown */
    ps_problem problem;
    ps_device *device;
    bool owns_device;
    ps_plan plan;
    ps_runner runner;
    ps_spectrum spectrum;
    double *coefficients; /* of a realization */
    /* On the torus [num_kept][1 + number of frequencies][2], S(0) first; room for so many */
    double *kept;
    size_t num_kept, kept_room;
    ps_mean *c2;
    double *weights;                /* [num_weighted][number of frequencies] */
    ps_mean *weighted;              /* [num_weighted] */
    ps_block_sums *weighted_blocks; /* the same */
    ps_text description;
    ps_mean *means; /* [all bins] for looks at the standard error */
    ps_sequential_look look;
};

/* Does the device make the sampler's points, as the plan is? */
bool ps_power_job_leaves_points(const ps_power_job *job);
/* Then tells the estimator, before the first realization; and ps_runner_kind.give. */
pspec_status ps_power_device_sets_begin(ps_power_job *job, ps_error *error) PS_MUST_CHECK;
pspec_status ps_power_device_sets_give(ps_power_job *job, uint64_t most, size_t *num,
                                       ps_error *error) PS_MUST_CHECK;

/* Memory for the coefficients that were asked for, if any; frequencies are enumerated. */
pspec_status ps_power_coefficients_begin(ps_power_job *job, ps_error *error) PS_MUST_CHECK;
/* ps_estimator_options.keep on the torus; payload is the job. */
pspec_status ps_power_coefficients_keep(void *payload, const double *coefficients,
                                        double weight_sum, ps_error *error) PS_MUST_CHECK;
/* Are so many sets not too many? */
pspec_status ps_power_coefficients_check(const ps_power_job *job, uint64_t num_sets,
                                         ps_error *error) PS_MUST_CHECK;

/* What it does not need. This fills job->needs from the question, once dimension and frequencies
 * are known. */
void ps_power_needs_find(ps_power_job *job);
/* The tolerance that the problem gets: what tolerance, standard error and floor ask for
 * together. */
double ps_power_needs_tolerance(const ps_power_question *question);
/* That the plan is made for. */
uint64_t ps_power_needs_realizations(const ps_power_job *job);
/* Fills job->plan for job->problem, and the rest of job->needs. */
pspec_status ps_power_needs_plan(ps_power_job *job, ps_error *error) PS_MUST_CHECK;

#endif
