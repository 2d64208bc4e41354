#include "files/text_lines.h"

#include "base/text.h"
#include "base/memory.h"
#include "files/decimal.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* The buffer grows with its input: small files are many, and of a large one several threads share a
 * part that stays in their cache. */
enum { FIRST_BYTES = 1 << 16, MOST_BYTES = 1 << 22, GROWTH = 8 };

/* ---- lines ------------------------------------------------------------------------------- */

pspec_status ps_lines_open(ps_lines *lines, ps_input *input, ps_error *error) {
    *lines = (ps_lines){.input = input, .line_number = 1, .capacity = FIRST_BYTES};
    PS_TRY(PS_NEW(&lines->buffer, FIRST_BYTES + PS_DECIMAL_PADDING, "text buffer", error));
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
    lines->lines_end -= used;
    lines->cursor = lines->buffer;
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
    if (lines->num_bytes > 0 && lines->buffer[lines->num_bytes - 1] != '\n') {
        lines->buffer[lines->num_bytes++] = '\n';
    }
    lines->lines_end = lines->buffer + lines->num_bytes;
}

/* One byte is kept for a missing '\n'. */
static size_t free_bytes(const ps_lines *lines) {
    return lines->capacity - 1 - lines->num_bytes;
}

static bool is_full(const ps_lines *lines) {
    return free_bytes(lines) == 0 && lines->capacity >= MOST_BYTES;
}

static pspec_status grow(ps_lines *lines, ps_error *error) {
    const size_t capacity = lines->capacity * GROWTH;
    char *const larger = realloc(lines->buffer, capacity + PS_DECIMAL_PADDING);
    if (larger == NULL) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for a text buffer");
    }
    memset(larger + lines->capacity, 0, capacity + PS_DECIMAL_PADDING - lines->capacity);
    lines->cursor = larger + (lines->cursor - lines->buffer);
    lines->lines_end = larger + (lines->lines_end - lines->buffer);
    lines->buffer = larger;
    lines->capacity = capacity;
    return PSPEC_OK;
}

static pspec_status read_more(ps_lines *lines, ps_error *error) {
    if ((lines->wants_more || free_bytes(lines) == 0) && lines->capacity < MOST_BYTES) {
        PS_TRY(grow(lines, error));
    }
    const size_t first = lines->num_bytes;
    const size_t room = free_bytes(lines);
    size_t count = 0;
    PS_TRY(ps_input_read_some(lines->input, lines->buffer + first, room, &count, error));
    lines->wants_more = count == room; /* there would have been more */
    lines->num_bytes += count;
    find_lines(lines, first);
    if (count == 0) {
        end_last_line(lines);
    }
    return PSPEC_OK;
}

/* Editors of Windows begin texts with U+FEFF. A line of three bytes is there, with its end. */
static void skip_byte_order_mark(ps_lines *lines) {
    static const char mark[] = {'\xef', '\xbb', '\xbf'};
    if (lines->lines_end - lines->cursor > (ptrdiff_t)sizeof mark &&
        memcmp(lines->cursor, mark, sizeof mark) == 0) {
        lines->cursor += sizeof mark;
    }
}

pspec_status ps_lines_fill(ps_lines *lines, bool *has_line, ps_error *error) {
    if (lines->cursor == lines->lines_end && !lines->is_at_end) {
        make_room(lines);
    }
    while (lines->cursor == lines->lines_end && !lines->is_at_end) {
        if (is_full(lines)) {
            return ps_lines_fail(lines, error,
                                 "no end of line within %d bytes; is this a text file?",
                                 MOST_BYTES - 1);
        }
        PS_TRY(read_more(lines, error));
    }
    *has_line = lines->cursor != lines->lines_end;
    if (!lines->has_begun && *has_line) {
        lines->has_begun = true;
        skip_byte_order_mark(lines);
    }
    return PSPEC_OK;
}

const char *ps_lines_after(const ps_lines *lines, size_t num_after) {
    const char *line = lines->cursor;
    for (size_t i = 0; i < num_after && line < lines->lines_end; i++) {
        line = (const char *)memchr(line, '\n', (size_t)(lines->lines_end - line)) + 1;
    }
    return line;
}

