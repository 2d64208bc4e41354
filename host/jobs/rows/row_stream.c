#include "jobs/rows/row_stream_private.h"

#include "base/clock.h"
#include "base/memory.h"
#include "device/kind.h"
#include "math/larger.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Members meet after about so long, which is long beside a message and short beside a job; the
 * first times sooner, as nobody knows how long a realization takes. */
static const double ROUND_SECONDS = 1;
enum { FIRST_SHARE = 1, MOST_GROWTH = 8, MOST_BYTES = 64 << 20 };

/* Where a row of each member takes more, as pictures of many pixels do under hundreds of ranks,
 * each member makes all rows itself. */
enum { MOST_SLOT_BYTES = 128 << 20 };

/* What is before the rows of a slot; numbers of which the largest counts stand between. */
typedef struct slot {
    uint64_t num;   /* rows */
    double seconds; /* that they took */
} slot;

void ps_row_stream_join(ps_row_stream *stream, const ps_checkpoint_spec *spec) {
    stream->team = spec != NULL ? spec->team : NULL;
    stream->tape = spec != NULL ? spec->tape : NULL;
    stream->part = spec != NULL ? spec->part : 0;
}

/* The realizations of the range; there may be fewer of a job that is clipped. */
static pspec_status begin_range(ps_row_stream *self, ps_error *error) {
    const uint64_t all = self->total > 0 ? self->total : UINT64_MAX;
    self->first = 0;
    self->end = all;
    self->keeps = self->tape != NULL && !self->tape->is_played && ps_team_is_led_here(self->team);
    if (!ps_rows_are_ranged(self)) {
        return PSPEC_OK;
    }
    const ps_realization_range *const range = &self->tape->range;
    PS_TRY(self->is_clipped ? PSPEC_OK : ps_range_check_end(range, all, self->are_sampled, error));
    self->first = range->first < all ? range->first : all;
    self->end = range->end < all ? range->end : all;
    return PSPEC_OK;
}

static pspec_status begin_shares(ps_row_stream *self, ps_error *error) {
    const size_t num = self->team->num;
    if (self->shares == NULL) {
        PS_TRY(PS_NEW(&self->shares, 2 * num, "members of a team", error));
    }
    for (size_t i = 0; i < num; i++) {
        self->shares[i] = FIRST_SHARE;
    }
    return PSPEC_OK;
}

pspec_status ps_row_stream_begin(ps_row_stream *stream, uint64_t num_done, ps_error *error) {
    const ps_team *const team = stream->team;
    if (team != NULL && (double)team->num * (double)stream->row_bytes > MOST_SLOT_BYTES) {
        stream->team = NULL;
    }
    stream->num_done = num_done;
    stream->position = 0;
    stream->has_met = stream->has_ended = false;
    PS_TRY(stream->team != NULL ? begin_shares(stream, error) : PSPEC_OK);
    PS_TRY(begin_range(stream, error));
    if (ps_rows_are_played(stream)) {
        return ps_rows_begin_playing(stream, error);
    }
    if (num_done == 0) {
        return PSPEC_OK; /* it may begin behind others, of a checkpoint, before there is a row */
    }
    PS_TRY(ps_rows_pass_to(stream, stream->first + num_done, error));
    return ps_checkpoint_check_sets(stream->position, stream->first + num_done, error);
}

/* ---- those of all ---------------------------------------------------------------------------- */

/* What has to be the same of all members: a text, which is compared as it is. */
typedef struct alike {
    char text[1024];
} alike;

static pspec_status describe(const ps_row_stream *self, alike *out, ps_error *error) {
    ps_text text = {0};
    if (!self->team->is_mixed && self->device != NULL) {
        const ps_device_kind kind = ps_device_kind_of(ps_device_get_limits(self->device));
        ps_text_append(&text, "device %s\n", kind.text);
    }
    if (!self->team->is_mixed && self->chosen != NULL) {
        ps_text_append(&text, "engine %s in %s precision\n", self->chosen->engine->name,
                       ps_precision_name(self->chosen->precision));
    }
    ps_text_append(&text, "%" PRIu64 " realizations of a checkpoint\n", self->num_done);
    const pspec_status status = ps_text_check(&text, error);
    snprintf(out->text, sizeof out->text, "%s", ps_text_string(&text));
    ps_text_free(&text);
    return status;
}

