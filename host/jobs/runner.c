#include "jobs/runner.h"

#include <math.h>

void ps_runner_free(ps_runner *runner) {
    ps_estimator_destroy(runner->estimator);
    runner->estimator = NULL;
}

uint64_t ps_runner_held(const ps_runner *runner) {
    return runner->estimator != NULL ? (uint64_t)runner->plan->chosen->host_bytes : 0;
}

static pspec_status begin(ps_runner *runner, ps_error *error) {
    runner->num_done = 0;
    return runner->kind->begin(runner->job, error);
}

/* Makes the estimator of the plan instead of the one before; fails where nothing is feasible. */
static pspec_status start(ps_runner *runner, ps_error *error) {
    PS_TRY(ps_plan_require(runner->plan, runner->problem, error));
    const ps_candidate *const chosen = runner->plan->chosen;
    ps_estimator_options options = runner->kind->options(runner->job);
    options.problem = *runner->problem;
    options.engine = chosen->engine;
    options.precision = chosen->precision;
    options.batch = options.batch > 0 ? options.batch : chosen->batch;
    ps_runner_free(runner);
    PS_TRY(ps_estimator_create(&runner->estimator, &options, runner->device, error));
    return begin(runner, error);
}

/* All realizations, or as many as the standard error needs. Looks, and so what ends a job, do not
 * depend on batches. */
static pspec_status add_all(ps_runner *runner, ps_error *error) {
    const ps_runner_kind *const kind = runner->kind;
    const bool can_look = kind->look != NULL && runner->standard_error > 0;
    double largest = INFINITY;
    size_t num = 1;
    bool is_enough = false;
    while (num > 0 && !is_enough) {
        const uint64_t next =
            runner->is_sequential ? ps_sequential_next_look(runner->num_done) : UINT64_MAX;
        PS_TRY(kind->tell(runner->job, error));
        PS_TRY(kind->give(runner->job, next - runner->num_done, &num, error));
        runner->num_done += num;
        if (can_look && runner->num_done == next) {
            PS_TRY(kind->look(runner->job, &largest, error));
            is_enough = largest <= runner->standard_error;
        }
    }
    return can_look && !is_enough && runner->num_done > 1 ? kind->look(runner->job, &largest, error)
                                                          : PSPEC_OK;
}

/* Errors grow with the number of points, too, of which a set may have more than were announced. */
static void take_measured(ps_problem *problem, const ps_accuracy *accuracy) {
    problem->expected_power = accuracy->largest_mean_power;
    problem->weight_share = accuracy->largest_share;
    if (accuracy->largest_points > problem->num_points) {
        problem->num_points = accuracy->largest_points;
        problem->planned_points = accuracy->largest_points;
    }
}

/* The plan for the powers and numbers of points that were measured, if there is one; else all is as
 * it was. */
static pspec_status plan_again(ps_runner *runner, ps_error *error) {
    const ps_plan plan = *runner->plan; /* `chosen` is right again once it is copied back */
    const ps_problem problem = *runner->problem;
    take_measured(runner->problem, &runner->accuracy);
    pspec_status status = runner->kind->plan(runner->job, error);
    if (status == PSPEC_OK) {
        status = ps_plan_require(runner->plan, runner->problem, error);
    }
    if (status == PSPEC_OK) {
        status = runner->kind->rewind(runner->job, error);
    }
    if (status != PSPEC_OK) {
        *runner->plan = plan;
        *runner->problem = problem;
    }
    return status;
}

static pspec_status measure(ps_runner *runner, ps_error *error) {
    PS_TRY(ps_estimator_settle(runner->estimator, error));
    runner->accuracy = ps_estimator_accuracy(runner->estimator);
    return runner->has_no_accuracy || isfinite(runner->accuracy.error)
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_CHECK, "the powers are not finite numbers");
}

static bool is_settled(const ps_runner *runner) {
    return runner->has_no_accuracy || runner->accuracy.error <= runner->problem->tolerance;
}

static pspec_status settle(ps_runner *runner, ps_error *error) {
    enum {
        MOST_PLANS = 2
    }; /* the second has powers and points; one more, should another engine measure larger ones */
    PS_TRY(measure(runner, error));
    if (runner->is_part) {
        return PSPEC_OK;
    }
    for (int i = 0; i < MOST_PLANS && !is_settled(runner); i++) {
        PS_TRY(plan_again(runner, error));
        runner->was_replanned = true;
        PS_TRY(start(runner, error));
        PS_TRY(add_all(runner, error));
        PS_TRY(measure(runner, error));
    }
    return is_settled(runner)
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_TOLERANCE,
                         "no plan meets the tolerance %g with the powers that were measured",
                         runner->problem->tolerance);
}

pspec_status ps_runner_run(ps_runner *runner, ps_error *error) {
    if (runner->estimator != NULL) {
        ps_estimator_reset(runner->estimator);
        PS_TRY(begin(runner, error));
    } else {
        PS_TRY(start(runner, error));
    }
    PS_TRY(add_all(runner, error));
    return settle(runner, error);
}
