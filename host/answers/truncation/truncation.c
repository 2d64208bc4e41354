/* The error of shading integrals as truncated products in harmonics, and how many points of a
 * rule have the same. */
#include "answers/compare.h"
#include "answers/kind.h"
#include "answers/spectra/spectrum_header.h"
#include "base/memory.h"
#include "base/text.h"
#include "jobs/quadrature/quadrature_phases.h"
#include "jobs/spectrum/power_phases.h"
#include "plots/plot.h"
#include "request/options.h"
#include "rules/equal_error.h"
#include "rules/truncation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DEFAULT_DEGREE = 20, MOST_DEGREE = 10000 };

/* How exact kappa and kappa_0 are, and so E^2; how far apart the brackets of hemispherical sums may
 * be, relative to E. */
static const double TOLERANCE = 1e-13;
static const double BRACKET = 1e-4;

/* Nine digits of sum b_l^2 must be those of the closed form; where a lobe jumps the sum has its
 * bracket. */
static const double SUM_RULE = 1e-9;

typedef struct truncation {
    const ps_request *arguments;
    ps_brdf *brdf;
    ps_representer representer;
    bool is_hemispherical;
    size_t max_degree, sh_degree;
    double *degrees, *errors, *bounds, *points; /* [max_degree + 1] */
} truncation;

static truncation begin(const ps_request *arguments) {
    const char *const harmonics = arguments->harmonics;
    return (truncation){
        .arguments = arguments,
        .is_hemispherical = harmonics != NULL && strcmp(harmonics, "hemispherical") == 0,
        .max_degree = arguments->max_degree > 0 ? (size_t)arguments->max_degree : DEFAULT_DEGREE};
}

static void end(truncation *answer) {
    free(answer->degrees);
    ps_representer_destroy(&answer->representer);
    ps_brdf_destroy(answer->brdf);
}

/* ---- the numbers --------------------------------------------------------------------------- */

