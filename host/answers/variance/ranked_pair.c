#include "answers/variance/ranked_pair.h"

#include "answers/variance/tail_verdict.h"
#include "math/random/distributions.h"

#include <math.h>

/* Questions are sampler by sampler, and of a sampler N by N. */
ps_ranked ps_ranked_make(const ps_request *request, ps_variance_job *const *jobs, size_t question,
                         size_t integrand) {
    return (ps_ranked){.request = request,
                       .jobs = jobs,
                       .first = question % request->num_counts,
                       .step = request->num_counts,
                       .num = request->num_sources,
                       .integrand = integrand};
}

const ps_variance_job *ps_ranked_job(const ps_ranked *self, size_t sampler) {
    return self->jobs[self->first + sampler * self->step];
}

static const ps_variance_row *row_of(const ps_ranked *self, size_t sampler) {
    return &ps_ranked_job(self, sampler)->rows[self->integrand];
}

static double points_of(const ps_ranked *self, size_t sampler) {
    return ps_ranked_job(self, sampler)->spectrum->spectrum.mean_points;
}

/* ---- sides --------------------------------------------------------------------------------- */

/* What sums over pairs lose of their largest term: tests/integrands/test_sphere_pairs.c has it. */
static double rounding_of_pairs(const ps_ranked *self, size_t sampler) {
    const double digits = 1e-13;
    const ps_integrand *const integrand = ps_ranked_job(self, sampler)->integrands[self->integrand];
    const double mean = ps_integrand_integral(integrand);
    return digits *
           (row_of(self, sampler)->prediction.white * points_of(self, sampler) + mean * mean);
}

static bool has_pairs(const ps_ranked *self, size_t sampler) {
    const ps_variance_row *const row = row_of(self, sampler);
    return isfinite(row->pairwise) &&
           2 * rounding_of_pairs(self, sampler) < row->prediction.upper - row->prediction.lower;
}

/* The error e of S makes 2 sqrt(P) e + e^2 of a power (spectra/compare.c), and, E the energy of the
 * integrand, 2 e sqrt(V E/N) + e^2 E/N of a variance. */
static double rounding_of_powers(const ps_ranked *self, size_t sampler) {
    const ps_prediction *const prediction = &row_of(self, sampler)->prediction;
    const double error = ps_ranked_job(self, sampler)->spectrum->runner.accuracy.error;
    return 2 * error * sqrt(prediction->upper * prediction->white) +
           error * error * prediction->white;
}

typedef struct side {
    ps_log_variance log, lower, upper; /* and what cut-offs leave open */
    bool is_exact;
    double rounding;   /* of the variance */
    double open, more; /* per energy beyond the cut-off: predicted - lower, upper - predicted */
} side;

static void make_exact(side *out, double points, double variance, double rounding) {
    const ps_block_sums none = {0};
    *out = (side){.is_exact = true, .rounding = rounding};
    ps_log_variance_make(&out->log, points, (ps_mean){variance, 0}, &none);
    out->lower = out->log;
    out->upper = out->log;
}

static void make_predicted(side *out, const ps_ranked *self, size_t sampler) {
    const ps_variance_job *const job = ps_ranked_job(self, sampler);
    const ps_power_beyond *const beyond = &job->beyond;
    const double unit =
        ps_integrand_factor(job->integrands[self->integrand]) / points_of(self, sampler);
    *out = (side){.rounding = rounding_of_powers(self, sampler),
                  .open = beyond->white * unit,
                  .more = (ps_variance_likely_most(job) - beyond->white) * unit};
    ps_variance_job_log(job, self->integrand, PS_VARIANCE_PREDICTED, &out->log);
    ps_variance_job_log(job, self->integrand, PS_VARIANCE_LOWER, &out->lower);
    ps_variance_job_log(job, self->integrand, PS_VARIANCE_UPPER, &out->upper);
}

/* partner: who white noise has its N of. */
static void make_side(side *out, const ps_ranked *self, size_t sampler, size_t partner) {
    if (sampler == self->num) {
        make_exact(out, points_of(self, partner), row_of(self, partner)->prediction.white, 0);
    } else if (has_pairs(self, sampler)) {
        make_exact(out, points_of(self, sampler), row_of(self, sampler)->pairwise,
                   rounding_of_pairs(self, sampler));
    } else {
        make_predicted(out, self, sampler);
    }
}

/* ---- two of them --------------------------------------------------------------------------- */

/* Every sampler is compared with every other and with white noise, since any may come out first;
 * measured and predicted numbers are two tests. */
static double num_tests(const ps_ranked *self) {
    const double num = (double)self->num;
    return num * (num + 1) / 2 * (self->request->num_shifts > 0 ? 2 : 1);
}

static double rate_of_test(const ps_ranked *self) {
    return self->request->false_alarm_rate / num_tests(self);
}

static ps_uncertain divide(const ps_log_variance *a, const ps_log_variance *b) {
    const ps_log_variance both[] = {*a, *b};
    const double factors[] = {1, -1};
    return ps_log_variances_combine(both, factors, 2);
}

