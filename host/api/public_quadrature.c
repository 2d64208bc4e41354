/* The public library: analyses of quadrature rules over the quadrature job. */
#include "api/public_objects.h"
#include "api/public_request.h"
#include "base/memory.h"
#include "jobs/quadrature/quadrature_job.h"

#include <stdio.h>
#include <stdlib.h>

struct pspec_quadrature {
    pspec_worst_case_error error;
    size_t num_degrees;
    pspec_quadrature_degree *degrees;
    double *weights;
    size_t num_weights;
    char text[sizeof((ps_quadrature_result *)0)->engine];
};

/* ---- the question ------------------------------------------------------------------------ */

static pspec_status check_request(const pspec_quadrature_request *request,
                                  const pspec_pattern *patterns, size_t num_patterns,
                                  ps_error *error) {
    if (request == NULL || patterns == NULL || num_patterns == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no %s",
                       request == NULL ? "request" : "pattern");
    }
    PS_TRY(ps_public_check_size(request->struct_size, sizeof *request,
                                "PSPEC_QUADRATURE_REQUEST_INIT", error));
    if (!(request->tolerance > 0 && request->tolerance <= 1)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "tolerance %g must be above 0 and at most 1", request->tolerance);
    }
    if (request->weight_sum_one != 0 && request->optimal_weights == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "weight_sum_one is about optimal_weights, which is 0");
    }
    if (!(request->standard_error >= 0 && request->standard_error < 1)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "standard_error %g must be from 0 to below 1", request->standard_error);
    }
    return request->max_degree >= 0 && request->max_degree <= PS_MAX_DEGREE
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "max_degree %d is not between 0 and %d", (int)request->max_degree,
                         PS_MAX_DEGREE);
}

static void say_plan(void *payload, const ps_plan *plan) {
    const pspec_context *const context = payload;
    if (plan->chosen != NULL) {
        ps_log_say(&context->log, "plan: %s in %s precision: %s", plan->chosen->engine->name,
                   ps_precision_name(plan->chosen->precision), plan->chosen->reason);
    }
}

static pspec_status make_question(ps_quadrature_question *out, pspec_context *context,
                                  const pspec_quadrature_request *request, ps_error *error) {
    *out = (ps_quadrature_question){
        .smoothness = request->smoothness,
        .weights = {.kind = request->optimal_weights != 0 ? PS_WEIGHTS_OPTIMAL : PS_WEIGHTS_GIVEN,
                    .sum_to_one = request->weight_sum_one != 0},
        .keeps_weights = request->keep_weights != 0,
        .drops_below_horizon = request->drop_below_horizon != 0,
        .max_degree = (size_t)request->max_degree,
        .accuracy = {.tolerance = request->tolerance,
                     .standard_error = request->standard_error,
                     .no_skip = request->no_skip != 0},
        .limits = {.constraints = {.engine = request->engine,
                                   .memory_limit = context->memory_limit}},
        .watch = context->watch,
        .tell_plan = say_plan,
        .payload = context};
    PS_TRY(
        ps_public_parse_precision(request->precision, &out->limits.constraints.precision, error));
    if (ps_plan_may_need_device(&out->limits.constraints)) {
        PS_TRY(ps_context_open_device(context));
        out->open_device = context->device;
    }
    return PSPEC_OK;
}

/* ---- the answer -------------------------------------------------------------------------- */

static pspec_mean copy_mean(ps_mean mean) {
    return (pspec_mean){mean.mean, mean.standard_error};
}

static void fill_error(pspec_worst_case_error *out, const ps_quadrature_result *result) {
    *out = (pspec_worst_case_error){.num_realizations = result->num_realizations,
                                    .squared = copy_mean(result->squared),
                                    .zonal = copy_mean(result->zonal),
                                    .anisotropic = copy_mean(result->anisotropic),
                                    .tail = copy_mean(result->tail),
                                    .tail_model = result->tail_model,
                                    .tail_bound = result->tail_bound,
                                    .numerical_bound = result->numerical_bound,
                                    .weight_sum = copy_mean(result->weight_sum),
                                    .condition = result->largest_condition,
                                    .is_ill_conditioned = result->is_ill_conditioned,
                                    .num_dropped = result->num_dropped,
                                    .num_duplicates = result->num_duplicates};
}

/* The weights go over to the answer. */
static pspec_status fill_answer(pspec_quadrature *out, ps_quadrature_result *result,
                                ps_error *error) {
    const size_t num = result->max_degree + 1;
    PS_TRY(PS_NEW(&out->degrees, num, "degrees", error));
    out->num_degrees = num;
    for (size_t l = 0; l < num; l++) {
        const ps_quadrature_degree *const found = &result->degrees[l];
        out->degrees[l] = (pspec_quadrature_degree){
            (int32_t)l,          found->a, found->b, copy_mean(found->d2), copy_mean(found->c2),
            copy_mean(found->e2)};
    }
    fill_error(&out->error, result);
    out->weights = result->weights;
    out->num_weights = result->num_weights;
    result->weights = NULL;
    snprintf(out->text, sizeof out->text, "%s", result->engine);
    return PSPEC_OK;
}

static pspec_status analyse(pspec_quadrature *out, pspec_context *context,
                            const pspec_quadrature_request *request, const pspec_pattern *patterns,
                            size_t num_patterns) {
    ps_error *const error = &context->error;
    ps_quadrature_question question;
    ps_quadrature_result result = {0};
    ps_brdf *brdf = NULL;
    PS_TRY(make_question(&question, context, request, error));
    PS_TRY(ps_brdf_parse(&brdf, request->brdf != NULL ? request->brdf : "", error));
    question.brdf = brdf;
    question.patterns = patterns;
    question.num_patterns = num_patterns;
    question.num_realizations = num_patterns;
    pspec_status status = ps_quadrature_run(&result, &question, error);
    if (status == PSPEC_OK) {
        status = fill_answer(out, &result, error);
    }
    ps_quadrature_free(&result);
    ps_brdf_destroy(brdf);
    return status;
}

pspec_status pspec_quadrature_create(pspec_quadrature **out, pspec_context *context,
                                     const pspec_quadrature_request *request,
                                     const pspec_pattern *patterns, size_t num_patterns) {
    void *memory = NULL;
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    *out = NULL;
    PS_TRY(check_request(request, patterns, num_patterns, &context->error));
    PS_TRY(ps_allocate(&memory, 1, sizeof(pspec_quadrature), "an analysis", &context->error));
    const pspec_status status = analyse(memory, context, request, patterns, num_patterns);
    if (status != PSPEC_OK) {
        pspec_quadrature_destroy(memory);
        return status;
    }
    *out = memory;
    return PSPEC_OK;
}

void pspec_quadrature_destroy(pspec_quadrature *quadrature) {
    if (quadrature != NULL) {
        free(quadrature->degrees);
        free(quadrature->weights);
        free(quadrature);
    }
}

const pspec_worst_case_error *pspec_quadrature_error(const pspec_quadrature *quadrature) {
    return &quadrature->error;
}

const pspec_quadrature_degree *pspec_quadrature_degrees(const pspec_quadrature *quadrature,
                                                        size_t *num_degrees) {
    *num_degrees = quadrature->num_degrees;
    return quadrature->degrees;
}

const double *pspec_quadrature_weights(const pspec_quadrature *quadrature, size_t *num_weights) {
    *num_weights = quadrature->num_weights;
    return quadrature->weights;
}

const char *pspec_quadrature_text(const pspec_quadrature *quadrature) {
    return quadrature->text;
}
