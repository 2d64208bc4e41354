/* The result of a quadrature job, and looks at what is there before. */
#include "jobs/quadrature/quadrature_job.h"

#include <math.h>
#include <stdio.h>

static ps_mean finish(const ps_sums *sums, uint64_t num) {
    ps_mean out;
    ps_sums_finish(sums, num, &out.mean, &out.standard_error);
    return out;
}

static void collect_means(ps_quadrature_job *job) {
    ps_quadrature_result *const out = &job->result;
    const uint64_t num = out->num_realizations;
    for (size_t l = 0; l <= job->setup.max_degree; l++) {
        const ps_sums *const sums = &job->sums[PS_RULE_SUMS * l];
        out->degrees[l] =
            (ps_quadrature_degree){job->setup.representer.a[l], job->setup.representer.b[l],
                                   finish(&sums[PS_RULE_D2], num), finish(&sums[PS_RULE_C2], num),
                                   finish(&sums[PS_RULE_E2], num)};
    }
    out->squared = finish(&job->of_rules.squared, num);
    out->zonal = finish(&job->of_rules.zonal, num);
    out->anisotropic = finish(&job->of_rules.anisotropic, num);
    out->tail = finish(&job->of_rules.tail, num);
    out->weight_sum = finish(&job->of_rules.weight_sum, num);
}

/* The spectral form may not exceed the kernel form, nor the rest its rigorous bound, by more than
 * rounding. */
static pspec_status check_forms(const ps_quadrature_job *job, ps_error *error) {
    const ps_quadrature_result *const result = &job->result;
    const double slack = result->numerical_bound + job->question->accuracy.tolerance *
                                                       job->setup.representer.constant *
                                                       result->weight_size * result->weight_size;
    if (result->tail.mean >= -slack && result->tail.mean <= result->tail_bound + slack) {
        return PSPEC_OK;
    }
    return ps_fail(error, PSPEC_ERROR_CHECK,
                   "E^2 is %.17g by the kernel and %.17g to degree %zu by the spectrum: the rest, "
                   "%.3g, is outside 0 .. %.3g",
                   result->squared.mean, result->zonal.mean + result->anisotropic.mean,
                   job->setup.max_degree, result->tail.mean, result->tail_bound);
}

pspec_status ps_quadrature_collect(ps_quadrature_job *job, ps_error *error) {
    collect_means(job);
    ps_estimator_describe(job->runner.estimator, &job->description);
    PS_TRY(ps_text_check(&job->description, error));
    return check_forms(job, error);
}

/* ---- looks ----------------------------------------------------------------------------------- */

/* Degree l has 2l + 1 real coefficients, of which each counts half as much as a complex one. */
static double count_independent(size_t degree) {
    return (double)degree + 0.5;
}

/* E^2 is a sum over degrees. Its excess kurtosis is at most that of the lowest which has a part in
 * it, 1. */
static const double least_of_sum = 1.5;

ps_sequential_look ps_quadrature_look(const ps_quadrature_sums *sums, double least,
                                      uint64_t num_realizations) {
    ps_sequential_look look = {.bin = PS_LOOK_AT_NOTHING};
    const ps_mean squared = finish(sums->squared, num_realizations);
    if (squared.mean > least) {
        ps_sequential_look_at(&look, squared, least_of_sum, num_realizations, PS_LOOK_AT_E2);
    }
    for (size_t l = 0; l < sums->num_degrees; l++) {
        const ps_mean e2 = finish(&sums->degrees[l * sums->stride], num_realizations);
        if (e2.mean > least) {
            ps_sequential_look_at(&look, e2, count_independent(l), num_realizations, (int64_t)l);
        }
    }
    return look;
}

void ps_quadrature_look_name(char *text, size_t size, const ps_sequential_look *look) {
    if (look->bin < 0) {
        snprintf(text, size, "%s",
                 look->bin == PS_LOOK_AT_E2 ? "E^2" : "nothing above the tolerance");
    } else {
        snprintf(text, size, "e_l^2 of degree %lld", (long long)look->bin);
    }
}