/* Of the logarithm of the ratio of two variances, the larger one over the smaller one. */
static double rounding_of_log(const side *large, const ps_log_variance *of_large, const side *small,
                              const ps_log_variance *of_small) {
    const double less = fmin(1, large->rounding / exp(of_large->value));
    return log1p(small->rounding / exp(of_small->value)) - log1p(-less);
}

/* Rounding comes off the ratio first. */
static double find_p_value(const ps_ranked *self, const ps_uncertain *ratio, double rounding) {
    const double size = isnan(rounding) ? 0 : fmin(rounding, fabs(ratio->value));
    const double p_value = ps_uncertain_p_value(ratio, copysign(size, ratio->value));
    return isnan(p_value) ? NAN : fmin(1, num_tests(self) * p_value);
}

static void take(ps_ranked_pair *out, const ps_ranked *self, const ps_uncertain *ratio,
                 double rounding, ps_ranked_by by) {
    out->log = ratio->value;
    out->factor = isfinite(ratio->value) ? exp(ratio->value) : NAN;
    out->error = out->factor * ratio->error;
    out->score = ratio->error > 0 ? ratio->value / ratio->error : NAN;
    out->p_value = find_p_value(self, ratio, rounding);
    out->is_told = out->p_value <= self->request->false_alarm_rate;
    out->by = by;
}

/* large - open E >= e^(z error) (small + more E) */
static double find_energy(const ps_ranked *self, const ps_uncertain *ratio, const side *small,
                          const side *large) {
    const double z = ratio->plain > 0 ? ps_student_score(rate_of_test(self), ratio->freedom) : 0;
    const double times = exp(z * ratio->plain);
    return (exp(large->log.value) - times * exp(small->log.value)) /
           (large->open + times * small->more);
}

/* What cut-offs leave open counts at its worst: the larger one is its lower, the smaller one its
 * upper. */
static void take_predicted(ps_ranked_pair *out, const ps_ranked *self, const side *x,
                           const side *y) {
    const ps_uncertain ratio = divide(&x->log, &y->log);
    const ps_uncertain least = divide(&x->lower, &y->upper);
    const ps_uncertain largest = divide(&x->upper, &y->lower);
    const bool is_more = ratio.value > 0;
    const side *const large = is_more ? x : y;
    const side *const small = is_more ? y : x;
    const ps_uncertain *const worst = is_more ? &least : &largest;
    const bool stays = is_more ? least.value > 0 : largest.value < 0;
    take(out, self, &ratio, rounding_of_log(large, &large->log, small, &small->log),
         x->is_exact && y->is_exact ? PS_BY_PAIRS : PS_BY_PREDICTED);
    out->least = exp(least.value);
    out->largest = exp(largest.value);
    if (isnan(out->p_value)) {
        return;
    }
    const double rounding = rounding_of_log(large, &large->lower, small, &small->upper);
    const bool is_told_of_white = out->is_told;
    out->p_value = stays ? find_p_value(self, worst, rounding) : 1;
    out->score = isnan(out->score) ? NAN : stays ? worst->value / worst->error : 0;
    out->is_told = out->p_value <= self->request->false_alarm_rate;
    out->is_told_if_white = is_told_of_white && !out->is_told;
    if (out->is_told_if_white) {
        out->energy = find_energy(self, &ratio, small, large);
    }
}

/* What a side was measured to be; of white noise, and sums over pairs, nothing is left to measure.
 */
static bool measure(ps_log_variance *out, const ps_ranked *self, size_t sampler, const side *own) {
    *out = own->log;
    if (!own->is_exact) {
        ps_variance_job_log(ps_ranked_job(self, sampler), self->integrand, PS_VARIANCE_MEASURED,
                            out);
    }
    return isfinite(out->value) && !isnan(out->error);
}

/* Sets that stay in place are measured for another variance than that of the predictions, where
 * there are such. */
static bool is_left_open(const ps_ranked *self, const ps_ranked_pair *pair) {
    const ps_variance_job *const job = ps_ranked_job(self, 0);
    return !ps_integrand_is_predicted(job->integrands[self->integrand]) ||
           (!pair->is_told && !self->request->in_place &&
            (pair->is_told_if_white || (pair->least < 1 && pair->largest > 1)));
}

ps_ranked_pair ps_ranked_compare(const ps_ranked *self, size_t a, size_t b) {
    side x;
    side y;
    ps_log_variance measured[2];
    ps_ranked_pair out = {0};
    make_side(&x, self, a, b);
    make_side(&y, self, b, a);
    take_predicted(&out, self, &x, &y);
    if (a != b && is_left_open(self, &out) && !(x.is_exact && y.is_exact) &&
        measure(&measured[0], self, a, &x) && measure(&measured[1], self, b, &y)) {
        const ps_uncertain ratio = divide(&measured[0], &measured[1]);
        out.is_told_if_white = false;
        take(&out, self, &ratio, 0, PS_BY_MEASURED);
    }
    return out;
}
