/* Quadrature spectrum and worst-case error of rules for a BRDF. */
#include "answers/quadrature/quadrature_table.h"
#include "answers/spectra/spectra.h"
#include "base/memory.h"
#include "points/lists/weight_list.h"
#include "request/file_list.h"
#include "request/point_source.h"

#include <stdlib.h>
#include <string.h>

/* One rule, or one mean over realizations, for each sampler or set and number of points, or one for
 * the files, as the request counts them. Questions borrow from the request, and from here. */
typedef struct rules {
    ps_brdf *brdf;
    size_t num;
    ps_quadrature_question *questions; /* [num] */
    ps_sampler_request *requests;      /* [num] */
    ps_file_list *files;               /* [num] */
    ps_device *device;        /* of all of them, where they share one that was opened for them */
    ps_quadrature_job **jobs; /* [num] */
} rules;

/* ---- the question -------------------------------------------------------------------------- */

/* This tolerance is for E^2: good rules of many points have an E^2 of 1e-7 and less. */
static const double TOLERANCE = 1e-10;

static pspec_status check_source(const ps_request *arguments, ps_error *error) {
    if (arguments->brdf == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--brdf NAME is needed, as in --brdf diffuse or --brdf glossy:n=30");
    }
    PS_TRY(ps_sources_check(arguments, "no rule", error));
    PS_TRY(ps_point_options_check(arguments, error));
    return ps_option_pairs_check(arguments, PS_COMMAND_quadrature, error);
}

static pspec_status check_weights(const ps_request *arguments, ps_error *error) {
    if (arguments->is_given[PS_OPTION_WEIGHT_SUM] &&
        arguments->weights.kind != PS_WEIGHTS_OPTIMAL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s is about --weights optimal, which was not given",
                       ps_option_show(arguments, PS_OPTION_WEIGHT_SUM).text);
    }
    PS_TRY(ps_weights_check_counts(arguments, error));
    return (arguments->weights_out != NULL || arguments->wants_array) &&
                   (ps_request_num_questions(arguments) > 1 ||
                    ps_num_realizations_asked(arguments) > 1)
               ? ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s has the weights of one rule, but several samplers, sets, numbers of "
                         "points or realizations were asked for",
                         arguments->wants_array ? "arrays" : "--weights-out")
               : PSPEC_OK;
}

/* Points of the hemisphere get the density of the lobe, unless morph= says otherwise. */
static pspec_status make_request(ps_sampler_request *request, const ps_request *arguments,
                                 size_t index, const ps_brdf *brdf, ps_error *error) {
    const char *const name = ps_request_sampler(arguments, index);
    PS_TRY(ps_sampler_request_make(request, arguments, index, error));
    if (!ps_sampler_is_on_sphere(request)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--sampler %s makes points of the torus; " PS_LIFT_KEY
                       "=hemisphere takes them to directions",
                       name);
    }
    const bool on_hemisphere = ps_sampler_is_on_hemisphere(request);
    if (!on_hemisphere && !arguments->drop_below_horizon && !ps_brdf_is_below_horizon(brdf)) {
        return ps_fail(
            error, PSPEC_ERROR_INVALID_ARGUMENT,
            "--sampler %s makes points of the whole sphere, half of them below the "
            "horizon, where this BRDF is 0; fibonacci-hemisphere, white-hemisphere and " PS_LIFT_KEY
            "=hemisphere make none there",
            name);
    }
    if (on_hemisphere && !request->has_morph) {
        request->morph = ps_brdf_morph(brdf);
    }
    return PSPEC_OK;
}

