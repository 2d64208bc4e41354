/* Errors of shading integrals over random orientations: rules of a quadrature job estimate I(r) of
 * light F for a lobe about r, and their error is known from their spectrum, too
 * (docs/mathematics/quadrature.md#shading):
 *
 *     mean over orientations of (sum_j w_j F(R u_j) - I(R z))^2 = sum_l P_F(l) (d_l^2 + C_l^2)        (Q5)
 */
#ifndef PS_JOBS_SHADE_SHADE_JOB_H
#define PS_JOBS_SHADE_SHADE_JOB_H

#include "jobs/quadrature/quadrature_job.h"
#include "jobs/shade/light.h"
#include "trials/trials.h"

/* Of all rules together: the root of the mean of squares is known to 2 %. */
#define PS_USUAL_ORIENTATIONS UINT64_MAX

typedef struct ps_shade_question {
    ps_quadrature_question rules; /* without an observer */
    const ps_light *light;
    /* Of each rule; 0: nothing is measured; PS_USUAL_ORIENTATIONS: 1000 in all */
    uint64_t num_orientations;
    uint64_t seed; /* of the orientations */
} ps_shade_question;

typedef struct ps_shade_result {
    uint64_t num_orientations; /* of each rule */
    /* Means of squares over rules, with standard errors: those of a single rule are over
     * orientations, and its prediction has none; nan where nothing is measured */
    ps_mean measured, predicted;
    double beyond; /* of predicted: what rules are taken to have beyond the degrees, as white noise
                      has it */
} ps_shade_result;

typedef struct ps_shade_job {
    const ps_shade_question *question;
    ps_quadrature_question rules_question;
    ps_quadrature_job *rules;
    uint64_t seed;
    ps_trials *trials;
    size_t most_points, trials_of_call;
    double *moves, *estimates; /* [trials_of_call][9], [trials_of_call] */
    ps_sums measured, predicted, beyond, orientations;
    uint64_t num_rules;
    ps_shade_result result; /* after run */
} ps_shade_job;

/* As a quadrature job; the question must outlive it. */
pspec_status ps_shade_job_create(ps_shade_job **out, const ps_shade_question *question,
                                 ps_error *error) PS_MUST_CHECK;
void ps_shade_job_destroy(ps_shade_job *job); /* NULL is allowed */
pspec_status ps_shade_job_run(ps_shade_job *job, ps_error *error) PS_MUST_CHECK;

/* How many spherical Fibonacci points of the hemisphere, morphed to the lobe and of equal weights,
 * have these root mean square errors with the light, by (Q5), as ps_equal_error_points has it:
 * points[num]. rules: with brdf and smoothness, the device, who watches degrees; NULL for the
 * device takes the host, which is slow. */
pspec_status ps_shade_equal_points(const ps_light *light, const ps_quadrature_question *rules,
                                   const double *errors, size_t num, double *points,
                                   ps_error *error) PS_MUST_CHECK;

#endif
