#include "sets/sets.h"

#include "base/memory.h"
#include "base/process/memory_limit.h"
#include "base/text.h"
#include "base/workers.h"
#include "device/lender.h"
#include "sets/ahead.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A thing is handed over in 50 us (two cores of an EPYC, 2026-11), and where processors are busy in
 * more: sets that take less time than this are handed over in blocks that take BLOCK_SECONDS, by
 * one thread. */
static const double LEAST_SECONDS = 2e-4;
static const double BLOCK_SECONDS = 1e-3;

/* Sets made ahead: as many as a device takes in a batch, but not more than a hundredth of the
 * memory of a small machine; algorithms take some times as much while they work. Of blocks a few:
 * one is taken from, one made, and others level out what either does now and then. */
enum { MOST_SLOTS = 256, MOST_BLOCKS = 4, ROOM_BYTES = 1 << 24, SHARE_OF_LIMIT = 16 };

struct ps_sets {
    ps_sampler_request request;
    ps_sets_options options;
    ps_lender *lender;  /* to the threads that make sets; NULL: no device has work */
    uint64_t end, next; /* realizations */
    bool has_begun;
    ps_set_store *store; /* NULL: nothing is kept */
    ps_error no_store;   /* why, where something should be */
    ps_ahead *ahead;     /* NULL: sets are made where they are wanted */
    uint64_t first;      /* realization that is the first of the first thing of ahead */
    uint64_t block;      /* realizations of a thing */
    unsigned slot;       /* of the thing that they are taken from */
    size_t stride;       /* numbers of a realization */
    double *room;        /* [num_slots][block][stride] */
    size_t *num_points;  /* [num_slots][block] */
    char trouble[PS_MESSAGE_BYTES + PS_MAX_SAMPLER_VALUE];
};

/* ---- one realization ----------------------------------------------------------------------- */

static pspec_status make(const ps_sets *sets, uint64_t realization, double *points,
                         size_t *num_points, const ps_watch *watch, ps_error *error) {
    const ps_sampler_request *const request = &sets->request;
    if (sets->store == NULL) {
        return ps_sampler_generate(request, realization, points, num_points, watch, error);
    }
    PS_TRY(ps_set_store_make(sets->store, realization, points, num_points, watch, error));
    return ps_sampler_place(request, realization, points, *num_points, watch, error);
}

static pspec_status make_ahead(void *payload, uint64_t index, unsigned slot, const ps_watch *watch,
                               ps_error *error) {
    const ps_sets *const sets = payload;
    for (uint64_t i = 0; i < sets->block; i++) {
        const uint64_t realization = sets->first + index * sets->block + i;
        const uint64_t at = slot * sets->block + i;
        if (realization < sets->end) {
            PS_TRY(make(sets, realization, sets->room + at * sets->stride, &sets->num_points[at],
                        watch, error));
        }
    }
    return PSPEC_OK;
}

/* ---- all of them --------------------------------------------------------------------------- */

static void open_store(ps_sets *sets) {
    const ps_set_place *const place = &sets->options.place;
    if (sets->store == NULL && ps_set_place_takes(place, &sets->request) &&
        ps_set_store_open(&sets->store, &sets->request, place, &sets->no_store) != PSPEC_OK) {
        sets->store = NULL;
    }
}

static uint64_t least(uint64_t a, uint64_t b) {
    return a < b ? a : b;
}

static uint64_t find_room(const ps_sets *sets) {
    const uint64_t limit = sets->options.memory_limit / SHARE_OF_LIMIT;
    return sets->options.memory_limit > 0 && limit < ROOM_BYTES ? limit : ROOM_BYTES;
}

/* Sets for whose working memory there is room at a time: what the limit leaves, or else half of
 * what is free; one at least. */
static uint64_t count_fitting(const ps_sampler_request *request, const ps_sets_options *options) {
    const double each = ps_sampler_work_bytes(request);
    ps_memory_room room = {options->memory_limit, ""};
    if (each == 0) {
        return UINT64_MAX;
    }
    if (options->memory_limit == 0) {
        ps_memory_room_find(&room, 0);
    }
    const double left =
        options->memory_limit > 0
            ? (double)room.bytes - (double)(room.bytes / SHARE_OF_LIMIT) - (double)options->taken
            : (double)room.bytes / 2;
    return left < 2 * each ? 1 : (uint64_t)(left / each);
}

