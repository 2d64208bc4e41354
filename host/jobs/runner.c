#include "jobs/runner.h"

#include "spectra/row_tape.h"

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
    runner->is_complete = false;
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

static bool can_look(const ps_runner *runner) {
    return runner->kind->look != NULL && runner->standard_error > 0;
}

/* The next realizations, up to the next look. */
static pspec_status add_some(ps_runner *runner, double *largest, ps_error *error) {
    const ps_runner_kind *const kind = runner->kind;
    const uint64_t next =
        runner->is_sequential ? ps_sequential_next_look(runner->num_done) : UINT64_MAX;
    size_t num = 0;
    pspec_status status = kind->tell(runner->job, error);
    if (status == PSPEC_OK) {
        status = kind->give(runner->job, next - runner->num_done, &num, error);
    }
    if (status != PSPEC_OK) {
        return ps_runner_save_cancelled(runner, status, error);
    }
    runner->num_done += num;
    if (can_look(runner) && runner->num_done == next) {
        PS_TRY(kind->look(runner->job, largest, error));
    }
    runner->is_complete = num == 0 || *largest <= runner->standard_error;
    return ps_runner_save(runner, error);
}

/* All realizations, or as many as the standard error needs. Looks, and so what ends a job, do not
 * depend on batches. */
static pspec_status add_all(ps_runner *runner, ps_error *error) {
    double largest = INFINITY;
    while (!runner->is_complete) {
        PS_TRY(add_some(runner, &largest, error));
    }
    return can_look(runner) && largest > runner->standard_error && runner->num_done > 1
               ? runner->kind->look(runner->job, &largest, error)
               : PSPEC_OK;
}

/* The plan for the powers and numbers of points that were measured. Errors grow with the number of
 * points, too, of which a set may have more than were announced. */
static pspec_status make_plan(ps_runner *runner, const ps_replan *measured, ps_error *error) {
    ps_problem *const problem = runner->problem;
    problem->expected_power = measured->mean_power;
    problem->weight_share = measured->weight_share;
    if (measured->num_points > problem->num_points) {
        problem->num_points = measured->num_points;
        problem->planned_points = measured->num_points;
    }
    PS_TRY(runner->kind->plan(runner->job, error));
    return ps_plan_require(runner->plan, problem, error);
}

/* If there is none, all is as it was. */
static pspec_status plan_again(ps_runner *runner, ps_error *error) {
    const ps_accuracy *const accuracy = &runner->accuracy;
    const ps_replan measured = {runner->num_replans + 1, accuracy->largest_mean_power,
                                accuracy->largest_share, accuracy->largest_points};
    const ps_plan plan = *runner->plan; /* `chosen` is right again once it is copied back */
    const ps_problem problem = *runner->problem;
    pspec_status status = make_plan(runner, &measured, error);
    if (status == PSPEC_OK) {
        status = runner->kind->rewind(runner->job, error);
    }
    if (status != PSPEC_OK) {
        *runner->plan = plan;
        *runner->problem = problem;
    }
    return status;
}

/* The largest set may be one of others, whose engine had room for it. */
static pspec_status measure(ps_runner *runner, ps_error *error) {
    PS_TRY(ps_estimator_settle(runner->estimator, error));
    PS_TRY(ps_estimator_expect(runner->estimator,
                               ps_estimator_accuracy(runner->estimator).largest_points, error));
    runner->accuracy = ps_estimator_accuracy(runner->estimator);
    return runner->has_no_accuracy || isfinite(runner->accuracy.error)
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_CHECK, "the powers are not finite numbers");
}

static bool is_settled(const ps_runner *runner) {
    return runner->has_no_accuracy || runner->accuracy.error <= runner->problem->tolerance;
}

static pspec_status settle(ps_runner *runner, ps_error *error) {
    const ps_row_tape *const tape = runner->spec != NULL ? runner->spec->tape : NULL;
    PS_TRY(measure(runner, error));
    if (runner->is_part || (tape != NULL && tape->is_part)) {
        return PSPEC_OK;
    }
    if (tape != NULL && !is_settled(runner)) { /* its rows are those of the first plan */
        return ps_range_refuse_powers(runner->accuracy.error, runner->problem->tolerance, error);
    }
    while (runner->num_replans < PS_MOST_REPLANS && !is_settled(runner)) {
        PS_TRY(plan_again(runner, error));
        runner->num_replans++;
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

/* The first realization comes next, or that behind those of a checkpoint. */
static pspec_status get_ready(ps_runner *runner, ps_error *error) {
    bool is_found = false;
    PS_TRY(ps_runner_read_plan(runner, &is_found, error));
    if (!is_found && runner->replan.num > 0) {
        runner->num_replans = (unsigned)runner->replan.num;
        PS_TRY(make_plan(runner, &runner->replan, error));
    }
    if (runner->estimator == NULL || is_found) {
        PS_TRY(start(runner, error));
        return is_found ? ps_runner_read_state(runner, error) : PSPEC_OK;
    }
    ps_estimator_reset(runner->estimator);
    return begin(runner, error);
}

static pspec_status run(ps_runner *runner, ps_error *error) {
    PS_TRY(ps_runner_open_checkpoint(runner, error));
    PS_TRY(get_ready(runner, error));
    PS_TRY(add_all(runner, error));
    return settle(runner, error);
}

pspec_status ps_runner_run(ps_runner *runner, ps_error *error) {
    const pspec_status status = run(runner, error);
    ps_checkpoint_close(runner->checkpoint);
    runner->checkpoint = NULL;
    return status;
}