static ps_quadrature_question make_question(const ps_request *arguments, const ps_brdf *brdf) {
    ps_quadrature_question out = {
        .brdf = brdf,
        .smoothness = arguments->smoothness,
        .weights = arguments->weights,
        .keeps_weights = arguments->weights_out != NULL || arguments->wants_array,
        .point_options = ps_point_options_make(arguments),
        .drops_below_horizon = arguments->drop_below_horizon,
        .max_degree = (size_t)arguments->max_degree,
        .accuracy = arguments->accuracy,
        .limits = arguments->limits,
    };
    if (!arguments->is_given[PS_OPTION_TOLERANCE]) {
        out.accuracy.tolerance = TOLERANCE;
    }
    out.point_options.domain = PS_DOMAIN_SPHERE;
    out.point_options.above_horizon =
        !arguments->drop_below_horizon && !ps_brdf_is_below_horizon(brdf);
    if (arguments->reading.lift == PS_LIFT_TO_HEMISPHERE && !arguments->reading.has_morph) {
        out.point_options.morph = ps_brdf_morph(brdf); /* as of samplers */
    }
    return out;
}

static pspec_status fill_points(rules *self, size_t index, const ps_request *arguments,
                                ps_error *error) {
    ps_quadrature_question *const out = &self->questions[index];
    out->paths = self->files[index].paths;
    out->num_paths = self->files[index].num;
    if (out->num_paths > 0) {
        return PSPEC_OK;
    }
    out->sampler = &self->requests[index];
    out->num_realizations = ps_num_realizations_asked(arguments);
    return make_request(&self->requests[index], arguments, index, self->brdf, error);
}

/* Checks that the options fit together. */
static pspec_status ask(rules *self, const ps_request *arguments, ps_error *error) {
    const size_t num = ps_request_num_questions(arguments);
    PS_TRY(check_source(arguments, error));
    PS_TRY(check_weights(arguments, error));
    PS_TRY(ps_brdf_parse(&self->brdf, arguments->brdf, error));
    PS_TRY(PS_NEW(&self->questions, num, "questions", error));
    PS_TRY(PS_NEW(&self->requests, num, "questions", error));
    PS_TRY(PS_NEW(&self->jobs, num, "jobs", error));
    self->num = num;
    PS_TRY(ps_file_lists_make(&self->files, arguments, error));
    for (size_t i = 0; i < num; i++) {
        self->questions[i] = make_question(arguments, self->brdf);
        PS_TRY(fill_points(self, i, arguments, error));
    }
    return PSPEC_OK;
}

static void release(rules *self) {
    for (size_t i = 0; i < self->num; i++) {
        ps_quadrature_job_destroy(self->jobs[i]);
    }
    free(self->jobs);
    ps_brdf_destroy(self->brdf);
    free(self->questions);
    free(self->requests);
    ps_file_lists_free(self->files, self->num);
    ps_device_close(self->device);
}

static pspec_status check_question(const ps_request *request, ps_error *error) {
    rules self = {0};
    const pspec_status status = ask(&self, request, error);
    release(&self);
    return status;
}

/* ---- plan ---------------------------------------------------------------------------------- */

static pspec_status add_plan(ps_planner *planner, const ps_request *request,
                             const ps_quadrature_job *job, size_t index, ps_error *error) {
    const ps_quadrature_setup *const setup = &job->setup;
    ps_phases phases = ps_plan_table_begin_phases(planner);
    const double repeats = ps_quadrature_job_phases(job, &phases);
    ps_meta notes[2];
    ps_planned planned = {.problem = &setup->problem,
                          .needs = &setup->needs,
                          .limits = ps_device_get_limits(setup->device),
                          .plan = &setup->plan,
                          .phases = &phases,
                          .repeats = repeats,
                          .notes = notes};
    ps_plan_table_add_picture(&phases, request);
    if (setup->degrees_note[0] != '\0') {
        notes[planned.num_notes++] = (ps_meta){"degrees_note", PS_TEXT(setup->degrees_note)};
    }
    if (setup->weights_note[0] != '\0') {
        notes[planned.num_notes++] = (ps_meta){"weights", PS_TEXT(setup->weights_note)};
    }
    return ps_plan_table_add_job(planner, request, &planned, index, error);
}

