/* The table of verbs. */
#include "commands/points.h"
#include "commands/verb.h"
#include "scene/run/run.h"

#include <string.h>

/* ---- those that are no kinds of answers ------------------------------------------------------ */

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

const ps_verb ps_verb_run = {.name = "run", .bit = PS_VERB_BIT(run), .plan = plan_run};

const ps_verb ps_verb_sample = {.name = "sample",
                                .bit = PS_VERB_BIT(sample),
                                .formats = PS_POINT_FORMATS,
                                .makes_points = true,
                                .plan = plan_sample};

const ps_verb ps_verb_convert = {.name = "convert",
                                 .bit = PS_VERB_BIT(convert),
                                 .formats = PS_POINT_FORMATS,
                                 .weights = "equal|column",
                                 .makes_points = true,
                                 .plan = plan_convert};

/* ---- all ------------------------------------------------------------------------------------- */

#define NOTHING(word)
#define DEFINE(word)                                                                               \
    static const ps_verb verb_##word = {                                                           \
        .name = #word, .bit = PS_VERB_BIT(word), .kind = &ps_kind_##word};
PS_VERBS(DEFINE, NOTHING)

#define ADDRESS(word) &verb_##word,
const ps_verb *const ps_verbs[] = {&ps_verb_run, &ps_verb_sample, &ps_verb_convert,
                                   PS_VERBS(ADDRESS, NOTHING) NULL};

const ps_verb *ps_verb_find(const char *name) {
    size_t i = 0;
    while (ps_verbs[i] != NULL && strcmp(ps_verbs[i]->name, name) != 0) {
        i++;
    }
    return ps_verbs[i];
}

const char *ps_verb_words(const ps_verb *verb, ps_option_id id) {
    if (verb->kind != NULL) {
        return ps_kind_words(verb->kind, id);
    }
    const char *const own = id == PS_OPTION_FORMAT    ? verb->formats
                            : id == PS_OPTION_WEIGHTS ? verb->weights
                                                      : NULL;
    return own != NULL ? own : ps_options[id].metavar;
}
