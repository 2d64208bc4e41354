#include "base/thread.h"

#include <signal.h>
#include <time.h>

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

void ps_thread_wait_a_little(pthread_cond_t *has_changed, pthread_mutex_t *mutex) {
    enum { NANOSECONDS = 100000000, OF_SECOND = 1000000000 };
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += NANOSECONDS;
    until.tv_sec += until.tv_nsec / OF_SECOND;
    until.tv_nsec %= OF_SECOND;
    pthread_cond_timedwait(has_changed, mutex, &until);
}
