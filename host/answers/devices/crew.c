#include "answers/devices/crew.h"

#include "base/memory.h"
#include "base/thread.h"
#include "store/figures_file.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum part_state { PART_IDLE = 0, PART_BEGUN, PART_DONE } part_state;

typedef struct crew crew;

/* A device and its thread. What is behind the thread is under the mutex of the crew. */
typedef struct member {
    crew *crew;
    const char *selector;
    ps_device *device; /* NULL: it is not open */
    bool has_checked;  /* itself, in its first part */
    pthread_t thread;
    bool has_thread;
    bool is_over; /* it takes no more parts */
    uint64_t part;
    uint64_t done;      /* realizations of the job of that part that is under way */
    unsigned num_begun; /* jobs of that part */
} member;

struct crew {
    const ps_crew_task *task;
    ps_crew_part *parts;
    ps_answer_hooks of_parts; /* of what is said of checkpoints */
    pthread_mutex_t mutex;
    pthread_cond_t has_changed;
    part_state *states; /* [num_parts] */
    uint64_t num_done;  /* parts */
    size_t num_alive;   /* devices */
    size_t num_working; /* threads */
    member *members;
    bool is_cancelled;
    uint64_t failed; /* the first part that no device can answer; num_parts: there is none */
    ps_error error;  /* of it */
    ps_text said;    /* warnings, a line each, for who called */
    char name[128];  /* that the device of who called has otherwise */
};

static bool is_over(const crew *self) {
    return self->is_cancelled || self->failed < self->task->num_parts ||
           self->num_done == self->task->num_parts || self->num_alive == 0;
}

static uint64_t part_size(const crew *self, uint64_t part) {
    const ps_crew_task *const task = self->task;
    const ps_realization_range range =
        ps_parts_range(task->num_realizations, task->num_parts, part);
    return range.end - range.first;
}

/* ---- what a part's hooks hear ---------------------------------------------------------------- */

static int tell(const ps_watch_report *report, void *payload) {
    member *const self = payload;
    crew *const team = self->crew;
    pthread_mutex_lock(&team->mutex);
    if (strcmp(report->phase, team->task->kind->counted) == 0) {
        self->done = report->done;
    }
    /* The first part that fails tells why, whatever others would have failed by later. */
    const bool stops = team->is_cancelled || team->failed < self->part;
    pthread_mutex_unlock(&team->mutex);
    return stops;
}

static void next_job(void *payload) {
    member *const self = payload;
    pthread_mutex_lock(&self->crew->mutex);
    self->num_begun++;
    self->done = 0;
    pthread_mutex_unlock(&self->crew->mutex);
}

/* All parts may have the same to say. */
static void warn_once(crew *self, const char *sentence) {
    ps_text_append_once(&self->said, sentence, "\n");
}

static void warn(void *payload, const char *sentence) {
    crew *const self = payload;
    pthread_mutex_lock(&self->mutex);
    warn_once(self, sentence);
    pthread_mutex_unlock(&self->mutex);
}

static void warn_of_member(void *payload, const char *sentence) {
    const member *const self = payload;
    warn(self->crew, sentence);
}

/* ---- a device -------------------------------------------------------------------------------- */

static pspec_status open_device(member *self, ps_error *error) {
    const ps_limits_spec *const limits = &self->crew->task->request->limits;
    const bool is_first = self == self->crew->members;
    if (is_first && self->crew->task->hooks->device != NULL) {
        self->device = self->crew->task->hooks->device;
    }
    if (self->device == NULL) {
        PS_TRY(ps_figures_open_device(&self->device, self->selector, limits->profile,
                                      limits->cache_folder, error));
    }
    ps_device_set_name(self->device, self->crew->task->device);
    return PSPEC_OK;
}

