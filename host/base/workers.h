/* A few threads that do one thing together, again and again: number 0 is the caller itself. */
#ifndef PS_BASE_WORKERS_H
#define PS_BASE_WORKERS_H

#include <stddef.h>

typedef struct ps_workers ps_workers;

/* Threads of one thing to do. */
enum { PS_WORKERS_MOST = 16 };

/* Threads that come and go take PS_WORKERS_SECONDS, which so many things of some nanoseconds each
 * pay for (2 cores of a Zen 5 EPYC, Linux 6.18, 2026-11). */
enum { PS_WORKERS_LEAST = 1 << 17 };
#define PS_WORKERS_SECONDS 0.1e-3

/* At most most_threads, the caller counted, and no more than there are processors; NULL when there
 * is nothing to gain, or no thread to be had: ps_workers_count is 1 then. */
ps_workers *ps_workers_create(unsigned most_threads);
void ps_workers_destroy(ps_workers *workers);
unsigned ps_workers_count(const ps_workers *workers);

/* Calls task(payload, i) for i = 0 .. count - 1, each in a thread of its own, and returns when all
 * are done. Signals are handled by the caller's thread only. */
void ps_workers_run(ps_workers *workers, void (*task)(void *payload, unsigned index),
                    void *payload);

/* The same with threads for this once, where num things to do are worth that: task(payload, i,
 * count) for all i below count, which is 1 for few. What becomes of a thing must not depend on who
 * does it. */
void ps_workers_share(size_t num, void (*task)(void *payload, unsigned index, unsigned count),
                      void *payload);

/* So many threads that has at most on this machine. */
unsigned ps_workers_most(void);

/* The first of num things that are part `index` of `count`; of part `count`: num. */
static inline size_t ps_share_begin(size_t num, unsigned index, unsigned count) {
    return num / count * index + (num % count < index ? num % count : index);
}

#endif
