#include "jobs/pattern_check.h"

#include "math/unit_vector.h"

#include <float.h>
#include <math.h>

static double length_off(double square) {
    return fabs(sqrt(square) - 1);
}

static pspec_status refuse_vector(const ps_pattern_count *count, const pspec_pattern *block,
                                  ps_error *error) {
    size_t j = 0;
    while (j + 1 < block->num_points &&
           length_off(ps_square_length(block->points + j * PS_SPHERE_DIMENSION)) <=
               PS_UNIT_LENGTH_SLACK) {
        j++;
    }
    const double *u = block->points + j * PS_SPHERE_DIMENSION;
    return ps_fail(error, PSPEC_ERROR_INPUT,
                   "set %llu, point %llu: the vector (%.17g, %.17g, %.17g) has the length %g "
                   "instead of 1",
                   (unsigned long long)count->realization + 1,
                   (unsigned long long)(count->num_points + j + 1), u[0], u[1], u[2],
                   sqrt(ps_square_length(u)));
}

/* A square that overflows is infinite, and refused like any other. Roots grow with their squares,
 * so that the shortest and the longest vector say what all of them are off at most. */
static pspec_status check_vectors(ps_pattern_count *count, const pspec_pattern *block,
                                  ps_error *error) {
    double least = 1, most = 1;
    bool are_numbers = true;
    for (size_t j = 0; j < block->num_points; j++) {
        const double square = ps_square_length(block->points + j * PS_SPHERE_DIMENSION);
        least = square < least ? square : least;
        most = square > most ? square : most;
        are_numbers &= square == square;
    }
    const double off = fmax(length_off(least), length_off(most));
    count->length_error = off > count->length_error ? off : count->length_error;
    return are_numbers && off <= PS_UNIT_LENGTH_SLACK ? PSPEC_OK
                                                      : refuse_vector(count, block, error);
}

static pspec_status check_coordinates(const ps_pattern_count *count, const pspec_pattern *block,
                                      ps_error *error) {
    const size_t num = block->num_points * block->dimension;
    for (size_t i = 0; i < num; i++) {
        const double x = block->points[i];
        if (!(x >= 0 && x < 1)) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "set %llu, point %llu: coordinate %.17g is outside [0,1)",
                           (unsigned long long)count->realization + 1,
                           (unsigned long long)(count->num_points + i / block->dimension + 1), x);
        }
    }
    return PSPEC_OK;
}

/* The exponent of the largest |w| so far; sums are kept in step, which changes none of their bits.
 */
static pspec_status raise_exponent(ps_pattern_count *count, const double *weights,
                                   size_t num_weights, ps_error *error) {
    double largest = count->largest;
    int exponent = 0;
    for (size_t j = 0; j < num_weights; j++) {
        if (!isfinite(weights[j])) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "set %llu, point %llu: weight %g is not finite",
                           (unsigned long long)count->realization + 1,
                           (unsigned long long)(count->num_weights + j + 1), weights[j]);
        }
        largest = fabs(weights[j]) > largest ? fabs(weights[j]) : largest;
    }
    frexp(largest, &exponent);
    if (count->largest > 0 && exponent > count->exponent) {
        const int raised = exponent - count->exponent;
        count->sum = ldexpl(count->sum, -raised);
        count->squares = ldexpl(count->squares, -2 * raised);
        count->sizes = ldexpl(count->sizes, -raised);
    }
    count->largest = largest;
    count->exponent = exponent;
    return PSPEC_OK;
}

pspec_status ps_pattern_count_weights(ps_pattern_count *count, const double *weights,
                                      size_t num_weights, ps_error *error) {
    PS_TRY(raise_exponent(count, weights, num_weights, error));
    for (size_t j = 0; j < num_weights; j++) {
        const long double weight = ldexpl(weights[j], -count->exponent);
        count->sum += weight;
        count->squares += weight * weight;
        count->sizes += fabsl(weight);
    }
    count->num_weights += num_weights;
    return PSPEC_OK;
}

pspec_status ps_pattern_count_add(ps_pattern_count *count, const pspec_pattern *block,
                                  ps_error *error) {
    PS_TRY(count->on_sphere ? check_vectors(count, block, error)
                            : check_coordinates(count, block, error));
    count->num_points += block->num_points;
    return block->weights != NULL
               ? ps_pattern_count_weights(count, block->weights, block->num_points, error)
               : PSPEC_OK;
}

