/* The public library: plans made over the runner of jobs, and the callbacks of their context. */
#include "api/public_plan.h"
#include "base/clock.h"
#include "base/memory.h"

#include <stdlib.h>

/* ---- progress ---------------------------------------------------------------------------- */

static bool ask_to_stop(pspec_plan *plan) {
    return ps_watch_tell(&plan->context->watch, "realizations",
                         ps_estimator_num_realizations(plan->runner.estimator),
                         plan->problem.num_realizations, NULL, NULL) != PSPEC_OK;
}

/* Asked by engines, some of them for every frequency: the callback is not called as often. */
static bool should_stop(void *payload) {
    const double interval = 0.1; /* seconds; what people call at once */
    pspec_plan *plan = payload;
    if (plan->context->watch.tell == NULL) {
        return false;
    }
    const double time = ps_clock_seconds();
    if (time - plan->last_asked < interval) {
        return false;
    }
    plan->last_asked = time;
    return ask_to_stop(plan);
}

static pspec_status after_batch(void *payload, ps_error *error) {
    return ask_to_stop(payload) ? ps_fail(error, PSPEC_ERROR_CANCELLED, "cancelled") : PSPEC_OK;
}

/* ---- create ------------------------------------------------------------------------------ */

static void log_choice(const pspec_plan *plan) {
    for (size_t i = 0; i < plan->choice.num_candidates; i++) {
        const ps_candidate *candidate = &plan->choice.candidates[i];
        if (candidate->is_excluded) { /* as the request says */
            continue;
        }
        ps_log_say(&plan->context->log, "%s in %s precision%s: %s", candidate->engine->name,
                   ps_precision_name(candidate->precision), candidate->is_chosen ? ", chosen" : "",
                   candidate->reason);
    }
}

static pspec_status choose_engine(void *payload, ps_error *error) {
    pspec_plan *const plan = payload;
    const pspec_context *const context = plan->context;
    const bool any_engine = plan->engine_name.length == 0;
    ps_memory_room room;
    const ps_plan_constraints constraints = {
        .engine = any_engine ? NULL : ps_text_string(&plan->engine_name),
        .precision = plan->request.precision,
        .memory_limit = context->memory_limit,
        .offers = PS_OFFER_RINGS,
        .room = &room};
    const ps_needs_strict strict = {.tolerance = plan->problem.tolerance};
    const ps_device_limits *limits =
        context->device != NULL ? ps_device_get_limits(context->device) : NULL;
    ps_memory_room_find(&room, ps_runner_held(&plan->runner));
    PS_TRY(ps_needs_plan(&plan->needs, &plan->choice, &plan->problem, limits, &constraints, &strict,
                         error));
    log_choice(plan);
    return PSPEC_OK;
}

/* What a limit that was set leaves beside the plan and the patterns that it keeps. */
static uint64_t room_for_spares(const pspec_plan *plan) {
    const double taken = plan->choice.chosen->bytes + (double)ps_kept_patterns_bytes(&plan->kept);
    const double rest = (double)plan->context->memory_limit - taken;
    return plan->context->memory_limit == 0 ? UINT64_MAX : rest > 0 ? (uint64_t)rest : 0;
}

static ps_estimator_options choose_options(void *payload) {
    const pspec_plan *const plan = payload;
    return (ps_estimator_options){
        .want_frequencies = true,
        .want_c2 = plan->request.want_c2,
        .self_check = !plan->request.no_self_check,
        .normalization = plan->request.normalization,
        .spare_bytes = room_for_spares(plan),
        .should_stop = should_stop,
        .payload = payload,
        .log = plan->context->log,
    };
}

/* There is another estimator. */
static pspec_status begin(void *payload, ps_error *error) {
    pspec_plan *const plan = payload;
    const ps_gather_options gather = {.estimator = plan->runner.estimator,
                                      .dimension = plan->request.frequencies.dimension,
                                      .num_points = plan->request.num_points,
                                      .after_batch = after_batch,
                                      .payload = plan};
    ps_text_free(&plan->text);
    ps_estimator_describe(plan->runner.estimator, &plan->text);
    PS_TRY(ps_text_check(&plan->text, error));
    ps_log_say(&plan->context->log, "plan: %s, %zu realizations at a time",
               ps_text_string(&plan->text), ps_estimator_batch(plan->runner.estimator));
    ps_gather_destroy(plan->gather);
    plan->gather = NULL;
    return ps_gather_create(&plan->gather, &gather, error);
}

/* The next of the patterns that were kept. */
static pspec_status give_kept(void *payload, uint64_t most, size_t *num, ps_error *error) {
    pspec_plan *const plan = payload;
    const size_t batch = ps_estimator_batch(plan->runner.estimator);
    const size_t rest = plan->kept.num - plan->num_again;
    *num = rest < batch ? rest : batch;
    *num = *num < most ? *num : (size_t)most;
    PS_TRY(ps_estimator_add(plan->runner.estimator, plan->kept.patterns + plan->num_again, NULL,
                            *num, error));
    plan->num_again += *num;
    return PSPEC_OK;
}

static pspec_status rewind_kept(void *payload, ps_error *error) {
    pspec_plan *const plan = payload;
    plan->num_again = 0;
    return plan->kept.is_partial
               ? ps_fail(error, PSPEC_ERROR_TOLERANCE, "the patterns were too many to be kept")
               : PSPEC_OK;
}

static const ps_runner_kind kind = {.plan = choose_engine,
                                    .options = choose_options,
                                    .begin = begin,
                                    .tell = after_batch,
                                    .give = give_kept,
                                    .rewind = rewind_kept};

