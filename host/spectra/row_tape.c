#include "spectra/row_tape.h"

#include "base/memory.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

ps_row_track *ps_row_tape_find(const ps_row_tape *tape, unsigned part) {
    for (size_t i = 0; i < tape->num; i++) {
        if (tape->tracks[i].part == part) {
            return &tape->tracks[i];
        }
    }
    return NULL;
}

pspec_status ps_row_tape_track(ps_row_track **out, ps_row_tape *tape, unsigned part,
                               ps_error *error) {
    void *tracks = tape->tracks;
    *out = ps_row_tape_find(tape, part);
    if (*out != NULL) {
        return PSPEC_OK;
    }
    PS_TRY(ps_grow(&tracks, &tape->room, tape->num + 1, sizeof *tape->tracks, "kept rows", error));
    tape->tracks = tracks;
    *out = &tape->tracks[tape->num++];
    **out = (ps_row_track){.part = part};
    return PSPEC_OK;
}

pspec_status ps_row_track_add(ps_row_track *track, const void *rows, uint64_t num,
                              ps_error *error) {
    void *all = track->rows;
    const size_t before = (size_t)(track->num * track->row_bytes);
    size_t bytes = 0;
    if (!ps_size_multiply((size_t)num, (size_t)track->row_bytes, &bytes) ||
        bytes > SIZE_MAX / 2 - before) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "%" PRIu64 " kept rows are too many", num);
    }
    PS_TRY(ps_grow(&all, &track->room, before + bytes, 1, "kept rows", error));
    track->rows = all;
    track->num += num;
    if (rows != NULL && bytes > 0) {
        memcpy(track->rows + before, rows, bytes);
    }
    return PSPEC_OK;
}

void ps_row_tape_free(ps_row_tape *tape) {
    for (size_t i = 0; i < tape->num; i++) {
        free(tape->tracks[i].rows);
    }
    free(tape->tracks);
    *tape = (ps_row_tape){0};
}
