#include "jobs/quadrature/quadrature_phases.h"
#include "jobs/quadrature/truncation_job.h"
#include "jobs/spectrum/power_phases.h"
#include "rules/equal_error.h"

#include <math.h>

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
    ps_phases_add(phases, "conversion", PS_HOST_SCALAR,
                  (double)job->question.max_degree * x * x * step_seconds);
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
    pspec_status status = ps_truncation_job_find_errors(&job, &easy, loose, error);
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