/* What a caller of the library needs: every frequency of the request, with its standard error. */
static ps_needs find_needs(const ps_public_request *request) {
    const ps_frequencies *const frequencies = &request->frequencies;
    const bool is_grid = frequencies->kind != PS_FREQUENCIES_LIST && !request->is_on_sphere;
    const ps_needs_question needs = {
        .dimension = frequencies->dimension,
        .max_frequency = is_grid ? frequencies->max_frequency : 0,
        .max_norm2 = frequencies->max_norm2,
        .on_sphere = request->is_on_sphere,
        .on_hemisphere = request->is_on_sphere && frequencies->degree_step > 1,
        .wants_full_array = frequencies->kind != PS_FREQUENCIES_BALL,
        .wants_frequency_errors = true,
        .share_not_drawn =
            1 - (double)frequencies->num / (double)ps_frequencies_population(frequencies),
        .num_realizations = request->num_realizations};
    return ps_needs_find(&needs);
}

static ps_problem make_problem(const ps_public_request *request, bool has_weights) {
    const bool is_pairs = request->normalization == PSPEC_NORMALIZATION_PAIRS;
    return (ps_problem){
        .frequencies = &request->frequencies,
        .num_points = request->num_points,
        .planned_points = request->num_points,
        .num_realizations = request->num_realizations,
        .has_weights = has_weights,
        .measure = is_pairs ? PS_OF_PAIR_SUMS : PS_OF_AMPLITUDES,
        .floor = is_pairs ? request->floor : 0,
        .tolerance = ps_plan_tolerance(request->tolerance, is_pairs ? 0 : request->floor),
    };
}

/* As for files in the program, a quarter of a limit that was set leaves room for what computes
 * with the patterns. */
static pspec_status make_room_to_keep(pspec_plan *plan, ps_error *error) {
    const ps_kept_shape shape = {.dimension = plan->request.frequencies.dimension,
                                 .num_points = plan->request.num_points,
                                 .num_realizations = plan->request.num_realizations,
                                 .most_bytes = plan->context->memory_limit / 4};
    return ps_kept_patterns_create(&plan->kept, &shape, error);
}

static pspec_status fill_plan(pspec_plan *plan, ps_error *error) {
    pspec_context *const context = plan->context;
    const ps_plan_constraints constraints = {.engine = plan->request.engine,
                                             .precision = plan->request.precision};
    if (plan->request.engine != NULL) {
        ps_text_append(&plan->engine_name, "%s", plan->request.engine);
        PS_TRY(ps_text_check(&plan->engine_name, error));
    }
    PS_TRY(ps_frequencies_enumerate(&plan->request.frequencies, error));
    if (ps_plan_may_need_device(&constraints)) {
        PS_TRY(ps_context_open_device(context));
    }
    plan->problem = make_problem(&plan->request, false);
    plan->needs = find_needs(&plan->request);
    plan->runner = (ps_runner){.kind = &kind,
                               .job = plan,
                               .problem = &plan->problem,
                               .plan = &plan->choice,
                               .device = context->device};
    PS_TRY(choose_engine(plan, error));
    PS_TRY(ps_plan_require(&plan->choice, &plan->problem, error)); /* what follows needs a choice */
    PS_TRY(make_room_to_keep(plan, error));
    return ps_runner_start(&plan->runner, error);
}

/* Takes over the frequencies of the request. */
static pspec_status create_plan(pspec_plan **out, pspec_context *context,
                                ps_public_request *request) {
    void *memory = NULL;
    pspec_status status = ps_allocate(&memory, 1, sizeof(pspec_plan), "a plan", &context->error);
    if (status != PSPEC_OK) {
        ps_frequencies_free(&request->frequencies);
        return status;
    }
    pspec_plan *plan = memory;
    plan->context = context;
    plan->request = *request;
    status = fill_plan(plan, &context->error);
    if (status != PSPEC_OK) {
        pspec_plan_destroy(plan);
        return status;
    }
    *out = plan;
    return PSPEC_OK;
}

pspec_status pspec_plan_create(pspec_plan **out, pspec_context *context,
                               const pspec_power_request *request) {
    ps_public_request checked = {0};
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    *out = NULL;
    PS_TRY(ps_public_request_power(&checked, request, &context->error));
    return create_plan(out, context, &checked);
}

pspec_status pspec_plan_create_angular(pspec_plan **out, pspec_context *context,
                                       const pspec_angular_request *request) {
    ps_public_request checked = {0};
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    *out = NULL;
    PS_TRY(ps_public_request_angular(&checked, request, &context->error));
    return create_plan(out, context, &checked);
}

void pspec_plan_destroy(pspec_plan *plan) {
    if (plan != NULL) {
        ps_gather_destroy(plan->gather);
        ps_runner_free(&plan->runner);
        ps_kept_patterns_free(&plan->kept);
        ps_text_free(&plan->engine_name);
        ps_frequencies_free(&plan->request.frequencies);
        ps_text_free(&plan->text);
        free(plan);
    }
}

const char *pspec_plan_text(const pspec_plan *plan) {
    return ps_text_string(&plan->text);
}

pspec_status ps_public_plan_begin_anew(pspec_plan *plan, bool has_weights) {
    ps_error *const error = &plan->context->error;
    const ps_plan choice = plan->choice; /* `chosen` is right again once it is copied back */
    const ps_problem problem = plan->problem;
    plan->problem = make_problem(&plan->request, has_weights);
    pspec_status status = choose_engine(plan, error);
    if (status == PSPEC_OK) {
        status = ps_plan_require(&plan->choice, &plan->problem, error);
    }
    if (status != PSPEC_OK) {
        plan->choice = choice;
        plan->problem = problem;
        return status;
    }
    plan->runner.was_replanned = true; /* until it is done: a reset after a failure begins anew */
    PS_TRY(ps_runner_start(&plan->runner, error));
    plan->runner.was_replanned = false;
    return PSPEC_OK;
}
