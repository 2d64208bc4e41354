#include "answers/devices/device_team.h"

#include "answers/devices/crew.h"
#include "base/memory.h"
#include "base/thread.h"
#include "store/figures_file.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct device_team device_team;

typedef struct member {
    device_team *owner;
    ps_team team;
    const char *selector;
    ps_device *device;
    bool is_borrowed; /* the device, of who called */
    bool has_thread;
    pthread_t thread;
    ps_answer answer;
    pspec_status status;
    ps_error error;
    const char *slots; /* while it meets the others, of so many bytes each */
    size_t bytes;
} member;

struct device_team {
    const ps_device_team_task *task;
    pthread_mutex_t mutex;
    pthread_cond_t has_changed;
    member *members; /* [num] */
    size_t num;
    /* What the first has told last */
    char phase[128];
    uint64_t done, total;
    /* Under the mutex */
    size_t num_waiting;
    uint64_t num_meetings;
    const member *failed; /* the first that has failed; NULL: none */
};

/* ---- meetings -------------------------------------------------------------------------------- */

static bool has_failed(device_team *self) {
    pthread_mutex_lock(&self->mutex);
    const bool has = self->failed != NULL;
    pthread_mutex_unlock(&self->mutex);
    return has;
}

/* With the mutex, which is free meanwhile. The first of the members is the thread of who called,
 * whose watch is asked: it does not wait for ever. */
static pspec_status wait_a_little(device_team *self, const member *own, ps_error *error) {
    if (own->team.own > 0) {
        pthread_cond_wait(&self->has_changed, &self->mutex);
        return PSPEC_OK;
    }
    ps_thread_wait_a_little(&self->has_changed, &self->mutex);
    pthread_mutex_unlock(&self->mutex);
    const pspec_status status =
        ps_watch_tell(&self->task->hooks->watch, self->phase, self->done, self->total, NULL, error);
    pthread_mutex_lock(&self->mutex);
    return status;
}

/* Until all are here; what one has failed by is another matter. */
static pspec_status wait_for_all(device_team *self, const member *own, ps_error *error) {
    pspec_status status = PSPEC_OK;
    pthread_mutex_lock(&self->mutex);
    const uint64_t meeting = self->num_meetings;
    if (++self->num_waiting == self->num) {
        self->num_waiting = 0;
        self->num_meetings++;
        pthread_cond_broadcast(&self->has_changed);
    }
    while (status == PSPEC_OK && self->num_meetings == meeting && self->failed == NULL) {
        status = wait_a_little(self, own, error);
    }
    const bool are_here = self->num_meetings > meeting;
    pthread_mutex_unlock(&self->mutex);
    return are_here ? PSPEC_OK
           : status != PSPEC_OK
               ? status
               : ps_fail(error, PSPEC_ERROR_CANCELLED, "another device has failed");
}

static pspec_status exchange(const ps_team *team, pspec_status status, void *slots, size_t bytes,
                             ps_error *error) {
    member *const own = team->payload;
    device_team *const self = own->owner;
    PS_TRY(status);
    own->slots = slots;
    own->bytes = bytes;
    PS_TRY(wait_for_all(self, own, error));
    for (size_t i = 0; i < self->num; i++) {
        const member *const other = &self->members[i];
        if (other->bytes != bytes) {
            return ps_fail(error, PSPEC_ERROR_IO, "devices do not do the same: %zu and %zu bytes",
                           other->bytes, bytes);
        }
        if (i != team->own && bytes > 0) {
            memcpy((char *)slots + i * bytes, other->slots + i * bytes, bytes);
        }
    }
    return wait_for_all(self, own, error); /* nobody needs the slots of another any more */
}

/* ---- members --------------------------------------------------------------------------------- */

/* Of members but the first, whose watch is that of who called. */
static int tell(const ps_watch_report *report, void *payload) {
    (void)report;
    return has_failed(payload);
}

static int tell_first(const ps_watch_report *report, void *payload) {
    device_team *const self = payload;
    const ps_watch *const watch = &self->task->hooks->watch;
    snprintf(self->phase, sizeof self->phase, "%s", report->phase);
    self->done = report->done;
    self->total = report->total;
    return tell(report, payload) ||
           (watch->tell != NULL && watch->tell(report, watch->payload) != 0);
}

static pspec_status open_device(member *self, ps_error *error) {
    const ps_device_team_task *const task = self->owner->task;
    const ps_limits_spec *const limits = &task->request->limits;
    self->is_borrowed =
        task->hooks->device != NULL && self->selector == task->selectors->of[0].text;
    if (self->is_borrowed) {
        self->device = task->hooks->device;
    } else {
        PS_TRY(ps_figures_open_device(&self->device, self->selector, limits->profile,
                                      limits->cache_folder, error));
    }
    ps_device_set_name(self->device, task->device);
    return PSPEC_OK;
}

static pspec_status answer(member *self, ps_error *error) {
    device_team *const owner = self->owner;
    const ps_device_team_task *const task = owner->task;
    const bool is_first = self->team.own == 0;
    ps_request request = *task->request;
    ps_answer_hooks hooks = is_first ? *task->hooks : (ps_answer_hooks){0};
    PS_TRY(open_device(self, error));
    hooks.watch = (ps_watch){is_first ? tell_first : tell, owner};
    hooks.tell_profile = NULL; /* that of every device is told at the end */
    hooks.device = self->device;
    hooks.team = &self->team;
    request.limits.device = self->selector;
    request.integrands_made = NULL; /* which one thread may make and ask */
    return task->answer(&self->answer, task->kind, &request, &hooks, error);
}

