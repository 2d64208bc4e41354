/* Opening what is read: a file or standard input, with the refusals that are the same for both. */
#ifndef PS_IO_INPUT_FILE_H
#define PS_IO_INPUT_FILE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* {0} is closed. The stream has no buffer: readers bring larger ones, and input from a pipe can be
 * taken as it comes. first_byte was read already and shows the format. */
typedef struct ps_input {
    FILE *stream;
    char *name; /* for messages */
    int first_byte;
} ps_input;

/* Opens path, or standard input for "-". Folders and empty files are refused. */
pspec_status ps_input_open(ps_input *input, const char *path, ps_error *error) PS_MUST_CHECK;
void ps_input_close(ps_input *input);

/* Records that reading name failed, as errno says; an interruption is PSPEC_ERROR_CANCELLED, so
 * that whoever installed the signal handler decides (SA_RESTART or not) whether reads go on. */
pspec_status ps_input_fail(const char *name, ps_error *error);

/* Lines of a text input. The text between cursor and lines_end is whole lines, each with its '\n'
 * (added to the last line when missing), so that parsers need no other limit. */
typedef struct ps_lines {
    const ps_input *input;
    char *buffer;
    const char *cursor;    /* the caller moves it past each line it has read */
    const char *lines_end; /* end of the last whole line */
    size_t num_bytes;      /* of buffer in use */
    size_t line_number;    /* of the line at cursor, counted from 1; the caller counts */
    bool is_at_end;
} ps_lines;

pspec_status ps_lines_open(ps_lines *lines, const ps_input *input, ps_error *error) PS_MUST_CHECK;
void ps_lines_close(ps_lines *lines);
/* Makes at least one whole line available at cursor; *has_line is false at the end of the input.
 * Pointers into the buffer do not survive this call. */
pspec_status ps_lines_fill(ps_lines *lines, bool *has_line, ps_error *error) PS_MUST_CHECK;

/* The token at text, up to a separator, made printable and shortened for a message. */
enum { PS_TOKEN_BYTES = 128 };
const char *ps_token_show(char shown[PS_TOKEN_BYTES], const char *text, size_t length);

#endif
