/* --rates: how fast variances fall as N grows, and from which N on a sampler is better than
 * another (jobs/variance/rates.h). */
#ifndef PS_ANSWERS_VARIANCE_RATES_TABLE_H
#define PS_ANSWERS_VARIANCE_RATES_TABLE_H

#include "jobs/variance/variance_job.h"
#include "request/request.h"
#include "tables/table.h"

/* Columns of rows: the exponent from the N before to this one, of the prediction. */
enum { PS_RATE_COLUMNS = 2 };
extern const char *const ps_rate_columns[PS_RATE_COLUMNS];
/* jobs are those of all questions, of which this is one. */
void ps_rates_cells(ps_cell cells[PS_RATE_COLUMNS], const ps_request *request,
                    ps_variance_job *const *jobs, size_t question, size_t integrand);

/* Refuses what has no rate: one number of points, too few realizations. */
pspec_status ps_rates_check(const ps_request *request, ps_error *error) PS_MUST_CHECK;
/* Header lines: of each sampler and integrand its exponents, of each two samplers where their
 * variances cross. */
pspec_status ps_rates_add_header(ps_table *table, const ps_request *request,
                                 ps_variance_job *const *jobs, ps_error *error) PS_MUST_CHECK;
/* The exponent that such a header has, and its error; nan: none. */
ps_uncertain ps_rates_find(const ps_table *table, const char *sampler, const char *integrand);

#endif
