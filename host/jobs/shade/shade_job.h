/* Errors of shading integrals over random orientations: rules of a quadrature job estimate I(r) of
 * light F for a lobe about r, and their error is known from their spectrum, too
 * (docs/mathematics/quadrature.md#shading):
 *
 *     mean over orientations of (sum_j w_j F(R u_j) - I(R z))^2 = sum_l P_F(l) (d_l^2 + C_l^2)        (Q5)
 *
 * This is what is added to a quadrature job: it hears of its rules, one after the other.
 */
#ifndef PS_JOBS_SHADE_SHADE_JOB_H
#define PS_JOBS_SHADE_SHADE_JOB_H

#include "jobs/quadrature/quadrature_job.h"
#include "jobs/shade/light.h"
#include "trials/trials.h"

/* Of all rules together: the root of the mean of squares is known to 2 %. */
#define PS_USUAL_ORIENTATIONS UINT64_MAX

typedef struct ps_shade_job {
    const ps_light *light;
    /* Of each rule; 0: nothing is measured; PS_USUAL_ORIENTATIONS: 1000 in all */
    uint64_t wanted_orientations;
    uint64_t seed; /* of the orientations of these rules */

    /* While the job runs */
    const ps_quadrature_job *rules;
    ps_trials *trials;
    size_t most_points, trials_of_call;
    double *moves, *estimates; /* [trials_of_call][9], [trials_of_call] */
    ps_sums squares, predictions, parts_beyond, orientations;
    uint64_t num_rules;

    /* After it has run */
    uint64_t num_orientations; /* of each rule */
    /* Means of squares over rules, with standard errors: those of a single rule are over
     * orientations, and its prediction has none; nan where nothing is measured */
    ps_mean measured, predicted;
    double beyond; /* of predicted: what rules are taken to have beyond the degrees, as white noise
                      has it */
} ps_shade_job;

/* Becomes the observer of the question, whose jobs must end before it; it must not be moved. seed:
 * of all orientations that a request asks for. Freed by ps_shade_job_free, also after an error. */
pspec_status ps_shade_job_make(ps_shade_job *out, const ps_light *light, uint64_t num_orientations,
                               uint64_t seed, ps_quadrature_question *rules,
                               ps_error *error) PS_MUST_CHECK;
void ps_shade_job_free(ps_shade_job *self);

/* How many spherical Fibonacci points of the hemisphere, morphed to the lobe and of equal weights,
 * have these root mean square errors with the light, by (Q5), as ps_equal_error_points has it:
 * points[num]. rules: with brdf and smoothness, the device, who watches degrees; NULL for the
 * device takes the host, which is slow. */
pspec_status ps_shade_equal_points(const ps_light *light, const ps_quadrature_question *rules,
                                   const double *errors, size_t num, double *points,
                                   ps_error *error) PS_MUST_CHECK;

#endif
