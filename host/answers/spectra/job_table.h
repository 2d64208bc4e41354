/* What the tables of all kinds of jobs share: header lines, and the rows of one question after the
 * other.
 */
#ifndef PS_ANSWERS_SPECTRA_JOB_TABLE_H
#define PS_ANSWERS_SPECTRA_JOB_TABLE_H

#include "answers/spectra/measured.h"

typedef struct ps_job_table {
    const char *name;           /* of the command */
    const char *const *columns; /* behind those of the lead */
    size_t num_columns;
    /* The rows of a question, which begin with the cells of its lead. */
    pspec_status (*add_rows)(ps_table *, const ps_request *, const ps_measured *, ps_error *);
} ps_job_table;

/* Makes the table of num questions. */
pspec_status ps_job_table_make(ps_table **out, const ps_job_table *kind,
                               const ps_request *arguments, const ps_measured *all, size_t num,
                               ps_error *error) PS_MUST_CHECK;

#endif
