/* Plans as a table: header lines and candidates of one question after the other. */
#ifndef PS_CLI_PLAN_TABLE_H
#define PS_CLI_PLAN_TABLE_H

#include "tables/table.h"
#include "device/device.h"
#include "plan/phases.h"
#include "questions/results.h"

typedef struct ps_planner {
    ps_table *table;
    const char *job; /* what the rows begin with, where the table has that column; NULL otherwise */
    ps_device
        *device; /* borrowed; NULL: the one that a request names is opened where it is needed */
    const ps_figures *host; /* what was measured of the host; NULL: nothing */
    ps_begun begun;
    double seconds; /* of all jobs so far */
    bool is_at_most;
} ps_planner;

/* has_jobs: rows begin with the job that they are of. */
pspec_status ps_plan_table_create(ps_table **out, bool has_jobs, ps_error *error) PS_MUST_CHECK;

/* What is asked, what is skipped and why, and what takes how long, as header lines; every engine as a row. The seconds of a
 * row are those of the whole job with that engine. */
pspec_status ps_plan_table_add(ps_planner *to, const ps_result_kind *kind,
                               const ps_request *request, ps_error *error) PS_MUST_CHECK;
/* Of a question that the cache of results answers. */
pspec_status ps_plan_table_add_cached(ps_planner *to, ps_error *error) PS_MUST_CHECK;

/* Of points that are made or rewritten: there is nothing to choose. */
pspec_status ps_plan_table_add_sample(ps_planner *to, const ps_request *request,
                                      ps_error *error) PS_MUST_CHECK;
pspec_status ps_plan_table_add_convert(ps_planner *to, const ps_request *request,
                                       ps_error *error) PS_MUST_CHECK;
/* Phases as header lines (of several jobs as rows, too), and their sum. */
pspec_status ps_plan_table_add_phases(ps_planner *to, const ps_phases *phases,
                                      ps_error *error) PS_MUST_CHECK;
/* The last header line: seconds of all jobs. */
pspec_status ps_plan_table_end(const ps_planner *to, ps_error *error) PS_MUST_CHECK;

/* One block for every question of the scene request->files[0]: `plan run`. */
pspec_status ps_plan_scene(ps_planner *to, const ps_request *arguments,
                           ps_error *error) PS_MUST_CHECK;

#endif
