/* Is what the cut-offs of predictions leave open as small as --tail asks? */
#ifndef PS_ANSWERS_VARIANCE_TAIL_VERDICT_H
#define PS_ANSWERS_VARIANCE_TAIL_VERDICT_H

#include "jobs/variance/variance_job.h"
#include "request/request.h"

/* Half of upper - lower over predicted, the largest of all rows; jobs [num] have run. */
double ps_variance_largest_tail(const ps_request *request, ps_variance_job *const *jobs,
                                size_t num);
/* *verdict is PSPEC_ERROR_TOLERANCE, with a sentence that has the cut-off that would do, where a
 * row misses request->tail; else it stays as it is. */
pspec_status ps_variance_judge_tails(ps_error *verdict, const ps_request *request,
                                     ps_variance_job *const *jobs, size_t num,
                                     ps_error *error) PS_MUST_CHECK;

#endif
