/* Plans as a table: header lines and candidates of one question after the other. */
#ifndef PS_CLI_PLAN_TABLE_H
#define PS_CLI_PLAN_TABLE_H

#include "io/table.h"
#include "device/device.h"
#include "scene/results.h"

typedef struct ps_planner {
    ps_table *table;
    const char *job; /* what the rows begin with, where the table has that column; NULL otherwise */
    ps_device
        *device; /* borrowed; NULL: the one that a request names is opened where it is needed */
} ps_planner;

/* has_jobs: rows begin with the job that they are of. */
pspec_status ps_plan_table_create(ps_table **out, bool has_jobs, ps_error *error) PS_MUST_CHECK;

/* What is asked, what is skipped and why, as header lines; every engine as a row. */
pspec_status ps_plan_table_add(const ps_planner *to, const ps_result_kind *kind,
                               const ps_request *request, ps_error *error) PS_MUST_CHECK;
/* Of a question that the cache of results answers. */
pspec_status ps_plan_table_add_cached(const ps_planner *to, ps_error *error) PS_MUST_CHECK;

/* One block for every question of the scene request->files[0]: `plan run`. */
pspec_status ps_plan_scene(ps_table *table, const ps_request *arguments,
                           ps_error *error) PS_MUST_CHECK;

#endif
