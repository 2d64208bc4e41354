/* What of a plan nobody needs: precision, and what the engines that are not chosen would take. */
#include "plan/cost_model.h"
#include "plan/needs.h"

#include <stdio.h>

static double share_saved(double seconds, double seconds_without) {
    return seconds_without > seconds ? 1 - seconds / seconds_without : 0;
}

/* A plan for the same without the skip. */
static pspec_status make_exact(ps_plan *plan, const ps_problem *problem,
                               const ps_device_limits *limits,
                               const ps_plan_constraints *constraints, double tolerance,
                               ps_error *error) {
    ps_problem exact = *problem;
    ps_plan_constraints own = *constraints;
    exact.tolerance = tolerance;
    own.prefers_double = true;
    return ps_plan_make(plan, &exact, limits, &own, error);
}

static void skip_precision(ps_needs *needs, const ps_candidate *chosen, double tolerance,
                           const ps_candidate *exact, const ps_needs_strict *strict) {
    char what[sizeof needs->skips[0].what];
    char why[sizeof needs->skips[0].why];
    const bool is_looser = tolerance > strict->tolerance;
    if (exact == NULL || (chosen->precision >= exact->precision && !is_looser)) {
        return; /* what could be more exact cannot do it, or is no more exact */
    }
    const double share = share_saved(chosen->seconds + strict->other_seconds,
                                     exact->seconds + strict->other_seconds);
    if (share <= 0) {
        return; /* the cheapest way is the exact one */
    }
    if (chosen->precision >= exact->precision) {
        snprintf(what, sizeof what, "digits beyond %.2g", tolerance);
    } else {
        snprintf(what, sizeof what, "%s precision", ps_precision_name(exact->precision));
    }
    if (is_looser) {
        snprintf(why, sizeof why, "--standard-error and --floor need a tolerance of %.2g, not %.2g",
                 tolerance, strict->tolerance);
    } else {
        snprintf(why, sizeof why, "%s precision is within the tolerance %.2g",
                 ps_precision_name(chosen->precision), tolerance);
    }
    ps_needs_add(needs, what, why, share);
}

/* By operations at the device's peak: a sum of squares in two parts
 * (spectra/accumulate/accumulate_device.c). */
static void skip_squares(ps_needs *needs, const ps_problem *problem, const ps_plan *plan,
                         const ps_device_limits *limits) {
    const double square_flops = 9;
    const ps_candidate *const chosen = plan->chosen;
    if (!needs->no_frequency_errors || limits == NULL || !chosen->engine->needs_device) {
        return;
    }
    const double sets = problem->num_realizations > 0 ? (double)problem->num_realizations : 1;
    const double seconds = square_flops * sets * (double)problem->frequencies->num /
                           ps_cost_nominal_flops(limits, chosen->precision);
    ps_needs_add(needs, "standard errors of single frequencies",
                 "only those of rings are asked for",
                 share_saved(chosen->seconds, chosen->seconds + seconds));
}

/* Kernels are built when an engine is created, and a device is opened for engines that need one. */
static void add_matters_of_course(ps_needs *needs, const ps_plan *plan,
                                  const ps_plan_constraints *constraints) {
    char what[sizeof needs->skips[0].what];
    if (!ps_plan_may_need_device(constraints)) {
        ps_needs_add(needs, "OpenCL devices", "no engine that may be chosen needs one", 0);
    } else {
        snprintf(what, sizeof what, "kernels of other engines than %s", plan->chosen->engine->name);
        ps_needs_add(needs, what, "only what is launched is built", 0);
    }
    needs->skips[needs->num_skips - 1].is_matter_of_course = true;
}

pspec_status ps_needs_plan(ps_needs *needs, ps_plan *plan, const ps_problem *problem,
                           const ps_device_limits *limits, const ps_plan_constraints *constraints,
                           const ps_needs_strict *strict, ps_error *error) {
    const size_t num_of_question = needs->num_of_question;
    ps_plan other;
    needs->num_skips = num_of_question;
    if (needs->no_skip) {
        PS_TRY(make_exact(plan, problem, limits, constraints, problem->tolerance, error));
    } else {
        PS_TRY(ps_plan_make(plan, problem, limits, constraints, error));
    }
    if (plan->chosen == NULL) {
        return PSPEC_OK;
    }
    if (!needs->no_skip) {
        const ps_candidate *exact = ps_plan_cheapest(plan, PS_DOUBLE);
        if (strict->tolerance != problem->tolerance) { /* planning takes milliseconds */
            PS_TRY(make_exact(&other, problem, limits, constraints, strict->tolerance, error));
            exact = other.chosen;
        }
        skip_precision(needs, plan->chosen, problem->tolerance, exact, strict);
        skip_squares(needs, problem, plan, limits);
    }
    add_matters_of_course(needs, plan, constraints);
    needs->num_of_question = num_of_question;
    return PSPEC_OK;
}
