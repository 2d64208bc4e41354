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

static pspec_status sum_weights(const pspec_pattern *pattern, pspec_normalization normalization,
                                uint64_t realization, ps_pattern_sums *sums, ps_error *error) {
    long double sum = 0;
    long double squares = 0;
    long double sizes = 0;
    for (size_t j = 0; j < pattern->num_points; j++) {
        const double weight = pattern->weights[j];
        if (!isfinite(weight)) {
            return ps_fail(error, PSPEC_ERROR_INPUT, "set %llu, point %zu: weight %g is not finite",
                           (unsigned long long)realization + 1, j + 1, weight);
        }
        sum += weight;
        squares += (long double)weight * weight;
        sizes += fabsl((long double)weight);
    }
    /* A sum this small is what rounding of the weights leaves of an exact zero. */
    const long double rounding = (long double)DBL_EPSILON * sizes;
    if (fabsl(sum) <= rounding && normalization == PSPEC_NORMALIZATION_POWER) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "set %llu: the weights sum to 0, so N |S|^2 / W^2 does not exist; use "
                       "--normalize effective",
                       (unsigned long long)realization + 1);
    }
    if (squares == 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "set %llu: all weights are 0",
                       (unsigned long long)realization + 1);
    }
    *sums = (ps_pattern_sums){(double)sum, (double)squares};
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
    *sums = (ps_pattern_sums){(double)pattern->num_points, (double)pattern->num_points};
    return pattern->weights == NULL ? PSPEC_OK
                                    : sum_weights(pattern, normalization, realization, sums, error);
}
