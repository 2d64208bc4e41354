/* A job that takes realizations one after the other and needs no runner (runner.h), for it has no
 * estimator: between two of them it is whole, where checkpoints are written and read. */
#ifndef PS_JOBS_SET_LOOP_H
#define PS_JOBS_SET_LOOP_H

#include "device/device.h"
#include "jobs/source.h"
#include "store/checkpoint.h"

typedef struct ps_set_loop {
    void *job;
    /* Takes the next realizations, which are numbered from num_done on, all of them or, after an
     * error, none; *num 0 behind the last. */
    pspec_status (*give)(void *job, uint64_t num_done, size_t *num, ps_error *error);
    /* Leaves so many realizations out, which the checkpoint has; NULL: none needs to be. */
    pspec_status (*skip)(void *job, uint64_t num, ps_error *error);
    ps_snapshot_walk *walk;         /* through what realizations have changed of the job */
    const ps_checkpoint_spec *spec; /* NULL: no checkpoints */
    ps_device *device;              /* that bits depend on; NULL: the host alone */
    /* known afterwards */
    uint64_t num_done;
    /* while it runs */
    ps_checkpoint *checkpoint; /* NULL: none */
    bool is_complete;
} ps_set_loop;

pspec_status ps_set_loop_run(ps_set_loop *loop, ps_error *error) PS_MUST_CHECK;

/* For skip: sets of samplers are not made, others are read. */
pspec_status ps_source_pass(ps_source *source, uint64_t num, const ps_watch *watch,
                            ps_error *error) PS_MUST_CHECK;

#endif
