#include "answers/quadrature/rule_list.h"

#include "answers/spectra/spectra.h"
#include "base/memory.h"
#include "request/point_source.h"

#include <stdlib.h>

/* This tolerance is for E^2: good rules of many points have an E^2 of 1e-7 and less. */
static const double TOLERANCE = 1e-10;

static pspec_status check_source(const ps_request *arguments, ps_command_id taker,
                                 ps_error *error) {
    if (arguments->brdf == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--brdf NAME is needed, as in --brdf diffuse or --brdf glossy:n=30");
    }
    PS_TRY(ps_sources_check(arguments, "no rule", error));
    PS_TRY(ps_point_options_check(arguments, error));
    return ps_option_pairs_check(arguments, taker, error);
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
        .smoothness = arguments->smoothness[0],
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

static pspec_status fill_points(ps_rule_list *self, size_t index, const ps_request *arguments,
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

pspec_status ps_rule_list_make(ps_rule_list *out, const ps_request *arguments, ps_command_id taker,
                               ps_error *error) {
    const size_t num = ps_request_num_questions(arguments);
    PS_TRY(check_source(arguments, taker, error));
    PS_TRY(check_weights(arguments, error));
    PS_TRY(ps_brdf_parse(&out->brdf, arguments->brdf, error));
    PS_TRY(PS_NEW(&out->questions, num, "questions", error));
    PS_TRY(PS_NEW(&out->requests, num, "questions", error));
    out->num = num;
    PS_TRY(ps_file_lists_make(&out->files, arguments, error));
    for (size_t i = 0; i < num; i++) {
        out->questions[i] = make_question(arguments, out->brdf);
        out->questions[i].limits.checkpoint.part += (unsigned)i;
        PS_TRY(fill_points(out, i, arguments, error));
    }
    return PSPEC_OK;
}

void ps_rule_list_free(ps_rule_list *list) {
    for (size_t i = 0; list->jobs != NULL && i < list->num; i++) {
        ps_quadrature_job_destroy(list->jobs[i]);
    }
    free(list->jobs);
    ps_device_close(list->device);
    ps_brdf_destroy(list->brdf);
    free(list->questions);
    free(list->requests);
    ps_file_lists_free(list->files, list->num);
    *list = (ps_rule_list){0};
}

/* ---- plan ---------------------------------------------------------------------------------- */

static pspec_status add_plan(ps_planner *planner, const ps_request *request,
                             const ps_quadrature_job *job, size_t index, ps_error *error) {
    const ps_quadrature_setup *const setup = &job->setup;
    ps_phases phases = ps_plan_table_begin_phases(planner);
    const double repeats = ps_quadrature_job_phases(job, &phases);
    ps_meta notes[3];
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
    if (job->question->horizon != NULL) {
        notes[planned.num_notes++] =
            (ps_meta){"horizon_points", PS_INTEGER(job->question->horizon->num)};
    }
    if (setup->weights_note[0] != '\0') {
        notes[planned.num_notes++] = (ps_meta){"weights", PS_TEXT(setup->weights_note)};
    }
    return ps_plan_table_add_job(planner, request, &planned, index, error);
}

static pspec_status plan_one(ps_planner *planner, const ps_request *request,
                             ps_quadrature_question *question, size_t index, ps_error *error) {
    ps_quadrature_job *job = NULL;
    PS_TRY(ps_plan_table_begin_question(planner, request, index, &question->limits.constraints,
                                        &question->open_device, &question->may_lack_device, error));
    PS_TRY(ps_quadrature_job_create(&job, question, error));
    pspec_status status = ps_quadrature_job_rate(job, error);
    if (status == PSPEC_OK) {
        status = add_plan(planner, request, job, index, error);
    }
    ps_quadrature_job_destroy(job);
    return status;
}

pspec_status ps_rule_list_plan(ps_rule_list *self, ps_planner *planner, const ps_request *request,
                               ps_error *error) {
    for (size_t i = 0; i < self->num; i++) {
        PS_TRY(plan_one(planner, request, &self->questions[i], i, error));
    }
    return PSPEC_OK;
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
    ps_answer_begin_job(hooks, &question->watch, &question->open_device);
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

pspec_status ps_rule_list_run(ps_rule_list *self, const ps_request *request,
                              const ps_answer_hooks *hooks, ps_error *error) {
    PS_TRY(PS_NEW(&self->jobs, self->num, "jobs", error));
    PS_TRY(ps_answer_open_device(&self->device, request, &self->questions[0].limits.constraints,
                                 self->num, hooks, error));
    for (size_t i = 0; i < self->num; i++) {
        self->questions[i].open_device = self->device;
        PS_TRY(run_one(&self->jobs[i], &self->questions[i], hooks, error));
    }
    return PSPEC_OK;
}
