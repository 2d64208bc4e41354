/* The error of shading integrals as truncated products in harmonics, and how many points of a
 * rule have the same. */
#include "answers/kind.h"
#include "answers/quadrature/light_header.h"
#include "base/memory.h"
#include "request/options.h"
#include "answers/spectra/spectrum_header.h"
#include "jobs/quadrature/truncation_job.h"
#include "jobs/shade/shade_job.h"
#include "rules/truncation.h"

#include <stdio.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DEFAULT_DEGREE = 20, MOST_DEGREE = 10000 };

typedef struct products {
    ps_truncation_job job;
    ps_light light; /* {0}: none */
    /* With it, [max_degree + 1]: root mean square errors, and points that have them; NULL: none */
    double *errors, *points;
    ps_device *device; /* NULL: none is there, or needed */
    bool owns_device;
} products;

static ps_truncation_question question_of(const ps_request *request) {
    const char *const harmonics = request->harmonics;
    return (ps_truncation_question){
        .brdf = request->brdf,
        .smoothness = request->smoothness[0],
        .is_hemispherical = harmonics != NULL && strcmp(harmonics, "hemispherical") == 0,
        .max_degree = request->max_degree > 0 ? (size_t)request->max_degree : DEFAULT_DEGREE};
}

static pspec_status check_question(const ps_request *arguments, ps_error *error) {
    PS_TRY(ps_request_check_no_files(arguments, "", error));
    if (arguments->brdf == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--brdf NAME is needed, as in --brdf diffuse or --brdf glossy:n=30");
    }
    if (arguments->max_degree > MOST_DEGREE) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: degree %llu is more than %d",
                       ps_option_show(arguments, PS_OPTION_MAX_DEGREE).text,
                       (unsigned long long)arguments->max_degree, MOST_DEGREE);
    }
    PS_TRY(ps_option_pairs_check(arguments, PS_COMMAND_truncation, error));
    return ps_light_check(arguments, false, error);
}

/* Map of 1024 x 512, 20 degrees, diffuse lobe, for all rules of up to 32768 points and 256 degrees:
 * two cores, AVX-512, PoCL 3.1. */
static const double light_seconds = 4;

/* Products in harmonics are the host's: there is nothing to choose. */
static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    const ps_truncation_question question = question_of(request);
    ps_phases phases = ps_plan_table_begin_phases(planner);
    PS_TRY(check_question(request, error));
    PS_TRY(ps_truncation_phases(&question, &phases, error));
    if (request->num_integrands > 0) {
        ps_phases_add(&phases, "points with the light's error", light_seconds);
        ps_phases_say(&phases, "points with the light's error", "the same for the light");
        ps_phases_limit(&phases, "points with the light's error");
    }
    ps_plan_table_add_picture(&phases, request);
    return ps_plan_table_add_host(planner, &phases, 0, "series of the lobe, in double precision",
                                  error);
}

/* Points of equal errors are those of rules with spectra, which a device has faster. */
static pspec_status find_points(products *self, const ps_request *request,
                                const ps_answer_hooks *hooks, ps_error *error) {
    ps_quadrature_question rules = {.brdf = self->job.brdf,
                                    .smoothness = request->smoothness[0],
                                    .limits = request->limits,
                                    .watch = hooks->watch};
    PS_TRY(ps_limits_open_device(&request->limits, hooks->device, true, &rules.open_device,
                                 &self->owns_device, error));
    self->device = rules.open_device;
    return ps_shade_equal_points(&self->light, &rules, self->errors,
                                 self->job.question.max_degree + 1, self->points, error);
}

