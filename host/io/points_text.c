/* UTK text: one point per line, coordinates between blanks, '#' at the start of a line ends a set.
 *
 * Lenient where nothing can be misunderstood: tabs, CR LF, no '\n' at the end, '#' lines before the
 * first set, one '#' line after the last, blank lines at the very end. */
#include "base/memory.h"
#include "io/decimal.h"
#include "io/points_format.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct text_state {
    ps_lines lines;
    unsigned columns;  /* of every row; 0 before the first */
    size_t first_line; /* the line that fixed the columns */
} text_state;

static pspec_status text_open(ps_point_reader *reader, ps_error *error) {
    PS_TRY(ps_allocate(&reader->state, 1, sizeof(text_state), "text reader", error));
    text_state *state = reader->state;
    return ps_lines_open(&state->lines, &reader->input, error);
}

static void text_close(ps_point_reader *reader) {
    text_state *state = reader->state;
    if (state != NULL) {
        ps_lines_close(&state->lines);
        free(state);
    }
}

/* ---- rows ---- */

static const char *skip_blanks(const char *text) {
    while (*text == ' ' || *text == '\t') {
        text++;
    }
    return text;
}

/* The '\n' when nothing but blanks is left of the line, else NULL. */
static const char *find_line_end(const char *text) {
    text = skip_blanks(text);
    text += text[0] == '\r' && text[1] == '\n';
    return *text == '\n' ? text : NULL;
}

static bool ends_token(const char *text) {
    return *text == ' ' || *text == '\t' || *text == '\n' || (text[0] == '\r' && text[1] == '\n');
}

static size_t token_length(const char *text) {
    size_t length = 0;
    while (!ends_token(text + length)) {
        length++;
    }
    return length;
}

/* Reads exactly columns numbers and the end of the line: the '\n', or NULL when the line is
 * anything else; refuse_row finds out what. */
static const char *parse_row(const char *text, unsigned columns, double *row) {
    for (unsigned i = 0; i < columns; i++) {
        text = ps_decimal_parse(skip_blanks(text), &row[i]);
        if (text == NULL || !ends_token(text)) {
            return NULL;
        }
    }
    return find_line_end(text);
}

static bool is_not_finite(const char *token, size_t length) {
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

/* "FILE, line 3" */
typedef struct row_place {
    char text[512];
} row_place;

static const char *show_place(const ps_point_reader *reader, row_place *place) {
    const text_state *const state = reader->state;
    snprintf(place->text, sizeof place->text, "%.480s, line %zu", reader->input.name,
             state->lines.line_number);
    return place->text;
}

/* Counts the columns of the line at text; a token that is no number is an error. */
static pspec_status count_columns(const ps_point_reader *reader, const char *text,
                                  size_t *num_columns, ps_error *error) {
    row_place place;
    char shown[PS_TOKEN_BYTES];
    *num_columns = 0;
    for (text = skip_blanks(text); find_line_end(text) == NULL; text = skip_blanks(text)) {
        double value = 0;
        const size_t length = token_length(text);
        if (ps_decimal_parse(text, &value) != text + length) {
            ps_token_show(shown, text, length);
            return ps_fail(error, PSPEC_ERROR_INPUT, "%s: \"%s\" is not a %snumber",
                           show_place(reader, &place), shown,
                           is_not_finite(text, length) ? "finite " : "");
        }
        text += length;
        ++*num_columns;
    }
    return PSPEC_OK;
}

static pspec_status refuse_row(const ps_point_reader *reader, const char *text, ps_error *error) {
    const text_state *const state = reader->state;
    row_place place;
    size_t num_columns = 0;
    PS_TRY(count_columns(reader, text, &num_columns, error));
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s: %zu column%s, where line %zu has %u",
                   show_place(reader, &place), num_columns, num_columns == 1 ? "" : "s",
                   state->first_line, state->columns);
}

/* The value that was refused is shown as the input has it. */
static pspec_status refuse_value(const ps_point_reader *reader, const char *text, unsigned column,
                                 double value, ps_error *error) {
    row_place place;
    char shown[PS_TOKEN_BYTES];
    text = skip_blanks(text);
    for (unsigned i = 0; i < column; i++) {
        text = skip_blanks(text + token_length(text));
    }
    ps_token_show(shown, text, token_length(text));
    show_place(reader, &place);
    const bool is_weight =
        reader->options.weight_column && column + 1 == ((const text_state *)reader->state)->columns;
    return is_weight ? ps_weight_refuse(place.text, shown, error)
                     : ps_coordinate_refuse(place.text, shown, value, error);
}

/* The first row fixes the number of columns for all sets of the input. */
static pspec_status fix_columns(ps_point_reader *reader, const char *text, ps_error *error) {
    text_state *const state = reader->state;
    row_place place;
    size_t num_columns = 0;
    unsigned dimension = 0;
    PS_TRY(count_columns(reader, text, &num_columns, error));
    PS_TRY(ps_points_dimension(reader, show_place(reader, &place), num_columns, &dimension, error));
    state->columns = (unsigned)num_columns;
    state->first_line = state->lines.line_number;
    return PSPEC_OK;
}

/* Adds the row at text to set; *line_end is its '\n'. */
static pspec_status read_row(const ps_point_reader *reader, const char *text, ps_point_set *set,
                             const char **line_end, ps_error *error) {
    const unsigned columns = ((const text_state *)reader->state)->columns;
    double row[PS_MAX_COLUMNS] = {0};
    *line_end = parse_row(text, columns, row);
    if (*line_end == NULL) {
        return refuse_row(reader, text, error);
    }
    double *const point = set->points + set->num_points * set->dimension;
    for (unsigned i = 0; i < set->dimension; i++) {
        point[i] = row[i];
        if (!ps_coordinate_accept(&point[i], reader->options.wrap)) {
            return refuse_value(reader, text, i, row[i], error);
        }
    }
    if (set->has_weights) {
        set->weights[set->num_points] = row[columns - 1];
        if (!isfinite(row[columns - 1])) {
            return refuse_value(reader, text, columns - 1, row[columns - 1], error);
        }
    }
    set->num_points++;
    return PSPEC_OK;
}

