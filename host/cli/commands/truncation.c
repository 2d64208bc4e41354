/* pointspec truncation: the error of shading integrals as truncated products in harmonics, and how many points of a
 * rule have the same. */
#include "rules/truncation.h"
#include "base/memory.h"
#include "base/text.h"
#include "cli/answer.h"
#include "cli/output_check.h"
#include "cli/picture.h"
#include "questions/options.h"
#include "report/spectrum_header.h"
#include "plots/plot.h"
#include "rules/equal_error.h"
#include "jobs/spectrum/power_phases.h"
#include "jobs/quadrature/quadrature_phases.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DEFAULT_DEGREE = 20, MOST_DEGREE = 10000 };

/* Of kappa and kappa_0, and so of E^2; the brackets of hemispherical sums, relative to E. */
static const double TOLERANCE = 1e-13;
static const double BRACKET = 1e-4;

/* Nine digits of sum b_l^2 must be those of the closed form; where a lobe jumps the sum has its bracket. */
static const double SUM_RULE = 1e-9;

typedef struct answer {
    const ps_request *arguments;
    ps_brdf *brdf;
    ps_representer representer;
    bool is_hemispherical;
    size_t max_degree, sh_degree;
    double *degrees, *errors, *bounds, *points; /* [max_degree + 1] */
} answer;

static answer begin(const ps_request *arguments);
static void end(answer *of);

/* ---- the numbers --------------------------------------------------------------------------- */

pspec_status ps_truncation_check(const ps_request *arguments, ps_error *error) {
    if (arguments->num_files > 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "no file is read, but %s was given",
                       arguments->files[0]);
    }
    if (arguments->brdf == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--brdf NAME is needed, as in --brdf diffuse or --brdf glossy:n=30");
    }
    if (arguments->max_degree > MOST_DEGREE) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: degree %llu is more than %d",
                       ps_option_show(arguments, PS_OPTION_MAX_DEGREE).text,
                       (unsigned long long)arguments->max_degree, MOST_DEGREE);
    }
    return PSPEC_OK;
}

/* The coefficients are right when their squares add up to what int phat^2 is. */
static pspec_status check_sum_rule(const answer *of, double *off, ps_error *error) {
    double sum = 0;
    for (size_t l = of->representer.max_degree + 1; l-- > 0;) {
        sum += of->representer.b[l] * of->representer.b[l];
    }
    *off = sum / of->representer.energy - 1;
    return *off <= SUM_RULE ? PSPEC_OK
                            : ps_fail(error, PSPEC_ERROR_CHECK,
                                      "the sum of the b_l^2 is %.3g of itself above its closed "
                                      "form: the coefficients are wrong",
                                      *off);
}

static pspec_status find_points(const answer *of, const ps_answer_hooks *hooks, ps_error *error) {
    ps_equal_error equal = {.representer = &of->representer, .morph = ps_brdf_morph(of->brdf)};
    for (size_t l = 0; l <= of->max_degree; l++) {
        of->points[l] = NAN;
        if (equal.morph.kind != PS_MORPH_NONE && of->errors[l] > 0) {
            PS_TRY(ps_equal_error_points(&equal, of->errors[l], &of->points[l], error));
        }
        PS_TRY(ps_watch_tell(&hooks->watch, "degrees", l + 1, of->max_degree + 1, NULL, error));
    }
    return PSPEC_OK;
}

