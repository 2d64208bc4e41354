/* What the tables of all kinds of jobs share: header lines, and the rows of one sampler after the
 * other.
 */
#ifndef PS_REPORT_JOB_TABLE_H
#define PS_REPORT_JOB_TABLE_H

#include "questions/question.h"
#include "tables/table.h"

typedef struct ps_job_table {
    const char *name; /* of the command */
    const char *const *columns;
    size_t num_columns;
    /* The rows of a job; sampler: NULL unless the table begins with a column of samplers. */
    pspec_status (*add_rows)(ps_table *, const ps_request *, const ps_power_job *,
                             const char *sampler, ps_error *);
} ps_job_table;

/* Makes the table of num jobs that have run. */
pspec_status ps_job_table_make(ps_table **out, const ps_job_table *kind,
                               const ps_request *arguments, const ps_power_job *const *jobs,
                               size_t num, ps_error *error) PS_MUST_CHECK;

#endif
