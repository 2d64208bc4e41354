/* Is what the cut-offs of predictions leave open as small as --tail asks, and which cut-off would
 * do? */
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
/* The most power beyond cut-offs: a peak may lie behind one that is small. */
double ps_variance_likely_most(const ps_variance_job *job);
/* *out: a cut-off above that of the job, of two digits, beyond which the integrand has no more than
 * this energy; infinite where none can be computed. */
pspec_status ps_variance_find_cutoff(double *out, const ps_request *request,
                                     const ps_variance_job *job, size_t integrand, double energy,
                                     ps_error *error) PS_MUST_CHECK;

#endif
