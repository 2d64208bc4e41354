/* How far two answers to the same question are apart, made with other engines, or of other
 * realizations. */
#include "answers/kind.h"

#include "spectra/compare.h"

#include <math.h>
#include <string.h>

/* Standard errors by which answers of other realizations may be apart: of some thousand rings one
 * in a million runs is. */
static const double FAR = 7;

/* ---- values ---------------------------------------------------------------------------------- */

static double value_at(const ps_table *table, size_t row, const char *name) {
    return ps_cell_number(ps_table_find_cell(table, row, name));
}

static double of_header(const ps_table *table, const char *key) {
    return ps_cell_number(ps_table_find_meta(table, key));
}

static ps_cell find(const ps_compared_field *what, const ps_table *table, size_t row,
                    const char *name) {
    return what->is_of_header ? ps_table_find_meta(table, name)
                              : ps_table_find_cell(table, row, name);
}

static double predicted_errors(const ps_both_tables *both) {
    return of_header(both->a, "predicted_error") + of_header(both->b, "predicted_error");
}

/* ---- what is allowed ------------------------------------------------------------------------- */

/* Frequencies of a ring, coefficients of a degree. */
static double modes_of(const ps_table *table, size_t row) {
    const double count = value_at(table, row, "count");
    return isnan(count) ? 2 * value_at(table, row, "degree") + 1 : count;
}

/* Bounds the error of the power of a bin, in the share that it has of all modes. */
static double power_bound(const ps_table *table, size_t row, double modes) {
    return ps_compared_error(value_at(table, row, "power"), of_header(table, "predicted_error"),
                             modes_of(table, row) / modes, 1);
}

double ps_compared_power_bound(const ps_both_tables *both, const char *value) {
    (void)value;
    return power_bound(both->a, both->row, both->modes) +
           power_bound(both->b, both->row, both->modes);
}

double ps_compared_predicted_bound(const ps_both_tables *both, const char *value) {
    (void)value;
    return predicted_errors(both);
}

/* E^2 to the tolerance c T, c being 2^(2s-1)/s, and what the header announces; E to what of it its
 * slope leaves. */
double ps_compared_rule_bound(const ps_both_tables *both, const char *value) {
    const double smoothness = of_header(both->a, "smoothness");
    const double unit = pow(2, 2 * smoothness - 1) / smoothness;
    const double sum = of_header(both->a, "weight_sum");
    const double of_square =
        of_header(both->a, "tolerance") * unit * sum * sum + predicted_errors(both);
    return of_square / (of_header(both->a, value) + of_header(both->b, value));
}

/* An error e of amplitudes relative to white noise, whose variance is `white`, is one of a variance
 * v by sqrt(v) -> sqrt(v) + e sqrt(white); single precision of values is one of that kind. */
double ps_compared_variance_bound(const ps_both_tables *both, const char *value) {
    const double single = 1e-6;
    const double e = predicted_errors(both) + single;
    const double white = value_at(both->a, both->row, "white");
    return e * (2 * sqrt(fabs(value_at(both->a, both->row, value) * white)) + e * white);
}

/* ---- the comparison -------------------------------------------------------------------------- */

/* |x - y| in units of what the two sides allow; texts are the same, or they are not. Standard
 * errors count where the realizations are not the same ones. */
static double apart(const ps_compared_field *what, const ps_both_tables *both) {
    const double rounding = 1e-15;
    const ps_cell a = find(what, both->a, both->row, what->value);
    const ps_cell b = find(what, both->b, both->row, what->value);
    if (what->bound == NULL) {
        const bool are_texts = a.kind == PS_CELL_TEXT && b.kind == PS_CELL_TEXT;
        return are_texts && strcmp(a.text, b.text) != 0 ? INFINITY : 0;
    }
    const double x = ps_cell_number(a);
    const double y = ps_cell_number(b);
    double scatter = 0;
    if (of_header(both->a, "realizations") != of_header(both->b, "realizations")) {
        const double s = ps_cell_number(find(what, both->a, both->row, what->error));
        const double t = ps_cell_number(find(what, both->b, both->row, what->error));
        scatter = hypot(isnan(s) ? 0 : s, isnan(t) ? 0 : t);
    }
    return fabs(x - y) / (what->bound(both, what->value) + FAR * scatter +
                          rounding * (fabs(x) + fabs(y)) + 1e-300);
}

double ps_answer_compare(const ps_kind *kind, const ps_table *a, const ps_table *b) {
    ps_both_tables both = {a, b, 0, 0};
    double worst = 0;
    for (size_t row = 0; row < ps_table_num_rows(a); row++) {
        both.modes += modes_of(a, row);
    }
    for (const ps_compared_field *what = kind->compared; what != NULL && what->value != NULL;
         what++) {
        const size_t num = what->is_of_header ? 1 : ps_table_num_rows(a);
        if (!what->is_of_header && num != ps_table_num_rows(b)) {
            return INFINITY;
        }
        for (both.row = 0; both.row < num; both.row++) {
            worst = fmax(worst, apart(what, &both));
        }
    }
    return worst;
}
