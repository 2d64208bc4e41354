/* The table of tasks. */
#include "commands/points.h"
#include "commands/task.h"
#include "scene/run/run.h"

#include <string.h>

/* ---- those that are no kinds of results ------------------------------------------------------ */

static pspec_status plan_run(ps_planner *planner, const ps_request *request,
                             const ps_answer_hooks *hooks, ps_error *error) {
    return ps_run_plan(planner, request, hooks, error);
}

static pspec_status plan_sample(ps_planner *planner, const ps_request *request,
                                const ps_answer_hooks *hooks, ps_error *error) {
    (void)hooks;
    return ps_points_plan_sample(planner, request, error);
}

static pspec_status plan_convert(ps_planner *planner, const ps_request *request,
                                 const ps_answer_hooks *hooks, ps_error *error) {
    (void)hooks;
    return ps_points_plan_convert(planner, request, error);
}

const ps_task ps_task_run = {.name = "run", .taker = PS_TAKER_BIT(run), .plan = plan_run};

const ps_task ps_task_sample = {.name = "sample",
                                .taker = PS_TAKER_BIT(sample),
                                .formats = PS_POINT_FORMATS,
                                .makes_points = true,
                                .plan = plan_sample};

const ps_task ps_task_convert = {.name = "convert",
                                 .taker = PS_TAKER_BIT(convert),
                                 .formats = PS_POINT_FORMATS,
                                 .weights = "equal|column",
                                 .makes_points = true,
                                 .plan = plan_convert};

/* ---- all ------------------------------------------------------------------------------------- */

#define NOTHING(word)
#define DEFINE(word)                                                                               \
    static const ps_task task_##word = {                                                           \
        .name = #word, .taker = PS_TAKER_BIT(word), .kind = &ps_result_##word};
PS_TAKERS(DEFINE, NOTHING)

#define ADDRESS(word) &task_##word,
const ps_task *const ps_tasks[] = {&ps_task_run, &ps_task_sample, &ps_task_convert,
                                   PS_TAKERS(ADDRESS, NOTHING) NULL};

const ps_task *ps_task_find(const char *name) {
    size_t i = 0;
    while (ps_tasks[i] != NULL && strcmp(ps_tasks[i]->name, name) != 0) {
        i++;
    }
    return ps_tasks[i];
}

const char *ps_task_words(const ps_task *task, ps_option_id id) {
    if (task->kind != NULL) {
        return ps_result_words(task->kind, id);
    }
    const char *const own = id == PS_OPTION_FORMAT    ? task->formats
                            : id == PS_OPTION_WEIGHTS ? task->weights
                                                      : NULL;
    return own != NULL ? own : ps_options[id].metavar;
}
