#include "jobs/variance/rates.h"

#include "base/memory.h"
#include "math/random/distributions.h"

#include <math.h>
#include <stdlib.h>

/* ---- logarithms of variances ----------------------------------------------------------------- */

/* The error is that over all realizations; blocks, which are fewer, share it. */
static void share_error(ps_log_variance *out, const ps_block_sums *blocks) {
    double square = 0;
    out->num_blocks = ps_block_sums_deviations(blocks, out->deviations);
    for (size_t i = 0; i < PS_MOST_BLOCKS; i++) {
        square += out->deviations[i] * out->deviations[i];
    }
    for (size_t i = 0; i < PS_MOST_BLOCKS; i++) {
        out->deviations[i] *= square > 0 ? out->error / sqrt(square) : 0;
    }
}

void ps_log_variance_make(ps_log_variance *out, double points, ps_mean variance,
                          const ps_block_sums *blocks) {
    const double error = variance.standard_error;
    *out = (ps_log_variance){.points = points, .error = error == 0 ? 0 : error / variance.mean};
    out->value = log(variance.mean) + (out->error > 0 ? out->error * out->error / 2 : 0);
    if (out->error > 0) {
        share_error(out, blocks);
        out->scatter = (double)out->num_blocks * out->error * out->error;
    }
}

static size_t fewest_blocks(const ps_log_variance *logs, size_t num) {
    size_t fewest = 0;
    for (size_t i = 0; i < num; i++) {
        const size_t own = logs[i].num_blocks;
        fewest = own > 0 && (fewest == 0 || own < fewest) ? own : fewest;
    }
    return fewest;
}

/* (B-1)/(B-3), under the root */
static double student_factor(const ps_log_variance *logs, size_t num) {
    const size_t fewest = fewest_blocks(logs, num);
    const double left = (double)fewest - 3;
    return fewest == 0 ? 1 : left > 0 ? sqrt((left + 2) / left) : NAN;
}

/* The mean of those of all, by what they have of the error. */
static double mean_scatter(const ps_log_variance *logs, const double *factors, size_t num) {
    double sum = 0;
    double squares = 0;
    for (size_t i = 0; i < num; i++) {
        const double part = factors[i] * logs[i].error;
        sum += part * part * logs[i].scatter;
        squares += part * part;
    }
    return squares > 0 ? sum / squares : 0;
}

/* The variance of the logarithm of a variance that B gamma variables tell is (2 + 2 cv^2) / B, in
 * place of 2 / B of normal ones: that many degrees of freedom less, as spectra/compare.c has it. */
static double find_freedom(const ps_log_variance *logs, const double *factors, size_t num) {
    const size_t fewest = fewest_blocks(logs, num);
    return fewest == 0 ? INFINITY : ((double)fewest - 1) / (1 + mean_scatter(logs, factors, num));
}

ps_uncertain ps_log_variances_combine(const ps_log_variance *logs, const double *factors,
                                      size_t num) {
    ps_uncertain out = {0};
    double square = 0;
    for (size_t i = 0; i < num; i++) {
        out.value += factors[i] * logs[i].value;
        out.error += factors[i] * logs[i].error * 0; /* nan where one is */
    }
    for (size_t b = 0; b < PS_MOST_BLOCKS; b++) {
        double sum = 0;
        for (size_t i = 0; i < num; i++) {
            sum += factors[i] * logs[i].deviations[b];
        }
        square += sum * sum;
    }
    out.plain = out.error + sqrt(square);
    out.error += sqrt(square) * student_factor(logs, num);
    out.freedom = find_freedom(logs, factors, num);
    return out;
}

double ps_uncertain_p_value(const ps_uncertain *found, double exact) {
    const double distance = fabs(found->value - exact);
    if (isnan(distance) || isnan(found->error)) {
        return NAN;
    }
    return found->plain > 0 ? ps_student_two_sided(distance / found->plain, found->freedom)
           : distance > 0   ? 0
                            : 1;
}

/* ln(a/b), at the N of a: 0 errors on both sides are one of 0. */
static ps_log_variance subtract(const ps_log_variance *a, const ps_log_variance *b) {
    const double factors[] = {1, -1};
    const ps_log_variance both[] = {*a, *b};
    const ps_uncertain found = ps_log_variances_combine(both, factors, 2);
    ps_log_variance out = {.points = a->points, .value = found.value, .error = found.error};
    out.num_blocks = fewest_blocks(both, 2);
    out.scatter = mean_scatter(both, factors, 2);
    for (size_t i = 0; i < PS_MOST_BLOCKS; i++) {
        out.deviations[i] = a->deviations[i] - b->deviations[i];
    }
    return out;
}

/* ---- lines --------------------------------------------------------------------------------- */

/* Coefficients of least squares are sums of the values times factors of ln N alone: a line has the
 * mean of the slopes between neighbours, with weights that nothing random is in. Weights by errors
 * would be made of the same numbers as the values, and of what is no line each would be another
 * mean. */
static double find_middle(const double *x, size_t num) {
    double middle = 0;
    for (size_t i = 0; i < num; i++) {
        middle += x[i] / (double)num;
    }
    return middle;
}

/* factors [num] hold a polynomial that all of lower degree are orthogonal to. */
static void divide_by_square(double *factors, size_t num) {
    double square = 0;
    for (size_t i = 0; i < num; i++) {
        square += factors[i] * factors[i];
    }
    for (size_t i = 0; i < num; i++) {
        factors[i] /= square;
    }
}