static pspec_status answer_part(member *self, uint64_t part, ps_error *error) {
    const ps_crew_task *const task = self->crew->task;
    ps_request request = *task->request;
    ps_answer_hooks hooks = {.watch = {tell, self},
                             .payload = self,
                             .next = next_job,
                             .warn = warn_of_member,
                             .is_shared = true};
    ps_crew_part *const own = &self->crew->parts[part];
    PS_TRY(open_device(self, error));
    ps_part_end(&own->part, false); /* that of a device that was dropped */
    hooks.device = self->device;
    request.limits.device = self->selector;
    request.integrands_made = NULL; /* which one thread may make and ask */
    /* The answer tells of the comparison with the referee that the first part has made. */
    request.accuracy.no_self_check |= self->has_checked && part > 0;
    pspec_status status = ps_part_begin(&own->part, task->kind, &request, task->num_realizations,
                                        task->num_parts, part, &self->crew->of_parts, error);
    if (status == PSPEC_OK) {
        status = ps_answer_make(&own->answer, task->kind, &own->part.request, &hooks, error);
    }
    if (status != PSPEC_OK) {
        ps_answer_free(&own->answer);
    }
    self->has_checked = true;
    return status;
}

/* ---- who does what, under the mutex ---------------------------------------------------------- */

/* Waits for a part that is idle: one that is under way may come back. */
static bool take(member *self) {
    crew *const team = self->crew;
    for (;;) {
        if (is_over(team)) {
            return false;
        }
        for (uint64_t part = 0; part < team->task->num_parts; part++) {
            if (team->states[part] == PART_IDLE) {
                team->states[part] = PART_BEGUN;
                self->part = part;
                self->done = 0;
                self->num_begun = 0;
                return true;
            }
        }
        pthread_cond_wait(&team->has_changed, &team->mutex);
    }
}

bool ps_crew_is_of_device(pspec_status status) {
    return status == PSPEC_ERROR_DEVICE || status == PSPEC_ERROR_NO_DEVICE ||
           status == PSPEC_ERROR_BUILD || status == PSPEC_ERROR_MEMORY ||
           status == PSPEC_ERROR_CHECK;
}

static void drop(member *self, const ps_error *error) {
    crew *const team = self->crew;
    char sentence[PS_MESSAGE_BYTES];
    snprintf(sentence, sizeof sentence, "device %s is dropped, and the others do its work: %.600s",
             self->selector, error->message);
    warn_once(team, sentence);
    team->states[self->part] = PART_IDLE;
    team->num_alive--;
    self->is_over = true;
}

static void finish(member *self, pspec_status status, const ps_error *error) {
    crew *const team = self->crew;
    if (status == PSPEC_OK) {
        team->states[self->part] = PART_DONE;
        team->num_done++;
    } else if (ps_crew_is_of_device(status) && team->num_alive > 1) {
        drop(self, error);
    } else if (self->part < team->failed) {
        team->failed = self->part;
        team->error = *error;
    }
    pthread_cond_broadcast(&team->has_changed);
}

static void *work(void *payload) {
    member *const self = payload;
    crew *const team = self->crew;
    pthread_mutex_lock(&team->mutex);
    while (!self->is_over && take(self)) {
        ps_error error = {0};
        pthread_mutex_unlock(&team->mutex);
        const pspec_status status = answer_part(self, self->part, &error);
        pthread_mutex_lock(&team->mutex);
        finish(self, status, &error);
    }
    team->num_working--;
    pthread_cond_broadcast(&team->has_changed);
    pthread_mutex_unlock(&team->mutex);
    return NULL;
}

/* ---- who called ------------------------------------------------------------------------------ */

/* Realizations of all jobs. */
static uint64_t count_done(const crew *self) {
    uint64_t done = 0;
    for (uint64_t part = 0; part < self->task->num_parts; part++) {
        done += self->states[part] == PART_DONE ? self->task->num_jobs * part_size(self, part) : 0;
    }
    for (size_t i = 0; i < self->task->selectors->num; i++) {
        const member *const one = &self->members[i];
        if (self->states[one->part] == PART_BEGUN && !one->is_over && one->num_begun > 0) {
            done += (one->num_begun - 1) * part_size(self, one->part) + one->done;
        }
    }
    return done;
}

