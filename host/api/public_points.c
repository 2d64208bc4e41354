/* The public library: points of samplers, and point files. */
#include "api/public_words.h"
#include "base/memory.h"
#include "commands/points.h"

#include <stdlib.h>

struct pspec_sampler {
    ps_sampler_request request; /* resolved; it borrows nothing */
};

/* ---- into arrays ------------------------------------------------------------------------- */

pspec_status pspec_sampler_create(pspec_sampler **out, pspec_context *context,
                                  const pspec_option *options, size_t num_options) {
    ps_public_words words;
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    *out = NULL;
    pspec_sampler *self = NULL;
    PS_TRY(PS_NEW(&self, 1, "a sampler", error));
    pspec_status status =
        ps_public_words_make(&words, context, "", &ps_command_sample, options, num_options);
    if (status == PSPEC_OK) {
        status = ps_points_find_sampler(&self->request, &words.request, error);
    }
    ps_public_words_free(&words);
    if (status != PSPEC_OK) {
        free(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

void pspec_sampler_destroy(pspec_sampler *sampler) {
    free(sampler);
}

pspec_sampler_shape pspec_sampler_get_shape(const pspec_sampler *sampler) {
    const ps_sampler_request *const request = &sampler->request;
    const pspec_domain domain = ps_sampler_is_on_hemisphere(request) ? PSPEC_DOMAIN_HEMISPHERE
                                : ps_sampler_is_on_sphere(request)   ? PSPEC_DOMAIN_SPHERE
                                                                     : PSPEC_DOMAIN_TORUS;
    return (pspec_sampler_shape){domain, request->dimension, request->num_points,
                                 ps_sampler_most_points(request)};
}

pspec_status pspec_sampler_generate(const pspec_sampler *sampler, pspec_context *context,
                                    uint64_t realization, double *points, size_t *num_points) {
    if (context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    if (sampler == NULL || points == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "there is no sampler, or no room for its points");
    }
    if (num_points == NULL && ps_sampler_varies(&sampler->request)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "there is no place for the number of points, which changes from realization "
                       "to realization");
    }
    ps_sampler_request request = sampler->request;
    if (ps_sampler_uses_device(&request)) {
        PS_TRY(ps_context_lend(context, &request.lender));
    }
    return ps_sampler_generate(&request, realization, points, num_points, &context->watch, error);
}

/* ---- into files -------------------------------------------------------------------------- */

static pspec_status make_file(pspec_context *context, const ps_command *row,
                              const pspec_option *options, size_t num_options) {
    ps_public_words words;
    ps_answer nothing = {0};
    if (context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    pspec_status status = ps_public_words_make(&words, context, "", row, options, num_options);
    if (status == PSPEC_OK && words.request.output == NULL &&
        !ps_request_only_draws(&words.request)) {
        status = ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s needs the option output, the file to write", row->name);
    }
    if (status == PSPEC_OK) {
        const ps_answer_hooks hooks = ps_public_hooks(context);
        status = row->run(&nothing, &words.request, &hooks, error);
    }
    ps_public_words_free(&words);
    return status;
}

pspec_status pspec_sample(pspec_context *context, const pspec_option *options, size_t num_options) {
    return make_file(context, &ps_command_sample, options, num_options);
}

pspec_status pspec_convert(pspec_context *context, const pspec_option *options,
                           size_t num_options) {
    return make_file(context, &ps_command_convert, options, num_options);
}
