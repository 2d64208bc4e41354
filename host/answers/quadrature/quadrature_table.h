/* The table of quadrature jobs that have run. */
#ifndef PS_ANSWERS_QUADRATURE_QUADRATURE_TABLE_H
#define PS_ANSWERS_QUADRATURE_QUADRATURE_TABLE_H

#include "answers/field.h"
#include "jobs/quadrature/quadrature_job.h"
#include "request/request.h"
#include "fields/table.h"

/* jobs[num] */
pspec_status ps_quadrature_table(ps_table **out, const ps_request *arguments,
                                 ps_quadrature_job *const *jobs, size_t num,
                                 ps_error *error) PS_MUST_CHECK;

/* Header entries of all rules, and of those of one question: what its job found; with_range: their
 * numbers of points, too. */
pspec_status ps_quadrature_begin_header(ps_table *table, const ps_request *arguments,
                                        const ps_quadrature_question *question,
                                        ps_error *error) PS_MUST_CHECK;
pspec_status ps_quadrature_add_header(ps_table *table, const ps_request *arguments, size_t question,
                                      const ps_quadrature_job *job, bool with_range,
                                      ps_error *error) PS_MUST_CHECK;
/* The rows that declare them. */
extern const ps_field_row ps_fields_rules[];

#endif