static pspec_status plan_one(ps_planner *planner, const ps_request *request,
                             ps_quadrature_question *question, size_t index, ps_error *error) {
    ps_quadrature_job *job = NULL;
    question->open_device = planner->device;
    ps_plan_table_begin_question(planner, request, index);
    PS_TRY(ps_plan_table_find_lack(planner, &question->limits.constraints,
                                   &question->may_lack_device, error));
    PS_TRY(ps_quadrature_job_create(&job, question, error));
    pspec_status status = ps_quadrature_job_rate(job, error);
    if (status == PSPEC_OK) {
        status = add_plan(planner, request, job, index, error);
    }
    ps_quadrature_job_destroy(job);
    return status;
}

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    rules self = {0};
    pspec_status status = ask(&self, request, error);
    for (size_t i = 0; status == PSPEC_OK && i < self.num; i++) {
        status = plan_one(planner, request, &self.questions[i], i, error);
    }
    release(&self);
    return status;
}

/* ---- work ---------------------------------------------------------------------------------- */

static void warn_of_standard_error(const ps_quadrature_result *result, double standard_error,
                                   const ps_answer_hooks *hooks) {
    char where[48];
    if (result->has_look && !(result->look.corrected <= standard_error)) {
        ps_quadrature_look_name(where, sizeof where, &result->look);
        ps_answer_warn(
            hooks, "the standard error %.3g was not reached in %llu realizations: it is %.3g of %s",
            standard_error, (unsigned long long)result->num_realizations, result->look.corrected,
            where);
    }
}

static pspec_status run_one(ps_quadrature_job **job, ps_quadrature_question *question,
                            const ps_answer_hooks *hooks, ps_error *error) {
    question->watch = hooks->watch;
    if (hooks->device != NULL) {
        question->open_device = hooks->device;
    }
    ps_answer_begin_next(hooks);
    PS_TRY(ps_quadrature_job_create(job, question, error));
    if (hooks->tell_plan != NULL) {
        hooks->tell_plan(hooks->payload, &(*job)->setup.plan);
    }
    PS_TRY(ps_quadrature_job_run(*job, error));
    ps_answer_tell_profile(hooks, (*job)->setup.device);
    ps_answer_warn_of(hooks, ps_source_trouble((*job)->rules.sets.source));
    warn_of_standard_error(&(*job)->result, question->accuracy.standard_error, hooks);
    ps_quadrature_job_release(*job);
    return PSPEC_OK;
}

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    PS_TRY(ps_allocate(out, 1, sizeof(rules), "rules", error));
    rules *const self = *out;
    PS_TRY(ask(self, request, error));
    PS_TRY(ps_answer_open_device(&self->device, request, &self->questions[0].limits.constraints,
                                 self->num, hooks, error));
    for (size_t i = 0; i < self->num; i++) {
        self->questions[i].open_device = self->device;
        PS_TRY(run_one(&self->jobs[i], &self->questions[i], hooks, error));
    }
    return PSPEC_OK;
}

static pspec_status add_weights(ps_table *table, const ps_quadrature_result *result,
                                ps_error *error) {
    ps_npy_array array;
    PS_TRY(ps_npy_make_array(&array, 1, &result->num_weights, false, error));
    memcpy(array.data, result->weights, result->num_weights * sizeof *array.data);
    return ps_table_add_array(table, "weights", false, &array, error);
}

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    const rules *const self = computed;
    PS_TRY(ps_quadrature_table(&out->table, request, self->jobs, self->num, error));
    return request->wants_array || request->weights_out != NULL
               ? add_weights(out->table, &self->jobs[0]->result, error)
               : PSPEC_OK;
}

static pspec_status check_weights_out(const ps_request *request, ps_error *error) {
    return request->weights_out != NULL ? ps_weights_check_name(request->weights_out, error)
                                        : PSPEC_OK;
}

static void discard(void *computed) {
    if (computed != NULL) {
        release(computed);
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

static const ps_field_row own_fields[] = {
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

static const ps_field_row *const fields[] = {ps_fields_asked, ps_fields_points, own_fields,
                                             ps_fields_computed, NULL};

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
    .compute = compute,
    .tabulate = tabulate,
    .discard = discard,
    .fields = fields,
    .summary = summary,
    .pictures = pictures,
    .compared = compared,
};