/* The errors of all degrees; those of hemispherical harmonics are in brackets, relative to them. */
static pspec_status find_errors(answer *of, double bracket, ps_error *error) {
    enum { COLUMNS = 4 };
    const ps_request *const arguments = of->arguments;
    const size_t num = of->max_degree + 1;
    void *memory = NULL;
    PS_TRY(ps_brdf_parse(&of->brdf, arguments->brdf, error));
    /* twice the degrees: the last one's rest is then mostly summed, not bracketed */
    PS_TRY(ps_representer_create(&of->representer, of->brdf, arguments->smoothness, TOLERANCE,
                                 2 * num, error));
    PS_TRY(ps_allocate(&memory, num, COLUMNS * sizeof(double), "degrees", error));
    of->degrees = memory;
    of->errors = of->degrees + num;
    of->bounds = of->errors + num;
    of->points = of->bounds + num;
    for (size_t l = 0; l < num; l++) {
        of->degrees[l] = (double)l;
    }
    if (of->is_hemispherical) {
        PS_TRY(ps_truncation_hemispherical(of->brdf, arguments->smoothness, of->max_degree, bracket,
                                           of->errors, of->bounds, &of->sh_degree, error));
        return PSPEC_OK;
    }
    of->sh_degree = of->representer.max_degree;
    return ps_truncation_spherical(&of->representer, of->max_degree, of->errors, of->bounds, error);
}

static pspec_status find_answer(answer *of, const ps_answer_hooks *hooks, ps_error *error) {
    PS_TRY(find_errors(of, BRACKET, error));
    return find_points(of, hooks, error);
}

/* Pairs, and points, of a rule. */
static void add_rule(const answer *of, ps_phases *phases, double num) {
    static const char name[] = "points of equal error";
    ps_phases_add(phases, name, PS_HOST_FIBONACCI, num);
    ps_phases_add_sets(phases, name, PS_HOST_KAPPA, num * (double)of->representer.num_terms, 1);
    ps_phases_add_sets(phases, name,
                       of->arguments->smoothness == 1.5 ? PS_HOST_PAIR : PS_HOST_PAIR_POWER,
                       num * num / 2, 1);
}

/* Of every degree how many points will have its error: E falls like N^(-s/2) from a rule that is cheap. Each takes two
 * rules of about so many, and all together the rungs of the ladder up to the highest. */
static pspec_status add_equal_points(answer *of, ps_phases *phases, ps_error *error) {
    enum { FEW = 256, STEPS = 2 };
    const double s = of->arguments->smoothness;
    const ps_morph morph = ps_brdf_morph(of->brdf);
    double of_few = 0;
    double most = 1;
    PS_TRY(ps_fibonacci_error(&of->representer, &morph, FEW, &of_few, error));
    for (size_t l = 0; l <= of->max_degree; l++) {
        const double num = FEW * pow(of_few / of->errors[l], 2 / s);
        const bool is_there = of->errors[l] > 0 && num <= PS_EQUAL_ERROR_MOST;
        most = of->errors[l] > 0 ? fmax(most, fmin(num, PS_EQUAL_ERROR_MOST)) : most;
        for (int step = 0; is_there && step < STEPS; step++) {
            add_rule(of, phases, num);
        }
    }
    for (double num = 1; num < 2 * most; num *= 2) {
        add_rule(of, phases, num);
    }
    ps_phases_say(phases, "points of equal error", "rules of up to %.3g points", most);
    return PSPEC_OK;
}

/* Steps of the conversion go as L X^2, X growing until the brackets are narrow enough: to where they usually are. */
static void add_conversion(const answer *of, ps_phases *phases) {
    const double usual = 1000;
    const double x = fmax(usual, 4 * (double)of->max_degree);
    ps_phases_add(phases, "conversion", PS_HOST_HEMISPHERE, (double)of->max_degree * x * x);
    ps_phases_say(phases, "conversion", "of hemispherical harmonics to spherical ones");
    ps_phases_limit(phases, "conversion");
}

