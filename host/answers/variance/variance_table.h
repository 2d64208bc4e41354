/* Tables and pictures of variances. */
#ifndef PS_ANSWERS_VARIANCE_VARIANCE_TABLE_H
#define PS_ANSWERS_VARIANCE_VARIANCE_TABLE_H

#include "jobs/variance/variance_job.h"
#include "request/request.h"
#include "tables/table.h"

/* A row for each integrand of each question; jobs [num] have run. verdict is that on --tail. */
pspec_status ps_variance_table(ps_table **out, const ps_request *request,
                               ps_variance_job *const *jobs, size_t num, const ps_error *verdict,
                               ps_error *error) PS_MUST_CHECK;
/* Draws request->plot: variances against N, predicted ones as lines and measured ones as lines of
 * the same sampler and integrand, and those of white noise. */
pspec_status ps_variance_plot(const ps_request *request, ps_variance_job *const *jobs, size_t num,
                              ps_error *error) PS_MUST_CHECK;

#endif
