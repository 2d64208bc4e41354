/* Inside of ps_row_stream, for the files row_*.c only. */
#ifndef PS_JOBS_ROWS_ROW_STREAM_PRIVATE_H
#define PS_JOBS_ROWS_ROW_STREAM_PRIVATE_H

#include "jobs/rows/row_stream.h"

/* ---- what a member does by itself (row_own.c) ---- */

/* Room for so many rows, and for so many bytes of slots. */
pspec_status ps_rows_make_room(ps_row_stream *self, size_t num, ps_error *error) PS_MUST_CHECK;
pspec_status ps_rows_make_slots(ps_row_stream *self, size_t bytes, ps_error *error) PS_MUST_CHECK;
/* This member passes over realizations up to that number. */
pspec_status ps_rows_pass_to(ps_row_stream *self, uint64_t position, ps_error *error) PS_MUST_CHECK;

/* Makes as many as are wanted, unless there are fewer. */
pspec_status ps_rows_make(ps_row_stream *self, size_t wanted, char *rows, size_t *num,
                          ps_error *error) PS_MUST_CHECK;

/* ---- what a tape keeps or gives (row_kept.c) ---- */

bool ps_rows_are_played(const ps_row_stream *self);
/* Are they those of a range? */
bool ps_rows_are_ranged(const ps_row_stream *self);
/* Keeps the num rows of the last call, where this stream does that, behind num_done. */
pspec_status ps_rows_keep(ps_row_stream *self, size_t num, ps_error *error) PS_MUST_CHECK;
/* Behind the last. */
pspec_status ps_rows_end_keeping(ps_row_stream *self, ps_error *error) PS_MUST_CHECK;
pspec_status ps_rows_begin_playing(ps_row_stream *self, ps_error *error) PS_MUST_CHECK;
/* As ps_row_stream_next. */
pspec_status ps_rows_play(ps_row_stream *self, uint64_t most, size_t *num,
                          ps_error *error) PS_MUST_CHECK;

#endif
