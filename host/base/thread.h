/* Threads for work: signals that a handler waits for go to the others. */
#ifndef PS_BASE_THREAD_H
#define PS_BASE_THREAD_H

#include <pthread.h>
#include <stdbool.h>

/* Starts run(argument) in a thread that blocks all signals, to be joined; false: there is no
 * thread to be had. */
bool ps_thread_begin(pthread_t *thread, void *(*run)(void *argument), void *argument);

/* Waits for `has_changed` a tenth of a second at most: as often base/watch.h is told. The caller
 * has the mutex, which is free meanwhile. */
void ps_thread_wait_a_little(pthread_cond_t *has_changed, pthread_mutex_t *mutex);

#endif
