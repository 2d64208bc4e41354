/* Text whose line breaks mean nothing. With the number of points at its beginning: psa-text (of
 * PSA, and GBN in the plane), "N" and then N times "x y" (or what else --columns says); gbn, "N d" and then N times
 * d numbers. What follows is ignored, as these tools do; one set per file. And tokens, the numbers
 * alone, as pbrt's pspec reads them, with '#' lines between sets. */
#include "base/memory.h"
#include "files/decimal.h"
#include "points/text/points_text.h"

#include <math.h>
#include <string.h>

/* The next number of the input; *length 0: there is none. Numbers may be anywhere in lines. */
static pspec_status next_number(ps_point_reader *reader, double *value, bool *has_number,
                                ps_error *error) {
    ps_lines *const lines = &((ps_text_state *)reader->state)->lines;
    bool has_line = true;
    *has_number = false;
    while (has_line && !*has_number) {
        PS_TRY(ps_lines_fill(lines, &has_line, error));
        if (!has_line) {
            break;
        }
        const char *const text = ps_skip_blanks(lines->cursor);
        if (ps_ends_line(text)) {
            ps_lines_skip(lines);
            continue;
        }
        const size_t length = ps_token_length(text);
        if (length == 0 || ps_decimal_parse(text, value) != text + length) {
            char shown[PS_TOKEN_BYTES];
            return ps_lines_fail(lines, error, "\"%s\" is not a %snumber",
                                 ps_token_show(shown, text, length > 0 ? length : 1),
                                 ps_token_is_not_finite(text, length) ? "finite " : "");
        }
        lines->cursor = text + length;
        *has_number = true;
    }
    return PSPEC_OK;
}

static pspec_status read_count(ps_point_reader *reader, const char *what, double largest,
                               size_t *count, ps_error *error) {
    double value = 0;
    bool has_number = false;
    PS_TRY(next_number(reader, &value, &has_number, error));
    if (!has_number || !(value >= 1 && value <= largest) || value != floor(value)) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s begins with %.17g, which is not a number of %s", reader->input.name,
                       value, what);
    }
    *count = (size_t)value;
    return PSPEC_OK;
}

static const double MOST_POINTS = 1e15; /* counts in doubles are exact */

/* Rows of three numbers are points with weights, or something else: that is for the user to say. */
static pspec_status check_columns(ps_point_reader *reader, ps_error *error) {
    ps_text_state *const state = reader->state;
    const ps_lines *const lines = &state->lines;
    double row[3];
    ps_line_kind kind = PS_LINE_NONE;
    PS_TRY(ps_text_next_line(state, &kind, error));
    if (kind == PS_LINE_POINT && ps_row_parse(lines->cursor, ' ', 3, row) != NULL) {
        return ps_lines_fail(&state->lines, error,
                             "3 columns after a count; --columns xyz, or xyw, if the "
                             "third one is the weight");
    }
    return PSPEC_OK;
}

/* Past the line, where nothing more stands in it. */
static void leave_line(ps_text_state *state) {
    state->is_in_line = !ps_ends_line(ps_skip_blanks(state->lines.cursor));
    if (!state->is_in_line) {
        ps_lines_skip(&state->lines);
    }
}

static void set_columns(ps_point_reader *reader, unsigned columns, const char *name) {
    ps_text_set_columns(reader, columns);
    reader->own_columns = name;
    leave_line(reader->state); /* that of the count */
}

static pspec_status open_psa(ps_point_reader *reader, ps_error *error) {
    const ps_point_options *options = &reader->options;
    const unsigned told = ps_columns_told(options);
    const unsigned of_plane = 2U + options->weight_column;
    const unsigned columns = told > 0 ? told : of_plane;
    const char *const own = options->weight_column ? "xyw" : "xy";
    PS_TRY(ps_text_open_lines(reader, ' ', error));
    ps_text_state *const state = reader->state;
    PS_TRY(read_count(reader, "points", MOST_POINTS, &state->promised, error));
    set_columns(reader, columns, columns == of_plane ? own : NULL);
    return options->weight_column || told > 0 || state->is_in_line ? PSPEC_OK
                                                                   : check_columns(reader, error);
}

static pspec_status open_gbn(ps_point_reader *reader, ps_error *error) {
    size_t dimension = 0;
    PS_TRY(ps_text_open_lines(reader, ' ', error));
    ps_text_state *const state = reader->state;
    PS_TRY(read_count(reader, "points", MOST_POINTS, &state->promised, error));
    PS_TRY(read_count(reader, "dimensions from 1 to 6", PS_MAX_DIMENSION, &dimension, error));
    set_columns(reader, (unsigned)dimension, NULL);
    return PSPEC_OK;
}

static pspec_status open_tokens(ps_point_reader *reader, ps_error *error) {
    PS_TRY(ps_text_open_lines(reader, ' ', error));
    ps_text_set_columns(reader, ps_columns_told(&reader->options));
    return PSPEC_OK;
}

