#include "cli/commands/bench_scenes.h"

#include "spectra/compare.h"
#include "cli/run/run.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Standard errors by which answers of other realizations may be apart: of some thousand rings one in a million runs is. */
static const double FAR = 7;

/* Runs of each kind, in turn; the fastest counts, since a machine has other things to do. */
enum { RUNS = 2 };

static double meta_number(const ps_table *table, const char *key) {
    return ps_cell_number(ps_run_meta(table, key));
}

static double value_at(const ps_table *table, size_t row, const char *name) {
    size_t column = 0;
    return ps_table_find_column(table, name, &column)
               ? ps_cell_number(ps_table_cell(table, row, column))
               : NAN;
}

/* ---- how far answers are apart ------------------------------------------------------------- */

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

/* Of a bin: the bound of the error of its power, in the share that it has of all modes. */
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

static double compare_powers(const ps_table *a, const ps_table *b) {
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

static double compare_pair_sums(const ps_table *a, const ps_table *b) {
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
static double compare_rules(const ps_table *a, const ps_table *b) {
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

/* 1 is what is allowed; infinite where one side has rows that the other lacks. */
static double compare(const ps_result_kind *kind, const ps_table *a, const ps_table *b) {
    if (kind == &ps_result_quadrature) {
        return compare_rules(a, b);
    }
    if (ps_table_num_rows(a) != ps_table_num_rows(b)) {
        return INFINITY;
    }
    if (kind == &ps_result_power || kind == &ps_result_angular) {
        return compare_powers(a, b);
    }
    if (kind == &ps_result_pairs) {
        return compare_pair_sums(a, b);
    }
    const ps_cell x = ps_run_meta(a, "verdict");
    const ps_cell y = ps_run_meta(b, "verdict");
    const bool are_same =
        x.kind != PS_CELL_TEXT || y.kind != PS_CELL_TEXT || strcmp(x.text, y.text) == 0;
    return are_same ? 0 : INFINITY;
}

static double compare_result(const ps_run_result *a, const ps_run_result *b) {
    double worst = 0;
    for (size_t q = 0; q < a->num; q++) {
        worst = fmax(worst, compare(a->asked->kind, a->questions[q].answer.table,
                                    b->questions[q].answer.table));
    }
    return worst;
}

/* ---- runs ---------------------------------------------------------------------------------- */

/* Answers of one scene: with skips, and without. */
typedef struct comparison {
    const ps_scene *scene;
    ps_request arguments[2];
    ps_run runs[2];
    double differs; /* the largest difference of all results so far */
} comparison;

static pspec_status answer(const ps_request *arguments, const ps_scene *scene, ps_run *out,
                           ps_error *error) {
    *out = (ps_run){.arguments = arguments, .scene = scene};
    PS_TRY(ps_run_ask(out, error));
    return ps_run_answer(out, error);
}

static double seconds_of(const ps_run_result *result) {
    double seconds = 0;
    for (size_t q = 0; q < result->num; q++) {
        seconds += result->questions[q].seconds;
    }
    return seconds;
}

static void keep_fastest(ps_run *run, const ps_run *other) {
    for (size_t i = 0; i < run->num_results; i++) {
        for (size_t q = 0; q < run->results[i].num; q++) {
            double *const seconds = &run->results[i].questions[q].seconds;
            *seconds = fmin(*seconds, other->results[i].questions[q].seconds);
        }
    }
}

/* The first run of each kind is kept for its answers, and compiles what has to be compiled. */
static pspec_status answer_again(comparison *of, int kind, ps_error *error) {
    ps_run again;
    pspec_status status = answer(&of->arguments[kind], of->scene, &again, error);
    if (status == PSPEC_OK) {
        keep_fastest(&of->runs[kind], &again);
    }
    ps_run_free(&again);
    return status;
}

static pspec_status add_rows(ps_table *table, comparison *of, ps_error *error) {
    for (size_t i = 0; i < of->runs[0].num_results; i++) {
        const ps_run_result *const skip = &of->runs[0].results[i];
        const double with = seconds_of(skip);
        const double without = seconds_of(&of->runs[1].results[i]);
        const double difference = compare_result(skip, &of->runs[1].results[i]);
        const ps_cell cells[] = {
            PS_TEXT(of->scene->path), PS_TEXT(skip->asked->name),
            PS_INTEGER(skip->num),    PS_NUMBER(with),
            PS_NUMBER(without),       PS_NUMBER(without / with),
            PS_NUMBER(difference),    PS_TEXT(difference <= 1 ? "same" : "different")};
        of->differs = fmax(of->differs, difference);
        PS_TRY(ps_table_add_row(table, cells, error));
    }
    return PSPEC_OK;
}

static pspec_status bench_scene(ps_table *table, comparison *of, ps_error *error) {
    for (int run = 0; run < RUNS; run++) {
        for (int kind = 0; kind < 2; kind++) {
            PS_TRY(run == 0 ? answer(&of->arguments[kind], of->scene, &of->runs[kind], error)
                            : answer_again(of, kind, error));
        }
    }
    return add_rows(table, of, error);
}

static pspec_status bench_file(ps_table *table, const ps_request *arguments, const char *path,
                               ps_error *error) {
    ps_scene scene;
    comparison of = {.scene = &scene, .arguments = {*arguments, *arguments}};
    of.arguments[1].no_skip = true;
    pspec_status status = ps_scene_read(&scene, path, error);
    if (status == PSPEC_OK) {
        status = bench_scene(table, &of, error);
    }
    ps_run_free(&of.runs[0]);
    ps_run_free(&of.runs[1]);
    ps_scene_free(&scene);
    return status != PSPEC_OK || of.differs <= 1
               ? status
               : ps_fail(error, PSPEC_ERROR_CHECK,
                         "answers of %s with and without skips are %.3g times as far apart as "
                         "both sides allow",
                         path, of.differs);
}

static pspec_status add_header(ps_table *table, const ps_request *arguments, ps_error *error) {
    PS_TRY(ps_table_add_meta(table, "pointspec_version", PS_TEXT(pspec_version()), error));
    PS_TRY(ps_table_add_meta(table, "schema", PS_INTEGER(1), error));
    PS_TRY(ps_table_add_meta(table, "command", PS_TEXT(arguments->command_line), error));
    PS_TRY(ps_table_add_meta(
        table, "time",
        PS_TEXT(
            "of the questions, one after the other, on the clock: the faster of two runs in turn"),
        error));
    return ps_table_add_meta(
        table, "difference",
        PS_TEXT(
            "the largest, in units of the error bounds of both sides and, where realizations are "
            "others, 7 standard errors of the difference; more than 1 is too much"),
        error);
}

pspec_status ps_bench_scenes(ps_table **out, const ps_request *arguments, ps_error *error) {
    static const char *const columns[] = {"scene",           "result",  "questions",  "seconds",
                                          "seconds_no_skip", "speedup", "difference", "verdict"};
    pspec_status verdict = PSPEC_OK;
    ps_error first = {0};
    PS_TRY(ps_table_create(out, "bench", columns, sizeof columns / sizeof columns[0], error));
    PS_TRY(add_header(*out, arguments, error));
    for (size_t i = 0; i < arguments->num_files; i++) {
        const pspec_status status = bench_file(*out, arguments, arguments->files[i], error);
        if (status != PSPEC_OK && status != PSPEC_ERROR_CHECK) {
            return status;
        }
        if (status != PSPEC_OK && verdict == PSPEC_OK) {
            verdict = status;
            first = *error;
        }
    }
    if (verdict != PSPEC_OK) {
        *error = first;
    }
    return verdict;
}