static pspec_status check_question(const ps_request *arguments, ps_error *error) {
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
static pspec_status check_sum_rule(const truncation *answer, double *off, ps_error *error) {
    double sum = 0;
    for (size_t l = answer->representer.max_degree + 1; l-- > 0;) {
        sum += answer->representer.b[l] * answer->representer.b[l];
    }
    *off = sum / answer->representer.energy - 1;
    return *off <= SUM_RULE ? PSPEC_OK
                            : ps_fail(error, PSPEC_ERROR_CHECK,
                                      "the sum of the b_l^2 is %.3g of itself above its closed "
                                      "form: the coefficients are wrong",
                                      *off);
}

static pspec_status find_points(const truncation *answer, const ps_answer_hooks *hooks,
                                ps_error *error) {
    ps_equal_error equal = {.representer = &answer->representer,
                            .morph = ps_brdf_morph(answer->brdf)};
    for (size_t l = 0; l <= answer->max_degree; l++) {
        answer->points[l] = NAN;
        if (equal.morph.kind != PS_MORPH_NONE && answer->errors[l] > 0) {
            PS_TRY(ps_equal_error_points(&equal, answer->errors[l], &answer->points[l], error));
        }
        PS_TRY(ps_watch_tell(&hooks->watch, "degrees", l + 1, answer->max_degree + 1, NULL, error));
    }
    return PSPEC_OK;
}

/* The errors of all degrees; those of hemispherical harmonics are in brackets, relative to them. */
static pspec_status find_errors(truncation *answer, double bracket, ps_error *error) {
    enum { COLUMNS = 4 };
    const ps_request *const arguments = answer->arguments;
    const size_t num = answer->max_degree + 1;
    PS_TRY(ps_brdf_parse(&answer->brdf, arguments->brdf, error));
    /* twice the degrees: the last one's rest is then mostly summed, not bracketed */
    PS_TRY(ps_representer_create(&answer->representer, answer->brdf, arguments->smoothness,
                                 TOLERANCE, 2 * num, error));
    PS_TRY(ps_allocate_for(&answer->degrees, num, COLUMNS * sizeof(double), "degrees", error));
    answer->errors = answer->degrees + num;
    answer->bounds = answer->errors + num;
    answer->points = answer->bounds + num;
    for (size_t l = 0; l < num; l++) {
        answer->degrees[l] = (double)l;
    }
    if (answer->is_hemispherical) {
        PS_TRY(ps_truncation_hemispherical(answer->brdf, arguments->smoothness, answer->max_degree,
                                           bracket, answer->errors, answer->bounds,
                                           &answer->sh_degree, error));
        return PSPEC_OK;
    }
    answer->sh_degree = answer->representer.max_degree;
    return ps_truncation_spherical(&answer->representer, answer->max_degree, answer->errors,
                                   answer->bounds, error);
}

/* ---- plan ---------------------------------------------------------------------------------- */

/* Pairs, and points, of a rule; making the points takes nothing beside. */
static void add_rule(const truncation *answer, ps_phases *phases, double num) {
    static const char name[] = "points of equal error";
    ps_phases_kappa(phases, name, num, (double)answer->representer.num_terms, 1);
    ps_phases_distances(phases, name, answer->arguments->smoothness, num * num / 2, 1);
}

/* For every degree as many points as will have its error: E falls like N^(-s/2) from a rule that is
 * cheap. (From 4096 points on, those of 31333 points were off by more than 4 %; from 8192 on, by
 * less.) Each takes two rules of about so many, or one where the second would be the first again,
 * and all together the rungs of the ladder up to the highest: at most so much. */
static pspec_status add_equal_points(truncation *answer, ps_phases *phases, ps_error *error) {
    enum { FEW = 8192, STEPS = 2 };
    const double s = answer->arguments->smoothness;
    const ps_morph morph = ps_brdf_morph(answer->brdf);
    double of_few = 0;
    double most = 1;
    PS_TRY(ps_fibonacci_error(&answer->representer, &morph, FEW, &of_few, error));
    for (size_t l = 0; l <= answer->max_degree; l++) {
        const double num = FEW * pow(of_few / answer->errors[l], 2 / s);
        const bool is_there = answer->errors[l] > 0 && num <= PS_EQUAL_ERROR_MOST;
        most = answer->errors[l] > 0 ? fmax(most, fmin(num, PS_EQUAL_ERROR_MOST)) : most;
        for (int step = 0; is_there && step < STEPS; step++) {
            add_rule(answer, phases, num);
        }
    }
    for (double num = 1; num < 2 * most; num *= 2) {
        add_rule(answer, phases, num);
    }
    ps_phases_limit(phases, "points of equal error");
    ps_phases_say(phases, "points of equal error", "rules of up to %.3g points", most);
    return PSPEC_OK;
}

/* Steps of the conversion go as L X^2, X growing until the brackets are narrow enough: to where
 * they usually are. */
static void add_conversion(const truncation *answer, ps_phases *phases) {
    const double usual = 1000;
    const double step_seconds = 2e-9; /* a degree of each kind of harmonics */
    const double x = fmax(usual, 4 * (double)answer->max_degree);
    ps_phases_add(phases, "conversion", PS_HOST_SCALAR,
                  (double)answer->max_degree * x * x * step_seconds);
    ps_phases_say(phases, "conversion", "of hemispherical harmonics to spherical ones");
    ps_phases_limit(phases, "conversion");
}

static pspec_status find_phases(const ps_request *arguments, ps_phases *phases, ps_error *error) {
    enum { FEW_DEGREES = 60 };
    const double loose = 0.5;
    truncation answer = begin(arguments);
    PS_TRY(check_question(arguments, error));
    /* Errors of many degrees in hemispherical harmonics take their time: those in spherical ones
     * are about as large. */
    const bool is_hemispherical = answer.is_hemispherical;
    answer.is_hemispherical = is_hemispherical && answer.max_degree <= FEW_DEGREES;
    pspec_status status = find_errors(&answer, loose, error);
    if (status == PSPEC_OK) {
        ps_phases_start(phases, NULL);
        ps_phases_lobe(phases, &answer.representer);
        if (is_hemispherical && answer.errors[0] > 0) {
            add_conversion(&answer, phases);
        }
        if (ps_brdf_morph(answer.brdf).kind != PS_MORPH_NONE) {
            status = add_equal_points(&answer, phases, error);
        }
        ps_phases_tabulate(phases, (double)answer.max_degree);
    }
    end(&answer);
    return status;
}

/* Products in harmonics are the host's: there is nothing to choose. */
static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    ps_phases phases = ps_plan_table_begin_phases(planner);
    PS_TRY(find_phases(request, &phases, error));
    ps_plan_table_add_picture(&phases, request);
    return ps_plan_table_add_host(planner, &phases, "series of the lobe, in double precision",
                                  error);
}

/* ---- the table ----------------------------------------------------------------------------- */

