#include "jobs/quadrature/truncation_job.h"

#include "base/memory.h"
#include "rules/truncation.h"
#include "jobs/quadrature/quadrature_job.h"
#include "jobs/spectrum/power_phases.h"

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
static pspec_status find_errors(ps_truncation_job *job, const ps_truncation_question *question,
                                double bracket, ps_error *error) {
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
    PS_TRY(find_errors(out, question, usual_bracket, error));
    PS_TRY(check_sum_rule(out, error));
    return find_points(out, watch, error);
}

void ps_truncation_job_free(ps_truncation_job *job) {
    free(job->degrees);
    ps_representer_destroy(&job->representer);
    ps_brdf_destroy(job->brdf);
    *job = (ps_truncation_job){0};
}

/* ---- how long it takes ----------------------------------------------------------------------- */

/* Pairs, and points, of a rule; making the points takes nothing beside. */
static void add_rule(const ps_truncation_job *job, ps_phases *phases, double num) {
    static const char name[] = "points of equal error";
    ps_phases_kappa(phases, name, num, (double)job->representer.num_terms, 1);
    ps_phases_distances(phases, name, job->question.smoothness, num * num / 2, 1);
}

/* For every degree as many points as will have its error: E falls like N^(-s/2) from a rule that is
 * cheap. (From 4096 points on, those of 31333 points were off by more than 4 %; from 8192 on, by
 * less.) Each takes two rules of about so many, or one where the second would be the first again,
 * and all together the rungs of the ladder up to the highest: at most so much. */
static pspec_status add_equal_points(ps_truncation_job *job, ps_phases *phases, ps_error *error) {
    enum { FEW = 8192, STEPS = 2 };
    const double s = job->question.smoothness;
    const ps_morph morph = ps_brdf_morph(job->brdf);
    double of_few = 0;
    double most = 1;
    PS_TRY(ps_fibonacci_error(&job->representer, &morph, FEW, &of_few, error));
    for (size_t l = 0; l <= job->question.max_degree; l++) {
        const double num = FEW * pow(of_few / job->errors[l], 2 / s);
        const bool is_there = job->errors[l] > 0 && num <= PS_EQUAL_ERROR_MOST;
        most = job->errors[l] > 0 ? fmax(most, fmin(num, PS_EQUAL_ERROR_MOST)) : most;
        for (int step = 0; is_there && step < STEPS; step++) {
            add_rule(job, phases, num);
        }
    }
    for (double num = 1; num < 2 * most; num *= 2) {
        add_rule(job, phases, num);
    }
    ps_phases_limit(phases, "points of equal error");
    ps_phases_say(phases, "points of equal error", "rules of up to %.3g points", most);
    return PSPEC_OK;
}

/* Steps of the conversion go as L X^2, X growing until the brackets are narrow enough: to where
 * they usually are. */
static void add_conversion(const ps_truncation_job *job, ps_phases *phases) {
    const double usual = 1000;
    const double step_seconds = 2e-9; /* a degree of each kind of harmonics */
    const double x = fmax(usual, 4 * (double)job->question.max_degree);
    ps_phases_add(phases, "conversion", (double)job->question.max_degree * x * x * step_seconds);
    ps_phases_say(phases, "conversion", "of hemispherical harmonics to spherical ones");
    ps_phases_limit(phases, "conversion");
}

pspec_status ps_truncation_phases(const ps_truncation_question *question, ps_phases *phases,
                                  ps_error *error) {
    enum { FEW_DEGREES = 60 };
    const double loose = 0.5;
    ps_truncation_question easy = *question;
    ps_truncation_job job = {0};
    /* Errors of many degrees in hemispherical harmonics take their time: those in spherical ones
     * are about as large. */
    easy.is_hemispherical = question->is_hemispherical && question->max_degree <= FEW_DEGREES;
    pspec_status status = find_errors(&job, &easy, loose, error);
    if (status == PSPEC_OK) {
        ps_phases_start(phases, NULL, NULL);
        ps_phases_lobe(phases, &job.representer);
        if (question->is_hemispherical && job.errors[0] > 0) {
            add_conversion(&job, phases);
        }
        if (ps_brdf_morph(job.brdf).kind != PS_MORPH_NONE) {
            status = add_equal_points(&job, phases, error);
        }
        ps_phases_tabulate(phases, (double)question->max_degree);
    }
    ps_truncation_job_free(&job);
    return status;
}
