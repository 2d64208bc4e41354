#include "base/thread.h"

#include <signal.h>

/* A signal that ended up in a thread that goes on working would be heard late. */
bool ps_thread_begin(pthread_t *thread, void *(*run)(void *argument), void *argument) {
    sigset_t all;
    sigset_t kept;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &kept);
    const bool is_there = pthread_create(thread, NULL, run, argument) == 0;
    pthread_sigmask(SIG_SETMASK, &kept, NULL);
    return is_there;
}
