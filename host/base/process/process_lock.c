#include "base/process/process_lock.h"

#include <pthread.h>

/* The exception to "no state at file scope" (CONTRIBUTING.md); tests/project/test_symbols.sh knows
 * its name. */
static struct {
    pthread_mutex_t mutex;
    ps_process process;
} process_lock = {.mutex = PTHREAD_MUTEX_INITIALIZER};

ps_process *ps_process_lock(void) {
    pthread_mutex_lock(&process_lock.mutex);
    return &process_lock.process;
}

void ps_process_unlock(void) {
    pthread_mutex_unlock(&process_lock.mutex);
}
