/* Plans as a table: header lines and candidates of one question after the other. */
#ifndef PS_ANSWERS_PLAN_TABLE_H
#define PS_ANSWERS_PLAN_TABLE_H

#include "answers/lead.h"
#include "device/device.h"
#include "plan/choose.h"
#include "plan/needs.h"
#include "plan/phases.h"
#include "request/request.h"
#include "fields/table.h"

typedef struct ps_planner {
    ps_table *table;
    ps_lead lead; /* what the rows begin with, the same columns in all of them */
    /* Borrowed; NULL: the one that a request names is opened where it is needed */
    ps_device *device;
    const struct ps_answer_hooks *hooks; /* borrowed: a scene hands them on */
    const ps_figures *host;              /* what was measured of the host; NULL: nothing */
    ps_begun begun;
    double seconds; /* of all jobs so far */
    bool is_at_most;
} ps_planner;

/* lead: its columns. */
pspec_status ps_plan_table_create(ps_table **out, const ps_lead *lead,
                                  ps_error *error) PS_MUST_CHECK;
/* That of a scene, whose questions are jobs: the name, borrowed. */
ps_lead ps_plan_table_lead(const char *job);
/* Rows are of number `index` of the questions of a request from here on, where it has several. The
 * question gets the planner's device. Without any device the host's engines are planned, and the
 * header says why there is none; a device that was named and is not there is an error, as for the
 * command itself. */
pspec_status ps_plan_table_begin_question(ps_planner *planner, const ps_request *request,
                                          size_t index, const ps_plan_constraints *constraints,
                                          ps_device **open_device, bool *lacks_device,
                                          ps_error *error) PS_MUST_CHECK;

/* A job with a choice of engines. */
typedef struct ps_planned {
    const ps_problem *problem;
    const ps_needs *needs;
    const ps_device_limits *limits; /* NULL: no device */
    const ps_plan *plan;
    const ps_phases *phases; /* of all of it */
    double repeats;          /* how often the chosen engine's seconds are in them */
    const ps_meta *notes;    /* more header lines, [num_notes] */
    size_t num_notes;
} ps_planned;

/* What is asked by number `index` of the questions of a request, what is skipped and why, and what
 * takes how long, as header lines; every engine as a row. The seconds of a row are those of the
 * whole job with that engine. */
pspec_status ps_plan_table_add_job(ps_planner *planner, const ps_request *request,
                                   const ps_planned *job, size_t index,
                                   ps_error *error) PS_MUST_CHECK;
/* What is done without a choice of engines, and why: phases that were begun here, as header lines
 * and one row. */
typedef struct ps_only_way {
    ps_device *device;  /* NULL: the host does it */
    const char *engine; /* what the device's is called */
    double bytes;       /* 0: they are not counted */
    const char *reason;
} ps_only_way;
pspec_status ps_plan_table_add_only(ps_planner *planner, const ps_phases *phases,
                                    const ps_only_way *way, ps_error *error) PS_MUST_CHECK;
/* As the host alone does it. */
pspec_status ps_plan_table_add_host(ps_planner *planner, const ps_phases *phases, double bytes,
                                    const char *reason, ps_error *error) PS_MUST_CHECK;
ps_phases ps_plan_table_begin_phases(ps_planner *planner);
/* A picture needs gnuplot, which takes its time whatever is in it. */
void ps_plan_table_add_picture(ps_phases *phases, const ps_request *request);

/* Says that the cache of results answers the question. */
pspec_status ps_plan_table_add_cached(ps_planner *planner, ps_error *error) PS_MUST_CHECK;

/* Phases as header lines (of several jobs as rows, too), and their sum. */
pspec_status ps_plan_table_add_phases(ps_planner *planner, const ps_phases *phases,
                                      ps_error *error) PS_MUST_CHECK;
/* The header line "seconds", where it was begun: the sum of all jobs. */
pspec_status ps_plan_table_end(const ps_planner *planner, ps_error *error) PS_MUST_CHECK;

#endif