/* ---- reading ----------------------------------------------------------------------------- */

/* The next number, wherever it is, and the point that it may complete. */
static pspec_status read_number(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    ps_text_state *const state = reader->state;
    bool has_number = false;
    PS_TRY(next_number(reader, &state->partial[state->num_partial], &has_number, error));
    if (!has_number) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s is truncated: it promises %zu points, and point %zu is not there",
                       reader->input.name, state->promised, reader->rows_in_set + out->num + 1);
    }
    leave_line(state);
    if (++state->num_partial == reader->columns) {
        memcpy(out->rows + out->num * reader->columns, state->partial,
               reader->columns * sizeof *state->partial);
        out->num++;
        state->num_partial = 0;
    }
    return PSPEC_OK;
}

/* A set of tokens ends at the cursor, or the input does. */
static pspec_status end_tokens(ps_point_reader *reader, ps_rows_read *out, ps_line_kind kind,
                               ps_error *error) {
    const ps_text_state *const state = reader->state;
    if (state->num_partial > 0) {
        return ps_lines_fail(
            &state->lines, error, "set %llu ends inside a point, after %u of its %u numbers",
            (unsigned long long)reader->num_sets + 1, state->num_partial, reader->columns);
    }
    if (kind == PS_LINE_MARK && state->is_in_line) {
        return ps_lines_fail(&state->lines, error, "a '#' behind numbers");
    }
    if (kind == PS_LINE_MARK) {
        return ps_text_end_set(reader, out, error);
    }
    out->end = PS_END_OF_INPUT;
    return PSPEC_OK;
}

/* Points that stand each on a line of its own, as they mostly do, or else a number. Only tokens
 * have '#' lines, and an end that nothing promised. */
static pspec_status read_some(ps_point_reader *reader, ps_line_kind kind, ps_rows_read *out,
                              size_t most, ps_error *error) {
    ps_text_state *const state = reader->state;
    const size_t before = out->num;
    if (kind == PS_LINE_POINT && !state->is_in_line && state->num_partial == 0) {
        ps_text_take_rows(reader, out, most);
    }
    if (out->num > before) {
        return PSPEC_OK;
    }
    if (state->promised == 0 && kind == PS_LINE_BLANK) {
        ps_lines_skip(&state->lines);
        return PSPEC_OK;
    }
    return state->promised == 0 && kind != PS_LINE_POINT ? end_tokens(reader, out, kind, error)
                                                         : read_number(reader, out, error);
}

static pspec_status read_psa(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    ps_text_state *const state = reader->state;
    const size_t left = state->promised > 0 ? state->promised - reader->rows_in_set : SIZE_MAX;
    const size_t most = left < out->capacity ? left : out->capacity;
    ps_line_kind kind = PS_LINE_NONE;
    pspec_status status = PSPEC_OK;
    while (status == PSPEC_OK && out->num < most && out->end == PS_MORE_ROWS) {
        PS_TRY(ps_text_next_line(state, &kind, error));
        status = read_some(reader, kind, out, most, error);
    }
    if (out->num == left) {
        out->end = PS_END_OF_INPUT;
    }
    return out->num > 0 ? PSPEC_OK : status; /* the next call finds it again */
}

/* ---- writing ----------------------------------------------------------------------------- */

/* Counts that become known at the end are written again over blanks of the same length. */
static void write_count(ps_point_writer *writer, const char *after) {
    char text[64];
    const int length = snprintf(text, sizeof text, writer->completes_header ? "%-20zu%s" : "%zu%s",
                                writer->shape.num_points, after);
    ps_output_write(writer->file, text, 1, (size_t)length);
}

static void begin_psa(ps_point_writer *writer) {
    write_count(writer, "\n");
}

static void begin_gbn(ps_point_writer *writer) {
    char after[8];
    snprintf(after, sizeof after, " %u\n", writer->shape.dimension);
    write_count(writer, after);
}

const ps_point_format ps_format_psa_text = {.name = "psa-text",
                                            .open = open_psa,
                                            .read = read_psa,
                                            .close = ps_text_close,
                                            .abilities =
                                                PS_HOLDS_WEIGHTS | PS_HOLDS_TORUS | PS_NEEDS_COUNTS,
                                            .only_dimension = 2,
                                            .begin = begin_psa,
                                            .write = ps_text_write_rows};

const ps_point_format ps_format_gbn = {.name = "gbn",
                                       .open = open_gbn,
                                       .read = read_psa,
                                       .close = ps_text_close,
                                       .abilities = PS_HOLDS_TORUS | PS_NEEDS_COUNTS,
                                       .begin = begin_gbn,
                                       .write = ps_text_write_rows};

const ps_point_format ps_format_tokens = {
    .name = "tokens", .open = open_tokens, .read = read_psa, .close = ps_text_close};