static void fit_slope(double *factors, const double *x, size_t num) {
    const double middle = find_middle(x, num);
    for (size_t i = 0; i < num; i++) {
        factors[i] = x[i] - middle;
    }
    divide_by_square(factors, num);
}

/* Of (ln N)^2. */
static void fit_square(double *factors, const double *x, size_t num) {
    const double middle = find_middle(x, num);
    double squares = 0;
    double cubes = 0;
    for (size_t i = 0; i < num; i++) {
        squares += pow(x[i] - middle, 2);
        cubes += pow(x[i] - middle, 3);
    }
    for (size_t i = 0; i < num; i++) {
        const double u = x[i] - middle;
        factors[i] = u * u - cubes / squares * u - squares / (double)num;
    }
    divide_by_square(factors, num);
}

/* *x [2][num], to be freed: ln N, and room for factors. */
static pspec_status make_places(double **x, const ps_log_variance *logs, size_t num,
                                ps_error *error) {
    PS_TRY(PS_NEW(x, 2 * num, "a regression", error));
    for (size_t i = 0; i < num; i++) {
        (*x)[i] = log(logs[i].points);
    }
    return PSPEC_OK;
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

/* times: of either sign */
static ps_uncertain scale(ps_uncertain one, double times) {
    one.value *= times;
    one.error *= fabs(times);
    one.plain *= fabs(times);
    return one;
}

pspec_status ps_rate_fit(ps_rate *out, const ps_log_variance *logs, size_t num, ps_error *error) {
    const double doubled = 2 * log(2);
    double *x = NULL;
    PS_TRY(check_logs(logs, num, error));
    PS_TRY(make_places(&x, logs, num, error));
    double *const factors = x + num;
    *out = (ps_rate){.num = num,
                     .from = logs[0].points,
                     .to = logs[num - 1].points,
                     .change = PS_UNCERTAIN_NONE};
    fit_slope(factors, x, num);
    out->rate = scale(ps_log_variances_combine(logs, factors, num), -1);
    if (num > 2) {
        fit_square(factors, x, num);
        out->change = scale(ps_log_variances_combine(logs, factors, num), -doubled);
    }
    free(x);
    return PSPEC_OK;
}

ps_uncertain ps_rate_between(const ps_log_variance *first, const ps_log_variance *second) {
    const ps_log_variance both[] = {*first, *second};
    const double length = log(second->points / first->points);
    const double factors[] = {1 / length, -1 / length};
    return ps_log_variances_combine(both, factors, 2);
}

/* ---- crossings ----------------------------------------------------------------------------- */

/* ratio: ln(a/b). -1: a has less, 1: b has, 0: not told apart. */
static int which_has_less(const ps_log_variance *ratio, double p_value) {
    const double one = 1;
    const ps_uncertain found = ps_log_variances_combine(ratio, &one, 1);
    const bool is_told = ps_uncertain_p_value(&found, 0) <= p_value;
    return !is_told || ratio->value == 0 ? 0 : ratio->value < 0 ? -1 : 1;
}

/* Where the line through these is 0: the middle less c/s, c the mean and s the slope. */
static pspec_status cross(ps_crossing *out, const ps_log_variance *ratios, size_t num,
                          ps_error *error) {
    double *x = NULL;
    double c = 0;
    PS_TRY(make_places(&x, ratios, num, error));
    double *const factors = x + num;
    for (size_t i = 0; i < num; i++) {
        c += ratios[i].value / (double)num;
    }
    fit_slope(factors, x, num);
    const double s = ps_log_variances_combine(ratios, factors, num).value;
    for (size_t i = 0; i < num; i++) {
        factors[i] = -(1 / (double)num - c / s * factors[i]) / s;
    }
    out->points.value = exp(find_middle(x, num) - c / s);
    out->points.error = out->points.value * ps_log_variances_combine(ratios, factors, num).error;
    out->is_a_below = ratios[0].value < 0;
    free(x);
    return PSPEC_OK;
}

/* From one that is told apart to the next one, which is told apart the other way. */
static pspec_status find_between(ps_crossings *out, const ps_log_variance *ratios, size_t num,
                                 double p_value, ps_error *error) {
    size_t last = num;
    int before = 0;
    for (size_t i = 0; i < num; i++) {
        const int now = which_has_less(&ratios[i], p_value);
        if (now != 0 && now == -before) {
            PS_TRY(cross(&out->found[out->num], ratios + last, i + 1 - last, error));
            out->num++;
        }
        out->num_a += now < 0;
        out->num_b += now > 0;
        last = now != 0 ? i : last;
        before = now != 0 ? now : before;
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
                               const ps_log_variance *b, size_t num, double p_value,
                               ps_error *error) {
    ps_log_variance *ratios = NULL;
    *out = (ps_crossings){.found = found};
    PS_TRY(PS_NEW(&ratios, num, "ratios of variances", error));
    for (size_t i = 0; i < num; i++) {
        const ps_log_variance at_a = move(b, num, i, a[i].points);
        ratios[i] = subtract(&a[i], &at_a);
    }
    const pspec_status status = find_between(out, ratios, num, p_value, error);
    free(ratios);
    return status;
}
