/* Errors of shading integrals over random orientations of the normal, measured and predicted. */
#include "answers/kept_rows.h"
#include "answers/ranges/row_ranges.h"
#include "answers/kind.h"
#include "answers/lead.h"
#include "answers/quadrature/light_header.h"
#include "answers/quadrature/quadrature_table.h"
#include "answers/quadrature/rule_list.h"
#include "answers/spectra/spectrum_header.h"
#include "base/memory.h"
#include "jobs/shade/shade_job.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

typedef struct work {
    ps_rule_list list;
    ps_light light;
    ps_horizon horizon;
    ps_shade_job *shade_jobs; /* [list.num] */
} work;

static void release(work *self) {
    for (size_t i = 0; self->shade_jobs != NULL && i < self->list.num; i++) {
        ps_shade_job_free(&self->shade_jobs[i]);
    }
    free(self->shade_jobs);
    ps_rule_list_free(&self->list);
    ps_horizon_free(&self->horizon);
    ps_light_free(&self->light);
}

static void discard(void *computed) {
    if (computed != NULL) {
        release(computed);
        free(computed);
    }
}

static pspec_status ask(work *self, const ps_request *request, ps_error *error) {
    const uint64_t num_orientations =
        request->is_given[PS_OPTION_SHIFTS] ? request->num_shifts : PS_USUAL_ORIENTATIONS;
    ps_rule_list *const list = &self->list;
    PS_TRY(ps_rule_list_make(list, request, PS_COMMAND_shade, error));
    PS_TRY(ps_light_check(request, true, error));
    PS_TRY(ps_light_make(&self->light, request->integrands[0], request->integrands_made, list->brdf,
                         error));
    if (request->view_angle > 0) {
        PS_TRY(ps_horizon_make(&self->horizon, list->brdf, request->view_angle,
                               self->light.max_degree, error));
    }
    PS_TRY(PS_NEW(&self->shade_jobs, list->num, "questions", error));
    for (size_t i = 0; i < list->num; i++) {
        ps_quadrature_question *const rules = &list->questions[i];
        rules->horizon = request->view_angle > 0 ? &self->horizon : NULL;
        if (rules->max_degree == 0) { /* degrees of E^2 are no guide: light is less smooth */
            rules->max_degree = self->light.max_degree;
        }
        PS_TRY(ps_shade_job_make(&self->shade_jobs[i], &self->light, num_orientations,
                                 request->seed, rules, error));
    }
    return PSPEC_OK;
}

static pspec_status check_question(const ps_request *request, ps_error *error) {
    ps_rule_list list = {0};
    const pspec_status status = ps_rule_list_make(&list, request, PS_COMMAND_shade, error);
    ps_rule_list_free(&list);
    return status == PSPEC_OK ? ps_light_check(request, true, error) : status;
}

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    work self = {0};
    pspec_status status = ask(&self, request, error);
    if (status == PSPEC_OK) {
        status = ps_rule_list_plan(&self.list, planner, request, error);
    }
    release(&self);
    return status;
}

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    PS_TRY(ps_allocate(out, 1, sizeof(work), "an answer", error));
    work *const self = *out;
    PS_TRY(ask(self, request, error));
    return ps_rule_list_run(&self->list, request, hooks, error);
}

/* ---- the table: a row for every question ---------------------------------------------------- */

static const char *const columns[] = {"rmse", "rmse_error", "predicted", "predicted_error",
                                      "z_score"};
enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };

/* Of a root, from that of its square. */
static double error_of_root(ps_mean square) {
    return square.standard_error / (2 * sqrt(square.mean));
}

/* Light that any rule integrates exactly has none: both errors are rounding of its mean. Nor have
 * rules that are so good that most of their prediction is what they are taken to have beyond. */
static double score(const ps_shade_job *result) {
    const double rounding = fmax(1e-28 * result->light->powers[0], 2 * result->beyond);
    const double error = hypot(result->measured.standard_error, result->predicted.standard_error);
    return result->predicted.mean > rounding
               ? (result->measured.mean - result->predicted.mean) / error
               : NAN;
}