/* Every member comes to the same sentence. */
static pspec_status compare(const alike *all, size_t num, ps_error *error) {
    for (size_t i = 1; i < num; i++) {
        const char *a = all[0].text;
        const char *b = all[i].text;
        while (*a == *b && *a != '\0') {
            a++;
            b++;
        }
        while (a > all[0].text && a[-1] != '\n') { /* the line that differs */
            a--;
            b--;
        }
        if (strcmp(a, b) != 0) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "rank %zu has \"%.*s\", and rank 0 \"%.*s\": what they compute would "
                           "not be one result",
                           i, (int)strcspn(b, "\n"), b, (int)strcspn(a, "\n"), a);
        }
    }
    return PSPEC_OK;
}

static pspec_status meet_first(ps_row_stream *self, ps_error *error) {
    const ps_team *const team = self->team;
    alike *all = NULL;
    PS_TRY(PS_NEW(&all, team->num, "members of a team", error));
    pspec_status status = describe(self, &all[team->own], error);
    if (status == PSPEC_OK) {
        status = team->exchange(team, PSPEC_OK, all, sizeof *all, error);
    }
    if (status == PSPEC_OK) {
        status = compare(all, team->num, error);
    }
    free(all);
    self->has_met = status == PSPEC_OK;
    return status;
}

static size_t numbers_bytes(const ps_row_stream *self) {
    return self->num_largest * sizeof(double);
}

/* Deals the realizations of this round, in the order of the members: as many as they may have, or
 * in these proportions where there are fewer. Returns how many they are. */
static uint64_t deal_round(const ps_row_stream *self, uint64_t most) {
    const size_t num = self->team->num;
    const uint64_t *const wanted = self->shares;
    uint64_t *const given = self->shares + num;
    uint64_t all = 0;
    uint64_t dealt = 0;
    for (size_t i = 0; i < num; i++) {
        all += wanted[i];
    }
    const double part = most < all ? (double)most / (double)all : 1;
    uint64_t sum = 0;
    for (size_t i = 0; i < num; i++) { /* up to a place: nothing is left over by rounding */
        sum += wanted[i];
        const uint64_t end = i + 1 < num ? (uint64_t)(part * (double)sum) : most < all ? most : all;
        given[i] = end - dealt;
        dealt = end;
    }
    return dealt;
}

/* Of those members before this one, with it. */
static uint64_t count_before(const ps_row_stream *self, size_t end) {
    const uint64_t *const given = self->shares + self->team->num;
    uint64_t num = 0;
    for (size_t i = 0; i < end; i++) {
        num += given[i];
    }
    return num;
}

static pspec_status fill_slot(ps_row_stream *self, char *own, ps_error *error) {
    const ps_team *const team = self->team;
    const uint64_t before = self->first + count_before(self, team->own);
    const uint64_t share = self->shares[team->num + team->own];
    char *const rows = own + sizeof(slot) + numbers_bytes(self);
    const double begun = ps_clock_seconds();
    size_t num = 0;
    PS_TRY(ps_rows_pass_to(self, self->num_done + before, error));
    PS_TRY(ps_rows_make(self, (size_t)share, rows, &num, error));
    const slot head = {num, ps_clock_seconds() - begun};
    memcpy(own, &head, sizeof head);
    return self->measure != NULL
               ? self->measure(self->job, (double *)(void *)(own + sizeof(slot)), error)
               : PSPEC_OK;
}

/* How many realizations the member may have until all meet again. No result depends on it. */
static void choose_share(ps_row_stream *self, size_t member, double seconds) {
    const size_t num = self->team->num;
    uint64_t *const wanted = &self->shares[member];
    const uint64_t given = self->shares[num + member];
    const double fit = (double)MOST_BYTES / (double)(num * self->row_bytes);
    const double growth = ROUND_SECONDS / (seconds > 0 ? seconds : ROUND_SECONDS / MOST_GROWTH);
    const double share = (double)given * (growth < MOST_GROWTH ? growth : MOST_GROWTH);
    if (given < *wanted) {
        return; /* there were no more */
    }
    *wanted = (uint64_t)(share < fit ? share : fit);
    *wanted = *wanted > 0 ? *wanted : 1;
}