/* Says what there is to say, a line after the other. */
static void speak(const ps_answer_hooks *hooks, ps_text *said) {
    for (const char *at = ps_text_string(said); *at != '\0';) {
        const size_t length = strcspn(at, "\n");
        ps_answer_warn(hooks, "%.*s", (int)length, at);
        at += length + (at[length] == '\n');
    }
    ps_text_free(said);
}

/* Tells how far all are, until none works. Progress and warnings are of this thread. */
static void watch(crew *self) {
    const ps_crew_task *const task = self->task;
    const uint64_t total = task->num_jobs * task->num_realizations;
    pthread_mutex_lock(&self->mutex);
    for (bool is_last = false; !is_last;) {
        ps_error why;
        ps_text said = self->said;
        const uint64_t done = count_done(self);
        is_last = self->num_working == 0;
        self->said = (ps_text){0};
        pthread_mutex_unlock(&self->mutex);
        speak(task->hooks, &said);
        const bool stops = ps_watch_tell(&task->hooks->watch, task->kind->counted, done, total,
                                         NULL, &why) != PSPEC_OK;
        pthread_mutex_lock(&self->mutex);
        if (stops && !self->is_cancelled && self->failed == task->num_parts) {
            self->error = why; /* no part need hear of it */
        }
        self->is_cancelled = self->is_cancelled || stops;
        if (self->num_working > 0) {
            ps_thread_wait_a_little(&self->has_changed, &self->mutex);
        }
    }
    pthread_mutex_unlock(&self->mutex);
}

static pspec_status begin(crew *self, ps_error *error) {
    const ps_selectors *const selectors = self->task->selectors;
    const ps_device_limits *const limits = ps_device_get_limits(self->task->hooks->device);
    snprintf(self->name, sizeof self->name, "%s", limits != NULL ? limits->name : "");
    PS_TRY(PS_NEW(&self->states, self->task->num_parts, "parts of a job", error));
    PS_TRY(PS_NEW(&self->members, selectors->num, "devices", error));
    pthread_mutex_lock(&self->mutex);
    for (size_t i = 0; i < selectors->num; i++) {
        member *const one = &self->members[i];
        *one = (member){.crew = self, .selector = selectors->of[i].text};
        one->has_thread = ps_thread_begin(&one->thread, work, one);
        self->num_working += one->has_thread;
    }
    self->num_alive = self->num_working;
    pthread_mutex_unlock(&self->mutex);
    return self->num_working > 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_MEMORY, "the system gives no thread for a device");
}

/* Profiles are of the whole job. */
static void end(crew *self) {
    for (size_t i = 0; self->members != NULL && i < self->task->selectors->num; i++) {
        const member *const one = &self->members[i];
        if (one->has_thread) {
            pthread_join(one->thread, NULL);
        }
        ps_answer_tell_profile(self->task->hooks, one->device);
        if (one->device != self->task->hooks->device) {
            ps_device_close(one->device);
        }
    }
    if (self->task->hooks->device != NULL) {
        ps_device_set_name(self->task->hooks->device, self->name);
    }
    pthread_cond_destroy(&self->has_changed);
    pthread_mutex_destroy(&self->mutex);
    free(self->states);
    free(self->members);
}

pspec_status ps_crew_answer(ps_crew_part *parts, const ps_crew_task *task, ps_error *error) {
    crew self = {.task = task, .parts = parts, .failed = task->num_parts};
    self.of_parts = (ps_answer_hooks){.payload = &self, .warn = warn};
    pthread_mutex_init(&self.mutex, NULL);
    pthread_cond_init(&self.has_changed, NULL);
    pspec_status status = begin(&self, error);
    if (status == PSPEC_OK) {
        watch(&self);
    }
    if (status == PSPEC_OK && self.num_done < task->num_parts) {
        *error = self.error;
        status = self.error.status;
    }
    end(&self);
    return status;
}