/* Directions below the horizon have what light has up to its last degree; beyond they are as good
 * as random ones with their weights. */
static double horizon_error(const work *self) {
    const ps_rule rule = {self->horizon.num, self->horizon.points, self->horizon.weights};
    const double square = rule.num_points > 0 ? ps_rule_weight_sums(&rule).square : 0;
    return sqrt(square / PS_FOUR_PI * ps_light_beyond(&self->light, self->light.max_degree));
}

static pspec_status add_one(ps_table *table, const ps_request *request, const work *self, size_t i,
                            ps_error *error) {
    const ps_quadrature_job *const job = self->list.jobs[i];
    const ps_shade_job *const result = &self->shade_jobs[i];
    const ps_rule_facts *const facts = &job->result.facts;
    const ps_lead lead = ps_lead_make(request, i);
    const ps_meta entries[] = {
        {"orientations", PS_INTEGER(result->num_orientations)},
        {"rmse", ps_number_or_missing(sqrt(result->measured.mean))},
        {"rmse_predicted", PS_NUMBER(sqrt(result->predicted.mean))},
        {"rmse_beyond", PS_NUMBER(sqrt(result->beyond))},
    };
    const ps_cell cells[NUM_COLUMNS] = {
        ps_number_or_missing(sqrt(result->measured.mean)),
        ps_number_or_missing(error_of_root(result->measured)),
        PS_NUMBER(sqrt(result->predicted.mean)),
        ps_number_or_missing(error_of_root(result->predicted)),
        ps_number_or_missing(score(result)),
    };
    PS_TRY(ps_quadrature_add_header(table, request, i, job,
                                    facts->smallest_points != facts->largest_points, error));
    PS_TRY(ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error));
    return ps_lead_add_row(table, &lead, cells, NUM_COLUMNS, error);
}

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    const work *const self = computed;
    const ps_lead first = ps_lead_make(request, 0);
    PS_TRY(ps_lead_create_table(&out->table, "shade", &first, columns, NUM_COLUMNS, error));
    PS_TRY(ps_quadrature_begin_header(out->table, request, &self->list.questions[0], error));
    PS_TRY(ps_light_add_header(out->table, request, &self->light, error));
    if (request->is_given[PS_OPTION_VIEW]) {
        const ps_meta entries[] = {{"view", PS_NUMBER(request->view_angle)},
                                   {"below_horizon", PS_NUMBER(self->horizon.share)},
                                   {"horizon_points", PS_INTEGER(self->horizon.num)},
                                   {"horizon_error", PS_NUMBER(horizon_error(self))}};
        PS_TRY(ps_table_add_metas(out->table, entries, sizeof entries / sizeof entries[0], error));
    }
    PS_TRY(ps_table_add_meta(out->table, "z_score_is",
                             PS_TEXT("of squares: (rmse^2 - predicted^2) over its standard error"),
                             error));
    for (size_t i = 0; i < self->list.num; i++) {
        PS_TRY(add_one(out->table, request, self, i, error));
    }
    return PSPEC_OK;
}

/* ---- what tables mean ------------------------------------------------------------------------ */

static const char *const summary[] = {
    "points", "realizations", "orientations", "rmse", "rmse_predicted", "worst_case_error", NULL};
static const ps_picture_kind pictures[] = {
    {.suffix = "-rmse",
     .what = "error of shading integrals",
     .make = ps_lines_figure,
     .dealing = PS_OF_COUNTS,
     .by = PS_BY_SCENE | PS_BY_COMMAND,
     .x = "points",
     .is_of_entries = true,
     .lines = {{.y = "rmse_predicted", .look = PS_LOOK_CURVE},
               {.y = "rmse", .look = PS_LOOK_MARKS, .name = ""}},
     .x_label = "points N",
     .y_label = "RMSE",
     .is_log_x = true,
     .is_log_y = true},
    {.make = NULL}};