static pspec_status add_header(ps_table *table, const truncation *answer, ps_error *error) {
    char check[128];
    double off = 0;
    double worst = 0;
    PS_TRY(check_sum_rule(answer, &off, error));
    for (size_t l = 0; l <= answer->max_degree; l++) {
        worst = fmax(worst, answer->bounds[l]);
    }
    snprintf(check, sizeof check, "sum b_l^2 to degree %zu is 1 %+.2g of its closed form",
             answer->representer.max_degree, off);
    const char *const note = ps_brdf_note(answer->brdf);
    const ps_meta entries[] = {
        {"pointspec_version", PS_TEXT(pspec_version())},
        {"schema", PS_INTEGER(PS_TABLE_SCHEMA)},
        {"command", PS_TEXT(answer->arguments->command_line)},
        {"device", PS_TEXT("none")},
        {"engine", PS_TEXT("host")},
        {"precision", PS_TEXT("double")},
        {"tolerance", PS_NUMBER(TOLERANCE)},
        {"predicted_error", PS_NUMBER(worst)},
        {"self_check", PS_TEXT(check)},
        {"brdf", PS_TEXT(answer->arguments->brdf)},
        {"smoothness", PS_NUMBER(answer->arguments->smoothness)},
        {"harmonics", PS_TEXT(answer->is_hemispherical ? "hemispherical" : "spherical")},
        {"spherical_degrees", PS_INTEGER(answer->sh_degree)},
        {"kappa_0", PS_NUMBER(answer->representer.kappa_0)},
        {"equivalent_points",
         PS_TEXT(ps_brdf_morph(answer->brdf).kind == PS_MORPH_NONE
                     ? "not known: no rule has the density of this lobe"
                     : "of equal-weight spherical Fibonacci points morphed to the lobe; empty "
                       "beyond 32768")},
        {"skipped", PS_TEXT("none")},
    };
    PS_TRY(ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error));
    return note != NULL ? ps_table_add_meta(table, "note", PS_TEXT(note), error) : PSPEC_OK;
}

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    const truncation *const answer = computed;
    static const char *const columns[] = {"degree", "error", "equivalent_points"};
    enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };
    (void)request;
    PS_TRY(ps_table_create(&out->table, "truncation", columns, NUM_COLUMNS, error));
    PS_TRY(add_header(out->table, answer, error));
    for (size_t l = 0; l <= answer->max_degree; l++) {
        const ps_cell cells[NUM_COLUMNS] = {PS_INTEGER(l), PS_NUMBER(answer->errors[l]),
                                            ps_number_or_missing(answer->points[l])};
        PS_TRY(ps_table_add_row(out->table, cells, error));
    }
    return PSPEC_OK;
}

static pspec_status draw(const void *computed, const ps_request *request, ps_error *error) {
    const truncation *const answer = computed;
    ps_text title = {0};
    ps_text_append(&title, "%s, %s harmonics, smoothness %g", answer->arguments->brdf,
                   answer->is_hemispherical ? "hemispherical" : "spherical",
                   answer->arguments->smoothness);
    const ps_series line = {
        .num = answer->max_degree + 1, .x = answer->degrees, .y = answer->errors};
    const ps_panel panel = {NULL, 1, &line};
    const ps_figure figure = {.form = PS_FIGURE_FRAME,
                              .title = ps_text_string(&title),
                              .x_label = "largest degree L",
                              .y_label = "worst-case error E(L)",
                              .axes = request->plot_axes,
                              .is_log_y = true,
                              .num_panels = 1,
                              .panels = &panel};
    pspec_status status = ps_text_check(&title, error);
    if (status == PSPEC_OK) {
        status = ps_figure_write(request->plot, &figure, error);
    }
    ps_text_free(&title);
    return status;
}

/* ---- the kind of answer ---------------------------------------------------------------------- */

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    PS_TRY(check_question(request, error));
    PS_TRY(ps_allocate(out, 1, sizeof(truncation), "an answer", error));
    truncation *const answer = *out;
    *answer = begin(request);
    ps_answer_begin_next(hooks);
    PS_TRY(find_errors(answer, BRACKET, error));
    return find_points(answer, hooks, error);
}

static void discard(void *computed) {
    if (computed != NULL) {
        end(computed);
        free(computed);
    }
}

static const char *const summary[] = {"brdf",    "smoothness",      "harmonics",
                                      "kappa_0", "predicted_error", NULL};
static const ps_line_kind lines[] = {
    {"-error", "worst-case error", "degree", "error", "largest degree L", "E(L)", false, true},
    {"-points", "points with the same error", "degree", "equivalent_points", "largest degree L",
     "N", false, true},
    {.suffix = NULL}};

const ps_kind ps_kind_truncation = {
    .name = "truncation",
    .bit = PS_VERB_BIT(truncation),
    .counted = "degrees",
    .is_of_host = true,
    .check_arguments = check_question,
    .check_question = check_question,
    .plan = plan,
    .compute = compute,
    .tabulate = tabulate,
    .draw = draw,
    .discard = discard,
    .summary = summary,
    .lines = lines,
    .compare = ps_compare_verdicts,
};
