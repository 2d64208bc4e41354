/* Text with one point per line: utk-text (blanks between coordinates) and csv (commas); edat reads
 * its rows here, too. A '#' at the start of a line ends a set.
 *
 * Lenient where nothing can be misunderstood: tabs, CR LF, no '\n' at the end, '#' lines before the
 * first set, one '#' line after the last, blank lines before the first set and at the very end. */
#include "base/memory.h"
#include "files/decimal.h"
#include "points/text/points_text.h"

#include <math.h>
#include <string.h>

/* Numbers of a read: enough that several threads are worth while, 2 MiB. */
enum { BLOCK_VALUES = 1 << 18 };

/* ---- lines ------------------------------------------------------------------------------- */

/* What a program prints may have no end. */
static pspec_status check_idle(ps_text_state *state, ps_line_kind kind, ps_error *error) {
    enum { MOST_IDLE = 1 << 20 }; /* more than the longest header, and no second to read */
    state->num_idle = kind == PS_LINE_POINT ? 0 : state->num_idle + 1;
    return state->lines.input->program == NULL || state->num_idle <= MOST_IDLE
               ? PSPEC_OK
               : ps_lines_fail(&state->lines, error,
                               "the program has printed %d lines one after the other without a "
                               "point, and was stopped",
                               MOST_IDLE);
}

pspec_status ps_text_next_line(ps_text_state *state, ps_line_kind *kind, ps_error *error) {
    ps_lines *const lines = &state->lines;
    *kind = PS_LINE_NONE;
    if (lines->cursor == lines->lines_end) {
        bool has_line = false;
        PS_TRY(ps_lines_fill(lines, &has_line, error));
        if (!has_line) {
            return PSPEC_OK;
        }
    }
    const char *const text = ps_skip_blanks(lines->cursor);
    *kind = *text == '#' ? PS_LINE_MARK : ps_ends_line(text) ? PS_LINE_BLANK : PS_LINE_POINT;
    return check_idle(state, *kind, error);
}

/* After a blank line there may only be more of them. */
static pspec_status read_blank_end(ps_text_state *state, ps_error *error) {
    const size_t first = state->lines.line_number;
    ps_line_kind kind = PS_LINE_BLANK;
    while (kind == PS_LINE_BLANK) {
        ps_lines_skip(&state->lines);
        PS_TRY(ps_text_next_line(state, &kind, error));
    }
    return kind == PS_LINE_NONE
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "%s, line %zu: a blank line, and more after it; sets are separated by a "
                         "'#' line",
                         state->lines.input->name, first);
}

/* ---- open -------------------------------------------------------------------------------- */

static pspec_status skip_marks(ps_text_state *state, ps_error *error) {
    ps_line_kind kind = PS_LINE_NONE;
    PS_TRY(ps_text_next_line(state, &kind, error));
    while (kind == PS_LINE_MARK || kind == PS_LINE_BLANK) {
        ps_lines_skip(&state->lines);
        PS_TRY(ps_text_next_line(state, &kind, error));
    }
    return kind == PS_LINE_POINT
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "%s holds no points", state->lines.input->name);
}

void ps_text_set_columns(ps_point_reader *reader, unsigned columns) {
    ps_text_state *const state = reader->state;
    reader->columns = columns;
    reader->block_values = BLOCK_VALUES;
    state->parser.columns = columns;
    state->parser.separator = state->separator;
}

pspec_status ps_text_fix_columns(ps_point_reader *reader, ps_error *error) {
    ps_text_state *const state = reader->state;
    size_t num_columns = state->header.num_chosen;
    if (!state->header.chooses) {
        PS_TRY(ps_row_count(&state->lines, state->separator, &num_columns, error));
    }
    if (num_columns > PS_MAX_COLUMNS) {
        return ps_lines_fail(&state->lines, error,
                             "%zu columns; at most %d dimensions are read (--columns "
                             "chooses among them by number, as in 1,2)",
                             num_columns, PS_MAX_DIMENSION);
    }
    ps_text_set_columns(reader, (unsigned)num_columns);
    state->columns_line = state->lines.line_number;
    return PSPEC_OK;
}

/* state may be there already: ps_text_detect has looked at the first lines. */
pspec_status ps_text_open_lines(ps_point_reader *reader, char separator, ps_error *error) {
    if (reader->state == NULL) {
        PS_TRY(ps_allocate(&reader->state, 1, sizeof(ps_text_state), "text reader", error));
        ps_text_state *const state = reader->state;
        PS_TRY(ps_lines_open(&state->lines, &reader->input, error));
    }
    ps_text_state *const state = reader->state;
    state->separator = separator;
    return skip_marks(state, error);
}

static pspec_status open_utk(ps_point_reader *reader, ps_error *error) {
    PS_TRY(ps_text_open_lines(reader, ' ', error));
    PS_TRY(ps_text_take_header(reader, error));
    return ps_text_fix_columns(reader, error);
}