static pspec_status shade(products *self, const ps_request *request, const ps_answer_hooks *hooks,
                          ps_error *error) {
    const ps_truncation_question *const question = &self->job.question;
    const size_t num = question->max_degree + 1;
    PS_TRY(ps_light_make(&self->light, request->integrands[0], request->integrands_made,
                         self->job.brdf, error));
    PS_TRY(PS_NEW(&self->errors, 2 * num, "errors", error));
    self->points = self->errors + num;
    PS_TRY(ps_truncation_of_light(self->job.brdf, question->is_hemispherical, question->max_degree,
                                  self->light.powers, self->light.max_degree + 1, self->errors,
                                  error));
    for (size_t l = 0; l < num; l++) {
        self->errors[l] = sqrt(self->errors[l]);
    }
    return find_points(self, request, hooks, error);
}

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    const ps_truncation_question question = question_of(request);
    PS_TRY(check_question(request, error));
    PS_TRY(ps_allocate(out, 1, sizeof(products), "an answer", error));
    products *const self = *out;
    ps_answer_begin_next(hooks);
    PS_TRY(ps_truncation_job_run(&self->job, &question, &hooks->watch, error));
    return request->num_integrands > 0 ? shade(self, request, hooks, error) : PSPEC_OK;
}

static void discard(void *computed) {
    products *const self = computed;
    if (self != NULL) {
        ps_truncation_job_free(&self->job);
        ps_light_free(&self->light);
        free(self->errors);
        if (self->owns_device) {
            ps_device_close(self->device);
        }
        free(self);
    }
}

/* ---- the table: a row for every degree ---------------------------------------------------- */

/* Series are the host's; points with the light's error are those of rules on a device. */
static const char *name_device(const products *self) {
    return self->device != NULL ? ps_device_get_limits(self->device)->name : "none";
}

static pspec_status add_header(ps_table *table, const products *self, const ps_request *request,
                               ps_error *error) {
    const ps_truncation_job *const job = &self->job;
    char check[128];
    double worst = 0;
    for (size_t l = 0; l <= job->question.max_degree; l++) {
        worst = fmax(worst, job->bounds[l]);
    }
    snprintf(check, sizeof check, "sum b_l^2 to degree %zu is 1 %+.2g of its closed form",
             job->representer.max_degree, job->off);
    const char *const note = ps_brdf_note(job->brdf);
    const ps_meta entries[] = {
        {"device", PS_TEXT(name_device(self))},
        {"engine", PS_TEXT("host")},
        {"precision", PS_TEXT("double")},
        {"tolerance", PS_NUMBER(PS_TRUNCATION_TOLERANCE)},
        {"predicted_error", PS_NUMBER(worst)},
        {"self_check", PS_TEXT(check)},
        {"brdf", PS_TEXT(job->question.brdf)},
        {"smoothness", PS_NUMBER(job->question.smoothness)},
        {"harmonics", PS_TEXT(job->question.is_hemispherical ? "hemispherical" : "spherical")},
        {"spherical_degrees", PS_INTEGER(job->sh_degree)},
        {"kappa_0", PS_NUMBER(job->representer.kappa_0)},
        {"equivalent_points",
         PS_TEXT(ps_brdf_morph(job->brdf).kind == PS_MORPH_NONE
                     ? "not known: no rule has the density of this lobe"
                     : "of equal-weight spherical Fibonacci points morphed to the lobe; empty "
                       "beyond 32768")},
        {"skipped", PS_TEXT("none")},
    };
    PS_TRY(ps_lead_add_origin(table, request->command_line, error));
    PS_TRY(ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error));
    return note != NULL ? ps_table_add_meta(table, "note", PS_TEXT(note), error) : PSPEC_OK;
}

static pspec_status make_table(ps_table **out, const products *self, const ps_request *request,
                               ps_error *error) {
    static const char *const columns[] = {"degree", "error", "equivalent_points", "rmse",
                                          "rmse_points"};
    enum { NUM_COLUMNS = sizeof columns / sizeof columns[0], OF_LIGHT = 2 };
    const ps_truncation_job *const job = &self->job;
    const bool has_light = self->errors != NULL;
    PS_TRY(ps_table_create(out, "truncation", columns, NUM_COLUMNS - (has_light ? 0 : OF_LIGHT),
                           error));
    PS_TRY(add_header(*out, self, request, error));
    PS_TRY(has_light ? ps_light_add_header(*out, request, &self->light, error) : PSPEC_OK);
    for (size_t l = 0; l <= job->question.max_degree; l++) {
        const ps_cell cells[NUM_COLUMNS] = {
            PS_INTEGER(l), PS_NUMBER(job->errors[l]), ps_number_or_missing(job->points[l]),
            PS_NUMBER(has_light ? self->errors[l] : NAN),
            ps_number_or_missing(has_light ? self->points[l] : NAN)};
        PS_TRY(ps_table_add_row(*out, cells, error));
    }
    return PSPEC_OK;
}

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    return make_table(&out->table, computed, request, error);
}

