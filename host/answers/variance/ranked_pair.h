/* Two samplers of a ranking, or one and white noise: which has less variance, by what, and is it
 * told apart? docs/mathematics/statistics.md, Rankings. */
#ifndef PS_ANSWERS_VARIANCE_RANKED_PAIR_H
#define PS_ANSWERS_VARIANCE_RANKED_PAIR_H

#include "jobs/variance/variance_job.h"
#include "request/request.h"

/* The rows of one integrand and one N. */
typedef struct ps_ranked {
    const ps_request *request;
    ps_variance_job *const *jobs; /* of all questions */
    size_t first, step, num;      /* those of the samplers */
    size_t integrand;
} ps_ranked;

/* The rows that row `integrand` of a question stands among. */
ps_ranked ps_ranked_make(const ps_request *request, ps_variance_job *const *jobs, size_t question,
                         size_t integrand);
const ps_variance_job *ps_ranked_job(const ps_ranked *self, size_t sampler);

/* What is compared: the predictions, or, of single sets, sums over their pairs; where neither
 * decides between two samplers because of what cut-offs leave open, what was measured. */
typedef enum ps_ranked_by { PS_BY_PREDICTED, PS_BY_PAIRS, PS_BY_MEASURED } ps_ranked_by;

typedef struct ps_ranked_pair {
    double log;            /* ln(V_a/V_b); not finite where one is 0 */
    double factor, error;  /* V_a/V_b with the standard error; nan: none */
    double least, largest; /* factors that powers beyond the cut-offs may make of it */
    /* How many standard errors the logarithm is from 0, where what the cut-offs leave open is as
     * near to 0 as it can be; nan: there is no error */
    double score;
    /* The smallest rate of false alarms, for the whole ranking, at which the two are told apart;
     * nan: nobody knows */
    double p_value;
    bool is_told;          /* at the rate of the request */
    bool is_told_if_white; /* it would be if all had white noise beyond the cut-off */
    /* The energy of the integrand beyond a cut-off that would tell them apart if so */
    double energy;
    ps_ranked_by by;
} ps_ranked_pair;

/* Of a to b. num is white noise, of as many points as the other has. */
ps_ranked_pair ps_ranked_compare(const ps_ranked *self, size_t a, size_t b);

#endif
