/* The table of pointspec truncation: a row for every degree. */
#ifndef PS_ANSWERS_TRUNCATION_TRUNCATION_TABLE_H
#define PS_ANSWERS_TRUNCATION_TRUNCATION_TABLE_H

#include "jobs/quadrature/truncation_job.h"
#include "request/request.h"
#include "tables/table.h"

pspec_status ps_truncation_table(ps_table **out, const ps_truncation_job *job,
                                 const ps_request *request, ps_error *error) PS_MUST_CHECK;

#endif