static void *work(void *payload) {
    member *const self = payload;
    device_team *const owner = self->owner;
    self->status = answer(self, &self->error);
    pthread_mutex_lock(&owner->mutex);
    if (self->status != PSPEC_OK && owner->failed == NULL) {
        owner->failed = self;
        pthread_cond_broadcast(&owner->has_changed);
    }
    pthread_mutex_unlock(&owner->mutex);
    return NULL;
}

/* The first works in the thread of who called. */
static void run_all(device_team *self) {
    for (size_t i = 1; i < self->num; i++) {
        member *const one = &self->members[i];
        one->has_thread = ps_thread_begin(&one->thread, work, one);
        if (!one->has_thread) {
            one->status =
                ps_fail(&one->error, PSPEC_ERROR_DEVICE, "the system gives no thread for a device");
            pthread_mutex_lock(&self->mutex);
            self->failed = self->failed != NULL ? self->failed : one;
            pthread_cond_broadcast(&self->has_changed);
            pthread_mutex_unlock(&self->mutex);
        }
    }
    (void)work(&self->members[0]);
    for (size_t i = 1; i < self->num; i++) {
        if (self->members[i].has_thread) {
            pthread_join(self->members[i].thread, NULL);
        }
    }
}

/* ---- all of them ----------------------------------------------------------------------------- */

/* Those that are left, in order. */
static void begin(device_team *self, const bool *is_dropped) {
    const ps_selectors *const selectors = self->task->selectors;
    self->num = self->num_waiting = 0;
    self->failed = NULL;
    for (size_t i = 0; i < selectors->num; i++) {
        if (!is_dropped[i]) {
            self->members[self->num++] = (member){.owner = self, .selector = selectors->of[i].text};
        }
    }
    for (size_t i = 0; i < self->num; i++) {
        self->members[i].team = (ps_team){.own = i,
                                          .num = self->num,
                                          .is_mixed = self->task->request->limits.mixed,
                                          .payload = &self->members[i],
                                          .exchange = exchange};
    }
}

/* *out is the answer of the first. */
static void end(device_team *self, ps_answer *out) {
    for (size_t i = 0; i < self->num; i++) {
        member *const one = &self->members[i];
        ps_answer_tell_profile(self->task->hooks, one->device);
        if (!one->is_borrowed) {
            ps_device_close(one->device);
        }
        if (i == 0 && one->status == PSPEC_OK) {
            *out = one->answer;
        } else {
            ps_answer_free(&one->answer);
        }
    }
}

/* Marks the device that has failed; false: no other would do better. */
static bool drop(const device_team *self, bool *is_dropped) {
    const member *const failed = self->failed;
    const ps_selectors *const selectors = self->task->selectors;
    const bool is_of_limit = failed->status == PSPEC_ERROR_MEMORY &&
                             self->task->request->limits.constraints.memory_limit > 0;
    if (self->num == 1 || !ps_crew_is_of_device(failed->status) || is_of_limit) {
        return false;
    }
    for (size_t i = 0; i < selectors->num; i++) {
        is_dropped[i] = is_dropped[i] || selectors->of[i].text == failed->selector;
    }
    ps_answer_warn(self->task->hooks,
                   "device %s is dropped, and the others begin anew without it: %.600s",
                   failed->selector, failed->error.message);
    return true;
}

static pspec_status run(device_team *self, ps_answer *out, bool *is_dropped, ps_error *error) {
    pspec_status status = PSPEC_OK;
    bool is_again = true;
    while (is_again) {
        begin(self, is_dropped);
        run_all(self);
        is_again = self->failed != NULL && drop(self, is_dropped);
        if (self->failed != NULL) {
            status = self->failed->status;
            *error = self->failed->error;
        } else {
            status = PSPEC_OK;
        }
        end(self, out);
    }
    return status;
}

pspec_status ps_device_team_answer(ps_answer *out, const ps_device_team_task *task,
                                   ps_error *error) {
    const ps_device_limits *const limits = ps_device_get_limits(task->hooks->device);
    device_team self = {.task = task, .phase = "realizations"};
    bool *is_dropped = NULL;
    char name[128];
    *out = (ps_answer){0};
    snprintf(name, sizeof name, "%s", limits != NULL ? limits->name : "");
    pthread_mutex_init(&self.mutex, NULL);
    pthread_cond_init(&self.has_changed, NULL);
    pspec_status status = PS_NEW(&self.members, task->selectors->num, "devices", error);
    if (status == PSPEC_OK) {
        status = PS_NEW(&is_dropped, task->selectors->num, "devices", error);
    }
    if (status == PSPEC_OK) {
        status = run(&self, out, is_dropped, error);
    }
    if (task->hooks->device != NULL) {
        ps_device_set_name(task->hooks->device, name);
    }
    pthread_cond_destroy(&self.has_changed);
    pthread_mutex_destroy(&self.mutex);
    free(self.members);
    free(is_dropped);
    return status;
}
