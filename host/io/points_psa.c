/* Text that begins with the number of points: psa-text (of PSA, and GBN in the plane), "N" and then N
 * times "x y" (or "x y w"); gbn, "N d" and then N times d numbers. What follows is ignored, as these
 * tools do; line breaks mean nothing. One set per file. */
#include "base/memory.h"
#include "io/decimal.h"
#include "io/points_text.h"

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
            return ps_fail(error, PSPEC_ERROR_INPUT, "%s, line %zu: \"%s\" is not a %snumber",
                           reader->input.name, lines->line_number,
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
static pspec_status choose_columns(ps_point_reader *reader, ps_error *error) {
    const ps_point_options *options = &reader->options;
    ps_lines *const lines = &((ps_text_state *)reader->state)->lines;
    const bool says_weights = options->weight_column ||
                              (options->columns != NULL && strcmp(options->columns, "xyw") == 0);
    double row[3];
    bool has_line = false;
    ps_line_kind kind = PS_LINE_BLANK;
    reader->columns = says_weights ? 3 : 2;
    reader->own_columns = says_weights ? "xyw" : "xy";
    while (kind == PS_LINE_BLANK) { /* the rest of the line of the count */
        ps_lines_skip(lines);
        PS_TRY(ps_text_next_line(reader->state, &kind, error));
    }
    PS_TRY(ps_lines_fill(lines, &has_line, error));
    if (has_line && !says_weights && options->columns == NULL &&
        ps_row_parse(lines->cursor, ' ', 3, row) != NULL) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s, line %zu: 3 columns after a count; --columns xyw, if the third one is "
                       "the weight",
                       reader->input.name, lines->line_number);
    }
    return PSPEC_OK;
}

static pspec_status open_psa(ps_point_reader *reader, ps_error *error) {
    PS_TRY(ps_text_open_lines(reader, ' ', error));
    ps_text_state *const state = reader->state;
    PS_TRY(read_count(reader, "points", MOST_POINTS, &state->promised, error));
    if (ps_ends_line(ps_skip_blanks(state->lines.cursor))) {
        return choose_columns(reader, error);
    }
    reader->columns = 2 + reader->options.weight_column; /* points begin on the line of the count */
    reader->own_columns = reader->options.weight_column ? "xyw" : "xy";
    return PSPEC_OK;
}

static pspec_status open_gbn(ps_point_reader *reader, ps_error *error) {
    size_t dimension = 0;
    PS_TRY(ps_text_open_lines(reader, ' ', error));
    ps_text_state *const state = reader->state;
    PS_TRY(read_count(reader, "points", MOST_POINTS, &state->promised, error));
    PS_TRY(read_count(reader, "dimensions from 1 to 6", PS_MAX_DIMENSION, &dimension, error));
    reader->columns = (unsigned)dimension;
    return PSPEC_OK;
}

static pspec_status fail_short(const ps_point_reader *reader, size_t promised, size_t num_points,
                               ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT,
                   "%s is truncated: it promises %zu points, and point %zu is not there",
                   reader->input.name, promised, num_points + 1);
}

static pspec_status read_psa(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    const size_t promised = ((ps_text_state *)reader->state)->promised;
    const size_t left = promised - reader->rows_in_set;
    const size_t num = left < out->capacity ? left : out->capacity;
    for (; out->num < num; out->num++) {
        for (unsigned j = 0; j < reader->columns; j++) {
            bool has_number = false;
            PS_TRY(next_number(reader, &out->rows[out->num * reader->columns + j], &has_number,
                               error));
            if (!has_number) {
                return fail_short(reader, promised, reader->rows_in_set + out->num, error);
            }
        }
    }
    out->end = out->num == left ? PS_END_OF_INPUT : PS_MORE_ROWS;
    return PSPEC_OK;
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
