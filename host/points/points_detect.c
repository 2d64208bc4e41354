/* Formats of text that no first bytes tell apart: the first two lines do. */
#include "files/decimal.h"
#include "points/points_text.h"

#include <math.h>
#include <string.h>

/* The first line as counts: one whole number ("N") or two ("N d"). */
static unsigned count_header(const char *line, double *counts) {
    enum { MOST_COUNTS = 2 };
    unsigned num = 0;
    for (line = ps_skip_blanks(line); !ps_ends_line(line); line = ps_skip_blanks(line)) {
        const size_t length = ps_token_length(line);
        if (num == MOST_COUNTS || length == 0 || strspn(line, "0123456789") != length) {
            return 0;
        }
        ps_decimal_parse(line, &counts[num]);
        if (counts[num++] < 1) {
            return 0;
        }
        line += length;
    }
    return num;
}

/* A header is "N" before rows of other length, or "N d" before rows of d numbers. "256 2" could be
 * a point itself, but not one of the torus, unless it is to be wrapped. */
static pspec_status detect_counts(ps_point_reader *reader, const char *second, ps_error *error) {
    ps_text_state *const state = reader->state;
    double counts[2] = {0};
    double row[PS_MAX_COLUMNS];
    const unsigned num = count_header(state->lines.cursor, counts);
    unsigned columns = PS_MAX_COLUMNS;
    while (columns > 0 && ps_row_parse(second, ' ', columns, row) == NULL) {
        columns--;
    }
    if (num == 1 && columns >= 2) {
        reader->format = &ps_format_psa_text;
    } else if (num == 2 && counts[1] == columns && (columns != 2 || !reader->options.wrap)) {
        reader->format = &ps_format_gbn;
    } else if (num == 2 && counts[1] == columns) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: is the first line a point to be wrapped, or a count and a dimension? "
                       "--input-format utk-text or gbn",
                       reader->input.name);
    }
    return PSPEC_OK;
}

/* "0 0" and "1 1" are corners of a domain, or points to be wrapped onto one place. */
static pspec_status detect_corners(const ps_point_reader *reader, const char *second,
                                   ps_error *error) {
    const ps_text_state *const state = reader->state;
    double lower[PS_MAX_COLUMNS];
    double upper[PS_MAX_COLUMNS];
    unsigned columns = PS_MAX_COLUMNS;
    while (columns > 0 && ps_row_parse(state->lines.cursor, ' ', columns, lower) == NULL) {
        columns--;
    }
    if (columns == 0 || ps_row_parse(second, ' ', columns, upper) == NULL) {
        return PSPEC_OK;
    }
    for (unsigned j = 0; j < columns; j++) {
        if (lower[j] != floor(lower[j]) || upper[j] != floor(upper[j]) || lower[j] >= upper[j]) {
            return PSPEC_OK;
        }
    }
    return ps_fail(error, PSPEC_ERROR_INPUT,
                   "%s: are the first two lines points to be wrapped, or the corners of a domain? "
                   "--input-format utk-text or edat",
                   reader->input.name);
}

static bool is_text(const char *line) {
    while (*line == '\t' || *line == '\r' || (unsigned char)*line >= ' ') {
        line++;
    }
    return *line == '\n';
}

pspec_status ps_text_detect(ps_point_reader *reader, ps_error *error) {
    const char *second = NULL;
    reader->format = &ps_format_utk_text; /* whose close frees what is made here */
    PS_TRY(ps_text_open_lines(reader, ' ', error));
    ps_text_state *const state = reader->state;
    if (!is_text(state->lines.cursor)) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s is neither text nor begins like a format that is known; raw float32 "
                       "pairs are read with --input-format rps",
                       reader->input.name);
    }
    PS_TRY(ps_lines_peek_second(&state->lines, &second, error));
    if (strcspn(state->lines.cursor, ",;") < strcspn(state->lines.cursor, "\n")) {
        reader->format = &ps_format_csv;
    } else if (second != NULL) {
        PS_TRY(detect_counts(reader, second, error));
        if (reader->format == &ps_format_utk_text && reader->options.wrap) {
            PS_TRY(detect_corners(reader, second, error));
        }
    }
    return PSPEC_OK;
}
