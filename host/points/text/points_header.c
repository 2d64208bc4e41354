/* The first line of a text: has it names of columns? */
#include "files/text_lines.h"
#include "points/text/points_text.h"
#include "points/text/text_header.h"

#include <string.h>

/* Have all numbers of the rows after this line decimal points, up to the last that is looked at? */
static pspec_status are_decimals(ps_text_state *state, bool *are, ps_error *error) {
    enum { MOST_ROWS = 1000 };
    ps_lines *const lines = &state->lines;
    const char *line = NULL;
    size_t num_rows = 0;
    PS_TRY(ps_lines_peek(lines, MOST_ROWS, &line, error)); /* so that they are there */
    line = lines->cursor;
    for (*are = true; *are && num_rows < MOST_ROWS; num_rows++) {
        line = (const char *)memchr(line, '\n', (size_t)(lines->lines_end - line)) + 1;
        if (line == lines->lines_end) {
            break;
        }
        const bool is_row = *line != '#' && !ps_ends_line(ps_skip_blanks(line));
        *are = !is_row || ps_text_header_is_decimal(line, state->separator);
    }
    *are = *are && num_rows > 0;
    return PSPEC_OK;
}

static bool says(const char *option, const char *word) {
    return option != NULL && strcmp(option, word) == 0;
}

/* Is the first line one of names? */
static pspec_status find_header(ps_point_reader *reader, bool *is_there, ps_error *error) {
    ps_text_state *const state = reader->state;
    const ps_point_options *const options = &reader->options;
    const char *const line = state->lines.cursor;
    const bool is_numbered = ps_text_header_is_numbered(line, state->separator);
    bool are_labels = false;
    *is_there = ps_text_header_is(line, state->separator) || says(options->header, "yes") ||
                (is_numbered && options->column_names != NULL &&
                 !ps_columns_are_numbers(options->column_names));
    if (says(options->header, "no")) {
        *is_there = false;
    } else if (!*is_there && is_numbered) {
        PS_TRY(are_decimals(state, &are_labels, error));
    }
    return !are_labels
               ? PSPEC_OK
               : ps_lines_fail(&state->lines, error,
                               "labels of columns, or a point? Its numbers have no "
                               "decimal points, and those after it have; --header yes or no");
}

/* Names like "x,y,r" do not tell that all are coordinates. */
static pspec_status check_similar(const ps_point_reader *reader, ps_error *error) {
    const ps_text_state *const state = reader->state;
    const ps_point_options *const options = &reader->options;
    char shown[PS_TOKEN_BYTES];
    const bool is_told = options->column_names != NULL || options->columns != NULL ||
                         options->dimension != 0 || options->weight_column;
    return is_told || reader->own_columns != NULL || state->header.are_similar
               ? PSPEC_OK
               : ps_lines_fail(
                     &state->lines, error,
                     "are these all coordinates? --columns %s says so, or chooses among "
                     "them; --weights column, that the last is the weight",
                     ps_token_show(shown, state->header.used, strlen(state->header.used)));
}

/* Numbers in quotes are read field by field. */
static bool has_quotes(const char *line) {
    return memchr(line, '"', strcspn(line, "\n")) != NULL;
}

/* Columns of a text that has no names. */
static pspec_status choose_columns(ps_point_reader *reader, ps_error *error) {
    ps_text_state *const state = reader->state;
    const char *const numbers = reader->options.column_names;
    const char *const row = state->lines.cursor;
    if (numbers != NULL && !ps_columns_are_numbers(numbers)) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: --columns names columns (%s), and the first line has no names; columns "
                       "by number are --columns 1,2",
                       reader->input.name, numbers);
    }
    if (reader->options.select != NULL) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: --select %s is about a column with a name, and the first line has no "
                       "names",
                       reader->input.name, reader->options.select);
    }
    if (numbers == NULL && !has_quotes(row)) {
        return PSPEC_OK;
    }
    PS_TRY(ps_text_header_choose(&state->header, row, state->separator, numbers, &state->lines,
                                 error));
    reader->own_columns = ps_columns_meaning(numbers);
    reader->chosen = numbers != NULL ? state->header.used : NULL;
    return PSPEC_OK;
}

/* Numbers between blanks, each with a comma between digits. */
static bool has_decimal_commas(const char *line) {
    static const char digits[] = "0123456789";
    unsigned num = 0;
    for (line = ps_skip_blanks(line); !ps_ends_line(line); line = ps_skip_blanks(line)) {
        line += *line == '-' || *line == '+';
        const size_t before = strspn(line, digits);
        const size_t after = line[before] == ',' ? strspn(line + before + 1, digits) : 0;
        line += before + 1 + after;
        if (before == 0 || after == 0 || (ps_skip_blanks(line) == line && !ps_ends_line(line))) {
            return false;
        }
        num++;
    }
    return num > 1;
}