/* Rows of all members, in their order. */
static size_t take_rows(ps_row_stream *self, size_t slot_bytes) {
    size_t num = 0;
    for (size_t i = 0; i < self->team->num; i++) {
        const char *const at = self->slots + i * slot_bytes;
        slot head;
        memcpy(&head, at, sizeof head);
        memcpy(self->rows + num * self->row_bytes, at + sizeof head + numbers_bytes(self),
               head.num * self->row_bytes);
        choose_share(self, i, head.seconds);
        num += head.num;
    }
    return num;
}

static void take_largest(ps_row_stream *self, size_t slot_bytes) {
    double *const all = (double *)(void *)(self->slots + sizeof(slot));
    for (size_t i = 1; i < self->team->num; i++) {
        const double *const other =
            (const double *)(const void *)(self->slots + i * slot_bytes + sizeof(slot));
        for (size_t n = 0; n < self->num_largest; n++) {
            all[n] = ps_larger(all[n], other[n]);
        }
    }
    if (self->num_largest > 0) {
        self->take_largest(self->job, all);
    }
}

static uint64_t find_largest_share(const ps_row_stream *self) {
    const uint64_t *const given = self->shares + self->team->num;
    uint64_t largest = 0;
    for (size_t i = 0; i < self->team->num; i++) {
        largest = given[i] > largest ? given[i] : largest;
    }
    return largest;
}

static pspec_status next_of_team(ps_row_stream *self, uint64_t most, size_t *num, ps_error *error) {
    const ps_team *const team = self->team;
    const uint64_t round = deal_round(self, most);
    const size_t share = (size_t)find_largest_share(self);
    const size_t bytes = sizeof(slot) + numbers_bytes(self) + share * self->row_bytes;
    const size_t slot_bytes = (bytes + sizeof(double) - 1) / sizeof(double) * sizeof(double);
    *num = 0;
    if (round == 0) {
        return PSPEC_OK;
    }
    PS_TRY(self->has_met ? PSPEC_OK : meet_first(self, error));
    PS_TRY(ps_rows_make_slots(self, team->num * slot_bytes, error));
    PS_TRY(ps_rows_make_room(self, (size_t)round, error));
    PS_TRY(fill_slot(self, self->slots + team->own * slot_bytes, error));
    PS_TRY(team->exchange(team, PSPEC_OK, self->slots, slot_bytes, error));
    *num = take_rows(self, slot_bytes);
    take_largest(self, slot_bytes);
    return PSPEC_OK;
}

pspec_status ps_row_stream_next(ps_row_stream *stream, uint64_t most, size_t *num,
                                ps_error *error) {
    const uint64_t left = stream->end - stream->first - stream->num_done;
    const uint64_t wanted = most < left ? most : left;
    const size_t batch = wanted < stream->batch ? (size_t)wanted : stream->batch;
    *num = 0;
    if (ps_rows_are_played(stream)) {
        PS_TRY(ps_rows_play(stream, batch, num, error));
    } else if (stream->team != NULL) {
        PS_TRY(next_of_team(stream, wanted, num, error));
    } else if (batch > 0) {
        PS_TRY(ps_rows_pass_to(stream, stream->first + stream->num_done, error));
        PS_TRY(ps_rows_make_room(stream, batch, error));
        PS_TRY(stream->make(stream->job, stream->position, batch, stream->rows, num, error));
        stream->position += *num;
        stream->has_ended = *num == 0;
    }
    PS_TRY(ps_rows_keep(stream, *num, error));
    PS_TRY(stream->keeps && *num == 0 ? ps_rows_end_keeping(stream, error) : PSPEC_OK);
    stream->num_done += *num;
    return PSPEC_OK;
}