pspec_status ps_lines_peek(ps_lines *lines, size_t num_after, const char **line, ps_error *error) {
    make_room(lines);
    *line = NULL;
    while (ps_lines_after(lines, num_after) == lines->lines_end && !lines->is_at_end &&
           !is_full(lines)) {
        PS_TRY(read_more(lines, error));
    }
    const char *const found = ps_lines_after(lines, num_after);
    *line = found < lines->lines_end ? found : NULL;
    return PSPEC_OK;
}

void ps_lines_skip(ps_lines *lines) {
    lines->cursor =
        (const char *)memchr(lines->cursor, '\n', (size_t)(lines->lines_end - lines->cursor)) + 1;
    lines->line_number++;
}

pspec_status ps_lines_fail(const ps_lines *lines, ps_error *error, const char *format, ...) {
    char what[PS_MESSAGE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s, line %zu: %s", lines->input->name,
                   lines->line_number, what);
}

/* ---- tokens ------------------------------------------------------------------------------ */

size_t ps_token_length(const char *text) {
    size_t length = 0;
    while (text[length] != ' ' && text[length] != '\t' && text[length] != ',' &&
           text[length] != ';' && !ps_ends_line(text + length)) {
        length++;
    }
    return length;
}

bool ps_token_is_one_of(const char *text, const char *words) {
    return ps_text_find_word(text, ps_token_length(text), words) >= 0;
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

bool ps_token_is_not_finite(const char *token, size_t length) {
    static const char *const words[] = {"nan", "inf", "infinity"};
    const size_t sign = length > 0 && (*token == '-' || *token == '+');
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (length - sign == strlen(words[i]) &&
            strncasecmp(token + sign, words[i], length - sign) == 0) {
            return true;
        }
    }
    return false;
}

/* ---- rows -------------------------------------------------------------------------------- */

static bool ends_number(const char *text, char separator) {
    return *text == ' ' || *text == '\t' || *text == separator || ps_ends_line(text);
}

const char *ps_row_parse(const char *text, char separator, size_t num_columns, double *row) {
    for (size_t i = 0; i < num_columns; i++) {
        text = ps_skip_blanks(text);
        if (separator != ' ' && i > 0) {
            if (*text != separator) {
                return NULL;
            }
            text = ps_skip_blanks(text + 1);
        }
        text = ps_decimal_parse(text, &row[i]);
        if (text == NULL || !ends_number(text, separator)) {
            return NULL;
        }
    }
    text = ps_skip_blanks(text);
    text += *text == '\r';
    return *text == '\n' ? text : NULL;
}

size_t ps_line_numbers(const char *line, bool are_whole, size_t most, double *row) {
    size_t num = 0;
    double value = 0;
    for (line = ps_skip_blanks(line); !ps_ends_line(line); line = ps_skip_blanks(line)) {
        const size_t length = ps_token_length(line);
        if (length == 0 || ps_decimal_parse(line, &value) != line + length ||
            (are_whole && strspn(line, "0123456789") != length)) {
            return 0;
        }
        if (num < most) {
            row[num] = value;
        }
        num++;
        line += length;
    }
    return num;
}

pspec_status ps_row_count(const ps_lines *lines, char separator, size_t *num_columns,
                          ps_error *error) {
    const char *text = ps_skip_blanks(lines->cursor);
    bool needs_number = true;
    *num_columns = 0;
    while (needs_number || !ps_ends_line(text)) {
        double value = 0;
        const size_t length = ps_token_length(text);
        if (length == 0 && separator == ';' && *text == ',') {
            return ps_lines_fail(lines, error,
                                 "a comma in a number; decimals are written with a point");
        }
        if (length == 0 || ps_decimal_parse(text, &value) != text + length) {
            char shown[PS_TOKEN_BYTES];
            ps_token_show(shown, text, length > 0 ? length : !ps_ends_line(text));
            return ps_lines_fail(lines, error, "\"%s\" is not a %snumber", shown,
                                 ps_token_is_not_finite(text, length) ? "finite " : "");
        }
        ++*num_columns;
        text = ps_skip_blanks(text + length);
        needs_number = separator != ' ' && *text == separator;
        text = needs_number ? ps_skip_blanks(text + 1) : text;
    }
    return PSPEC_OK;
}