/* The next line that is not blank, which comes num_after lines after the one at the cursor; NULL:
 * there is none. */
static pspec_status peek_row(ps_lines *lines, const char **row, size_t *num_after,
                             ps_error *error) {
    const char *farthest = NULL;
    size_t wanted = 1;
    do {
        PS_TRY(ps_lines_peek(lines, wanted, &farthest, error)); /* so that all before are there */
        *row = lines->cursor;
        *num_after = 0;
        do {
            *row = (const char *)memchr(*row, '\n', (size_t)(lines->lines_end - *row)) + 1;
            ++*num_after;
        } while (*row < lines->lines_end && ps_ends_line(ps_skip_blanks(*row)));
        wanted *= 2;
    } while (*row == lines->lines_end && farthest != NULL);
    *row = *row < lines->lines_end ? *row : NULL;
    return PSPEC_OK;
}

/* Of the first two lines that are not blank, in which the decimals begin. Between commas there are
 * columns that may hold anything where others are chosen. */
static pspec_status check_commas(const ps_point_reader *reader, const char *row, size_t num_after,
                                 ps_error *error) {
    const ps_text_state *const state = reader->state;
    const bool may_be_text = state->separator != ' ' && reader->options.column_names != NULL;
    const bool begins = has_decimal_commas(state->lines.cursor);
    if (state->separator == ';' || may_be_text ||
        !(begins || (row != NULL && has_decimal_commas(row)))) {
        return PSPEC_OK;
    }
    return ps_fail(error, PSPEC_ERROR_INPUT,
                   "%s, line %zu: commas in numbers; decimals are written with a point",
                   reader->input.name, state->lines.line_number + (begins ? 0 : num_after));
}

/* Is the line at the cursor one of names? They tell what parts the rows of the file; *row is the
 * first, num_after lines after them, and NULL where there is none. */
static pspec_status find_names(ps_point_reader *reader, bool *are_there, const char **row,
                               size_t *num_after, ps_error *error) {
    ps_text_state *const state = reader->state;
    ps_lines *const lines = &state->lines;
    const char unnamed = state->separator;
    *are_there = false;
    PS_TRY(ps_text_join(state, 0, error));
    PS_TRY(peek_row(lines, row, num_after, error));
    PS_TRY(check_commas(reader, *row, *num_after, error));
    if (*row != NULL) {
        state->separator = ps_text_header_separator(lines->cursor, *row, unnamed);
        PS_TRY(ps_text_join(state, 0, error)); /* it may take the only row, */
        PS_TRY(peek_row(lines, row, num_after, error));
    }
    if (*row != NULL) {
        PS_TRY(find_header(reader, are_there, error));
        PS_TRY(peek_row(lines, row, num_after, error)); /* and that may have moved */
    }
    if (!*are_there) {
        state->separator = unnamed;
        return PSPEC_OK;
    }
    PS_TRY(ps_text_join(state, *num_after, error));
    return peek_row(lines, row, num_after, error);
}

pspec_status ps_text_take_header(ps_point_reader *reader, ps_error *error) {
    ps_text_state *const state = reader->state;
    ps_lines *const lines = &state->lines;
    const ps_text_choice choice = {reader->options.column_names, reader->options.select, NULL};
    const char *row = NULL;
    size_t num_after = 0;
    bool is_there = false;
    PS_TRY(find_names(reader, &is_there, &row, &num_after, error));
    if (!is_there) {
        return choose_columns(reader, error);
    }
    PS_TRY(ps_text_header_read(&state->header, lines->cursor, row, state->separator, &choice, lines,
                               error));
    reader->own_columns = ps_columns_meaning(choice.names);
    if (reader->own_columns == NULL && reader->options.columns == NULL) {
        reader->own_columns = ps_text_header_meaning(&state->header);
    }
    reader->chosen = state->header.chooses ? state->header.used : NULL;
    PS_TRY(check_similar(reader, error));
    state->header.chooses = state->header.chooses || has_quotes(row) || choice.select != NULL ||
                            state->separator == '\t'; /* for other rows tabs are blanks */
    for (size_t i = 0; i < num_after; i++) {
        ps_lines_skip(lines);
    }
    return PSPEC_OK;
}
