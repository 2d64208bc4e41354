/* What program and library can be asked to do by options, one table: the kinds of results, points
 * of samplers, point files, scenes. All of it can be planned.
 */
#ifndef PS_COMMANDS_TASK_H
#define PS_COMMANDS_TASK_H

#include "answers/kind.h"
#include "request/options.h"

typedef struct ps_task {
    const char *name;           /* of the command; NULL ends the table */
    ps_takers taker;            /* its bit in the table of options */
    const ps_result_kind *kind; /* NULL: it is none */
    const char *formats,
        *weights;      /* words of these options; NULL: those of the kind or the table */
    bool makes_points; /* output and format are of points, not of a table */
    /* Adds what it would come to; NULL: the kind says so, or it is not planned. */
    pspec_status (*plan)(ps_planner *planner, const ps_request *request,
                         const ps_answer_hooks *hooks, ps_error *error);
} ps_task;

extern const ps_task ps_task_run, ps_task_sample, ps_task_convert;

/* All of them; ended by NULL. */
extern const ps_task *const ps_tasks[];

/* Does the task take the option? */
static inline bool ps_task_takes(const ps_task *task, ps_option_id id) {
    return ((ps_options[id].questions | ps_options[id].commands) & task->taker) != 0;
}
/* The values that the task admits for the option, "one|two|FILE"; NULL for a flag. */
const char *ps_task_words(const ps_task *task, ps_option_id id);

/* The task of that name; NULL: there is none. */
const ps_task *ps_task_find(const char *name);

/* What the task would do with the request, as a table: every engine with its seconds, bytes and
 * error, which is chosen and why, what is skipped, how long each phase takes. Nothing is computed
 * or timed. */
pspec_status ps_task_plan(ps_table **out, const ps_task *task, const ps_request *request,
                          const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;

#endif
