/* Tables whose rows come over minutes: as CSV on standard output every row is there as soon as it
 * is known. Files, and other formats, are written at the end, as ps_table_write does. */
#ifndef PS_TABLES_TABLE_STREAM_H
#define PS_TABLES_TABLE_STREAM_H

#include "tables/table.h"

typedef struct ps_table_stream ps_table_stream;

/* The table has its header lines; it belongs to the caller and stays until the stream is closed or
 * discarded. */
pspec_status ps_table_stream_open(ps_table_stream **out, const ps_table *table, const char *path,
                                  ps_table_format format, ps_error *error) PS_MUST_CHECK;
/* Shows the rows that were added since. */
pspec_status ps_table_stream_update(ps_table_stream *stream, ps_error *error) PS_MUST_CHECK;
/* Writes what is left. The handle is freed in every case and *stream set to NULL. */
pspec_status ps_table_stream_close(ps_table_stream **stream, ps_error *error) PS_MUST_CHECK;
/* A NULL handle is allowed. */
void ps_table_stream_discard(ps_table_stream **stream);

#endif
