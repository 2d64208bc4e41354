/* A job that adds up rows of realizations (row_stream.h) and needs no runner (runner.h), for it has
 * no estimator: between two of them it is whole, where checkpoints are written and read. */
#ifndef PS_JOBS_ROWS_SET_LOOP_H
#define PS_JOBS_ROWS_SET_LOOP_H

#include "jobs/rows/row_stream.h"
#include "jobs/source.h"
#include "store/checkpoint.h"

typedef struct ps_set_loop {
    /* Where rows come from, all that a job sets there but team and device; the job and the device
     * are those of the loop, too */
    ps_row_stream stream;
    /* Adds the row of realization `number`, in their order. */
    void (*take)(void *job, uint64_t number, const void *row);
    ps_snapshot_walk *walk;         /* through what realizations have changed of the job */
    const ps_checkpoint_spec *spec; /* NULL: no checkpoints, and no team */
    /* known afterwards */
    uint64_t num_done;
    /* while it runs */
    ps_checkpoint *checkpoint; /* NULL: none */
    bool is_complete;
} ps_set_loop;

pspec_status ps_set_loop_run(ps_set_loop *loop, ps_error *error) PS_MUST_CHECK;

/* For `pass` of the stream: sets of samplers are not made, others are read. */
pspec_status ps_source_pass(ps_source *source, uint64_t num, const ps_watch *watch,
                            uint64_t *passed, ps_error *error) PS_MUST_CHECK;

#endif