pspec_status ps_truncation_phases(const ps_request *arguments, ps_phases *phases, ps_error *error) {
    enum { FEW_DEGREES = 60 };
    const double loose = 0.5;
    answer of = begin(arguments);
    PS_TRY(ps_truncation_check(arguments, error));
    /* Errors of many degrees in hemispherical harmonics take their time: those in spherical ones are about as large. */
    const bool is_hemispherical = of.is_hemispherical;
    of.is_hemispherical = is_hemispherical && of.max_degree <= FEW_DEGREES;
    pspec_status status = find_errors(&of, loose, error);
    if (status == PSPEC_OK) {
        ps_phases_start(phases, NULL);
        ps_phases_lobe(phases, &of.representer);
        if (is_hemispherical && of.errors[0] > 0) {
            add_conversion(&of, phases);
        }
        if (ps_brdf_morph(of.brdf).kind != PS_MORPH_NONE) {
            status = add_equal_points(&of, phases, error);
        }
        ps_phases_add(phases, "results", PS_HOST_ROW, (double)of.max_degree);
        ps_phases_say(phases, "results", "a table");
    }
    end(&of);
    return status;
}

/* ---- the table ----------------------------------------------------------------------------- */

static pspec_status add_header(ps_table *table, const answer *of, ps_error *error) {
    char check[128];
    double off = 0;
    double worst = 0;
    PS_TRY(check_sum_rule(of, &off, error));
    for (size_t l = 0; l <= of->max_degree; l++) {
        worst = fmax(worst, of->bounds[l]);
    }
    snprintf(check, sizeof check, "sum b_l^2 to degree %zu is 1 %+.2g of its closed form",
             of->representer.max_degree, off);
    const char *const note = ps_brdf_note(of->brdf);
    const ps_meta entries[] = {
        {"pointspec_version", PS_TEXT(pspec_version())},
        {"schema", PS_INTEGER(1)},
        {"command", PS_TEXT(of->arguments->command_line)},
        {"device", PS_TEXT("none")},
        {"engine", PS_TEXT("host")},
        {"precision", PS_TEXT("double")},
        {"tolerance", PS_NUMBER(TOLERANCE)},
        {"predicted_error", PS_NUMBER(worst)},
        {"self_check", PS_TEXT(check)},
        {"brdf", PS_TEXT(of->arguments->brdf)},
        {"smoothness", PS_NUMBER(of->arguments->smoothness)},
        {"harmonics", PS_TEXT(of->is_hemispherical ? "hemispherical" : "spherical")},
        {"spherical_degrees", PS_INTEGER(of->sh_degree)},
        {"kappa_0", PS_NUMBER(of->representer.kappa_0)},
        {"equivalent_points",
         PS_TEXT(ps_brdf_morph(of->brdf).kind == PS_MORPH_NONE
                     ? "not known: no rule has the density of this lobe"
                     : "of equal-weight spherical Fibonacci points morphed to the lobe; empty "
                       "beyond 32768")},
        {"skipped", PS_TEXT("none")},
    };
    PS_TRY(ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error));
    return note != NULL ? ps_table_add_meta(table, "note", PS_TEXT(note), error) : PSPEC_OK;
}

static pspec_status make_table(ps_table **out, const answer *of, ps_error *error) {
    static const char *const columns[] = {"degree", "error", "equivalent_points"};
    enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };
    PS_TRY(ps_table_create(out, "truncation", columns, NUM_COLUMNS, error));
    PS_TRY(add_header(*out, of, error));
    for (size_t l = 0; l <= of->max_degree; l++) {
        const ps_cell cells[NUM_COLUMNS] = {PS_INTEGER(l), PS_NUMBER(of->errors[l]),
                                            ps_number_or_missing(of->points[l])};
        PS_TRY(ps_table_add_row(*out, cells, error));
    }
    return PSPEC_OK;
}

static pspec_status write_plot(const answer *of, ps_error *error) {
    ps_text title = {0};
    ps_text_append(&title, "%s, %s harmonics, smoothness %g", of->arguments->brdf,
                   of->is_hemispherical ? "hemispherical" : "spherical", of->arguments->smoothness);
    const ps_plot_line line = {NULL, of->max_degree + 1, of->degrees, of->errors};
    const ps_line_plot plot = {.title = ps_text_string(&title),
                               .x_label = "largest degree L",
                               .y_label = "worst-case error E(L)",
                               .is_log_y = true,
                               .num_lines = 1,
                               .lines = &line};
    pspec_status status = ps_text_check(&title, error);
    if (status == PSPEC_OK) {
        status = ps_line_plot_write(of->arguments->plot, &plot, error);
    }
    ps_text_free(&title);
    return status;
}

