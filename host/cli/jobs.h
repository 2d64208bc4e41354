/* What power and angular have in common: from a command line to jobs that have run. Progress, plan and profile
 * go to standard error. */
#ifndef PS_CLI_JOBS_H
#define PS_CLI_JOBS_H

#include "cli/question.h"
#include "io/table.h"

/* Writes the results of jobs that have run, the table in that format. */
typedef pspec_status (*ps_jobs_write)(const ps_arguments *arguments,
                                      const ps_power_job *const *jobs, size_t num,
                                      ps_table_format format, ps_error *error);

/* Whatever can be refused is refused before hours of work, not after. */
pspec_status ps_jobs_run(const ps_arguments *arguments, ps_domain domain, ps_jobs_write write,
                         ps_error *error) PS_MUST_CHECK;

#endif
