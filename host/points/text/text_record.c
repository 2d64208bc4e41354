/* Rows that take several lines, for a text in quotes may have line breaks. */
#include "points/text/points_text.h"
#include "points/text/text_fields.h"

#include <string.h>

static bool is_open(const char *line, char separator) {
    ps_field field = {.text = line};
    bool is_more = true;
    if (memchr(line, '"', strcspn(line, "\n")) == NULL) {
        return false;
    }
    while (ps_field_next(&line, separator, &is_more, &field)) {
    }
    return field.is_open;
}

pspec_status ps_text_join(ps_text_state *state, size_t num_after, ps_error *error) {
    enum { MOST_LINES = 1000 }; /* of a row: more than a text in a table has */
    ps_lines *const lines = &state->lines;
    const char *line = ps_lines_after(lines, num_after);
    const char *next = line;
    size_t num = 0;
    for (; line < lines->lines_end && is_open(line, state->separator); num++) {
        if (ps_lines_after(lines, num_after + 1) == lines->lines_end) {
            PS_TRY(ps_lines_peek(lines, num_after + 1, &next, error));
        }
        if (next == NULL || num == MOST_LINES) {
            return ps_fail(
                error, PSPEC_ERROR_INPUT,
                "%s, line %zu: a quote begins a column, and none closes it within %d lines",
                lines->input->name, lines->line_number + num_after, (int)MOST_LINES);
        }
        line = ps_lines_after(lines, num_after); /* it may have moved */
        lines->buffer[strcspn(line, "\n") + (size_t)(line - lines->buffer)] = ' ';
    }
    lines->line_number += num;
    return PSPEC_OK;
}
