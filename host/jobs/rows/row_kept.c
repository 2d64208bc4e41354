/* Rows of a stream that a tape keeps, or gives. */
#include "jobs/rows/row_stream_private.h"

#include <string.h>

/* ---- rows that are kept ---------------------------------------------------------------------- */

bool ps_rows_are_played(const ps_row_stream *self) {
    return self->tape != NULL && self->tape->is_played;
}

bool ps_rows_are_ranged(const ps_row_stream *self) {
    return self->tape != NULL && !self->is_whole;
}

static pspec_status find_track(const ps_row_stream *self, ps_row_track **out, ps_error *error) {
    PS_TRY(ps_row_tape_track(out, self->tape, self->part, error));
    (*out)->row_bytes = self->row_bytes;
    (*out)->is_whole = self->is_whole;
    return PSPEC_OK;
}

/* Those of realizations before num_done are there, of a checkpoint. */
pspec_status ps_rows_keep(ps_row_stream *self, size_t num, ps_error *error) {
    ps_row_track *track = NULL;
    if (!self->keeps) {
        return PSPEC_OK;
    }
    PS_TRY(find_track(self, &track, error));
    track->num = self->num_done;
    return ps_row_track_add(track, self->rows, num, error);
}

/* Files say at their end how many realizations there are. */
static pspec_status count_all(ps_row_stream *self, uint64_t *all, ps_error *error) {
    uint64_t behind = 0;
    if (self->total == 0 && !self->has_ended) {
        PS_TRY(self->pass(self->job, UINT64_MAX, &behind, error));
        self->has_ended = true;
    }
    *all = self->total > 0 ? self->total : self->position + behind;
    return ps_rows_are_ranged(self) && !self->is_clipped
               ? ps_range_check_end(&self->tape->range, *all, self->are_sampled, error)
               : PSPEC_OK;
}

pspec_status ps_rows_end_keeping(ps_row_stream *self, ps_error *error) {
    ps_row_track *track = NULL;
    PS_TRY(find_track(self, &track, error));
    PS_TRY(count_all(self, &track->all, error));
    return self->measure != NULL ? self->measure(self->job, track->largest, error) : PSPEC_OK;
}

pspec_status ps_row_stream_walk(ps_row_stream *stream, ps_snapshot *snapshot, ps_error *error) {
    ps_row_track *track = NULL;
    if (stream->tape == NULL || stream->tape->is_played) {
        return PSPEC_OK;
    }
    PS_TRY(find_track(stream, &track, error));
    uint64_t counts[] = {track->num, track->all};
    PS_TRY(ps_snapshot_counts(snapshot, "kept", counts, 2, error));
    PS_TRY(ps_snapshot_doubles(snapshot, "kept_largest", track->largest, PS_MOST_LARGEST, error));
    const uint64_t num = counts[0];
    if (ps_snapshot_is_read(snapshot)) {
        track->num = 0;
        track->all = counts[1];
        PS_TRY(ps_row_track_add(track, NULL, num, error));
    }
    return ps_snapshot_bytes(snapshot, "kept_rows", track->rows, (size_t)(num * track->row_bytes),
                             error);
}

/* ---- rows that are played -------------------------------------------------------------------- */

pspec_status ps_rows_begin_playing(ps_row_stream *self, ps_error *error) {
    const ps_row_track *const track = ps_row_tape_find(self->tape, self->part);
    if (track == NULL || track->row_bytes != self->row_bytes || track->is_whole != self->is_whole) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "the rows of job %u of the command are missing, or of another program",
                       self->part + 1);
    }
    return self->keeps_first ? ps_rows_pass_to(self, self->first, error) : PSPEC_OK;
}

/* What the first realization leaves beside its row. */
static pspec_status make_first(ps_row_stream *self, ps_error *error) {
    size_t num = 0;
    return self->keeps_first && self->num_done == 0
               ? self->make(self->job, self->position, 1, self->rows, &num, error)
               : PSPEC_OK;
}

pspec_status ps_rows_play(ps_row_stream *self, uint64_t most, size_t *num, ps_error *error) {
    const ps_row_track *const track = ps_row_tape_find(self->tape, self->part);
    const uint64_t left = track->num - self->num_done;
    *num = (size_t)(left < most ? left : most);
    if (*num > 0) {
        PS_TRY(ps_rows_make_room(self, *num, error));
        PS_TRY(make_first(self, error));
        memcpy(self->rows, track->rows + self->num_done * self->row_bytes, *num * self->row_bytes);
    } else if (self->num_largest > 0) {
        self->take_largest(self->job, track->largest);
    }
    return PSPEC_OK;
}
