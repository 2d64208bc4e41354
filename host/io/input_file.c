#include "io/input_file.h"

#include "base/memory.h"
#include "io/decimal.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Large enough that system calls do not show, small enough to stay in the cache. */
enum { BUFFER_BYTES = 1 << 20 };

pspec_status ps_input_fail(const char *name, ps_error *error) {
    const int reason = errno;
    return ps_fail(error, reason == EINTR ? PSPEC_ERROR_CANCELLED : PSPEC_ERROR_IO,
                   "cannot read %s: %s", name, strerror(reason));
}

/* Standard input is read through a copy of its descriptor, so that closing it is ours to do. */
static FILE *open_stream(const char *path) {
    if (strcmp(path, "-") != 0) {
        return fopen(path, "rb");
    }
    const int copy = dup(STDIN_FILENO);
    FILE *stream = copy >= 0 ? fdopen(copy, "rb") : NULL;
    if (copy >= 0 && stream == NULL) {
        close(copy);
    }
    return stream;
}

static pspec_status check_stream(ps_input *input, ps_error *error) {
    struct stat facts;
    errno = 0;
    if (fstat(fileno(input->stream), &facts) == 0 && S_ISDIR(facts.st_mode)) {
        errno = EISDIR;
        return ps_input_fail(input->name, error);
    }
    setvbuf(input->stream, NULL, _IONBF, 0);
    input->first_byte = getc(input->stream);
    if (input->first_byte == EOF) {
        return ferror(input->stream)
                   ? ps_input_fail(input->name, error)
                   : ps_fail(error, PSPEC_ERROR_INPUT, "%s is empty", input->name);
    }
    return PSPEC_OK;
}

pspec_status ps_input_open(ps_input *input, const char *path, ps_error *error) {
    *input = (ps_input){0};
    input->name = strdup(strcmp(path, "-") == 0 ? "standard input" : path);
    if (input->name == NULL) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for a file name");
    }
    input->stream = open_stream(path);
    const pspec_status status =
        input->stream != NULL ? check_stream(input, error) : ps_input_fail(input->name, error);
    if (status != PSPEC_OK) {
        ps_input_close(input);
    }
    return status;
}

void ps_input_close(ps_input *input) {
    if (input->stream != NULL) {
        fclose(input->stream);
    }
    free(input->name);
    *input = (ps_input){0};
}

pspec_status ps_lines_open(ps_lines *lines, const ps_input *input, ps_error *error) {
    *lines = (ps_lines){.input = input, .line_number = 1};
    void *buffer = NULL;
    PS_TRY(ps_allocate(&buffer, BUFFER_BYTES + PS_DECIMAL_PADDING, 1, "input buffer", error));
    lines->buffer = buffer;
    lines->buffer[0] = (char)input->first_byte;
    lines->num_bytes = 1;
    lines->cursor = lines->lines_end = lines->buffer;
    return PSPEC_OK;
}

void ps_lines_close(ps_lines *lines) {
    free(lines->buffer);
    *lines = (ps_lines){0};
}

/* Moves what is left to the start of the buffer. */
static void make_room(ps_lines *lines) {
    const size_t used = (size_t)(lines->cursor - lines->buffer);
    lines->num_bytes -= used;
    memmove(lines->buffer, lines->cursor, lines->num_bytes);
    lines->cursor = lines->lines_end = lines->buffer;
}

/* Looks for the last '\n' in the bytes from first on. */
static void find_lines(ps_lines *lines, size_t first) {
    for (size_t i = lines->num_bytes; i > first; i--) {
        if (lines->buffer[i - 1] == '\n') {
            lines->lines_end = lines->buffer + i;
            return;
        }
    }
}

static void end_last_line(ps_lines *lines) {
    lines->is_at_end = true;
    if (lines->num_bytes > 0) {
        lines->buffer[lines->num_bytes++] = '\n';
        lines->lines_end = lines->buffer + lines->num_bytes;
    }
}

pspec_status ps_lines_fill(ps_lines *lines, bool *has_line, ps_error *error) {
    if (lines->cursor == lines->lines_end && !lines->is_at_end) {
        make_room(lines);
        find_lines(lines, 0); /* the first byte of the input may be a whole line */
    }
    while (lines->cursor == lines->lines_end && !lines->is_at_end) {
        if (lines->num_bytes == BUFFER_BYTES - 1) { /* one byte is kept for a missing '\n' */
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "%s, line %zu: no end of line within %d bytes; is this a text file?",
                           lines->input->name, lines->line_number, BUFFER_BYTES - 1);
        }
        const size_t first = lines->num_bytes;
        const ssize_t count =
            read(fileno(lines->input->stream), lines->buffer + first, BUFFER_BYTES - 1 - first);
        if (count < 0) {
            return ps_input_fail(lines->input->name, error);
        }
        lines->num_bytes += (size_t)count;
        find_lines(lines, first);
        if (count == 0) {
            end_last_line(lines);
        }
    }
    *has_line = lines->cursor != lines->lines_end;
    return PSPEC_OK;
}

const char *ps_token_show(char shown[PS_TOKEN_BYTES], const char *text, size_t length) {
    enum { LONGEST = 4, SHOWN = 30 }; /* one byte may become "\xHH"; 30 tell which token it was */
    size_t used = 0;
    const size_t count = length < SHOWN ? length : SHOWN;
    for (size_t i = 0; i < count && used + LONGEST < PS_TOKEN_BYTES - 4; i++) {
        const unsigned char byte = (unsigned char)text[i];
        const int is_printable = byte >= ' ' && byte < 0x7f;
        used += (size_t)snprintf(shown + used, PS_TOKEN_BYTES - used,
                                 is_printable ? "%c" : "\\x%02x", byte);
    }
    snprintf(shown + used, PS_TOKEN_BYTES - used, "%s", count < length ? "..." : "");
    return shown;
}