pspec_status ps_pattern_check_largest(double largest, uint64_t realization, ps_error *error) {
    const double least = PS_LEAST_ABSOLUTE_WEIGHT;
    const double most = PS_MOST_ABSOLUTE_WEIGHT;
    return largest == 0 || (largest >= least && largest <= most)
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "set %llu: the largest |weight|, %.17g, is not between %g and %g, where "
                         "squares of errors are numbers; multiply all weights by a constant",
                         (unsigned long long)realization + 1, largest, least, most);
}

static pspec_status check_size(const ps_pattern_count *count, ps_error *error) {
    return ldexpl(count->sizes, count->exponent) <= (long double)PS_MOST_WEIGHT_SUM
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "set %llu: the largest |weight| is %.17g, and all |weight| sum to more "
                         "than %g, up to which sums over sets are numbers; multiply all weights by "
                         "a constant",
                         (unsigned long long)count->realization + 1, count->largest,
                         PS_MOST_WEIGHT_SUM);
}

/* P needs W. A sum this small is what rounding of the weights leaves of an exact zero. */
static pspec_status check_sum(const ps_pattern_count *count, ps_error *error) {
    const long double rounding = (long double)DBL_EPSILON * count->sizes;
    return fabsl(count->sum) > rounding
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "set %llu: the weights sum to 0%s, so N |S|^2 / W^2 does not exist; use "
                         "--normalize effective",
                         (unsigned long long)count->realization + 1,
                         count->sum != 0 ? " within rounding" : "");
}

pspec_status ps_pattern_count_finish(const ps_pattern_count *count,
                                     pspec_normalization normalization, ps_pattern_sums *sums,
                                     ps_error *error) {
    const unsigned long long set = (unsigned long long)count->realization + 1;
    if (count->num_weights == 0) {
        const double num = (double)count->num_points;
        *sums = (ps_pattern_sums){0, true, num, num, num, count->length_error};
        return PSPEC_OK;
    }
    if (count->largest == 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "set %llu: all weights are 0", set);
    }
    PS_TRY(normalization == PSPEC_NORMALIZATION_PAIRS
               ? ps_pattern_check_largest(count->largest, count->realization, error)
               : check_size(count, error));
    if (normalization == PSPEC_NORMALIZATION_POWER ||
        normalization == PSPEC_NORMALIZATION_INTEGRAL) {
        PS_TRY(check_sum(count, error));
    }
    *sums = (ps_pattern_sums){count->exponent,      false,
                              (double)count->sum,   (double)count->squares,
                              (double)count->sizes, count->length_error};
    return PSPEC_OK;
}

pspec_status ps_pattern_check_dimension(unsigned dimension, unsigned wanted, uint64_t realization,
                                        ps_error *error) {
    return dimension == wanted
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "set %llu has dimension %u instead of %u",
                         (unsigned long long)realization + 1, dimension, wanted);
}

pspec_status ps_pattern_check_size(const ps_frequencies *frequencies, uint64_t num_points,
                                   uint64_t realization, ps_error *error) {
    const ps_bin_rule *const bins = &frequencies->bins;
    return bins->kind != PS_BINS_RELATIVE || bins->num_points == num_points
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "set %llu has %llu points, and bins of %s are relative to %llu: all sets "
                         "must have one number of points",
                         (unsigned long long)realization + 1, (unsigned long long)num_points,
                         ps_bin_rule_write(bins).text, (unsigned long long)bins->num_points);
}

pspec_status ps_pattern_check(const pspec_pattern *pattern, const ps_frequencies *frequencies,
                              pspec_normalization normalization, uint64_t realization,
                              ps_pattern_sums *sums, ps_error *error) {
    ps_pattern_count count = {.realization = realization,
                              .on_sphere = frequencies->kind == PS_FREQUENCIES_DEGREES};
    PS_TRY(
        ps_pattern_check_dimension(pattern->dimension, frequencies->dimension, realization, error));
    if (pattern->num_points == 0 || pattern->points == NULL) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "set %llu has no points",
                       (unsigned long long)realization + 1);
    }
    PS_TRY(ps_pattern_check_size(frequencies, pattern->num_points, realization, error));
    PS_TRY(ps_pattern_count_add(&count, pattern, error));
    return ps_pattern_count_finish(&count, normalization, sums, error);
}

void ps_pattern_straighten(double u[3]) {
    const double square = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    if (fabs(square - 1) > 4 * DBL_EPSILON) {
        const double length = sqrt(square);
        for (int i = 0; i < 3; i++) {
            u[i] /= length;
        }
    }
}