static pspec_status check_memory(const ps_sampler_request *request, const ps_sets_options *options,
                                 ps_error *error) {
    const double bytes = ps_sampler_work_bytes(request);
    char needed[PS_SIZE_TEXT];
    char allowed[PS_SIZE_TEXT];
    return options->memory_limit == 0 || bytes <= (double)options->memory_limit
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_MEMORY,
                         "sampler %s: a set of %zu points takes %s of memory while it is made, "
                         "above the limit of %s",
                         request->sampler->name, request->num_points, ps_size_show(needed, bytes),
                         ps_size_show(allowed, (double)options->memory_limit));
}

unsigned ps_sets_makers(const ps_sampler_request *request, const ps_sets_options *options,
                        uint64_t num) {
    const unsigned processors = ps_workers_most();
    const uint64_t fitting = least(num, count_fitting(request, options));
    const unsigned most = fitting < processors ? (unsigned)fitting : processors;
    return most > 0 && ps_sampler_seconds(request) >= LEAST_SECONDS ? most : 1;
}

/* Expensive sets come one by one. */
static uint64_t count_block(const ps_sets *sets, uint64_t fit) {
    const double seconds = ps_sampler_seconds(&sets->request);
    if (seconds >= LEAST_SECONDS) {
        return 1;
    }
    const double wanted = seconds > 0 ? ceil(BLOCK_SECONDS / seconds) : HUGE_VAL;
    const uint64_t most = fit / MOST_BLOCKS;
    return wanted < (double)most ? (uint64_t)wanted : most;
}

static unsigned count_slots(const ps_sets *sets, uint64_t fit) {
    const uint64_t things = (sets->end - sets->next + sets->block - 1) / sets->block;
    return (unsigned)least(sets->block > 1 ? MOST_BLOCKS : MOST_SLOTS,
                           least(things, fit / sets->block));
}

static pspec_status begin_ahead(ps_sets *sets, unsigned num_slots, ps_error *error) {
    const ps_ahead_plan plan = {
        .make = make_ahead,
        .payload = sets,
        .num_things = (sets->end - sets->next + sets->block - 1) / sets->block,
        .num_slots = num_slots,
        .num_threads = ps_sets_makers(&sets->request, &sets->options, num_slots),
    };
    const size_t num = (size_t)(num_slots * sets->block);
    PS_TRY(PS_NEW(&sets->room, num * sets->stride, "sets made ahead", error));
    PS_TRY(PS_NEW(&sets->num_points, num, "sets made ahead", error));
    sets->first = sets->next;
    return ps_ahead_create(&sets->ahead, &plan, error);
}

static void end_ahead(ps_sets *sets) {
    ps_ahead_destroy(sets->ahead);
    free(sets->room);
    free(sets->num_points);
    sets->ahead = NULL;
    sets->room = NULL;
    sets->num_points = NULL;
    sets->has_begun = false;
}

/* A single slot would make nobody wait less. */
static pspec_status begin(ps_sets *sets, ps_error *error) {
    const uint64_t fit = find_room(sets) / (sets->stride * sizeof(double));
    open_store(sets);
    sets->has_begun = true;
    sets->block = count_block(sets, fit);
    const unsigned num_slots = sets->block > 0 ? count_slots(sets, fit) : 0;
    return num_slots > 1 ? begin_ahead(sets, num_slots, error) : PSPEC_OK;
}

static pspec_status lend_devices(ps_sets *sets, ps_error *error) {
    if (ps_sampler_uses_device(&sets->request)) {
        PS_TRY(ps_lender_create(&sets->lender, sets->options.device, error));
    }
    sets->request.lender = sets->lender;
    return PSPEC_OK;
}

pspec_status ps_sets_create(ps_sets **out, const ps_sampler_request *request,
                            uint64_t num_realizations, const ps_sets_options *options,
                            ps_error *error) {
    ps_sets *sets = NULL;
    *out = NULL;
    PS_TRY(ps_sampler_check(request, error));
    PS_TRY(check_memory(request, options, error));
    PS_TRY(PS_NEW(&sets, 1, "realizations of a sampler", error));
    sets->request = *request;
    sets->options = *options;
    sets->next = options->first;
    sets->end = options->first + num_realizations;
    sets->stride = ps_sampler_most_points(request) * request->dimension;
    const pspec_status status = lend_devices(sets, error);
    if (status != PSPEC_OK) {
        ps_sets_destroy(sets);
        return status;
    }
    *out = sets;
    return PSPEC_OK;
}

