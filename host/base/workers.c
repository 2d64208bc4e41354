#include "base/workers.h"

#include "base/thread.h"

#include <stdlib.h>
#include <unistd.h>

typedef struct worker {
    ps_workers *workers;
    unsigned index;
    pthread_t thread;
} worker;

struct ps_workers {
    pthread_mutex_t mutex;
    pthread_cond_t has_work, is_done;
    void (*task)(void *payload, unsigned index);
    void *payload;
    unsigned long round; /* how many runs there were */
    unsigned num_busy;
    bool is_over;
    unsigned num_threads; /* without the caller */
    worker threads[];
};

static void *work(void *argument) {
    const worker *const self = argument;
    ps_workers *const workers = self->workers;
    unsigned long round = 0;
    pthread_mutex_lock(&workers->mutex);
    for (;;) {
        while (!workers->is_over && workers->round == round) {
            pthread_cond_wait(&workers->has_work, &workers->mutex);
        }
        if (workers->is_over) {
            break;
        }
        round = workers->round;
        pthread_mutex_unlock(&workers->mutex);
        workers->task(workers->payload, self->index);
        pthread_mutex_lock(&workers->mutex);
        if (--workers->num_busy == 0) {
            pthread_cond_signal(&workers->is_done);
        }
    }
    pthread_mutex_unlock(&workers->mutex);
    return NULL;
}

static void start_threads(ps_workers *workers, unsigned wanted) {
    for (unsigned i = 0; i < wanted; i++) {
        worker *const self = &workers->threads[i];
        *self = (worker){.workers = workers, .index = i + 1};
        if (!ps_thread_begin(&self->thread, work, self)) {
            break;
        }
        workers->num_threads++;
    }
}

static unsigned count_processors(unsigned most_threads) {
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    return processors > 0 && (unsigned long)processors < most_threads ? (unsigned)processors
                                                                      : most_threads;
}

ps_workers *ps_workers_create(unsigned most_threads) {
    const unsigned most = count_processors(most_threads);
    ps_workers *const workers =
        most > 1 ? calloc(1, sizeof *workers + (most - 1) * sizeof(worker)) : NULL;
    if (workers == NULL) {
        return NULL;
    }
    pthread_mutex_init(&workers->mutex, NULL);
    pthread_cond_init(&workers->has_work, NULL);
    pthread_cond_init(&workers->is_done, NULL);
    start_threads(workers, most - 1);
    if (workers->num_threads == 0) {
        ps_workers_destroy(workers);
        return NULL;
    }
    return workers;
}

void ps_workers_destroy(ps_workers *workers) {
    if (workers == NULL) {
        return;
    }
    pthread_mutex_lock(&workers->mutex);
    workers->is_over = true;
    pthread_cond_broadcast(&workers->has_work);
    pthread_mutex_unlock(&workers->mutex);
    for (unsigned i = 0; i < workers->num_threads; i++) {
        pthread_join(workers->threads[i].thread, NULL);
    }
    pthread_cond_destroy(&workers->has_work);
    pthread_cond_destroy(&workers->is_done);
    pthread_mutex_destroy(&workers->mutex);
    free(workers);
}

unsigned ps_workers_count(const ps_workers *workers) {
    return workers != NULL ? workers->num_threads + 1 : 1;
}

void ps_workers_run(ps_workers *workers, void (*task)(void *payload, unsigned index),
                    void *payload) {
    if (workers == NULL) {
        task(payload, 0);
        return;
    }
    pthread_mutex_lock(&workers->mutex);
    workers->task = task;
    workers->payload = payload;
    workers->num_busy = workers->num_threads;
    workers->round++;
    pthread_mutex_unlock(&workers->mutex);
    /* Not before: a thread that wakes to find the mutex taken sleeps again, and its next waking
     * puts it on the caller's processor (Linux 6.18). */
    pthread_cond_broadcast(&workers->has_work);
    task(payload, 0);
    pthread_mutex_lock(&workers->mutex);
    while (workers->num_busy > 0) {
        pthread_cond_wait(&workers->is_done, &workers->mutex);
    }
    pthread_mutex_unlock(&workers->mutex);
}

typedef struct sharing {
    void (*task)(void *payload, unsigned index, unsigned count);
    void *payload;
    unsigned count;
} sharing;

static void do_share(void *payload, unsigned index) {
    const sharing *const self = payload;
    self->task(self->payload, index, self->count);
}

unsigned ps_workers_most(void) {
    return count_processors(PS_WORKERS_MOST);
}

void ps_workers_share(size_t num, void (*task)(void *payload, unsigned index, unsigned count),
                      void *payload) {
    ps_workers *const workers = num >= PS_WORKERS_LEAST ? ps_workers_create(PS_WORKERS_MOST) : NULL;
    sharing all = {task, payload, ps_workers_count(workers)};
    ps_workers_run(workers, do_share, &all);
    ps_workers_destroy(workers);
}
