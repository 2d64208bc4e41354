#include "answers/compare.h"

#include "spectra/compare.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Standard errors by which answers of other realizations may be apart: of some thousand rings one
 * in a million runs is. */
static const double FAR = 7;

static double meta_number(const ps_table *table, const char *key) {
    return ps_cell_number(ps_table_find_meta(table, key));
}

static double value_at(const ps_table *table, size_t row, const char *name) {
    size_t column = 0;
    return ps_table_find_column(table, name, &column)
               ? ps_cell_number(ps_table_cell(table, row, column))
               : NAN;
}

/* Standard errors count where the realizations are not the same ones. */
static bool are_other_realizations(const ps_table *a, const ps_table *b) {
    return meta_number(a, "realizations") != meta_number(b, "realizations");
}

/* |x - y| in units of what the two sides allow. */
static double apart(double x, double y, double bound, double scatter) {
    const double rounding = 1e-15;
    return fabs(x - y) / (bound + FAR * scatter + rounding * (fabs(x) + fabs(y)) + 1e-300);
}

static double scatter_of(double a, double b) {
    return hypot(isnan(a) ? 0 : a, isnan(b) ? 0 : b);
}

/* Bounds the error of the power of a bin, in the share that it has of all modes. */
static double bound_of(const ps_table *table, size_t row, double modes) {
    const double count = value_at(table, row, "count");
    const double degree = value_at(table, row, "degree");
    const double own = isnan(count) ? 2 * degree + 1 : count;
    return ps_compared_error(value_at(table, row, "power"), meta_number(table, "predicted_error"),
                             own / modes, 1);
}

static double count_modes(const ps_table *table) {
    double modes = 0;
    for (size_t row = 0; row < ps_table_num_rows(table); row++) {
        const double count = value_at(table, row, "count");
        modes += isnan(count) ? 2 * value_at(table, row, "degree") + 1 : count;
    }
    return modes;
}

static bool have_same_rows(const ps_table *a, const ps_table *b) {
    return ps_table_num_rows(a) == ps_table_num_rows(b);
}

double ps_compare_powers(const ps_table *a, const ps_table *b) {
    if (!have_same_rows(a, b)) {
        return INFINITY;
    }
    double worst = 0;
    const bool are_other = are_other_realizations(a, b);
    const double modes = count_modes(a);
    for (size_t row = 0; row < ps_table_num_rows(a); row++) {
        const double scatter = are_other ? scatter_of(value_at(a, row, "standard_error"),
                                                      value_at(b, row, "standard_error"))
                                         : 0;
        worst = fmax(worst, apart(value_at(a, row, "power"), value_at(b, row, "power"),
                                  bound_of(a, row, modes) + bound_of(b, row, modes), scatter));
    }
    return worst;
}

double ps_compare_pair_sums(const ps_table *a, const ps_table *b) {
    if (!have_same_rows(a, b)) {
        return INFINITY;
    }
    double worst = 0;
    const double bound = meta_number(a, "predicted_error") + meta_number(b, "predicted_error");
    const bool are_other = are_other_realizations(a, b);
    for (size_t row = 0; row < ps_table_num_rows(a); row++) {
        const double scatter = are_other ? scatter_of(value_at(a, row, "legendre_sum_error"),
                                                      value_at(b, row, "legendre_sum_error"))
                                         : 0;
        worst = fmax(worst, apart(value_at(a, row, "legendre_sum"),
                                  value_at(b, row, "legendre_sum"), bound, scatter));
    }
    return worst;
}

/* E^2 to the tolerance c T, c being 2^(2s-1)/s, and what the header announces. */
double ps_compare_rules(const ps_table *a, const ps_table *b) {
    const double e = meta_number(a, "worst_case_error");
    const double f = meta_number(b, "worst_case_error");
    const double smoothness = meta_number(a, "smoothness");
    const double unit = pow(2, 2 * smoothness - 1) / smoothness;
    const double sum = meta_number(a, "weight_sum");
    const double bound = meta_number(a, "tolerance") * unit * sum * sum +
                         meta_number(a, "predicted_error") + meta_number(b, "predicted_error");
    const double scatter =
        are_other_realizations(a, b)
            ? scatter_of(2 * e * meta_number(a, "worst_case_error_standard_error"),
                         2 * f * meta_number(b, "worst_case_error_standard_error"))
            : 0;
    return apart(e * e, f * f, bound, scatter);
}

/* An error e of amplitudes relative to white noise, whose variance is `white`, is one of a variance
 * v by sqrt(v) -> sqrt(v) + e sqrt(white); single precision of values is one of that kind. */
static double variances_apart(const ps_table *a, const ps_table *b, size_t row, const char *name,
                              const char *error_name) {
    const double single = 1e-6;
    const double e = meta_number(a, "predicted_error") + meta_number(b, "predicted_error") + single;
    const double v = value_at(a, row, name);
    const double white = value_at(a, row, "white");
    const double scatter = are_other_realizations(a, b) ? scatter_of(value_at(a, row, error_name),
                                                                     value_at(b, row, error_name))
                                                        : 0;
    return apart(v, value_at(b, row, name), e * (2 * sqrt(fabs(v * white)) + e * white), scatter);
}

double ps_compare_variances(const ps_table *a, const ps_table *b) {
    double worst = 0;
    if (!have_same_rows(a, b)) {
        return INFINITY;
    }
    for (size_t row = 0; row < ps_table_num_rows(a); row++) {
        worst = fmax(worst, variances_apart(a, b, row, "predicted", "predicted_error"));
        worst = fmax(worst, variances_apart(a, b, row, "measured", "measured_error"));
    }
    return worst;
}

double ps_compare_verdicts(const ps_table *a, const ps_table *b) {
    const ps_cell x = ps_table_find_meta(a, "verdict");
    const ps_cell y = ps_table_find_meta(b, "verdict");
    const bool are_same =
        x.kind != PS_CELL_TEXT || y.kind != PS_CELL_TEXT || strcmp(x.text, y.text) == 0;
    return have_same_rows(a, b) && are_same ? 0 : INFINITY;
}