/* Where the first line has a semicolon, columns lie between semicolons; where it has tabs and no
 * comma, between these. */
static pspec_status open_csv(ps_point_reader *reader, ps_error *error) {
    PS_TRY(ps_text_open_lines(reader, ',', error));
    ps_text_state *const state = reader->state;
    const char *const line = state->lines.cursor;
    const size_t length = strcspn(line, "\n");
    if (memchr(line, ';', length) != NULL) {
        state->separator = ';';
    } else if (memchr(line, ',', length) == NULL && memchr(line, '\t', length) != NULL) {
        state->separator = ' ';
    }
    PS_TRY(ps_text_take_header(reader, error));
    return ps_text_fix_columns(reader, error);
}

void ps_text_close(ps_point_reader *reader) {
    ps_text_state *const state = reader->state;
    ps_lines_close(&state->lines);
    ps_row_parser_free(&state->parser);
}

/* ---- read -------------------------------------------------------------------------------- */

/* The line at the cursor is no row: why not? */
static pspec_status refuse_line(const ps_point_reader *reader, ps_error *error) {
    const ps_text_state *const state = reader->state;
    size_t num_columns = 0;
    if (state->header.chooses) {
        const char *const line = state->lines.cursor;
        return ps_text_header_refuse(
            &state->header, line,
            ps_text_header_line_separator(&state->header, line, state->separator), &state->lines,
            error);
    }
    PS_TRY(ps_row_count(&state->lines, state->separator, &num_columns, error));
    if (num_columns == reader->columns) { /* blanks, in a file of commas */
        return ps_lines_fail(&state->lines, error, "no %s between two columns",
                             state->separator == ';' ? "semicolon" : "comma");
    }
    return ps_lines_fail(&state->lines, error, "%zu column%s, where line %zu has %u", num_columns,
                         num_columns == 1 ? "" : "s", state->columns_line, reader->columns);
}

/* Lines one by one: columns that are not chosen may hold anything. */
static pspec_status read_chosen(const ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    ps_text_state *const state = reader->state;
    ps_lines *const lines = &state->lines;
    while (lines->cursor < lines->lines_end && out->num < out->capacity) {
        const char *const text = ps_skip_blanks(lines->cursor);
        double *const row = out->rows + out->num * reader->columns;
        if (*text == '#' || ps_ends_line(text)) {
            return PSPEC_OK;
        }
        const pspec_status joined = ps_text_join(state, 0, error);
        if (joined != PSPEC_OK) {
            return out->num > 0 ? PSPEC_OK : joined;
        }
        const char separator =
            ps_text_header_line_separator(&state->header, lines->cursor, state->separator);
        bool is_taken = false;
        const char *const end =
            ps_text_header_row(&state->header, lines->cursor, separator, row, &is_taken);
        if (end == NULL) {
            return PSPEC_OK;
        }
        lines->cursor = end + 1;
        lines->line_number++;
        out->num += is_taken;
        state->has_dropped = state->has_dropped || !is_taken;
    }
    return PSPEC_OK;
}

void ps_text_take_rows(const ps_point_reader *reader, ps_rows_read *out, size_t most) {
    ps_text_state *const state = reader->state;
    ps_lines *const lines = &state->lines;
    double *const rows = out->rows + out->num * reader->columns;
    size_t num_rows = 0;
    state->parser.most_threads = reader->most_threads;
    lines->cursor = ps_rows_parse(&state->parser, lines->cursor, lines->lines_end, rows,
                                  most - out->num, &num_rows);
    lines->line_number += num_rows;
    out->num += num_rows;
}

pspec_status ps_text_fail_selection(const ps_point_reader *reader, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s: set %llu has no row with %s", reader->input.name,
                   (unsigned long long)reader->num_sets + 1, reader->options.select);
}

/* Rows of a set were dropped, and none is left. */
static bool has_lost_all(const ps_point_reader *reader, const ps_rows_read *out) {
    const ps_text_state *const state = reader->state;
    return state->has_dropped && reader->rows_in_set + out->num == 0;
}

pspec_status ps_text_end_set(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    ps_text_state *const state = reader->state;
    if (has_lost_all(reader, out)) {
        return ps_text_fail_selection(reader, error);
    }
    if (reader->rows_in_set + out->num == 0) {
        return ps_lines_fail(&state->lines, error, "set %llu has no points: two '#' lines in a row",
                             (unsigned long long)reader->num_sets + 1);
    }
    ps_lines_skip(&state->lines);
    state->header.index.may_restart = true;
    state->has_dropped = false;
    out->end = PS_END_OF_SET;
    return PSPEC_OK;
}

