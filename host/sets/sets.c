#include "sets/sets.h"

#include "base/memory.h"
#include "base/workers.h"
#include "sets/ahead.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Sets that take less time are made where they are wanted: a kept set is read and
 * handed over in 50 us (two cores of an EPYC, 2026-11), and where processors are busy in more. */
static const double LEAST_SECONDS = 2e-4;

/* Sets made ahead: as many as a device takes in a batch, but not more than a hundredth of the
 * memory of a small machine; algorithms take some times as much while they work. */
enum { MOST_SLOTS = 256, ROOM_BYTES = 1 << 24, SHARE_OF_LIMIT = 16 };

struct ps_sets {
    ps_sampler_request request;
    ps_sets_options options;
    uint64_t end, next; /* realizations */
    bool has_begun;
    ps_set_store *store; /* NULL: nothing is kept */
    ps_error no_store;   /* why, where something should be */
    ps_ahead *ahead;     /* NULL: sets are made where they are wanted */
    uint64_t first;      /* realization that is the first thing of ahead */
    size_t stride;       /* numbers of a slot */
    double *room;        /* [num_slots][stride] */
    size_t *num_points;  /* [num_slots] */
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
    return make(sets, sets->first + index, sets->room + slot * sets->stride,
                &sets->num_points[slot], watch, error);
}

/* ---- all of them --------------------------------------------------------------------------- */

static void open_store(ps_sets *sets) {
    const ps_set_place *const place = &sets->options.place;
    if (sets->store == NULL && ps_set_place_takes(place, &sets->request) &&
        ps_set_store_open(&sets->store, &sets->request, place, &sets->no_store) != PSPEC_OK) {
        sets->store = NULL;
    }
}

static uint64_t find_room(const ps_sets *sets) {
    const uint64_t limit = sets->options.memory_limit / SHARE_OF_LIMIT;
    return sets->options.memory_limit > 0 && limit < ROOM_BYTES ? limit : ROOM_BYTES;
}

unsigned ps_sets_makers(const ps_sampler_request *request, uint64_t num) {
    const unsigned processors = ps_workers_most();
    const unsigned most = num < processors ? (unsigned)num : processors;
    return most > 0 && ps_sampler_seconds(request) >= LEAST_SECONDS ? most : 1;
}

static unsigned count_slots(const ps_sets *sets) {
    const uint64_t fit = find_room(sets) / (sets->stride * sizeof(double));
    const uint64_t left = sets->end - sets->next;
    const uint64_t most = left < MOST_SLOTS ? left : MOST_SLOTS;
    return (unsigned)(fit < most ? fit : most);
}

static pspec_status begin_ahead(ps_sets *sets, unsigned num_slots, ps_error *error) {
    const ps_ahead_plan plan = {
        .make = make_ahead,
        .payload = sets,
        .num_things = sets->end - sets->next,
        .num_slots = num_slots,
        .num_threads = ps_sets_makers(&sets->request, num_slots),
    };
    PS_TRY(ps_allocate_for(&sets->room, num_slots * sets->stride, sizeof *sets->room,
                           "sets made ahead", error));
    PS_TRY(PS_NEW(&sets->num_points, num_slots, "sets made ahead", error));
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
    open_store(sets);
    sets->has_begun = true;
    const unsigned num_slots = count_slots(sets);
    return num_slots > 1 && ps_sampler_seconds(&sets->request) >= LEAST_SECONDS
               ? begin_ahead(sets, num_slots, error)
               : PSPEC_OK;
}

pspec_status ps_sets_create(ps_sets **out, const ps_sampler_request *request,
                            uint64_t num_realizations, const ps_sets_options *options,
                            ps_error *error) {
    ps_sets *sets = NULL;
    *out = NULL;
    PS_TRY(ps_sampler_check(request, error));
    PS_TRY(PS_NEW(&sets, 1, "realizations of a sampler", error));
    sets->request = *request;
    sets->options = *options;
    sets->next = options->first;
    sets->end = options->first + num_realizations;
    sets->stride = ps_sampler_most_points(request) * request->dimension;
    *out = sets;
    return PSPEC_OK;
}

void ps_sets_destroy(ps_sets *sets) {
    if (sets != NULL) {
        end_ahead(sets);
        ps_set_store_close(sets->store);
        free(sets);
    }
}

void ps_sets_rewind(ps_sets *sets) {
    end_ahead(sets);
    sets->next = sets->options.first;
}

pspec_status ps_sets_next(ps_sets *sets, double *points, size_t *num_points, const ps_watch *watch,
                          ps_error *error) {
    unsigned slot = 0;
    if (!sets->has_begun) {
        PS_TRY(begin(sets, error));
    }
    if (sets->ahead == NULL) {
        PS_TRY(make(sets, sets->next, points, num_points, watch, error));
    } else {
        PS_TRY(ps_ahead_next(sets->ahead, watch, &slot, error));
        *num_points = sets->num_points[slot];
        memcpy(points, sets->room + slot * sets->stride,
               *num_points * sets->request.dimension * sizeof(double));
    }
    sets->next++;
    return PSPEC_OK;
}

/* ---- the store ----------------------------------------------------------------------------- */

ps_set_counts ps_sets_counts(const ps_sets *sets) {
    return sets->store != NULL ? ps_set_store_counts(sets->store) : (ps_set_counts){0};
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
