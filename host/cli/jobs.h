/* What power, angular and pairs have in common: from a command line to jobs that have run. Progress, plan and profile
 * go to standard error. */
#ifndef PS_CLI_JOBS_H
#define PS_CLI_JOBS_H

#include "cli/answer.h"
#include "questions/question.h"

/* What becomes of jobs that have run, besides pictures. */
typedef struct ps_jobs_output {
    pspec_status (*make_table)(ps_table **out, const ps_request *arguments,
                               const ps_power_job *const *jobs, size_t num, ps_error *error);
    /* Writes other files that were asked for; NULL: there are none. */
    pspec_status (*write_others)(const ps_request *arguments, const ps_power_job *const *jobs,
                                 ps_error *error);
} ps_jobs_output;

/* The candidates of a plan with their reasons, and the kernels that ran with their times, on standard error. */
void ps_print_plan(const ps_plan *plan);
void ps_print_profile(const ps_profile_row *rows, size_t num_rows);

/* Whatever can be refused is refused before hours of work, not after. */
pspec_status ps_jobs_run(const ps_request *arguments, ps_question_kind kind,
                         const ps_jobs_output *output, ps_error *error) PS_MUST_CHECK;

/* One job, made and run; the question must outlive it. *job may be there after a failure, too. */
pspec_status ps_jobs_run_one(const ps_request *arguments, ps_power_question *question,
                             const ps_answer_hooks *hooks, ps_power_job **job,
                             ps_error *error) PS_MUST_CHECK;

/* One device for several jobs, whose kernels are then built once. NULL where each job is to find its own: for a single job, where
 * none is needed, and for --profile, which is of one job. Closed by the caller, after the jobs. */
pspec_status ps_jobs_open_device(ps_device **out, const ps_request *arguments,
                                 const ps_plan_constraints *constraints, size_t num_jobs,
                                 ps_error *error) PS_MUST_CHECK;

#endif
