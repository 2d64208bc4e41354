/* Quadrature spectrum and worst-case error of rules for a BRDF. */
#include "answers/kept_rows.h"
#include "answers/ranges/row_ranges.h"
#include "answers/quadrature/quadrature_table.h"
#include "answers/quadrature/rule_list.h"
#include "base/memory.h"
#include "points/lists/weight_list.h"

#include <stdlib.h>

static pspec_status check_question(const ps_request *request, ps_error *error) {
    ps_rule_list list = {0};
    const pspec_status status = ps_rule_list_make(&list, request, PS_COMMAND_quadrature, error);
    ps_rule_list_free(&list);
    return status;
}

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    ps_rule_list list = {0};
    pspec_status status = ps_rule_list_make(&list, request, PS_COMMAND_quadrature, error);
    if (status == PSPEC_OK) {
        status = ps_rule_list_plan(&list, planner, request, error);
    }
    ps_rule_list_free(&list);
    return status;
}

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    PS_TRY(ps_allocate(out, 1, sizeof(ps_rule_list), "rules", error));
    PS_TRY(ps_rule_list_make(*out, request, PS_COMMAND_quadrature, error));
    return ps_rule_list_run(*out, request, hooks, error);
}

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    const ps_rule_list *const list = computed;
    return ps_quadrature_table(&out->table, request, list->jobs, list->num, error);
}

static pspec_status check_weights_out(const ps_request *request, ps_error *error) {
    return request->weights_out != NULL ? ps_weights_check_name(request->weights_out, error)
                                        : PSPEC_OK;
}

static void discard(void *computed) {
    if (computed != NULL) {
        ps_rule_list_free(computed);
        free(computed);
    }
}

/* ---- what tables mean ------------------------------------------------------------------------ */

static const char *const summary[] = {"points",
                                      "points_smallest",
                                      "points_largest",
                                      "realizations",
                                      "max_degree",
                                      "weight_sum",
                                      "worst_case_error",
                                      "worst_case_error_standard_error",
                                      "zonal_error",
                                      "anisotropic_error",
                                      "tail",
                                      "predicted_error",
                                      NULL};
static const ps_picture_kind pictures[] = {
    {.make = ps_lines_figure,
     .by = PS_BY_COMMAND,
     .x = "degree",
     .lines = {{.y = "d2", .formula = "d_l^2"},
               {.y = "c2", .formula = "C_l^2"},
               {.y = "e2", .formula = "e_l^2"}},
     .x_label = "degree l",
     .y_label = "{/*1.35 d_l^2 ,  C_l^2 ,  e_l^2 = a_l (d_l^2 + C_l^2 )}",
     .is_log_x = true,
     .is_log_y = true},
    {.suffix = "-convergence",
     .what = "worst-case error",
     .make = ps_lines_figure,
     .dealing = PS_OF_COUNTS,
     .by = PS_BY_SCENE | PS_BY_COMMAND,
     .needs = PS_NEEDS_COUNTS,
     .x = "points",
     .is_of_entries = true,
     .lines = {{.y = "worst_case_error"}},
     .x_label = "points N",
     .y_label = "E",
     .is_log_x = true,
     .is_log_y = true},
    PS_PICTURE_OF_DEGREES("-d2", "zonal part", "d2", "degree l", "{/*1.35 d_l^2}"),
    PS_PICTURE_OF_DEGREES("-c2", "part that depends on the azimuth", "c2", "degree l",
                          "{/*1.35 C_l^2}"),
    PS_PICTURE_OF_DEGREES("-e2", "share of the squared error", "e2", "degree l", "{/*1.35 e_l^2}"),
    {.make = NULL}};

