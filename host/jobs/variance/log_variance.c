#include "jobs/variance/log_variance.h"

#include "math/random/distributions.h"

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

ps_log_variance ps_log_variances_difference(const ps_log_variance *a, const ps_log_variance *b) {
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
