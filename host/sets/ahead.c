#include "sets/ahead.h"

#include "base/memory.h"
#include "base/thread.h"

#include <stdlib.h>
#include <time.h>

typedef struct slot_state {
    bool is_made;
    bool has_report;
    ps_watch_report report; /* the last that its maker gave; its texts are static */
    pspec_status status;
    ps_error error;
} slot_state;

struct ps_ahead {
    ps_ahead_plan plan;
    pthread_mutex_t mutex;
    pthread_cond_t has_room, is_made;
    uint64_t num_begun; /* things that somebody makes or has made */
    uint64_t num_taken;
    uint64_t num_released; /* their slots are free again: all that were taken but the last */
    bool is_over;
    unsigned num_threads;
    pthread_t *threads; /* [plan.num_threads] */
    slot_state *slots;  /* [plan.num_slots] */
};

typedef struct maker {
    ps_ahead *ahead;
    slot_state *state;
} maker;

/* ---- threads ------------------------------------------------------------------------------- */

static bool has_room(const ps_ahead *ahead) {
    return ahead->num_begun < ahead->num_released + ahead->plan.num_slots;
}

static int hear(const ps_watch_report *report, void *payload) {
    const maker *const self = payload;
    pthread_mutex_lock(&self->ahead->mutex);
    self->state->report = (ps_watch_report){report->phase, report->done, report->total, NULL};
    self->state->has_report = true;
    const bool is_over = self->ahead->is_over;
    pthread_mutex_unlock(&self->ahead->mutex);
    return is_over;
}

/* With the mutex, which it gives up while it makes the thing. */
static void make_next(ps_ahead *ahead) {
    const ps_ahead_plan *const plan = &ahead->plan;
    const uint64_t index = ahead->num_begun++;
    const unsigned slot = (unsigned)(index % plan->num_slots);
    maker self = {ahead, &ahead->slots[slot]};
    const ps_watch watch = {hear, &self};
    self.state->is_made = false;
    self.state->has_report = false;
    pthread_mutex_unlock(&ahead->mutex);
    self.state->error = (ps_error){0};
    self.state->status = plan->make(plan->payload, index, slot, &watch, &self.state->error);
    pthread_mutex_lock(&ahead->mutex);
    self.state->is_made = true;
    pthread_cond_signal(&ahead->is_made);
}

static void *work(void *argument) {
    ps_ahead *const ahead = argument;
    pthread_mutex_lock(&ahead->mutex);
    while (!ahead->is_over && ahead->num_begun < ahead->plan.num_things) {
        if (has_room(ahead)) {
            make_next(ahead);
        } else {
            pthread_cond_wait(&ahead->has_room, &ahead->mutex);
        }
    }
    pthread_mutex_unlock(&ahead->mutex);
    return NULL;
}

static pspec_status begin(ps_ahead *ahead, ps_error *error) {
    const unsigned wanted = ahead->plan.num_threads;
    PS_TRY(PS_NEW(&ahead->slots, ahead->plan.num_slots, "things made ahead", error));
    if (wanted > 0) {
        PS_TRY(PS_NEW(&ahead->threads, wanted, "threads", error));
    }
    while (ahead->num_threads < wanted &&
           ps_thread_begin(&ahead->threads[ahead->num_threads], work, ahead)) {
        ahead->num_threads++;
    }
    return PSPEC_OK;
}

pspec_status ps_ahead_create(ps_ahead **out, const ps_ahead_plan *plan, ps_error *error) {
    ps_ahead *ahead = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&ahead, 1, "things made ahead", error));
    ahead->plan = *plan;
    pthread_mutex_init(&ahead->mutex, NULL);
    pthread_cond_init(&ahead->has_room, NULL);
    pthread_cond_init(&ahead->is_made, NULL);
    const pspec_status status = begin(ahead, error);
    if (status != PSPEC_OK) {
        ps_ahead_destroy(ahead);
        return status;
    }
    *out = ahead;
    return PSPEC_OK;
}

void ps_ahead_destroy(ps_ahead *ahead) {
    if (ahead == NULL) {
        return;
    }
    pthread_mutex_lock(&ahead->mutex);
    ahead->is_over = true;
    pthread_cond_broadcast(&ahead->has_room);
    pthread_mutex_unlock(&ahead->mutex);
    for (unsigned i = 0; i < ahead->num_threads; i++) {
        pthread_join(ahead->threads[i], NULL);
    }
    pthread_cond_destroy(&ahead->has_room);
    pthread_cond_destroy(&ahead->is_made);
    pthread_mutex_destroy(&ahead->mutex);
    free(ahead->threads);
    free(ahead->slots);
    free(ahead);
}

/* ---- the caller ------------------------------------------------------------------------------ */

/* A tenth of a second of the clock that conditions have. */
static struct timespec soon(void) {
    const long tenth = 100000000;
    const long second = 1000000000;
    struct timespec moment = {0};
    clock_gettime(CLOCK_REALTIME, &moment);
    moment.tv_nsec += tenth;
    if (moment.tv_nsec >= second) {
        moment.tv_nsec -= second;
        moment.tv_sec++;
    }
    return moment;
}

/* With the mutex, which the watch is not told under. */
static pspec_status wait_for(ps_ahead *ahead, const slot_state *state, uint64_t index,
                             const ps_watch *watch, ps_error *error) {
    while (ahead->num_begun <= index || !state->is_made) {
        const struct timespec moment = soon();
        pthread_cond_timedwait(&ahead->is_made, &ahead->mutex, &moment);
        if (ahead->num_begun > index && state->is_made) {
            break;
        }
        const bool has_report = ahead->num_begun > index && state->has_report;
        const ps_watch_report said =
            has_report ? state->report : (ps_watch_report){PS_AHEAD_WAITS, index, 0, NULL};
        pthread_mutex_unlock(&ahead->mutex);
        const pspec_status status =
            ps_watch_tell(watch, said.phase, said.done, said.total, said.detail, error);
        pthread_mutex_lock(&ahead->mutex);
        PS_TRY(status);
    }
    return PSPEC_OK;
}

static pspec_status make_here(ps_ahead *ahead, unsigned slot, const ps_watch *watch,
                              ps_error *error) {
    const ps_ahead_plan *const plan = &ahead->plan;
    PS_TRY(plan->make(plan->payload, ahead->num_taken, slot, watch, error));
    ahead->num_taken++;
    return PSPEC_OK;
}

pspec_status ps_ahead_next(ps_ahead *ahead, const ps_watch *watch, unsigned *slot,
                           ps_error *error) {
    const uint64_t index = ahead->num_taken;
    *slot = (unsigned)(index % ahead->plan.num_slots);
    slot_state *const state = &ahead->slots[*slot];
    if (ahead->num_threads == 0) {
        return make_here(ahead, *slot, watch, error);
    }
    pthread_mutex_lock(&ahead->mutex);
    ahead->num_released = index;
    pthread_cond_broadcast(&ahead->has_room);
    pspec_status status = wait_for(ahead, state, index, watch, error);
    if (status == PSPEC_OK && state->status != PSPEC_OK) {
        status = ps_fail(error, state->status, "%s", state->error.message);
    } else if (status == PSPEC_OK) {
        ahead->num_taken++;
    }
    pthread_mutex_unlock(&ahead->mutex);
    return status;
}
