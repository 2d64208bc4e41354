/* Many things to do, shared among threads, some of them at a time: in between a watch is told how
 * many are done, and may stop the rest. What becomes of a thing must not depend on who does it. */
#ifndef PS_BASE_PIECES_H
#define PS_BASE_PIECES_H

#include "base/watch.h"
#include "base/workers.h"

#include <stddef.h>

typedef struct ps_pieces {
    ps_workers *workers; /* NULL: the caller alone */
    size_t each; /* things for each thread between two tellings: some hundredths of a second */
    const ps_watch *watch;
    const char *phase;
    uint64_t done, total; /* as the watch is told; done moves on */
} ps_pieces;

/* Calls task(payload, i) for i = 0 .. num - 1, each in one of the threads. */
pspec_status ps_pieces_do(ps_pieces *pieces, size_t num, void (*task)(void *payload, size_t i),
                          void *payload, ps_error *error) PS_MUST_CHECK;

/* The same with threads for this once, if they are worth it: the num things, told as `phase`, are
 * made of `work` smaller ones that take some nanoseconds each. */
pspec_status ps_pieces_share(const ps_watch *watch, const char *phase, size_t work, size_t num,
                             void (*task)(void *payload, size_t i), void *payload,
                             ps_error *error) PS_MUST_CHECK;

#endif