static const ps_field_row own_fields[] = {
    {"view", "degrees", PS_ENTRY, 0, "--view", "angle between normal and view"},
    {"below_horizon", "", PS_ENTRY, 0, "--view",
     "the share of the lobe that is below the horizon of the normal"},
    {"horizon_points", "", PS_ENTRY, 0, "--view",
     "directions that stand for that share in the exact integral and in spectra"},
    {"horizon_error", "", PS_ENTRY, 0, "--view",
     "what these are off by, root mean square over orientations: light beyond light_degree as "
     "random directions have it; a part of rmse_beyond"},
    {"z_score_is", "", PS_ENTRY, 0, "", "what the column of that name is"},
    {"orientations", "", PS_ENTRIES, 0, "", "random orientations of every rule"},
    {"rmse", "", PS_ENTRIES, 0, "", "as the column"},
    {"rmse_predicted", "", PS_ENTRIES, 0, "", "as the column predicted"},
    {"rmse_beyond", "", PS_ENTRIES, 0, "",
     "the part of predicted that rules are taken to have beyond the degrees, as white noise has "
     "it; its square is a part of that of predicted"},
    {"rmse", "", PS_COLUMN, 0, "",
     "root of the mean square error over orientations and realizations"},
    {"rmse_error", "", PS_COLUMN, 0, "",
     "its standard error, over realizations; of one over orientations"},
    {"predicted", "", PS_COLUMN, 0, "", "the same from the spectra of rule and light"},
    {"predicted_error", "", PS_COLUMN, 0, "", "its standard error, over realizations"},
    {"z_score", "", PS_COLUMN, 0, "",
     "what measurement and prediction are apart; missing where rmse_beyond is most of predicted"},
    {.name = NULL}};

static const ps_field_row *const fields[] = {
    ps_fields_asked,     ps_fields_points,   ps_fields_rules,
    ps_fields_light,     own_fields,         ps_fields_ranges,
    ps_fields_kept_rows, ps_fields_computed, NULL};

static const ps_compared_field compared[] = {{"rmse", "rmse_error", false, ps_compared_rule_bound},
                                             {.value = NULL}};

const ps_kind ps_kind_shade = {
    .name = "shade",
    .purpose = "errors of shading integrals over random orientations, measured and predicted",
    .usage = "shade --brdf NAME --integrand map:file=FILE [options] --sampler NAME | shade --brdf "
             "NAME --integrand map:file=FILE [options] FILE...",
    .description =
        "Integrates light, a function of the sphere with known coefficients (map, coefficients), "
        "times a BRDF about the normal at random orientations, by directions u_j with weights w_j "
        "(1/N unless given), and compares with the exact integrals. Prints the root of the mean "
        "square error, and beside it that which the spectra of rule and light predict, the root "
        "of sum_l P_F(l) (d_l^2 + C_l^2). Points of samplers of the hemisphere are morphed to the "
        "BRDF unless morph= says otherwise.",
    .examples = {"echo 1,0,1,0 >light.txt; pointspec shade --brdf diffuse --integrand "
                 "coefficients:file=light.txt --sampler fibonacci-hemisphere -n 64..256",
                 "echo 2,0,1,0 >light.txt; pointspec shade --brdf glossy:n=30 --integrand "
                 "coefficients:file=light.txt --sampler white-hemisphere -n 64 -m 20 --weights "
                 "optimal"},
    .takes = PS_COMMAND_BIT(shade),
    .weights = "equal|column|optimal|FILE",
    .samples = PS_DOMAIN_SPHERE,
    .counted = "realizations",
    .check_question = check_question,
    .plan = plan,
    .look_at_shares = ps_answer_look_at_rows,
    .merge = ps_row_ranges_merge,
    .compute = compute,
    .tabulate = tabulate,
    .discard = discard,
    .fields = fields,
    .summary = summary,
    .pictures = pictures,
    .compared = compared,
};
