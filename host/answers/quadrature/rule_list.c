#include "answers/quadrature/rule_list.h"

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
        PS_TRY(fill_points(out, i, arguments, error));
    }
    return PSPEC_OK;
}

void ps_rule_list_free(ps_rule_list *list) {
    ps_brdf_destroy(list->brdf);
    free(list->questions);
    free(list->requests);
    ps_file_lists_free(list->files, list->num);
    *list = (ps_rule_list){0};
}
