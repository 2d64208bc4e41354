#include "job/pattern_check.h"

#include <float.h>
#include <math.h>

static pspec_status check_coordinates(const pspec_pattern *pattern, uint64_t realization,
                                      ps_error *error) {
    const size_t count = pattern->num_points * pattern->dimension;
    for (size_t i = 0; i < count; i++) {
        const double x = pattern->points[i];
        if (!(x >= 0 && x < 1)) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "set %llu, point %zu: coordinate %.17g is outside [0,1)",
                           (unsigned long long)realization + 1, i / pattern->dimension + 1, x);
        }
    }
    return PSPEC_OK;
}

/* The exponent of the largest |w|, or a failure when a weight is not finite or all are 0. */
static pspec_status find_exponent(const pspec_pattern *pattern, uint64_t realization, int *exponent,
                                  ps_error *error) {
    double largest = 0;
    for (size_t j = 0; j < pattern->num_points; j++) {
        const double weight = pattern->weights[j];
        if (!isfinite(weight)) {
            return ps_fail(error, PSPEC_ERROR_INPUT, "set %llu, point %zu: weight %g is not finite",
                           (unsigned long long)realization + 1, j + 1, weight);
        }
        largest = fabs(weight) > largest ? fabs(weight) : largest;
    }
    if (largest == 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "set %llu: all weights are 0",
                       (unsigned long long)realization + 1);
    }
    frexp(largest, exponent);
    return PSPEC_OK;
}

static pspec_status sum_weights(const pspec_pattern *pattern, pspec_normalization normalization,
                                uint64_t realization, ps_pattern_sums *sums, ps_error *error) {
    long double sum = 0;
    long double squares = 0;
    long double sizes = 0;
    PS_TRY(find_exponent(pattern, realization, &sums->exponent, error));
    for (size_t j = 0; j < pattern->num_points; j++) {
        const long double weight = ldexp(pattern->weights[j], -sums->exponent);
        sum += weight;
        squares += weight * weight;
        sizes += fabsl(weight);
    }
    /* A sum this small is what rounding of the weights leaves of an exact zero. */
    const long double rounding = (long double)DBL_EPSILON * sizes;
    if (fabsl(sum) <= rounding && normalization == PSPEC_NORMALIZATION_POWER) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "set %llu: the weights sum to 0, so N |S|^2 / W^2 does not exist; use "
                       "--normalize effective",
                       (unsigned long long)realization + 1);
    }
    sums->weight_sum = (double)sum;
    sums->weight_square_sum = (double)squares;
    return PSPEC_OK;
}

pspec_status ps_pattern_check(const pspec_pattern *pattern, unsigned dimension,
                              pspec_normalization normalization, uint64_t realization,
                              ps_pattern_sums *sums, ps_error *error) {
    if (pattern->dimension != dimension) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "set %llu has dimension %u instead of %u",
                       (unsigned long long)realization + 1, pattern->dimension, dimension);
    }
    if (pattern->num_points == 0 || pattern->points == NULL) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "set %llu has no points",
                       (unsigned long long)realization + 1);
    }
    PS_TRY(check_coordinates(pattern, realization, error));
    *sums = (ps_pattern_sums){0, (double)pattern->num_points, (double)pattern->num_points};
    return pattern->weights == NULL ? PSPEC_OK
                                    : sum_weights(pattern, normalization, realization, sums, error);
}
