/* The public library: patterns through plans. */
#include "api/public_plan.h"
#include "base/memory.h"
#include "plan/memory_model.h"

#include <stdlib.h>

static pspec_status require_sound(const pspec_plan *plan) {
    return plan->has_failed
               ? ps_fail(&plan->context->error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "this plan failed before, so its averages cannot be used: destroy it, or "
                         "begin again with pspec_plan_reset")
               : PSPEC_OK;
}

/* Engines that were cancelled do not know how far the whole plan is. */
static pspec_status fail_cancelled(pspec_plan *plan) {
    return ps_fail(&plan->context->error, PSPEC_ERROR_CANCELLED,
                   "cancelled by the progress callback after %llu realizations",
                   (unsigned long long)ps_estimator_num_realizations(plan->runner.estimator));
}

/* Remembers a failure. */
static pspec_status note(pspec_plan *plan, pspec_status status) {
    plan->has_failed = status != PSPEC_OK;
    return status == PSPEC_ERROR_CANCELLED ? fail_cancelled(plan) : status;
}

/* Weights take memory, of which a limit leaves less for engines. As in the program the first
 * pattern tells whether there are any. */
static pspec_status plan_for_weights(pspec_plan *plan, const pspec_pattern *patterns, size_t num) {
    const bool is_first = !plan->has_begun && num > 0;
    plan->has_begun = plan->has_begun || is_first;
    const bool has_weights = is_first ? patterns[0].weights != NULL : plan->problem.has_weights;
    return has_weights == plan->problem.has_weights || plan->context->memory_limit == 0
               ? PSPEC_OK
               : ps_public_plan_begin_anew(plan, has_weights);
}

pspec_status pspec_plan_run(pspec_plan *plan, const pspec_pattern *patterns, size_t num_patterns) {
    if (plan == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    PS_TRY(require_sound(plan));
    if (patterns == NULL && num_patterns > 0) {
        return ps_fail(&plan->context->error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%zu patterns at the address NULL", num_patterns);
    }
    PS_TRY(note(plan, plan_for_weights(plan, patterns, num_patterns)));
    PS_TRY(note(plan, ps_gather_add(plan->gather, patterns, num_patterns, &plan->context->error)));
    ps_kept_patterns_add(&plan->kept, patterns, num_patterns);
    return PSPEC_OK;
}

/* Are coefficients within the limit that the caller has set, together with what the plan has? The
 * array that they are for counts, though it is the caller's. */
static pspec_status require_memory(const pspec_plan *plan, ps_harmonics harmonics) {
    pspec_context *context = plan->context;
    const ps_candidate *chosen = plan->choice.chosen;
    const double limit = (double)context->memory_limit;
    if (context->memory_limit == 0 || ps_problem_domain(&plan->problem) != PS_ON_SPHERE) {
        return PSPEC_OK;
    }
    const double bytes = ps_memory_of_coefficients(
        chosen->engine, chosen->precision, &plan->problem,
        context->device != NULL ? ps_device_get_limits(context->device) : NULL, harmonics);
    return chosen->bytes + bytes <= limit
               ? PSPEC_OK
               : ps_fail(&context->error, PSPEC_ERROR_MEMORY,
                         "coefficients to degree %d take %.3g bytes; with the %.3g of the plan "
                         "that is above the memory limit of %.3g",
                         (int)plan->request.frequencies.max_frequency, bytes, chosen->bytes, limit);
}

pspec_status pspec_plan_coefficients(pspec_plan *plan, const pspec_pattern *pattern,
                                     int hemispherical, double *coefficients) {
    if (plan == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    if (pattern == NULL || coefficients == NULL) {
        return ps_fail(&plan->context->error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "there is no pattern, or no room for its coefficients");
    }
    const bool on_sphere = ps_problem_domain(&plan->problem) == PS_ON_SPHERE;
    const ps_harmonics harmonics = hemispherical != 0 ? PS_HEMISPHERICAL_HARMONICS
                                   : on_sphere        ? PS_SPHERICAL_HARMONICS
                                                      : PS_EXPONENTIALS;
    if (!on_sphere && hemispherical != 0) {
        return ps_fail(&plan->context->error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "hemispherical harmonics are for points on the sphere");
    }
    PS_TRY(require_memory(plan, harmonics));
    const pspec_status status = ps_estimator_coefficients(
        plan->runner.estimator, pattern, harmonics, coefficients, &plan->context->error);
    return status == PSPEC_ERROR_CANCELLED ? fail_cancelled(plan) : status;
}

pspec_status pspec_plan_reset(pspec_plan *plan) {
    if (plan == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_kept_patterns_reset(&plan->kept);
    plan->has_begun = false;
    if (plan->runner.was_replanned) {
        return note(plan, ps_public_plan_begin_anew(plan, false));
    }
    ps_gather_reset(plan->gather);
    ps_estimator_reset(plan->runner.estimator);
    return note(plan, PSPEC_OK);
}

/* All that were run are in the averages, out of an engine that is within the tolerance of their
 * powers. */
static pspec_status settle(pspec_plan *plan, ps_error *error) {
    if (ps_estimator_num_realizations(plan->runner.estimator) == 0) {
        return PSPEC_OK;
    }
    const pspec_status status = ps_runner_settle(&plan->runner, error);
    if (status != PSPEC_ERROR_TOLERANCE) {
        return note(plan, status);
    }
    const ps_accuracy *const accuracy = &plan->runner.accuracy;
    return ps_fail(
        error, PSPEC_ERROR_TOLERANCE,
        "these patterns, of up to %llu points, have a mean power of %.3g, so %s precision "
        "has an error of %.2g, above the tolerance %g: make a plan of higher precision",
        (unsigned long long)accuracy->largest_points, accuracy->largest_mean_power,
        ps_precision_name(plan->choice.chosen->precision), accuracy->error,
        plan->problem.tolerance);
}

pspec_status ps_plan_sums(pspec_plan *plan, ps_spectrum_sums *out, const ps_bins **bins) {
    ps_error *error = &plan->context->error;
    PS_TRY(require_sound(plan));
    PS_TRY(note(plan, ps_gather_flush(plan->gather, error)));
    PS_TRY(settle(plan, error));
    *bins = ps_estimator_bins(plan->runner.estimator);
    return ps_estimator_sums(plan->runner.estimator, out, error);
}

pspec_status pspec_plan_c2(pspec_plan *plan, pspec_mean *c2) {
    ps_spectrum_sums sums = {0};
    const ps_bins *bins = NULL;
    if (plan == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *error = &plan->context->error;
    const size_t num = plan->request.frequencies.num;
    if (!plan->request.want_c2 || c2 == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       plan->request.want_c2
                           ? "there is no room for C_l^2"
                           : "this plan does not have C_l^2: its request lacks want_c2");
    }
    PS_TRY(ps_plan_sums(plan, &sums, &bins)); /* runs what waits, and checks the tolerance */
    ps_spectrum_sums_free(&sums);
    ps_mean *means = NULL;
    PS_TRY(PS_NEW(&means, num, "C_l^2", error));
    ps_estimator_c2(plan->runner.estimator, means);
    for (size_t i = 0; i < num; i++) {
        c2[i] = (pspec_mean){means[i].mean, means[i].standard_error};
    }
    free(means);
    return PSPEC_OK;
}

pspec_context *ps_plan_context(const pspec_plan *plan) {
    return plan->context;
}