void ps_sets_destroy(ps_sets *sets) {
    if (sets != NULL) {
        end_ahead(sets);
        ps_set_store_close(sets->store);
        ps_lender_destroy(sets->lender);
        free(sets);
    }
}

void ps_sets_leave(ps_sets *sets, uint64_t taken) {
    sets->options.taken = taken;
}

void ps_sets_rewind(ps_sets *sets) {
    end_ahead(sets);
    sets->next = sets->options.first;
}

void ps_sets_skip(ps_sets *sets, uint64_t num) {
    end_ahead(sets);
    sets->next += least(num, sets->end - sets->next);
}

static pspec_status take(ps_sets *sets, double *points, size_t *num_points, const ps_watch *watch,
                         ps_error *error) {
    if (!sets->has_begun) {
        PS_TRY(begin(sets, error));
    }
    if (sets->ahead == NULL) {
        PS_TRY(make(sets, sets->next, points, num_points, watch, error));
    } else {
        const uint64_t in_block = (sets->next - sets->first) % sets->block;
        if (in_block == 0) {
            PS_TRY(ps_ahead_next(sets->ahead, watch, &sets->slot, error));
        }
        const uint64_t at = sets->slot * sets->block + in_block;
        *num_points = sets->num_points[at];
        memcpy(points, sets->room + at * sets->stride,
               *num_points * sets->request.dimension * sizeof(double));
    }
    sets->next++;
    return PSPEC_OK;
}

/* What was said last of the set that is waited for: of the makers, that it has not begun. */
typedef struct listener {
    const ps_watch *watch;
    bool has_begun;
} listener;

static int listen(const ps_watch_report *report, void *payload) {
    listener *const self = payload;
    self->has_begun = strcmp(report->phase, PS_AHEAD_WAITS) != 0;
    return self->watch->tell(report, self->watch->payload);
}

pspec_status ps_sets_next(ps_sets *sets, double *points, size_t *num_points, const ps_watch *watch,
                          ps_error *error) {
    const uint64_t number = sets->next - sets->options.first + 1;
    const uint64_t num = sets->end - sets->options.first;
    listener self = {watch, false};
    const ps_watch heard = {listen, &self};
    const bool is_heard = watch != NULL && watch->tell != NULL;
    const pspec_status status = take(sets, points, num_points, is_heard ? &heard : NULL, error);
    if (status == PSPEC_ERROR_CANCELLED && error != NULL && self.has_begun && num > 1) {
        const ps_error said = *error;
        ps_fail(error, status, "%s of set %" PRIu64 " of %" PRIu64, said.message, number, num);
    }
    return ps_sets_say_kept(sets, status, error);
}

/* ---- the store ----------------------------------------------------------------------------- */

ps_set_counts ps_sets_counts(const ps_sets *sets) {
    return sets->store != NULL ? ps_set_store_counts(sets->store) : (ps_set_counts){0};
}

pspec_status ps_sets_say_kept(ps_sets *sets, pspec_status status, ps_error *error) {
    if (status != PSPEC_ERROR_CANCELLED || error == NULL) {
        return status;
    }
    end_ahead(sets);
    const ps_set_counts counts = ps_sets_counts(sets);
    const uint64_t num = counts.num_read + counts.num_kept;
    if (num == 0) {
        return status;
    }
    const ps_error said = *error;
    return ps_fail(error, status, "%s; %" PRIu64 " %s kept, the same command goes on", said.message,
                   num, num == 1 ? "set is" : "sets are");
}

const char *ps_sets_trouble(ps_sets *sets) {
    end_ahead(sets);
    const char *const name = sets->request.sampler->name;
    const unsigned num = ps_sets_counts(sets).num_damaged;
    const char *const reason =
        sets->store != NULL ? ps_set_store_trouble(sets->store) : sets->no_store.message;
    sets->trouble[0] = '\0';
    if (reason[0] != '\0') {
        snprintf(sets->trouble, sizeof sets->trouble, "kept sets of %s: %s", name, reason);
    } else if (num > 0) {
        snprintf(sets->trouble, sizeof sets->trouble, "kept sets of %s: %u %s damaged, made anew",
                 name, num, num == 1 ? "was" : "were");
    }
    return sets->trouble;
}
