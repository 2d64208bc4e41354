/* A command of several ranks (ranks/ranks.h): each has some of the parts of the job
 * (parts/parts.h), and rank 0 merges their answers and writes what one process would have written,
 * to the bit. A command with `look_at_shares` in its row is that of a team, of all ranks. All else
 * is done by rank 0 alone, and the others wait. Ranks NULL are one process, which has parts where
 * it goes on with a job that several have begun. */
#ifndef PS_ANSWERS_RANKS_RANKS_WORK_H
#define PS_ANSWERS_RANKS_RANKS_WORK_H

#include "answers/parts/parts.h"
#include "ranks/ranks.h"

typedef struct ps_ranks_plan {
    /* What rank 0 has found, and all ranks know. */
    struct {
        uint64_t num_realizations, num_parts;
        bool is_shared;
        bool has_shares; /* not of realizations: the row's `run` knows of what */
    } job;
    /* What this rank has found meanwhile: what it should have in common with the others, or why it
     * cannot do its share, which is nobody's concern where rank 0 fails first, or works alone */
    ps_text alike;
    ps_error failure;
} ps_ranks_plan;

/* Refuses ranks of other programs and command lines, and what a command refuses early; hooks are
 * those of this rank, and hear on rank 0 of ranks that have nothing to do. *out is freed by
 * ps_ranks_plan_free, also after an error. */
pspec_status ps_ranks_plan_work(ps_ranks_plan *out, ps_ranks *ranks, const ps_command *command,
                                const ps_request *request, const ps_answer_hooks *hooks,
                                ps_error *error) PS_MUST_CHECK;
void ps_ranks_plan_free(ps_ranks_plan *plan);

/* ps_answer_produce of a plan that is shared; on ranks but 0 *out has no table, and nothing is
 * written. Ranks of other devices, or whose plans are others, are refused. */
pspec_status ps_ranks_produce(ps_answer *out, ps_ranks *ranks, const ps_ranks_plan *plan,
                              const ps_kind *kind, const ps_request *request,
                              const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;

/* ---- a command of a team (ranks_shares.c) ---------------------------------------------------- */

typedef struct ps_ranks_share {
    ps_team team;
    ps_ranks *ranks;
    ps_watch watch; /* that of who asked */
    bool has_failed;
} ps_ranks_share;

/* Gives hooks the team of the ranks, and a watch that stops where another has failed; *self
 * outlives them. */
void ps_ranks_begin_share(ps_ranks_share *self, ps_ranks *ranks, ps_answer_hooks *hooks);
/* The round that ends the command, of which this rank has that status, unless one has failed
 * before. */
pspec_status ps_ranks_end_share(ps_ranks_share *self, pspec_status status,
                                ps_error *error) PS_MUST_CHECK;

/* ---- tables as bytes (ranks_tables.c) -------------------------------------------------------- */

/* Adds a table to the bytes, which the caller frees, also after an error. */
pspec_status ps_ranks_pack(ps_rank_bytes *out, const ps_table *table,
                           ps_error *error) PS_MUST_CHECK;
/* The next table of the bytes, behind *at, with its name in sentences; freed by the caller. */
pspec_status ps_ranks_unpack(ps_table **out, const ps_rank_bytes *bytes, size_t *at,
                             const char *name, ps_error *error) PS_MUST_CHECK;

/* ---- ranks that should be alike (ranks_alike.c) ---------------------------------------------- */

/* Lines "thing: value" of this rank, as a text that is compared with that of rank 0: the first line
 * that differs is PSPEC_ERROR_INPUT, which names thing, rank and both values. The verdict of the
 * round has num bytes of rank 0. status: how far this rank came. A rank without
 * lines is like all others. */
pspec_status ps_ranks_compare(ps_ranks *ranks, const ps_text *lines, pspec_status status,
                              void *bytes, size_t num, ps_error *error) PS_MUST_CHECK;

#endif
