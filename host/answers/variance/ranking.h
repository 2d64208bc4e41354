/* --rank: which sampler has the least variance, and how much more the others have, for each
 * integrand and number of points. */
#ifndef PS_ANSWERS_VARIANCE_RANKING_H
#define PS_ANSWERS_VARIANCE_RANKING_H

#include "jobs/variance/variance_job.h"
#include "request/request.h"
#include "tables/table.h"

/* Columns of rows. */
enum { PS_RANK_COLUMNS = 5 };
extern const char *const ps_rank_columns[PS_RANK_COLUMNS];
/* jobs are those of all questions, of which this is one. */
void ps_rank_cells(ps_cell cells[PS_RANK_COLUMNS], const ps_request *request,
                   ps_variance_job *const *jobs, size_t question, size_t integrand);

/* Refuses what cannot be compared: one sampler, too few realizations. */
pspec_status ps_rank_check(const ps_request *request, ps_error *error) PS_MUST_CHECK;
/* Header lines: a sentence for each integrand and number of points. */
pspec_status ps_rank_add_header(ps_table *table, const ps_request *request,
                                ps_variance_job *const *jobs, ps_error *error) PS_MUST_CHECK;

#endif
