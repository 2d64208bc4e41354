#include "answers/variance/variance_question.h"

#include "base/memory.h"
#include "request/options.h"
#include "request/point_source.h"

#include <stdlib.h>

static pspec_status fail_without_integrand(ps_error *error) {
    ps_text names = {0};
    for (size_t i = 0; ps_integrand_kinds[i] != NULL; i++) {
        ps_text_append(&names, "%s%s", i > 0 ? ", " : "", ps_integrand_kinds[i]->name);
    }
    ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "--integrand NAME is needed; there are %s",
            ps_text_string(&names));
    ps_text_free(&names);
    return PSPEC_ERROR_INVALID_ARGUMENT;
}

static pspec_status check_source(const ps_request *arguments, ps_error *error) {
    if (arguments->num_integrands == 0) {
        return fail_without_integrand(error);
    }
    if (arguments->num_files > 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: variances are of samplers, whose realizations are independent; point "
                       "files are not read",
                       arguments->files[0]);
    }
    if (arguments->num_samplers == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "nothing to take a variance of: name a --sampler");
    }
    if (arguments->in_place && arguments->is_given[PS_OPTION_SHIFTS]) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s does not go with %s: sets are moved, or they are not",
                       ps_option_show(arguments, PS_OPTION_SHIFTS).text,
                       ps_option_show(arguments, PS_OPTION_IN_PLACE).text);
    }
    return PSPEC_OK;
}

/* Estimates by morphed points have other weights than 1/N. */
static pspec_status check_sampler(const ps_sampler_request *request, const char *text,
                                  ps_error *error) {
    return request->morph.kind == PS_MORPH_NONE
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "--sampler %s: morphed points have the density of a lobe, and these "
                         "estimates are means over uniform points",
                         text);
}

static ps_variance_question make_question(const ps_request *arguments,
                                          const ps_sampler_request *sampler) {
    return (ps_variance_question){
        .spectrum = {.sampler = sampler,
                     .num_realizations = arguments->num_realizations,
                     .on_sphere = ps_sampler_is_on_sphere(sampler),
                     .on_hemisphere = ps_sampler_is_on_hemisphere(sampler),
                     .max_degree = (int64_t)arguments->max_degree,
                     .frequencies = arguments->frequencies,
                     /* all of the box: its energy is what the rest is told from */
                     .wants_full_array = true,
                     .normalization = PSPEC_NORMALIZATION_INTEGRAL,
                     .accuracy = arguments->accuracy,
                     .limits = arguments->limits},
        .texts = arguments->integrands,
        .num_integrands = arguments->num_integrands,
        .num_shifts = arguments->num_shifts,
        .is_moved = !arguments->in_place,
    };
}

pspec_status ps_variance_list_make(ps_variance_list *out, const ps_request *arguments,
                                   ps_error *error) {
    const size_t num = ps_request_num_questions(arguments);
    *out = (ps_variance_list){0};
    PS_TRY(check_source(arguments, error));
    PS_TRY(PS_NEW(&out->questions, num, "questions", error));
    PS_TRY(PS_NEW(&out->requests, num, "questions", error));
    out->num = num;
    for (size_t i = 0; i < num; i++) {
        PS_TRY(ps_sampler_request_make(&out->requests[i], arguments, i, error));
        PS_TRY(check_sampler(&out->requests[i], ps_request_sampler(arguments, i), error));
        out->questions[i] = make_question(arguments, &out->requests[i]);
        PS_TRY(ps_variance_question_check(&out->questions[i], error));
    }
    return PSPEC_OK;
}

void ps_variance_list_free(ps_variance_list *list) {
    free(list->questions);
    free(list->requests);
    *list = (ps_variance_list){0};
}
