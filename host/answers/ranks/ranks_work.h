/* A command of several ranks (ranks/ranks.h): each has a range of the realizations of the job, as
 * --range would have it, and rank 0 merges their answers and writes what one process would have
 * written, to the bit. What has no ranges is done by rank 0 alone, and the others wait. */
#ifndef PS_ANSWERS_RANKS_RANKS_WORK_H
#define PS_ANSWERS_RANKS_RANKS_WORK_H

#include "answers/kind.h"
#include "ranks/ranks.h"

/* What rank 0 has found, and all ranks know. */
typedef struct ps_ranks_plan {
    uint64_t num_realizations;
    bool is_shared;
} ps_ranks_plan;

/* Refuses ranks of other programs and command lines, and what a command refuses early; hooks are
 * those of this rank, and hear on rank 0 of ranks that have nothing to do. */
pspec_status ps_ranks_plan_work(ps_ranks_plan *out, ps_ranks *ranks, const ps_command *command,
                                const ps_request *request, const ps_answer_hooks *hooks,
                                ps_error *error) PS_MUST_CHECK;

/* ps_answer_produce of a plan that is shared; on ranks but 0 *out has no table, and nothing is
 * written. Ranks of other devices, or whose plans are others, are refused. */
pspec_status ps_ranks_produce(ps_answer *out, ps_ranks *ranks, const ps_ranks_plan *plan,
                              const ps_kind *kind, const ps_request *request,
                              const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;

/* ---- ranks that should be alike (ranks_alike.c) ---------------------------------------------- */

/* Lines "thing: value" of this rank, as a text that is compared with that of rank 0: the first line
 * that differs is PSPEC_ERROR_INPUT, which names thing, rank and both values. The verdict of the
 * round has num bytes of rank 0. status: how far this rank came. A rank without
 * lines is like all others. */
pspec_status ps_ranks_compare(ps_ranks *ranks, const ps_text *lines, pspec_status status,
                              void *bytes, size_t num, ps_error *error) PS_MUST_CHECK;

#endif
