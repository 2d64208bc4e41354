/* Lines of a text input, and the numbers in them. */
#ifndef PS_FILES_TEXT_LINES_H
#define PS_FILES_TEXT_LINES_H

#include "files/input_file.h"

/* The text between cursor and lines_end is whole lines, each with its '\n' (added to the last line
 * when missing), so that parsers need no other limit. */
typedef struct ps_lines {
    ps_input *input;
    char *buffer;
    const char *cursor;    /* the caller moves it past each line it has read */
    const char *lines_end; /* end of the last whole line */
    size_t num_bytes;      /* of buffer in use */
    size_t capacity;       /* of buffer, without the padding behind it */
    bool wants_more;       /* the last read filled the buffer */
    size_t line_number;    /* of the line at cursor, counted from 1; the caller counts */
    bool is_at_end;
    bool has_begun; /* the first line was there */
} ps_lines;

pspec_status ps_lines_open(ps_lines *lines, ps_input *input, ps_error *error) PS_MUST_CHECK;
void ps_lines_close(ps_lines *lines);

/* Makes at least one whole line available at cursor; *has_line is false at the end of the input.
 * Pointers into the buffer do not survive this call. */
pspec_status ps_lines_fill(ps_lines *lines, bool *has_line, ps_error *error) PS_MUST_CHECK;

/* The line that comes num_after lines after the one at cursor, which must be there; NULL when there
 * is none, or none that fits the buffer. Pointers into the buffer do not survive this call. */
pspec_status ps_lines_peek(ps_lines *lines, size_t num_after, const char **line,
                           ps_error *error) PS_MUST_CHECK;

/* The same among the lines that are there; lines_end when it is none of them. */
const char *ps_lines_after(const ps_lines *lines, size_t num_after);

/* Moves cursor past the line at it. */
void ps_lines_skip(ps_lines *lines);

/* PSPEC_ERROR_INPUT with a sentence about the line at cursor, "FILE, line 3: ...". */
pspec_status ps_lines_fail(const ps_lines *lines, ps_error *error, const char *format, ...)
    PS_PRINTF(3, 4);

/* ---- tokens ---- */

/* Past blanks and tabs. */
static inline const char *ps_skip_blanks(const char *text) {
    while (*text == ' ' || *text == '\t') {
        text++;
    }
    return text;
}

/* Is this the end of a line, "\n" or "\r\n"? */
static inline bool ps_ends_line(const char *text) {
    return *text == '\n' || (text[0] == '\r' && text[1] == '\n');
}

/* Characters up to a blank, a comma, a semicolon or the end of the line. */
size_t ps_token_length(const char *text);

/* Is the token at text one of these words, which bars separate? */
bool ps_token_is_one_of(const char *text, const char *words);

/* The token at text, made printable and shortened for a message. */
enum { PS_TOKEN_BYTES = 128 };
const char *ps_token_show(char shown[PS_TOKEN_BYTES], const char *text, size_t length);

/* Is the token a number that is not finite ("nan", "-inf"), in strtod's words? */
bool ps_token_is_not_finite(const char *token, size_t length);

/* ---- rows ---- */

/* Reads the whole line at text as num_columns numbers, separated by blanks (separator ' ') or by
 * one comma or semicolon each, blanks allowed. Returns the '\n', or NULL when the line is anything
 * else. */
const char *ps_row_parse(const char *text, char separator, size_t num_columns, double *row);

/* Counts the numbers between blanks of a line that has nothing else, 0: it has; the first `most` of
 * them go to row. are_whole: these have only digits. */
size_t ps_line_numbers(const char *line, bool are_whole, size_t most, double *row);

/* Counts the columns of the line at cursor; a token that is no number is an error. */
pspec_status ps_row_count(const ps_lines *lines, char separator, size_t *num_columns,
                          ps_error *error) PS_MUST_CHECK;

#endif
