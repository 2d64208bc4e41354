/* What commands that print a kind of result do: one way for all of them. */
#ifndef PS_CLI_ANSWER_H
#define PS_CLI_ANSWER_H

#include "results/kind.h"

/* Computes, then writes other files that were asked for, the table, and the picture. Whatever can be refused is refused
 * before hours of work, not after. Progress, plan and profile go to standard error. */
pspec_status ps_answer_print(const ps_result_kind *kind, const ps_request *arguments,
                             ps_error *error) PS_MUST_CHECK;

#endif
