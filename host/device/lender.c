#include "device/lender.h"

#include "base/memory.h"

#include <pthread.h>
#include <stdlib.h>

/* Devices other than CPUs: while the host works for one set, there is another's work to do. */
enum { MOST_OF_GPU = 2 };

struct ps_lender {
    const char *selector;
    pthread_mutex_t mutex;
    pthread_cond_t is_back;
    ps_device **idle; /* with room for all */
    size_t num_idle, num_open, capacity;
    size_t most; /* open at a time; one until it is known what device it is */
    bool is_set; /* ps_lender_set_most */
};

pspec_status ps_lender_create(ps_lender **out, const char *selector, ps_error *error) {
    *out = NULL;
    PS_TRY(PS_NEW(out, 1, "devices", error));
    (*out)->selector = selector;
    (*out)->most = 1;
    pthread_mutex_init(&(*out)->mutex, NULL);
    pthread_cond_init(&(*out)->is_back, NULL);
    return PSPEC_OK;
}

void ps_lender_destroy(ps_lender *lender) {
    if (lender == NULL) {
        return;
    }
    for (size_t i = 0; i < lender->num_idle; i++) {
        ps_device_close(lender->idle[i]);
    }
    pthread_cond_destroy(&lender->is_back);
    pthread_mutex_destroy(&lender->mutex);
    free(lender->idle);
    free(lender);
}

const char *ps_lender_selector(const ps_lender *lender) {
    return lender->selector;
}

/* With the mutex: devices are opened one after the other anyway. */
static pspec_status open_another(ps_lender *lender, ps_error *error) {
    void *idle = lender->idle;
    PS_TRY(ps_grow(&idle, &lender->capacity, lender->num_open + 1, sizeof(ps_device *), "devices",
                   error));
    lender->idle = idle;
    PS_TRY(ps_device_open(&lender->idle[lender->num_idle], lender->selector, false, error));
    if (!lender->is_set) {
        const bool is_cpu = ps_device_get_limits(lender->idle[lender->num_idle])->is_cpu;
        lender->most = is_cpu ? SIZE_MAX : MOST_OF_GPU;
    }
    lender->num_idle++;
    lender->num_open++;
    return PSPEC_OK;
}

pspec_status ps_lender_borrow(ps_lender *lender, ps_device **out, ps_error *error) {
    pspec_status status = PSPEC_OK;
    *out = NULL;
    pthread_mutex_lock(&lender->mutex);
    while (lender->num_idle == 0 && lender->num_open >= lender->most) {
        pthread_cond_wait(&lender->is_back, &lender->mutex);
    }
    if (lender->num_idle == 0) {
        status = open_another(lender, error);
    }
    if (status == PSPEC_OK) {
        *out = lender->idle[--lender->num_idle];
    }
    pthread_mutex_unlock(&lender->mutex);
    return status;
}

void ps_lender_give_back(ps_lender *lender, ps_device *device) {
    pthread_mutex_lock(&lender->mutex);
    lender->idle[lender->num_idle++] = device;
    pthread_cond_signal(&lender->is_back);
    pthread_mutex_unlock(&lender->mutex);
}

size_t ps_lender_num_open(ps_lender *lender) {
    pthread_mutex_lock(&lender->mutex);
    const size_t num = lender->num_open;
    pthread_mutex_unlock(&lender->mutex);
    return num;
}

void ps_lender_set_most(ps_lender *lender, size_t most) {
    lender->most = most;
    lender->is_set = true;
}
