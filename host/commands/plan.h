/* Plans of commands. */
#ifndef PS_COMMANDS_PLAN_H
#define PS_COMMANDS_PLAN_H

#include "answers/kind.h"

/* All that can be planned: kinds of answers, points of samplers, point files, scenes; ended by
 * NULL. */
extern const ps_command *const ps_plannable[];

/* Those of the library whose tables have declared fields. */
extern const ps_command *const ps_with_fields[];

/* What the command would do with the request, as a table: every engine with its seconds, bytes and
 * error, which is chosen and why, what is skipped, how long each phase takes. Nothing is computed
 * or timed. */
pspec_status ps_plan_command(ps_table **out, const ps_command *command, const ps_request *request,
                             const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;

#endif
