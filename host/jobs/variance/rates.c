#include "jobs/variance/rates.h"

#include "base/memory.h"
#include "math/gsl/regression.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- lines --------------------------------------------------------------------------------- */

/* Least squares of a polynomial of ln N, about the middle of ln N. */
typedef struct polynomial {
    size_t num, num_regressors;
    double middle;
    double *regressors, *weights; /* [num][num_regressors], [num] */
    double *unit;                 /* [num]: the values of one place at a time */
} polynomial;

static void release(polynomial *self) {
    free(self->regressors);
    free(self->weights);
    free(self->unit);
}

/* Single errors were measured, and those that came out small would count for more: the weights are
 * of a power law of errors, by least squares. */
static void weigh(polynomial *self, const double *x, const double *errors) {
    double mean = 0;
    double product = 0;
    double square = 0;
    for (size_t i = 0; i < self->num; i++) {
        mean += log(errors[i]) / (double)self->num;
        product += (x[i] - self->middle) * log(errors[i]);
        square += (x[i] - self->middle) * (x[i] - self->middle);
    }
    for (size_t i = 0; i < self->num; i++) {
        self->weights[i] = exp(-2 * (mean + product / square * (x[i] - self->middle)));
    }
}

static pspec_status prepare(polynomial *self, const double *x, const double *errors,
                            ps_error *error) {
    PS_TRY(PS_NEW(&self->regressors, self->num * self->num_regressors, "a regression", error));
    PS_TRY(PS_NEW(&self->weights, self->num, "a regression", error));
    PS_TRY(PS_NEW(&self->unit, self->num, "a regression", error));
    for (size_t i = 0; i < self->num; i++) {
        self->middle += x[i] / (double)self->num;
    }
    for (size_t i = 0; i < self->num; i++) {
        for (size_t k = 0; k < self->num_regressors; k++) {
            self->regressors[i * self->num_regressors + k] = pow(x[i] - self->middle, (double)k);
        }
    }
    weigh(self, x, errors);
    return PSPEC_OK;
}

/* factors [num_regressors][num]: the coefficients are sums of the values times these. */
static pspec_status find_factors(polynomial *self, double *factors, ps_error *error) {
    for (size_t i = 0; i < self->num; i++) {
        ps_regression found;
        memset(self->unit, 0, self->num * sizeof *self->unit);
        self->unit[i] = 1;
        PS_TRY(ps_regress(&found, self->num, self->num_regressors, self->regressors, self->unit,
                          self->weights, error));
        for (size_t k = 0; k < self->num_regressors; k++) {
            factors[k * self->num + i] = found.coefficients[k];
        }
    }
    return PSPEC_OK;
}

/* *factors is to be freed, also after an error; *middle is the ln N about which they are. */
static pspec_status fit(double **factors, double *middle, size_t num_regressors, const double *x,
                        const double *errors, size_t num, ps_error *error) {
    polynomial self = {.num = num, .num_regressors = num_regressors};
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, PS_NEW(factors, num * num_regressors, "a regression", error));
    PS_TRY_OUT(status, prepare(&self, x, errors, error));
    PS_TRY_OUT(status, find_factors(&self, *factors, error));
    *middle = self.middle;
out:
    release(&self);
    return status;
}

/* ---- rates --------------------------------------------------------------------------------- */

static pspec_status check_log(const ps_log_variance *one, ps_error *error) {
    if (!isfinite(one->value)) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "the variance at N = %.10g is 0 or unknown",
                       one->points);
    }
    return one->error > 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "the variance at N = %.10g has no standard error, without which nothing "
                         "says how well a line is known",
                         one->points);
}

static pspec_status check_logs(const ps_log_variance *logs, size_t num, ps_error *error) {
    size_t num_different = num > 0;
    for (size_t i = 0; i < num; i++) {
        PS_TRY(check_log(&logs[i], error));
        num_different += i > 0 && logs[i].points > logs[i - 1].points;
    }
    return num > 1 && num_different == num
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "a line takes two numbers of points or more, and there %s %zu",
                         num_different == 1 ? "is" : "are", num_different);
}

static pspec_status fit_logs(double **factors, size_t num_regressors, const ps_log_variance *logs,
                             size_t num, ps_error *error) {
    double *x = NULL;
    double middle = 0;
    PS_TRY(PS_NEW(&x, 2 * num, "a regression", error));
    for (size_t i = 0; i < num; i++) {
        x[i] = log(logs[i].points);
        x[num + i] = logs[i].error;
    }
    const pspec_status status = fit(factors, &middle, num_regressors, x, x + num, num, error);
    free(x);
    return status;
}

/* The coefficient of (ln N)^power. */
static pspec_status find_coefficient(ps_uncertain *out, size_t power, const ps_log_variance *logs,
                                     size_t num, ps_error *error) {
    double *factors = NULL;
    const pspec_status status = fit_logs(&factors, power + 1, logs, num, error);
    if (status == PSPEC_OK) {
        *out = ps_log_variances_combine(logs, factors + power * num, num);
    }
    free(factors);
    return status;
}

/* times: of either sign */
static ps_uncertain scale(ps_uncertain one, double times) {
    one.value *= times;
    one.error *= fabs(times);
    one.plain *= fabs(times);
    return one;
}

