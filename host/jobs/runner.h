/* The one way through a job, of the program and of the library: plan -> estimator, which checks
 * itself -> realizations, with looks at the standard error between them -> another plan when the
 * powers that were measured, or sets, are too large for this one -> the same realizations again.
 *
 * Kinds of jobs differ in what they give the estimator and in what they keep of it: ps_runner_kind.
 * What concerns every job belongs here, and has its place: a checkpoint is written between two
 * calls of `give`, where also `tell` is called, and read by a job that begins
 * (runner_checkpoint.c); a range of realizations is a part, which is planned as the whole job, and
 * does not plan again: who has all parts tells them what their next plan is for (`replan`).
 */
#ifndef PS_JOBS_RUNNER_H
#define PS_JOBS_RUNNER_H

#include "jobs/estimator.h"
#include "plan/replan.h"
#include "spectra/sequential.h"

typedef struct ps_runner_kind {
    /* Makes the plan for the problem, also once more when powers were measured. That nothing is
     * feasible is no error. */
    pspec_status (*plan)(void *job, ps_error *error);
    /* All but problem, engine and precision, which are the plan's; the batch, too, where it is 0.
     */
    ps_estimator_options (*options)(void *job);
    /* An estimator was made, and realizations begin with the first. */
    pspec_status (*begin)(void *job, ps_error *error);
    /* Tells how far the job is; a failure ends it. */
    pspec_status (*tell)(void *job, ps_error *error);
    /* Gives the estimator the next realizations, `most` at most; *num were given, 0 behind the
     * last. */
    pspec_status (*give)(void *job, uint64_t most, size_t *num, ps_error *error);
    /* Looks at the standard errors, returns the largest (ps_sequential_look.corrected); NULL: there
     * is none to look at. */
    pspec_status (*look)(void *job, double *largest, ps_error *error);
    /* Back to the first realization, or PSPEC_ERROR_TOLERANCE when they cannot be had again. */
    pspec_status (*rewind)(void *job, ps_error *error);
    /* Of jobs that have checkpoints: leaves so many realizations out, which the estimator has, and
     * takes what the job has of its own to a checkpoint or from one; NULL: it has nothing */
    pspec_status (*skip)(void *job, uint64_t num, ps_error *error);
    ps_snapshot_walk *walk;
    /* How many were added, after a call of `give` that was cancelled; false: one of them in part */
    bool (*count)(void *job, uint64_t *num);
} ps_runner_kind;

typedef struct ps_runner {
    /* set by the job */
    const ps_runner_kind *kind;
    void *job;
    ps_problem *problem;   /* the job's, in which measured powers are left */
    ps_plan *plan;         /* the job's, filled by kind->plan */
    ps_device *device;     /* NULL: none is needed */
    double standard_error; /* at which realizations stop; 0: nobody asked */
    bool is_sequential;    /* they do stop there */
    /* These are some of the realizations of a job, whose powers decide together whether another
     * plan is needed: whoever merges them looks at the errors, and says which plan this is. So it
     * is of rows that a tape keeps (spectra/row_tape.h); those that it plays have no second plan */
    bool is_part;
    ps_replan replan;
    /* Amplitudes alone are asked of the estimator, whose errors no power changes */
    bool has_no_accuracy;
    const ps_checkpoint_spec *spec; /* NULL: no checkpoints */
    /* known afterwards */
    ps_estimator *estimator; /* owned, freed by ps_runner_free */
    uint64_t num_done;       /* realizations */
    ps_accuracy accuracy;
    unsigned num_replans;
    /* while it runs */
    ps_checkpoint *checkpoint; /* NULL: none */
    bool is_complete;          /* all realizations were added */
} ps_runner;

void ps_runner_free(ps_runner *runner);

/* Adds all realizations, or as many as the standard error takes, to the estimator of the plan, and
 * makes sure that the averages are within the tolerance: where powers are too large, by another
 * plan and all realizations again. An estimator of the plan that is there already is reset. Where
 * no plan reaches it, or realizations cannot be had again, PSPEC_ERROR_TOLERANCE comes with
 * estimator, plan and problem as they were. */
pspec_status ps_runner_run(ps_runner *runner, ps_error *error) PS_MUST_CHECK;

/* ---- the parts of it that are in runner_checkpoint.c ----------------------------------------- */

/* Opens the checkpoint, where one was asked for, for the job of the plan. */
pspec_status ps_runner_open_checkpoint(ps_runner *runner, ps_error *error) PS_MUST_CHECK;
/* What is there before an estimator is: the plan that the job follows. *is_found: there is a
 * checkpoint of it, and not of a plan before that of a part. */
pspec_status ps_runner_read_plan(ps_runner *runner, bool *is_found, ps_error *error) PS_MUST_CHECK;
/* The rest, into the new estimator of that plan. */
pspec_status ps_runner_read_state(ps_runner *runner, ps_error *error) PS_MUST_CHECK;
/* Writes one where it is time, or there is one already and all realizations were added. */
pspec_status ps_runner_save(ps_runner *runner, ps_error *error) PS_MUST_CHECK;
/* Where the work was cancelled: writes one, whatever the time, and says so. Returns status. */
pspec_status ps_runner_save_cancelled(ps_runner *runner, pspec_status status, ps_error *error);

/* Bytes of the machine's memory that the estimator has, which another plan need not count as taken.
 */
uint64_t ps_runner_held(const ps_runner *runner);

#endif
