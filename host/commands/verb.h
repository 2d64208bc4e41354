/* What program and library can be asked to do by options, one table: the kinds of answers, points
 * of samplers, point files, scenes. All of it can be planned.
 */
#ifndef PS_COMMANDS_VERB_H
#define PS_COMMANDS_VERB_H

#include "answers/kind.h"
#include "request/options.h"

typedef struct ps_verb {
    const char *name;    /* of the command; NULL ends the table */
    ps_verb_set bit;     /* its bit in the table of options */
    const ps_kind *kind; /* NULL: it is none */
    const char *formats,
        *weights;      /* words of these options; NULL: those of the kind or the table */
    bool makes_points; /* output and format are of points, not of a table */
    /* Adds what it would come to; NULL: the kind says so, or it is not planned. */
    pspec_status (*plan)(ps_planner *planner, const ps_request *request,
                         const ps_answer_hooks *hooks, ps_error *error);
} ps_verb;

extern const ps_verb ps_verb_run, ps_verb_sample, ps_verb_convert;

/* All of them; ended by NULL. */
extern const ps_verb *const ps_verbs[];

/* Does the verb take the option? */
static inline bool ps_verb_takes(const ps_verb *verb, ps_option_id id) {
    return ((ps_options[id].questions | ps_options[id].commands) & verb->bit) != 0;
}
/* The values that the verb admits for the option, "one|two|FILE"; NULL for a flag. */
const char *ps_verb_words(const ps_verb *verb, ps_option_id id);

/* The verb of that name; NULL: there is none. */
const ps_verb *ps_verb_find(const char *name);

/* What the verb would do with the request, as a table: every engine with its seconds, bytes and
 * error, which is chosen and why, what is skipped, how long each phase takes. Nothing is computed
 * or timed. */
pspec_status ps_verb_plan(ps_table **out, const ps_verb *verb, const ps_request *request,
                          const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;

#endif
