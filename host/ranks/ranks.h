/* The processes of one job that mpirun has started: ranks, of which number 0 leads.
 *
 * They speak in rounds. In a round every rank hands in how far it came, with bytes, to rank 0
 * (ps_ranks_gather), and rank 0 gives the verdict, with bytes, to every rank (ps_ranks_conclude).
 * The first failure is the verdict: the other ranks hear of it at once, where they work and ask by
 * ps_ranks_must_stop, so that nobody computes for a job that has failed. All of MPI is in a module
 * that is loaded where the environment says that there are several ranks (module/mpi.c): without
 * mpirun a machine needs none of it.
 */
#ifndef PS_RANKS_RANKS_H
#define PS_RANKS_RANKS_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct ps_ranks ps_ranks;

/* What a rank has handed in. */
typedef struct ps_rank_bytes {
    void *data;
    size_t num;
} ps_rank_bytes;

/* The number of this process among those of mpirun, by the environment alone; 0 of a process that
 * nobody else was started with. */
size_t ps_ranks_find_own(void);

/* The same among those of its machine, of which there are *num; 0: nobody knows. */
size_t ps_ranks_find_local(size_t *num);

/* *out is NULL where the process is alone. folders: where the module may be, ended by NULL. Several
 * ranks without the module are PSPEC_ERROR_IO: each would do the whole job. */
pspec_status ps_ranks_open(ps_ranks **out, const char *const *folders,
                           ps_error *error) PS_MUST_CHECK;
/* Part of it: of a module that is there, of so many processes by the environment. */
struct ps_mpi_calls;
pspec_status ps_ranks_begin(ps_ranks **out, const struct ps_mpi_calls *calls, long num,
                            ps_error *error) PS_MUST_CHECK;
/* Waits for the other ranks; NULL is allowed. */
void ps_ranks_close(ps_ranks *ranks);

/* 1 and 0 of NULL. */
size_t ps_ranks_num(const ps_ranks *ranks);
size_t ps_ranks_own(const ps_ranks *ranks);

/* Has a rank failed? Asked while a rank works, by the thread that has opened them. NULL: no. */
bool ps_ranks_must_stop(ps_ranks *ranks);

/* A process that is alone (NULL) has its own status for the verdict.
 *
 * Hands in how far this rank came: status, with the sentence that *error has where it failed, and
 * bytes. On rank 0 parts[number of ranks], zeros before, get the bytes of the others, to be freed
 * by ps_ranks_free, also after an error; NULL: they have none that is needed. The status is that of
 * the job there, and the sentence names the rank. Elsewhere parts may be NULL, and the status is
 * the one that was handed in. */
pspec_status ps_ranks_gather(ps_ranks *ranks, pspec_status status, const ps_rank_bytes *own,
                             ps_rank_bytes *parts, ps_error *error) PS_MUST_CHECK;
/* The verdict of rank 0, whose status and error these are, and whose bytes all ranks have then,
 * where it is PSPEC_OK. Every gather has one conclusion. */
pspec_status ps_ranks_conclude(ps_ranks *ranks, pspec_status status, void *bytes, size_t num,
                               ps_error *error) PS_MUST_CHECK;
/* Both, of ranks that have no bytes. */
pspec_status ps_ranks_agree(ps_ranks *ranks, pspec_status status, ps_error *error) PS_MUST_CHECK;

void ps_ranks_free(ps_rank_bytes *parts, size_t num);

#endif
