/* What a power job does not need: from its question, and from its plan. For power_job.c. */
#ifndef PS_JOBS_SPECTRUM_POWER_NEEDS_H
#define PS_JOBS_SPECTRUM_POWER_NEEDS_H

#include "jobs/spectrum/power_job_private.h"

/* Fills job->needs, once dimension and frequencies are known. */
void ps_power_needs_find(ps_power_job *job);
/* The tolerance that the problem gets: what tolerance, standard error and floor ask for
 * together. */
double ps_power_needs_tolerance(const ps_power_question *question);
/* That the plan is made for. */
uint64_t ps_power_needs_realizations(const ps_power_job *job);
/* Fills job->plan for job->problem, and the rest of job->needs. */
pspec_status ps_power_needs_plan(ps_power_job *job, ps_error *error) PS_MUST_CHECK;

#endif