pspec_status ps_rate_fit(ps_rate *out, const ps_log_variance *logs, size_t num, ps_error *error) {
    const double doubled = 2 * log(2);
    ps_uncertain slope = PS_UNCERTAIN_NONE;
    ps_uncertain square = PS_UNCERTAIN_NONE;
    PS_TRY(check_logs(logs, num, error));
    PS_TRY(find_coefficient(&slope, 1, logs, num, error));
    if (num > 2) {
        PS_TRY(find_coefficient(&square, 2, logs, num, error));
    }
    *out = (ps_rate){.num = num,
                     .from = logs[0].points,
                     .to = logs[num - 1].points,
                     .rate = scale(slope, -1),
                     .change = scale(square, -doubled)};
    return PSPEC_OK;
}

ps_uncertain ps_rate_between(const ps_log_variance *first, const ps_log_variance *second) {
    const ps_log_variance both[] = {*first, *second};
    const double length = log(second->points / first->points);
    const double factors[] = {1 / length, -1 / length};
    return ps_log_variances_combine(both, factors, 2);
}

/* ---- crossings ----------------------------------------------------------------------------- */

/* ratios: ln(a/b). -1: a has less, 1: b has, 0: not told apart. */
static int which_has_less(const ps_log_variance *ratio) {
    const bool is_told = fabs(ratio->value) >= PS_RATES_TOLD_APART * ratio->error;
    return !is_told || ratio->value == 0 ? 0 : ratio->value < 0 ? -1 : 1;
}

/* Where the line through these is 0: the middle less c/s, c and s its coefficients. */
static pspec_status cross(ps_crossing *out, const ps_log_variance *ratios, size_t num,
                          ps_error *error) {
    double *x = NULL;
    double *factors = NULL;
    double middle = 0;
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, PS_NEW(&x, 2 * num, "a regression", error));
    for (size_t i = 0; i < num; i++) {
        x[i] = log(ratios[i].points);
        x[num + i] = num > 2 ? ratios[i].error : 1;
    }
    PS_TRY_OUT(status, fit(&factors, &middle, 2, x, x + num, num, error));
    const double c = ps_log_variances_combine(ratios, factors, num).value;
    const double s = ps_log_variances_combine(ratios, factors + num, num).value;
    for (size_t i = 0; i < num; i++) {
        factors[i] = -(factors[i] - c / s * factors[num + i]) / s;
    }
    out->points.value = exp(middle - c / s);
    out->points.error = out->points.value * ps_log_variances_combine(ratios, factors, num).error;
    out->is_a_below = ratios[0].value < 0;
out:
    free(x);
    free(factors);
    return status;
}

/* From one that is told apart to the next one, which is told apart the other way. */
static pspec_status find_between(ps_crossings *out, const ps_log_variance *ratios, size_t num,
                                 ps_error *error) {
    size_t last = num;
    for (size_t i = 0; i < num; i++) {
        const int now = which_has_less(&ratios[i]);
        const bool is_other = last < num && now == -which_has_less(&ratios[last]);
        if (now != 0 && is_other) {
            PS_TRY(cross(&out->found[out->num], ratios + last, i + 1 - last, error));
            out->num++;
        }
        out->num_a += now < 0;
        out->num_b += now > 0;
        last = now != 0 ? i : last;
    }
    return PSPEC_OK;
}

/* At `points`, near those of logs[i], along the line to a neighbour. */
static ps_log_variance move(const ps_log_variance *logs, size_t num, size_t i, double points) {
    ps_log_variance out = logs[i];
    if (points == out.points) {
        return out;
    }
    const ps_log_variance both[] = {out, logs[i + 1 < num ? i + 1 : i - 1]};
    const double share = log(points / out.points) / log(both[1].points / out.points);
    const double factors[] = {1 - share, share};
    const ps_uncertain moved = ps_log_variances_combine(both, factors, 2);
    out.points = points;
    out.value = moved.value;
    out.error = moved.error;
    for (size_t k = 0; k < PS_MOST_BLOCKS; k++) {
        out.deviations[k] += share * (both[1].deviations[k] - out.deviations[k]);
    }
    return out;
}

bool ps_crossings_have_same_points(const ps_log_variance *a, const ps_log_variance *b, size_t num) {
    const double part_of_gap = 0.1;
    bool are_same = true;
    for (size_t i = 0; i < num; i++) {
        const size_t next = i + 1 < num ? i + 1 : i - (num > 1);
        const double gap = fabs(log(b[next].points / b[i].points));
        are_same = are_same && fabs(log(a[i].points / b[i].points)) <= part_of_gap * gap;
    }
    return are_same;
}

pspec_status ps_crossings_find(ps_crossings *out, ps_crossing *found, const ps_log_variance *a,
                               const ps_log_variance *b, size_t num, ps_error *error) {
    ps_log_variance *ratios = NULL;
    *out = (ps_crossings){.found = found};
    PS_TRY(PS_NEW(&ratios, num, "ratios of variances", error));
    for (size_t i = 0; i < num; i++) {
        const ps_log_variance at_a = move(b, num, i, a[i].points);
        ratios[i] = ps_log_variances_difference(&a[i], &at_a);
    }
    const pspec_status status = find_between(out, ratios, num, error);
    free(ratios);
    return status;
}
