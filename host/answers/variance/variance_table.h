/* Tables and pictures of variances. */
#ifndef PS_ANSWERS_VARIANCE_VARIANCE_TABLE_H
#define PS_ANSWERS_VARIANCE_VARIANCE_TABLE_H

#include "answers/figure.h"
#include "jobs/variance/variance_job.h"
#include "request/request.h"
#include "tables/table.h"

/* A row for each integrand of each question; jobs [num] have run. verdict is that on --tail. */
pspec_status ps_variance_table(ps_table **out, const ps_request *request,
                               ps_variance_job *const *jobs, size_t num, const ps_error *verdict,
                               ps_error *error) PS_MUST_CHECK;
/* Variances against N, by the rows of such tables: a panel for each integrand, in which each
 * sampler has a colour. Predictions are lines on a band from lower to upper, measurements are marks
 * with bars of their errors, and white noise is a line of dashes. */
ps_make_figure ps_variance_figure;
void ps_variance_write_title(ps_text *out, const ps_request *request, const ps_table *table);

/* The number of sets of all samplers, or nan; with a text, which may be NULL, that of each. */
double ps_variance_num_sets(const ps_request *request, const ps_table *table, ps_text *each);

#endif
