/* Shading integrals as products in harmonics that are cut after a degree: the worst-case errors of
 * all degrees, and how many points of a rule have the same
 * (docs/mathematics/quadrature.md#truncation). */
#ifndef PS_JOBS_QUADRATURE_TRUNCATION_JOB_H
#define PS_JOBS_QUADRATURE_TRUNCATION_JOB_H

#include "base/watch.h"
#include "plan/phases.h"
#include "rules/representer.h"

/* How exact kappa and kappa_0 are, and so E^2. */
#define PS_TRUNCATION_TOLERANCE 1e-13

typedef struct ps_truncation_question {
    const char *brdf; /* as --brdf takes it */
    double smoothness;
    bool is_hemispherical; /* the harmonics */
    size_t max_degree;
} ps_truncation_question;

typedef struct ps_truncation_job {
    ps_truncation_question question;
    ps_brdf *brdf;
    ps_representer representer;
    size_t sh_degree; /* of the spherical harmonics that were summed */
    /* [max_degree + 1]; points: nan where no rule has the density of the lobe, or none is so good;
     * bounds: how far errors may be off */
    double *degrees, *errors, *bounds, *points;
    double off; /* sum b_l^2 over its closed form, less 1 */
} ps_truncation_job;

/* *out is freed by ps_truncation_job_free, also after an error. PSPEC_ERROR_CHECK: the coefficients
 * do not add up to their closed form. watch hears of degrees. */
pspec_status ps_truncation_job_run(ps_truncation_job *out, const ps_truncation_question *question,
                                   const ps_watch *watch, ps_error *error) PS_MUST_CHECK;
void ps_truncation_job_free(ps_truncation_job *job);

/* Adds how long that takes. */
pspec_status ps_truncation_phases(const ps_truncation_question *question, ps_phases *phases,
                                  ps_error *error) PS_MUST_CHECK;

#endif
