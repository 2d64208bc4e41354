/* A few threads that do one thing together, again and again: number 0 is the caller itself. */
#ifndef PS_BASE_WORKERS_H
#define PS_BASE_WORKERS_H

#include <stddef.h>

typedef struct ps_workers ps_workers;

/* At most most_threads, the caller counted, and no more than there are processors; NULL when there is
 * nothing to gain, or no thread to be had: ps_workers_count is 1 then. */
ps_workers *ps_workers_create(unsigned most_threads);
void ps_workers_destroy(ps_workers *workers);
unsigned ps_workers_count(const ps_workers *workers);

/* Calls task(payload, i) for i = 0 .. count - 1, each in a thread of its own, and returns when all
 * are done. Signals are handled by the caller's thread only. */
void ps_workers_run(ps_workers *workers, void (*task)(void *payload, unsigned index),
                    void *payload);

#endif