const ps_field_row ps_fields_rules[] = {
    {"weights", "", PS_ENTRY, 0, "", "equal, optimal, or where they come from"},
    {"degrees", "", PS_ENTRIES, 0, "where there is something to say", "why the degrees end at L"},
    {"dropped_below_horizon", "", PS_ENTRIES, 0, "--drop-below-horizon",
     "points that were left out, in all sets"},
    {"worst_case_error", "", PS_ENTRIES, 0, "", "E, of the mean of E^2"},
    {"worst_case_error_standard_error", "", PS_ENTRIES, 0, "",
     "its standard error over the realizations; missing for one"},
    {"zonal_error", "", PS_ENTRIES, 0, "", "root of sum a_l d_l^2 up to L"},
    {"anisotropic_error", "", PS_ENTRIES, 0, "", "root of sum a_l C_l^2 up to L"},
    {"tail", "", PS_ENTRIES, 0, "", "E^2 beyond L"},
    {"tail_model", "", PS_ENTRIES, 0, "",
     "what independent points of the lobe's density have there in the mean"},
    {"tail_bound", "", PS_ENTRIES, 0, "", "what the tail cannot exceed"},
    {"weights_by", "", PS_ENTRIES, 0, "--weights optimal", "how they were found"},
    {"condition", "", PS_ENTRIES, 0, "--weights optimal",
     "largest condition number of a kernel matrix; of conjugate gradients a bound from below"},
    {"duplicates", "", PS_ENTRIES, 0, "--weights optimal", "how many points are equal to others"},
    {"warning", "", PS_ENTRIES, 0, "--weights optimal",
     "that points lie too near each other for weights of four digits"},
    {.name = NULL}};

static const ps_field_row own_fields[] = {
    {"degree", "", PS_COLUMN, 0, "", "l"},
    {"b", "", PS_COLUMN, 0, "", "b_l, coefficient of the lobe"},
    {"d2", "", PS_COLUMN, 0, "", "mean of d_l^2, what the heights of the points do wrong"},
    {"d2_error", "", PS_COLUMN, 0, "", "its standard error"},
    {"c2", "", PS_COLUMN, 0, "", "mean of C_l^2, what their azimuths do wrong"},
    {"c2_error", "", PS_COLUMN, 0, "", "its standard error"},
    {"a", "", PS_COLUMN, 0, "", "a_l, coefficient of the kernel"},
    {"e2", "", PS_COLUMN, 0, "", "mean of e_l^2 = a_l (d_l^2 + C_l^2), of which E^2 is the sum"},
    {"e2_error", "", PS_COLUMN, 0, "", "its standard error"},
    {"weights", "", PS_FIELD_ARRAY, false, 0, "--weights-out",
     "weights of the only rule, float64 [N]; points that were dropped have 0"},
    {.name = NULL}};

static const ps_field_row *const fields[] = {
    ps_fields_asked,  ps_fields_points,    ps_fields_rules,    own_fields,
    ps_fields_ranges, ps_fields_kept_rows, ps_fields_computed, NULL};

static const ps_compared_field compared[] = {
    {"worst_case_error", "worst_case_error_standard_error", true, ps_compared_rule_bound},
    {.value = NULL}};

const ps_kind ps_kind_quadrature = {
    .name = "quadrature",
    .purpose = "quadrature spectrum and worst-case error of rules for a BRDF",
    .usage = "quadrature --brdf NAME [options] --sampler NAME | quadrature --brdf NAME [options] "
             "FILE...",
    .description =
        "For directions u_j with weights w_j (1/N unless given) as a rule for the integral of "
        "light times a BRDF, averages over realizations d_l^2 = (b_l - c_l0)^2, C_l^2 = 2 "
        "sum_{m>0} |c_lm|^2, c_lm = sum_j w_j Y_lm(u_j), and their share a_l (d_l^2 + C_l^2) of "
        "the squared worst-case error E^2 over the unit ball of the Sobolev space H^S. The header "
        "has E by the kernel form, the root of the mean of E^2, and the rest of E^2 beyond degree "
        "L. Points of samplers of the hemisphere are morphed to the BRDF unless morph= says "
        "otherwise.",
    .examples = {"pointspec quadrature --sampler fibonacci-hemisphere -n 256 --brdf diffuse "
                 "--smoothness 1.5 --weights optimal",
                 "pointspec quadrature --sampler white-hemisphere -n 64 -m 50 --brdf glossy:n=30 "
                 "-l 40"},
    .takes = PS_COMMAND_BIT(quadrature),
    .weights = "equal|column|optimal|FILE",
    .samples = PS_DOMAIN_SPHERE,
    .counted = "realizations",
    .has_arrays = true,
    .check_arguments = check_weights_out,
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
