/* The variance of Monte Carlo integration of several integrands by the sets of one sampler:
 * predicted from their spectrum, and measured by moved sets beside it.
 *
 * Realizations 0 .. M - 1 predict, M .. 2M - 1 are measured, so that the two are independent. The
 * formulas are in docs/user/variance.md; N is the mean number of points.
 */
#ifndef PS_JOBS_VARIANCE_VARIANCE_JOB_H
#define PS_JOBS_VARIANCE_VARIANCE_JOB_H

#include "integrands/integrand.h"
#include "jobs/spectrum/power_job.h"
#include "jobs/variance/prediction.h"
#include "plan/phases.h"

typedef struct ps_variance_question {
    /* Of the prediction: a sampler, under the normalization of integrals; its weighted sums are
     * set here. The measurement has as many realizations, and the same watch and device. */
    ps_power_question spectrum;
    const char *const *texts; /* of the integrands */
    size_t num_integrands;
    uint64_t num_shifts; /* trials of each set that is measured; 0: nothing is */
    bool is_moved; /* trials are shifted or rotated at random; else sets stay where they are */
} ps_variance_question;

/* Of one integrand. nan: there is none. */
typedef struct ps_variance_row {
    ps_prediction prediction;
    double measured, measured_error; /* about the known integral; error over sets */
    double z_score;                  /* nan where sets are not moved, or nothing varies */
} ps_variance_row;

typedef struct ps_variance_job ps_variance_job;

/* Are there such integrands where the points of the sampler are? */
pspec_status ps_variance_question_check(const ps_variance_question *question,
                                        ps_error *error) PS_MUST_CHECK;

/* Parses the integrands and plans the spectrum. The question must outlive the job. */
pspec_status ps_variance_job_create(ps_variance_job **out, const ps_variance_question *question,
                                    ps_error *error) PS_MUST_CHECK;
void ps_variance_job_destroy(ps_variance_job *job); /* NULL is allowed */
pspec_status ps_variance_job_run(ps_variance_job *job, ps_error *error) PS_MUST_CHECK;

/* Adds what the measurement comes to: its points, and trials. */
void ps_variance_job_phases(const ps_variance_job *job, ps_phases *phases);
/* The job of the prediction: its plan, and what it found. */
ps_power_job *ps_variance_job_spectrum(const ps_variance_job *job);
const ps_integrand *ps_variance_job_integrand(const ps_variance_job *job, size_t index);
/* [question.num_integrands], after run */
const ps_variance_row *ps_variance_job_rows(const ps_variance_job *job);
/* The power that `upper` has beyond the cut-off, after run. */
const ps_power_beyond *ps_variance_job_power_beyond(const ps_variance_job *job);

#endif