/* ---- sets ---- */

typedef enum line_kind { LINE_POINT, LINE_MARK, LINE_BLANK, LINE_NONE } line_kind;

static pspec_status next_line(text_state *state, line_kind *kind, ps_error *error) {
    ps_lines *const lines = &state->lines;
    *kind = LINE_NONE;
    if (lines->cursor == lines->lines_end) {
        bool has_line = false;
        PS_TRY(ps_lines_fill(lines, &has_line, error));
        if (!has_line) {
            return PSPEC_OK;
        }
    }
    const char *const text = skip_blanks(lines->cursor);
    *kind = *text == '#' ? LINE_MARK : find_line_end(text) != NULL ? LINE_BLANK : LINE_POINT;
    return PSPEC_OK;
}

static void finish_line(ps_lines *lines, const char *line_end) {
    lines->cursor = line_end + 1;
    lines->line_number++;
}

static void skip_line(ps_lines *lines) {
    finish_line(lines, memchr(lines->cursor, '\n', (size_t)(lines->lines_end - lines->cursor)));
}

/* After a blank line there may only be more of them. */
static pspec_status read_blank_end(const ps_point_reader *reader, ps_error *error) {
    text_state *const state = reader->state;
    row_place place;
    show_place(reader, &place);
    line_kind kind = LINE_BLANK;
    while (kind == LINE_BLANK) {
        skip_line(&state->lines);
        PS_TRY(next_line(state, &kind, error));
    }
    return kind == LINE_NONE
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "%s: a blank line, and more after it; sets are separated by a '#' line",
                         place.text);
}

/* Skips the '#' lines in front of the first set; one in front of any other ends an empty set. */
static pspec_status skip_leading_marks(const ps_point_reader *reader, ps_error *error) {
    text_state *const state = reader->state;
    row_place place;
    line_kind kind = LINE_NONE;
    PS_TRY(next_line(state, &kind, error));
    while (kind == LINE_MARK) {
        if (reader->num_sets > 0) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "%s: set %zu has no points: two '#' lines in a row",
                           show_place(reader, &place), reader->num_sets + 1);
        }
        skip_line(&state->lines);
        PS_TRY(next_line(state, &kind, error));
    }
    return PSPEC_OK;
}

static pspec_status add_point(ps_point_reader *reader, ps_point_set *set, ps_error *error) {
    enum { FIRST_POINTS = 1024 }; /* so that small sets are allocated once */
    text_state *const state = reader->state;
    if (state->columns == 0) {
        PS_TRY(fix_columns(reader, state->lines.cursor, error));
    }
    if (set->num_points == 0) {
        set->dimension = state->columns - reader->options.weight_column;
        PS_TRY(ps_points_reserve(set, FIRST_POINTS, error));
    }
    if ((set->num_points + 1) * set->dimension > set->points_capacity ||
        (set->has_weights && set->num_points == set->weights_capacity)) {
        PS_TRY(ps_points_reserve(set, set->num_points + 1, error));
    }
    const char *line_end = NULL;
    PS_TRY(read_row(reader, state->lines.cursor, set, &line_end, error));
    finish_line(&state->lines, line_end);
    return PSPEC_OK;
}

static pspec_status text_next(ps_point_reader *reader, ps_point_set *set, bool *has_set,
                              ps_error *error) {
    text_state *const state = reader->state;
    PS_TRY(skip_leading_marks(reader, error));
    line_kind kind = LINE_NONE;
    PS_TRY(next_line(state, &kind, error));
    while (kind == LINE_POINT) {
        PS_TRY(add_point(reader, set, error));
        PS_TRY(next_line(state, &kind, error));
    }
    if (kind == LINE_BLANK) {
        PS_TRY(read_blank_end(reader, error));
    } else if (kind == LINE_MARK) {
        skip_line(&state->lines);
    }
    *has_set = set->num_points > 0;
    return PSPEC_OK;
}

/* ---- writing ---- */

static void text_begin(ps_point_writer *writer) {
    (void)writer; /* no header */
}

static pspec_status text_write(ps_point_writer *writer, const double *points, ps_error *error) {
    enum { BLOCK_BYTES = 1 << 16, ROW_BYTES = PS_MAX_DIMENSION * PS_DECIMAL_BYTES };
    (void)error;
    char block[BLOCK_BYTES];
    size_t used = 0;
    if (writer->num_written > 0) {
        block[used++] = '#';
        block[used++] = '\n';
    }
    for (size_t i = 0; i < writer->num_points; i++) {
        for (unsigned j = 0; j < writer->dimension; j++) {
            used += ps_decimal_format(block + used, points[i * writer->dimension + j]);
            block[used++] = j + 1 < writer->dimension ? ' ' : '\n';
        }
        if (used > BLOCK_BYTES - ROW_BYTES) {
            ps_output_write(writer->file, block, 1, used);
            used = 0;
        }
    }
    ps_output_write(writer->file, block, 1, used);
    return PSPEC_OK;
}

const ps_point_format ps_format_utk_text = {.name = "utk-text",
                                            .ending = NULL,
                                            .first_byte = -1,
                                            .open = text_open,
                                            .next = text_next,
                                            .close = text_close,
                                            .begin = text_begin,
                                            .write = text_write};
