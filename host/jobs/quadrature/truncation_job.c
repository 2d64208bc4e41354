#include "jobs/quadrature/truncation_job.h"

#include "base/memory.h"
#include "rules/equal_error.h"
#include "rules/truncation.h"

#include <math.h>
#include <stdlib.h>

/* How far apart the brackets of hemispherical sums may be, relative to E. */
static const double usual_bracket = 1e-4;

/* Nine digits of sum b_l^2 must be those of the closed form; where a lobe jumps the sum has its
 * bracket. */
static const double sum_rule = 1e-9;

/* The coefficients are right when their squares add up to what int phat^2 is. */
static pspec_status check_sum_rule(ps_truncation_job *job, ps_error *error) {
    double sum = 0;
    for (size_t l = job->representer.max_degree + 1; l-- > 0;) {
        sum += job->representer.b[l] * job->representer.b[l];
    }
    job->off = sum / job->representer.energy - 1;
    return job->off <= sum_rule ? PSPEC_OK
                                : ps_fail(error, PSPEC_ERROR_CHECK,
                                          "the sum of the b_l^2 is %.3g of itself above its closed "
                                          "form: the coefficients are wrong",
                                          job->off);
}

static pspec_status find_points(const ps_truncation_job *job, const ps_watch *watch,
                                ps_error *error) {
    ps_equal_error equal = {.representer = &job->representer, .morph = ps_brdf_morph(job->brdf)};
    for (size_t l = 0; l <= job->question.max_degree; l++) {
        job->points[l] = NAN;
        if (equal.morph.kind != PS_MORPH_NONE && job->errors[l] > 0) {
            PS_TRY(ps_equal_error_points(&equal, job->errors[l], &job->points[l], error));
        }
        PS_TRY(ps_watch_tell(watch, "degrees", l + 1, job->question.max_degree + 1, NULL, error));
    }
    return PSPEC_OK;
}

/* The errors of all degrees; those of hemispherical harmonics are in brackets, relative to them. */
pspec_status ps_truncation_job_find_errors(ps_truncation_job *job,
                                           const ps_truncation_question *question, double bracket,
                                           ps_error *error) {
    enum { COLUMNS = 4 };
    const size_t num = question->max_degree + 1;
    *job = (ps_truncation_job){.question = *question};
    PS_TRY(ps_brdf_parse(&job->brdf, question->brdf, error));
    /* twice the degrees: the last one's rest is then mostly summed, not bracketed */
    PS_TRY(ps_representer_create(&job->representer, job->brdf, question->smoothness,
                                 PS_TRUNCATION_TOLERANCE, 2 * num, error));
    PS_TRY(ps_allocate_for(&job->degrees, num, COLUMNS * sizeof(double), "degrees", error));
    job->errors = job->degrees + num;
    job->bounds = job->errors + num;
    job->points = job->bounds + num;
    for (size_t l = 0; l < num; l++) {
        job->degrees[l] = (double)l;
    }
    if (question->is_hemispherical) {
        PS_TRY(ps_truncation_hemispherical(job->brdf, question->smoothness, question->max_degree,
                                           bracket, job->errors, job->bounds, &job->sh_degree,
                                           error));
        return PSPEC_OK;
    }
    job->sh_degree = job->representer.max_degree;
    return ps_truncation_spherical(&job->representer, question->max_degree, job->errors,
                                   job->bounds, error);
}

pspec_status ps_truncation_job_run(ps_truncation_job *out, const ps_truncation_question *question,
                                   const ps_watch *watch, ps_error *error) {
    PS_TRY(ps_truncation_job_find_errors(out, question, usual_bracket, error));
    PS_TRY(check_sum_rule(out, error));
    return find_points(out, watch, error);
}

void ps_truncation_job_free(ps_truncation_job *job) {
    free(job->degrees);
    ps_representer_destroy(&job->representer);
    ps_brdf_destroy(job->brdf);
    *job = (ps_truncation_job){0};
}
