/* The table of quadrature jobs that have run. */
#ifndef PS_ANSWERS_QUADRATURE_QUADRATURE_TABLE_H
#define PS_ANSWERS_QUADRATURE_QUADRATURE_TABLE_H

#include "jobs/quadrature/quadrature_job.h"
#include "request/request.h"
#include "tables/table.h"

/* jobs[num] */
pspec_status ps_quadrature_table(ps_table **out, const ps_request *arguments,
                                 ps_quadrature_job *const *jobs, size_t num,
                                 ps_error *error) PS_MUST_CHECK;

#endif