static const char *const summary[] = {"brdf",    "smoothness",      "harmonics",
                                      "kappa_0", "predicted_error", NULL};
static const ps_picture_kind pictures[] = {
    {.suffix = "-error",
     .what = "worst-case error",
     .make = ps_lines_figure,
     .by = PS_BY_SCENE | PS_BY_COMMAND,
     .x = "degree",
     .lines = {{.y = "error"}},
     .x_label = "largest degree L",
     .y_label = "worst-case error E(L)",
     .is_log_y = true},
    PS_PICTURE_OF_DEGREES("-points", "points with the same error", "equivalent_points",
                          "largest degree L", "N"),
    PS_PICTURE_WHERE(PS_NEEDS_INTEGRAND, "-rmse", "error with the light", "rmse",
                     "largest degree L", "RMSE"),
    PS_PICTURE_WHERE(PS_NEEDS_INTEGRAND, "-rmse_points",
                     "points with the same error with the light", "rmse_points", "largest degree L",
                     "N"),
    {.make = NULL}};

static const ps_field_row own_fields[] = {
    {"harmonics", "", PS_ENTRY, 0, "", "spherical or hemispherical"},
    {"spherical_degrees", "", PS_ENTRY, 0, "",
     "the last degree of the spherical harmonics that products are written in"},
    {"kappa_0", "", PS_ENTRY, 0, "", "sum of a_l b_l^2, the square of the error of no term at all"},
    {"equivalent_points", "", PS_ENTRY, 0, "", "what the column of that name is"},
    {"degree", "", PS_COLUMN, 0, "", "L"},
    {"error", "", PS_COLUMN, 0, "", "E(L), the error of products up to and including L"},
    {"equivalent_points", "", PS_COLUMN, 0, "",
     "N of spherical Fibonacci points with that error; missing above 32768 and for tables"},
    {"rmse", "", PS_COLUMN, 0, "--integrand",
     "root of the mean square error with that light over all orientations"},
    {"rmse_points", "", PS_COLUMN, 0, "--integrand",
     "N of those points with that root, by their spectrum; missing above 32768 and for tables"},
    {.name = NULL}};

static const ps_field_row *const fields[] = {ps_fields_asked, own_fields, ps_fields_light,
                                             ps_fields_computed, NULL};

static const ps_compared_field compared[] = {{"degree", NULL, false, NULL}, {.value = NULL}};

const ps_kind ps_kind_truncation = {
    .name = "truncation",
    .purpose = "error of shading integrals by truncated harmonics, and equivalent points",
    .usage = "truncation --brdf NAME[:key=value,...] [options]",
    .description =
        "Prints for L = 0, 1, ... the worst-case error of the integral of light times BRDF when "
        "it is a sum over harmonics up to and including degree L, for light from the unit ball of "
        "the Sobolev space H^S: E(L)^2 = sum_{l>L} a_l b_l^2 for spherical harmonics. "
        "equivalent_points is the number of spherical Fibonacci points, morphed to the lobe and "
        "with equal weights, whose worst-case error is the same. With --integrand rmse is the root "
        "of the mean square error of that light over all orientations, and rmse_points the number "
        "of the same points that have it.",
    .examples =
        {"pointspec truncation --brdf glossy:n=30 --smoothness 1.5 -l 12",
         "pointspec truncation --brdf diffuse --harmonics hemispherical -l 4 --format json"},
    .takes = PS_COMMAND_BIT(truncation),
    .counted = "degrees",
    .samples = PS_DOMAIN_SPHERE,
    .is_of_host = true,
    .check_arguments = check_question,
    .check_question = check_question,
    .plan = plan,
    .compute = compute,
    .tabulate = tabulate,
    .discard = discard,
    .fields = fields,
    .summary = summary,
    .pictures = pictures,
    .compared = compared,
};
