#include "base/memory.h"
#include "files/output_file.h"
#include "fields/table_rows.h"

#include <stdlib.h>
#include <string.h>

struct ps_table_stream {
    const ps_table *table;
    const char *path;
    ps_table_format format;
    ps_output_file *file; /* standard output, or NULL: all of it at the end */
    size_t num_shown;     /* rows */
};

pspec_status ps_table_stream_open(ps_table_stream **out, const ps_table *table, const char *path,
                                  ps_table_format format, ps_error *error) {
    *out = NULL;
    ps_table_stream *stream = NULL;
    PS_TRY(PS_NEW(&stream, 1, "table", error));
    *stream = (ps_table_stream){.table = table, .path = path, .format = format};
    *out = stream;
    if (format == PS_FORMAT_CSV && strcmp(path, "-") == 0) {
        const pspec_status status = ps_output_open(&stream->file, path, error);
        if (status != PSPEC_OK) {
            ps_table_stream_discard(out);
            return status;
        }
        ps_table_write_csv_head(table, ps_output_stream(stream->file));
    }
    return PSPEC_OK;
}

pspec_status ps_table_stream_update(ps_table_stream *stream, ps_error *error) {
    if (stream->file == NULL) {
        return PSPEC_OK;
    }
    ps_table_write_csv_rows(stream->table, stream->num_shown, ps_output_stream(stream->file));
    stream->num_shown = stream->table->num_rows;
    return ps_output_check(stream->file, error);
}

pspec_status ps_table_stream_close(ps_table_stream **stream, ps_error *error) {
    ps_table_stream *self = *stream;
    pspec_status status = ps_table_stream_update(self, error);
    if (status == PSPEC_OK) {
        status = self->file != NULL ? ps_output_commit(&self->file, error)
                                    : ps_table_write(self->table, self->path, self->format, error);
    }
    ps_table_stream_discard(stream);
    return status;
}

void ps_table_stream_discard(ps_table_stream **stream) {
    if (*stream != NULL) {
        ps_output_discard(&(*stream)->file);
        free(*stream);
        *stream = NULL;
    }
}
