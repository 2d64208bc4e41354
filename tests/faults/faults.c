/* Which call fails, what is outstanding, and the report of both. */
#include "faults.h"

#include <execinfo.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const class_names[NUM_FAULT_CLASSES] = {"memory", "file", "opencl"};

/* ---- which call ---------------------------------------------------------------------------- */

enum { MOST_FRAMES = 32 };
typedef struct place {
    void *frames[MOST_FRAMES];
    int num_frames;
} place;

static struct {
    unsigned long calls[NUM_FAULT_CLASSES];
    place last[NUM_FAULT_CLASSES];
    fault_class wanted_class;
    unsigned long wanted_call; /* 0: none */
    bool and_all_after, kills; /* the whole process, before the call */
    bool loses;         /* all calls after it of its thread, whose device is lost, fail, too */
    const char *failed; /* name of the first call that failed */
} plan;

static bool is_at_same_place(fault_class kind) {
    place here = {.num_frames = 0};
    here.num_frames = backtrace(here.frames, MOST_FRAMES);
    place *const last = &plan.last[kind];
    const bool is_same =
        here.num_frames == last->num_frames &&
        memcmp(here.frames, last->frames, (size_t)here.num_frames * sizeof here.frames[0]) == 0;
    *last = here;
    return is_same;
}

/* Devices of one process are called by a thread each. */
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;

static _Thread_local bool is_lost;

static bool count_locked(fault_class kind, const char *name, bool can_go_on) {
    const bool is_repeated = kind != FAULT_OPENCL && is_at_same_place(kind);
    plan.calls[kind] += !is_repeated;
    if (plan.wanted_call == 0 || kind != plan.wanted_class) {
        return false;
    }
    const bool is_due = (plan.calls[kind] == plan.wanted_call && !is_repeated) ||
                        (plan.and_all_after && can_go_on && plan.calls[kind] >= plan.wanted_call) ||
                        (is_lost && can_go_on);
    is_lost = is_lost || (is_due && plan.loses);
    if (is_due && plan.kills) {
        raise(SIGKILL);
    }
    if (is_due && plan.failed == NULL) {
        plan.failed = name;
    }
    return is_due;
}

static bool count_call(fault_class kind, const char *name, bool can_go_on) {
    pthread_mutex_lock(&mutex);
    const bool is_due = count_locked(kind, name, can_go_on);
    pthread_mutex_unlock(&mutex);
    return is_due;
}

bool fault_is_due(fault_class kind, const char *name) {
    return count_call(kind, name, true);
}

bool fault_is_due_alone(fault_class kind, const char *name) {
    return count_call(kind, name, false) && !plan.and_all_after;
}

static void read_plan(void) {
    const char *const text = getenv("POINTSPEC_FAULT");
    for (int i = 0; text != NULL && i < NUM_FAULT_CLASSES; i++) {
        const size_t length = strlen(class_names[i]);
        if (strncmp(text, class_names[i], length) == 0 && text[length] == ':') {
            char *end = NULL;
            plan.wanted_class = (fault_class)i;
            plan.wanted_call = strtoul(text + length + 1, &end, 10);
            plan.and_all_after = *end == '+';
            plan.kills = *end == '!';
            plan.loses = *end == '@';
        }
    }
}

/* ---- what is outstanding ------------------------------------------------------------------- */

enum { MOST_THINGS = 1 << 16 };
static struct {
    const void *thing;
    const char *by;
} outstanding[MOST_THINGS];
static size_t num_outstanding;
static size_t num_unknown; /* given back without having been taken */

void fault_gain(const void *thing, const char *by) {
    pthread_mutex_lock(&mutex);
    if (thing != NULL && num_outstanding < MOST_THINGS) {
        outstanding[num_outstanding].thing = thing;
        outstanding[num_outstanding++].by = by;
    }
    pthread_mutex_unlock(&mutex);
}

void fault_lose(const void *thing) {
    pthread_mutex_lock(&mutex);
    size_t i = num_outstanding;
    while (i > 0 && outstanding[i - 1].thing != thing) {
        i--;
    }
    if (i > 0) {
        outstanding[i - 1] = outstanding[--num_outstanding];
    } else if (thing != NULL) {
        num_unknown++;
    }
    pthread_mutex_unlock(&mutex);
}

/* ---- the report ---------------------------------------------------------------------------- */

static void report(void) {
    const char *const path = getenv("POINTSPEC_FAULT_REPORT");
    const int descriptor = path != NULL ? creat(path, 0666) : -1;
    if (descriptor < 0) {
        return;
    }
    for (int i = 0; i < NUM_FAULT_CLASSES; i++) {
        dprintf(descriptor, "calls %s %lu\n", class_names[i], plan.calls[i]);
    }
    if (plan.failed != NULL) {
        dprintf(descriptor, "failed %s\n", plan.failed);
    }
    for (size_t i = 0; i < num_outstanding; i++) {
        dprintf(descriptor, "leak %s\n", outstanding[i].by);
    }
    if (num_unknown > 0) {
        dprintf(descriptor, "unknown %zu\n", num_unknown);
    }
}

WRAPPER(main, int, (int argc, char **argv)) {
    read_plan();
    const int code = __real_main(argc, argv);
    report();
    return code;
}
