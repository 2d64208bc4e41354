/* Checkpoints of the runner: what a job is, and what there is of it between two batches. */
#include "device/kind.h"
#include "jobs/runner.h"

/* ---- the file -------------------------------------------------------------------------------- */

/* What bits depend on, beside the question: the kind of device, engine and precision of the first
 * plan. Those of another follow from what was measured. */
static pspec_status write_key(ps_text *out, const ps_runner *runner, ps_error *error) {
    const ps_candidate *const chosen = runner->plan->chosen;
    const bool needs_device = chosen->engine->needs_device && runner->device != NULL;
    ps_device_identify(out, needs_device ? ps_device_get_limits(runner->device) : NULL);
    ps_text_append(out, "engine %s in %s precision\n", chosen->engine->name,
                   ps_precision_name(chosen->precision));
    return ps_text_check(out, error);
}

pspec_status ps_runner_open_checkpoint(ps_runner *runner, ps_error *error) {
    ps_text key = {0};
    if (runner->spec == NULL || runner->spec->path == NULL) {
        return PSPEC_OK;
    }
    PS_TRY(ps_plan_require(runner->plan, runner->problem, error));
    pspec_status status = write_key(&key, runner, error);
    if (status == PSPEC_OK) {
        status = ps_checkpoint_open(&runner->checkpoint, runner->spec, ps_text_string(&key), error);
    }
    ps_text_free(&key);
    return status;
}

/* ---- state ----------------------------------------------------------------------------------- */

static pspec_status walk_plan(ps_runner *runner, ps_snapshot *snapshot, ps_error *error) {
    ps_problem *const problem = runner->problem;
    uint64_t counts[] = {runner->num_done, runner->is_complete, runner->num_replans,
                         problem->num_points, problem->planned_points};
    enum { DONE, COMPLETE, REPLANS, POINTS, PLANNED, NUM_COUNTS };
    double *const numbers[] = {&problem->expected_power, &problem->weight_share};
    PS_TRY(ps_snapshot_counts(snapshot, "runner", counts, NUM_COUNTS, error));
    PS_TRY(ps_snapshot_gather(snapshot, "measured", numbers, 2, error));
    runner->num_done = counts[DONE];
    runner->is_complete = counts[COMPLETE] != 0;
    runner->num_replans = (unsigned)counts[REPLANS];
    problem->num_points = counts[POINTS];
    problem->planned_points = counts[PLANNED];
    return PSPEC_OK;
}

static pspec_status walk(void *payload, ps_snapshot *snapshot, ps_error *error) {
    ps_runner *const runner = payload;
    PS_TRY(walk_plan(runner, snapshot, error));
    PS_TRY(ps_estimator_walk(runner->estimator, snapshot, error));
    return runner->kind->walk != NULL ? runner->kind->walk(runner->job, snapshot, error) : PSPEC_OK;
}

pspec_status ps_runner_read_plan(ps_runner *runner, bool *is_found, ps_error *error) {
    ps_snapshot *const found =
        runner->checkpoint != NULL ? ps_checkpoint_found(runner->checkpoint) : NULL;
    *is_found = found != NULL;
    if (found == NULL) {
        return PSPEC_OK;
    }
    PS_TRY(walk_plan(runner, found, error));
    if (runner->num_replans < runner->replan.num) {
        runner->num_done = 0;
        runner->is_complete = false;
        *is_found = false;
        ps_checkpoint_forget(runner->checkpoint);
        return PSPEC_OK;
    }
    return runner->num_replans > 0 ? runner->kind->plan(runner->job, error) : PSPEC_OK;
}

pspec_status ps_runner_read_state(ps_runner *runner, ps_error *error) {
    PS_TRY(walk(runner, ps_checkpoint_found(runner->checkpoint), error));
    ps_checkpoint_forget(runner->checkpoint);
    return runner->kind->skip(runner->job, runner->num_done, error);
}

/* ---- writing --------------------------------------------------------------------------------- */

pspec_status ps_runner_save(ps_runner *runner, ps_error *error) {
    return ps_checkpoint_keep(runner->checkpoint, runner->is_complete, walk, runner, error);
}

pspec_status ps_runner_save_cancelled(ps_runner *runner, pspec_status status, ps_error *error) {
    const bool is_whole = runner->kind->count(runner->job, &runner->num_done);
    return ps_checkpoint_keep_cancelled(runner->checkpoint, status, runner->num_done,
                                        is_whole ? walk : NULL, runner, error);
}
