/* Threads for work: signals that a handler waits for go to the others. */
#ifndef PS_BASE_THREAD_H
#define PS_BASE_THREAD_H

#include <pthread.h>
#include <stdbool.h>

/* Starts run(argument) in a thread that blocks all signals, to be joined; false: there is no
 * thread to be had. */
bool ps_thread_begin(pthread_t *thread, void *(*run)(void *argument), void *argument);

#endif
