#include "spectra/compare.h"

#include "base/memory.h"
#include "math/random/distributions.h"
#include "math/random/holm.h"

#include <math.h>
#include <stdlib.h>

double ps_compared_modes(const ps_frequencies *frequencies) {
    const double last = frequencies->max_frequency;
    if (frequencies->kind == PS_FREQUENCIES_DEGREES) {
        const double all = last * (last + 2); /* sum of 2l + 1 */
        return frequencies->degree_step > 1 ? (all + last) / 2 : all;
    }
    return frequencies->kind == PS_FREQUENCIES_LIST ? 2 * (double)frequencies->num
                                                    : pow(2 * last + 1, frequencies->dimension) - 1;
}

double ps_compared_unit(pspec_normalization normalization, double mean_points,
                        double mean_sample_size, uint64_t smallest_points) {
    const double of_weights = mean_points / mean_sample_size;
    switch (normalization) {
    case PSPEC_NORMALIZATION_EFFECTIVE:
        return 1;
    case PSPEC_NORMALIZATION_INTEGRAL:
        return of_weights * mean_points / (double)smallest_points;
    default:
        return of_weights;
    }
}

/* |S + dS|^2 - |S|^2 <= 2 |S| |dS| + |dS|^2, and at worst all of the error is in this bin. */
double ps_compared_error(double power, double error, double share, double unit) {
    const double e = error / sqrt(share);
    return (2 * sqrt(fabs(power) / unit) * e + e * e) * unit;
}

/* Both sides of a question, and what follows from the numbers of realizations. */
typedef struct sides {
    const ps_compared *saved, *measured;
    double num_saved, num_measured; /* realizations */
    double freedom;                 /* degrees of freedom of the scatter, M_1 + M_2 - 2 */
    double critical;                /* p_value at which the first bin differs */
} sides;

/* Scatter of one realization, from the standard error of the mean. */
static double variance_of(const ps_compared *bin, double num) {
    return num > 1 ? bin->standard_error * bin->standard_error * num : 0;
}

static double relative(double variance, double mean) {
    return variance > 0 ? variance / (mean * mean) : 0;
}

/* cv^2 of both sides together. Relative to the mean of each, which tells blue noise from white with
 * few realizations; but not less than the scatter of both relative to the mean of both: where
 * powers are rare events, a side without any has too small a mean and too small a scatter. */
static double find_scatter(const sides *both, size_t b) {
    const double m = both->num_saved;
    const double n = both->num_measured;
    const ps_compared *const x = &both->saved[b];
    const ps_compared *const y = &both->measured[b];
    const double mean = (m * x->power + n * y->power) / (m + n);
    const double v = (m - 1) * variance_of(x, m);
    const double w = (n - 1) * variance_of(y, n);
    const double own = (relative(v, x->power) + relative(w, y->power)) / both->freedom;
    return fmax(own, relative(v + w, mean) / both->freedom);
}

/* The variance of log cv^2 is (2 + 2 cv^2) / M for gamma variables, 2 / M for normal ones: that
 * many realizations less to learn it from. */
static double freedom_of(const sides *both, double scatter) {
    return both->freedom / (1 + scatter);
}

/* On the logarithm of the ratio, as if it were normal: what has probability 0.9 to be beyond the
 * critical score, and comes on top of the numerical errors. */
static double find_detectable(const sides *both, size_t b, double scatter) {
    const double score_of_power = 1.2815515655446004; /* Phi(it) = 0.9 */
    const double sigma = sqrt(scatter * (1 / both->num_saved + 1 / both->num_measured));
    const double critical =
        sigma > 0 ? ps_student_score(both->critical, freedom_of(both, scatter)) : 0;
    const double errors = both->saved[b].error + both->measured[b].error;
    return expm1((critical + score_of_power) * sigma) + errors / both->saved[b].power;
}

static bool is_equal(const sides *both, size_t b) {
    return fabs(both->measured[b].power - both->saved[b].power) <=
           both->saved[b].error + both->measured[b].error;
}

/* The numerical errors are taken as what they would have to be to bring the two sides together. */
static double find_score(const sides *both, size_t b, double scatter) {
    const double sign = both->measured[b].power > both->saved[b].power ? 1 : -1;
    const double x = fmax(0, both->saved[b].power + sign * both->saved[b].error);
    const double y = fmax(0, both->measured[b].power - sign * both->measured[b].error);
    return scatter > 0
               ? ps_gamma_ratio_score(y, both->num_measured / scatter, x, both->num_saved / scatter)
               : sign * HUGE_VAL;
}

static void compare_bin(ps_comparison *out, const sides *both, size_t b) {
    const double scatter = find_scatter(both, b);
    *out = (ps_comparison){0, 1, 1, find_detectable(both, b, scatter), false};
    if (is_equal(both, b)) {
        return;
    }
    out->score = find_score(both, b, scatter);
    out->p_value = ps_student_two_sided(out->score, freedom_of(both, scatter));
    if (isnan(out->p_value)) {
        out->p_value = 0; /* powers that are no numbers are not those of the other side */
    }
}

static pspec_status adjust(ps_comparison *out, size_t num, double false_alarm_rate,
                           ps_error *error) {
    double *values = NULL;
    PS_TRY(PS_NEW(&values, 2 * num, "probabilities of bins", error));
    double *const adjusted = values + num;
    for (size_t b = 0; b < num; b++) {
        values[b] = out[b].p_value;
    }
    const pspec_status status = ps_holm_adjust(num, values, adjusted, error);
    for (size_t b = 0; status == PSPEC_OK && b < num; b++) {
        out[b].adjusted_p_value = adjusted[b];
        out[b].differs = adjusted[b] <= false_alarm_rate;
    }
    free(values);
    return status;
}

/* Equal powers need no scatter. */
static pspec_status compare_single(ps_comparison *out, size_t num_bins, const sides *both,
                                   ps_error *error) {
    size_t num_equal = 0;
    for (size_t b = 0; b < num_bins; b++) {
        out[b] = (ps_comparison){0, 1, 1, NAN, false};
        num_equal += is_equal(both, b);
    }
    return num_equal == num_bins
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "one saved realization and one measured do not tell how much realizations "
                         "scatter, and %zu of %zu bins are not equal: save at least 2 "
                         "realizations, better 16 or more",
                         num_bins - num_equal, num_bins);
}

pspec_status ps_compare(ps_comparison *out, size_t num_bins, const ps_compared *saved,
                        uint64_t num_saved, const ps_compared *measured, uint64_t num_measured,
                        double false_alarm_rate, ps_error *error) {
    const sides both = {.saved = saved,
                        .measured = measured,
                        .num_saved = (double)num_saved,
                        .num_measured = (double)num_measured,
                        .freedom = (double)num_saved + (double)num_measured - 2,
                        .critical = false_alarm_rate / (double)num_bins};
    if (!(false_alarm_rate > 0 && false_alarm_rate < 1)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "a false alarm rate is above 0 and below 1, not %g", false_alarm_rate);
    }
    if (num_bins == 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "there are no rings or degrees to compare");
    }
    if (both.freedom <= 0) {
        return compare_single(out, num_bins, &both, error);
    }
    for (size_t b = 0; b < num_bins; b++) {
        compare_bin(&out[b], &both, b);
    }
    return adjust(out, num_bins, false_alarm_rate, error);
}
