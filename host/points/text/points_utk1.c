/* Text of UTK 1: a first line "mpts2 2 n unit-tor", the same for every dimension, then rows as in
 * utk-text, sets between lines "#patch-separator". */
#include "points/text/points_text.h"

#include <string.h>

static pspec_status open_utk1(ps_point_reader *reader, ps_error *error) {
    static const char first_line[] = "mpts2 2 n unit-tor";
    ps_line_kind kind = PS_LINE_NONE;
    PS_TRY(ps_text_open_lines(reader, ' ', error));
    ps_text_state *const state = reader->state;
    const char *const line = state->lines.cursor;
    if (strncmp(line, first_line, sizeof first_line - 1) != 0 ||
        !ps_ends_line(ps_skip_blanks(line + sizeof first_line - 1))) {
        char shown[PS_TOKEN_BYTES];
        return ps_lines_fail(&state->lines, error,
                             "\"%s\", where UTK 1 has \"%s\"; without that line the rows "
                             "are utk-text",
                             ps_token_show(shown, line, strcspn(line, "\r\n")), first_line);
    }
    ps_lines_skip(&state->lines);
    PS_TRY(ps_text_next_line(state, &kind, error));
    return kind == PS_LINE_POINT
               ? ps_text_fix_columns(reader, error)
               : ps_fail(error, PSPEC_ERROR_INPUT, "%s holds no points", reader->input.name);
}

const ps_point_format ps_format_utk1 = {.name = "utk1",
                                        .magic = "mpts",
                                        .open = open_utk1,
                                        .read = ps_text_read,
                                        .close = ps_text_close};
