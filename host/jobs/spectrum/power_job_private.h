/* Inside of ps_power_job, for the files power_*.c only. */
#ifndef PS_JOBS_SPECTRUM_POWER_JOB_PRIVATE_H
#define PS_JOBS_SPECTRUM_POWER_JOB_PRIVATE_H

#include "jobs/spectrum/power_job.h"

/* payload is the job. Progress; ps_runner_kind.tell. */
pspec_status ps_power_job_tell(void *payload, ps_error *error) PS_MUST_CHECK;
/* Asked by the engine while it works, and while points are made or counted: progress has not
 * changed since the last batch. */
bool ps_power_job_should_stop(void *payload);
/* The shape of the first set: a sampler's is known, a file is read. */
pspec_status ps_power_source_begin(ps_power_job *job, ps_error *error) PS_MUST_CHECK;
/* The sampler as it is needed: without shifts that nobody sees, one realization that stands for
 * all. */
pspec_status ps_power_source_sampler(ps_power_job *job, ps_error *error) PS_MUST_CHECK;

/* ---- a range of the realizations (power_range.c, power_range_sets.c) ---- */

/* Refuses what has no ranges, and those that are not of this job as far as that is known. */
pspec_status ps_power_range_check(const ps_power_job *job, ps_error *error) PS_MUST_CHECK;
/* The same where there are `all` realizations. */
pspec_status ps_power_range_check_end(const ps_power_job *job, uint64_t all,
                                      ps_error *error) PS_MUST_CHECK;
/* Realizations that this job computes; 0: unknown. */
uint64_t ps_power_range_count(const ps_power_job *job);
/* Passes over those before the range. */
pspec_status ps_power_range_begin(ps_power_job *job, ps_error *error) PS_MUST_CHECK;
/* Counts those behind it, finds job->num_all, and refuses a range beyond. */
pspec_status ps_power_range_end(ps_power_job *job, ps_error *error) PS_MUST_CHECK;
/* The averages of a range. */
pspec_status ps_power_range_finish(ps_power_job *job, ps_error *error) PS_MUST_CHECK;

/* ---- realizations that a team shares (power_rows.c) ---- */

/* Is nothing wanted of realizations but bins and weighted sums? In one dimension, where every bin
 * is a frequency, forming them for each realization takes longer than the transform (N = 1024, K =
 * 4000: 0.2 ms more than 0.1), and every member computes all of them. */
bool ps_power_rows_are_enough(const ps_power_job *job);
/* Are they shared? Then ps_runner_kind.give; and they go on behind the first num. */
bool ps_power_rows_are_shared(const ps_power_job *job);
/* Refuses a range of them where they are no rows. */
pspec_status ps_power_rows_check(const ps_power_job *job, ps_error *error) PS_MUST_CHECK;
pspec_status ps_power_rows_give(ps_power_job *job, uint64_t most, size_t *num,
                                ps_error *error) PS_MUST_CHECK;
pspec_status ps_power_rows_begin(ps_power_job *job, uint64_t num, ps_error *error) PS_MUST_CHECK;
/* Adds the next realizations, `most` at most: *num, 0 behind the last. */
pspec_status ps_power_job_add(ps_power_job *job, uint64_t most, size_t *num,
                              ps_error *error) PS_MUST_CHECK;
/* Passes over the next. */
pspec_status ps_power_job_pass(ps_power_job *job, uint64_t num, ps_passed_sets *passed,
                               ps_error *error) PS_MUST_CHECK;

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