static answer begin(const ps_request *arguments) {
    const char *const harmonics = arguments->harmonics;
    return (answer){
        .arguments = arguments,
        .is_hemispherical = harmonics != NULL && strcmp(harmonics, "hemispherical") == 0,
        .max_degree = arguments->max_degree > 0 ? (size_t)arguments->max_degree : DEFAULT_DEGREE};
}

static void end(answer *of) {
    free(of->degrees);
    ps_representer_destroy(&of->representer);
    ps_brdf_destroy(of->brdf);
}

pspec_status ps_truncation_answer(ps_table **out, const ps_request *request,
                                  const ps_answer_hooks *hooks, ps_error *error) {
    answer of = begin(request);
    PS_TRY(ps_truncation_check(request, error));
    pspec_status status = find_answer(&of, hooks, error);
    if (status == PSPEC_OK) {
        status = make_table(out, &of, error);
    }
    end(&of);
    return status;
}

static pspec_status find_shown(answer *of, ps_error *error) {
    ps_progress *const progress = ps_progress_begin(of->arguments, "degrees");
    const ps_answer_hooks hooks = {.watch = {ps_progress_tell, progress}};
    const pspec_status status = find_answer(of, &hooks, error);
    ps_progress_end(progress);
    return status;
}

static pspec_status run(const ps_request *arguments, ps_error *error) {
    const char *const path = arguments->output != NULL ? arguments->output : "-";
    ps_table_format format = PS_FORMAT_CSV;
    ps_table *table = NULL;
    answer of = begin(arguments);
    pspec_status status = PSPEC_OK;
    PS_TRY(ps_truncation_check(arguments, error));
    PS_TRY(ps_table_choose_format(&format, arguments->format, path, error));
    PS_TRY(ps_picture_check(arguments, error));
    PS_TRY(ps_outputs_check(arguments, true, error));
    PS_TRY_OUT(status, find_shown(&of, error));
    PS_TRY_OUT(status, make_table(&table, &of, error));
    PS_TRY_OUT(status, ps_table_write(table, path, format, error));
    if (arguments->plot != NULL) {
        status = ps_picture_settle(arguments, write_plot(&of, error), error);
    }
out:
    ps_table_destroy(table);
    end(&of);
    return status;
}

/* Beside those of the question. */
static const ps_option_id options[] = {PS_OPTION_OUTPUT, PS_OPTION_FORMAT, PS_OPTION_PLOT,
                                       PS_OPTION_QUIET,  PS_OPTION_HELP,   PS_NUM_OPTIONS};

const ps_command ps_command_truncation = {
    .name = "truncation",
    .summary = "error of shading integrals by truncated harmonics, and equivalent points",
    .usage = "truncation --brdf NAME[:key=value,...] [options]",
    .description =
        "Prints for L = 0, 1, ... the worst-case error of the integral of light times BRDF when "
        "it is a sum over harmonics up to and including degree L, for light from the unit ball of "
        "the Sobolev space H^S: E(L)^2 = sum_{l>L} a_l b_l^2 for spherical harmonics. "
        "equivalent_points is the number of spherical Fibonacci points, morphed to the lobe and "
        "with equal weights, whose worst-case error is the same.",
    .result = &ps_result_truncation,
    .options = options,
    .examples =
        {"pointspec truncation --brdf glossy:n=30 --smoothness 1.5",
         "pointspec truncation --brdf diffuse --harmonics hemispherical -l 4 --format json"},
    .run = run,
};