/* Rows before a blank line, which may be an error, are handed out first. */
static pspec_status end_input(ps_point_reader *reader, ps_rows_read *out, bool is_blank,
                              ps_error *error) {
    if (is_blank && out->num > 0) {
        return PSPEC_OK;
    }
    if (has_lost_all(reader, out)) {
        return ps_text_fail_selection(reader, error);
    }
    out->end = PS_END_OF_INPUT;
    return is_blank ? read_blank_end(reader->state, error) : PSPEC_OK;
}

pspec_status ps_text_read(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    ps_text_state *const state = reader->state;
    ps_line_kind kind = PS_LINE_POINT;
    reader->first_line = state->header.filter.value == NULL ? state->lines.line_number : 0;
    while (out->num < out->capacity) {
        PS_TRY(ps_text_next_line(state, &kind, error));
        if (kind == PS_LINE_MARK) {
            return ps_text_end_set(reader, out, error);
        }
        if (kind == PS_LINE_BLANK && reader->format == &ps_format_csv && out->num == 0) {
            ps_lines_skip(&state->lines); /* which data frames pass over, too */
            reader->first_line = state->header.filter.value == NULL ? state->lines.line_number : 0;
            continue;
        }
        if (kind == PS_LINE_NONE || kind == PS_LINE_BLANK) {
            return end_input(reader, out, kind == PS_LINE_BLANK, error);
        }
        const size_t before = state->lines.line_number;
        const size_t num_before = out->num;
        if (state->header.chooses) {
            PS_TRY(read_chosen(reader, out, error));
        } else {
            ps_text_take_rows(reader, out, out->capacity);
        }
        if (state->lines.line_number == before && out->num == num_before) {
            return out->num > 0 ? PSPEC_OK : refuse_line(reader, error);
        }
    }
    return PSPEC_OK;
}

/* ---- write ------------------------------------------------------------------------------- */

static void write_rows(ps_point_writer *writer, const double *rows, size_t num_rows,
                       char separator) {
    enum { BLOCK_BYTES = 1 << 16, ROW_BYTES = PS_MAX_COLUMNS * PS_DECIMAL_BYTES };
    char block[BLOCK_BYTES];
    size_t used = 0;
    for (size_t i = 0; i < num_rows; i++) {
        for (unsigned j = 0; j < writer->columns; j++) {
            used += ps_decimal_format(block + used, rows[i * writer->columns + j]);
            block[used++] = j + 1 < writer->columns ? separator : '\n';
        }
        if (used > BLOCK_BYTES - ROW_BYTES) {
            ps_output_write(writer->file, block, 1, used);
            used = 0;
        }
    }
    ps_output_write(writer->file, block, 1, used);
}

void ps_text_write_rows(ps_point_writer *writer, const double *rows, size_t num_rows) {
    write_rows(writer, rows, num_rows, ' ');
}

/* A first line "0" or "0 1" could be labels of columns: its 0 becomes 0.0. */
static void write_unlabelled(ps_point_writer *writer, const double *rows, size_t num_rows,
                             char separator) {
    bool are_labels =
        num_rows > 0 && writer->num_sets == 0 && writer->rows_in_set == 0 && !signbit(rows[0]);
    for (unsigned j = 0; are_labels && j < writer->columns; j++) {
        are_labels = rows[j] == j;
    }
    if (are_labels) {
        ps_output_write(writer->file, "0.", 1, 2);
    }
    write_rows(writer, rows, num_rows, separator);
}

static void write_utk(ps_point_writer *writer, const double *rows, size_t num_rows) {
    write_unlabelled(writer, rows, num_rows, ' ');
}

static void write_csv(ps_point_writer *writer, const double *rows, size_t num_rows) {
    write_unlabelled(writer, rows, num_rows, ',');
}

void ps_text_begin_set(ps_point_writer *writer) {
    if (writer->num_sets > 0) {
        ps_output_write(writer->file, "#\n", 1, 2);
    }
}

/* ---- the formats ------------------------------------------------------------------------- */

enum {
    ANY_POINTS =
        PS_HOLDS_SETS | PS_HOLDS_WEIGHTS | PS_HOLDS_TORUS | PS_HOLDS_VECTORS | PS_HOLDS_ANGLES
};

const ps_point_format ps_format_utk_text = {.name = "utk-text",
                                            .open = open_utk,
                                            .read = ps_text_read,
                                            .close = ps_text_close,
                                            .abilities = ANY_POINTS,
                                            .begin_set = ps_text_begin_set,
                                            .write = write_utk};

const ps_point_format ps_format_csv = {.name = "csv",
                                       .endings = {".csv"},
                                       .open = open_csv,
                                       .read = ps_text_read,
                                       .close = ps_text_close,
                                       .abilities = ANY_POINTS,
                                       .begin_set = ps_text_begin_set,
                                       .write = write_csv};
