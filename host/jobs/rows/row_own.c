/* What a member of a stream does by itself. */
#include "jobs/rows/row_stream_private.h"

#include "base/memory.h"

#include <stdlib.h>

/* ---- memory ---------------------------------------------------------------------------------- */

static pspec_status reserve(void *memory, size_t *room, size_t num, size_t bytes, const char *what,
                            ps_error *error) {
    char **const block = memory;
    if (num <= *room) {
        return PSPEC_OK;
    }
    free(*block);
    *block = NULL;
    *room = 0;
    PS_TRY(ps_allocate_for(block, num, bytes, what, error));
    *room = num;
    return PSPEC_OK;
}

pspec_status ps_rows_make_room(ps_row_stream *self, size_t num, ps_error *error) {
    return reserve(&self->rows, &self->room, num, self->row_bytes, "rows of realizations", error);
}

pspec_status ps_rows_make_slots(ps_row_stream *self, size_t bytes, ps_error *error) {
    return reserve(&self->slots, &self->slots_room, bytes, 1, "rows of members", error);
}

void ps_row_stream_free(ps_row_stream *stream) {
    free(stream->rows);
    free(stream->slots);
    free(stream->shares);
    stream->rows = stream->slots = NULL;
    stream->shares = NULL;
    stream->room = stream->slots_room = 0;
}

/* ---- realizations ---------------------------------------------------------------------------- */

pspec_status ps_rows_pass_to(ps_row_stream *self, uint64_t position, ps_error *error) {
    const uint64_t num = position - self->position;
    uint64_t passed = num;
    if (num == 0 || self->has_ended) {
        return PSPEC_OK;
    }
    PS_TRY(self->pass != NULL ? self->pass(self->job, num, &passed, error) : PSPEC_OK);
    self->position += passed;
    self->has_ended = passed < num;
    return PSPEC_OK;
}

pspec_status ps_rows_make(ps_row_stream *self, size_t wanted, char *rows, size_t *num,
                          ps_error *error) {
    for (*num = 0; *num < wanted && !self->has_ended;) {
        size_t some = 0;
        const size_t left = wanted - *num;
        PS_TRY(self->make(self->job, self->position, left < self->batch ? left : self->batch,
                          rows + *num * self->row_bytes, &some, error));
        self->position += some;
        self->has_ended = some == 0;
        *num += some;
    }
    return PSPEC_OK;
}
