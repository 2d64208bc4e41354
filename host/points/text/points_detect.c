/* Formats of text that no first bytes tell apart: the first lines do. */
#include "files/decimal.h"
#include "math/unit_vector.h"
#include "points/points_foreign.h"
#include "points/text/points_text.h"

#include <string.h>

/* A header is "N" before rows of other length, or "N d" before rows of d numbers. "256 2" could be
 * a point itself, but not one of the torus, unless it is to be wrapped. */
static pspec_status detect_counts(ps_point_reader *reader, const char *second, ps_error *error) {
    ps_text_state *const state = reader->state;
    double counts[2] = {1, 1};
    const size_t num = ps_line_numbers(state->lines.cursor, true, 2, counts);
    const size_t columns = ps_line_numbers(second, false, 0, NULL);
    if (counts[0] < 1 || counts[1] < 1 || columns > PS_MAX_COLUMNS) {
        return PSPEC_OK;
    }
    if (num == 1 && columns >= 2) {
        reader->format = &ps_format_psa_text;
    } else if (num == 2 && counts[1] == (double)columns &&
               (columns != 2 || !reader->options.wrap)) {
        reader->format = &ps_format_gbn;
    } else if (num == 2 && counts[1] == (double)columns) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: is the first line a point to be wrapped, or a count and a dimension? "
                       "--input-format utk-text or gbn",
                       reader->input.name);
    }
    return PSPEC_OK;
}

static bool is_text(const char *line) {
    while (*line == '\t' || *line == '\r' || (unsigned char)*line >= ' ') {
        line++;
    }
    return *line == '\n';
}

/* A set of one line may be one point, or all its points one after the other. */
static pspec_status detect_tokens(ps_point_reader *reader, ps_error *error) {
    enum { SEVERAL = 4, VECTOR = 3 }; /* at least two points of the plane */
    const ps_point_options *const options = &reader->options;
    const ps_text_state *const state = reader->state;
    const char *const line = state->lines.cursor;
    const bool may_be_sphere = options->domain != PS_DOMAIN_TORUS;
    double row[VECTOR + 1] = {0};
    const size_t num = ps_line_numbers(line, false, VECTOR + 1, row);
    const size_t told = ps_columns_told(options);
    if (options->column_names != NULL) {
        return PSPEC_OK; /* columns that are chosen are those of a line */
    }
    if (told > 0) {
        reader->format = num > told && num % told == 0 ? &ps_format_tokens : reader->format;
        return PSPEC_OK;
    }
    const bool is_vector = may_be_sphere && num == VECTOR + 1 &&
                           (options->normalize_vectors || ps_is_unit_vector(row));
    if (num < SEVERAL || is_vector) {
        return PSPEC_OK;
    }
    return ps_lines_fail(&state->lines, error,
                         "%zu numbers and no other line: one point, or one after the other? "
                         "%s",
                         num,
                         options->domain == PS_DOMAIN_SPHERE
                             ? "--columns, as in xyz, says what a point is"
                             : "-d says how many dimensions a point has, as in -d 2");
}

/* Formats of text whose rows have blanks, by their first lines. */
static pspec_status detect_blanks(ps_point_reader *reader, bool is_named_edat, ps_error *error) {
    ps_text_state *const state = reader->state;
    const char *second = NULL;
    if (reader->options.header != NULL && strcmp(reader->options.header, "yes") == 0) {
        return PSPEC_OK; /* the first line is nothing else */
    }
    PS_TRY(ps_xyz_detect(reader, error));
    if (reader->format == &ps_format_xyz) {
        return PSPEC_OK;
    }
    PS_TRY(ps_edat_detect(reader, is_named_edat, error));
    if (reader->format != &ps_format_utk_text) {
        return PSPEC_OK;
    }
    PS_TRY(ps_lines_peek(&state->lines, 1, &second, error));
    const char *const text = second != NULL ? ps_skip_blanks(second) : NULL;
    const bool is_alone = text == NULL || *text == '#' || ps_ends_line(text);
    if (is_alone) {
        return detect_tokens(reader, error);
    }
    const bool has_one_a_line = ps_line_numbers(state->lines.cursor, false, 0, NULL) == 1 &&
                                ps_line_numbers(second, false, 0, NULL) == 1;
    if (has_one_a_line && ps_columns_told(&reader->options) > 1) {
        reader->format = &ps_format_tokens;
        return PSPEC_OK;
    }
    return detect_counts(reader, second, error);
}

pspec_status ps_text_detect(ps_point_reader *reader, ps_error *error) {
    const bool is_named_edat = reader->format == &ps_format_edat;
    reader->format = &ps_format_utk_text; /* whose close frees what is made here */
    PS_TRY(ps_text_open_lines(reader, ' ', error));
    ps_text_state *const state = reader->state;
    if (!is_text(state->lines.cursor)) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s is neither text nor begins like a format that is known; raw float32 "
                       "pairs are read with --input-format rps",
                       reader->input.name);
    }
    PS_TRY(ps_foreign_check_lines(&state->lines, error));
    PS_TRY(ps_obj_detect(reader, error));
    if (reader->format == &ps_format_obj) {
        return PSPEC_OK;
    }
    if (strcspn(state->lines.cursor, ",;") < strcspn(state->lines.cursor, "\n")) {
        reader->format = &ps_format_csv;
        return PSPEC_OK;
    }
    return detect_blanks(reader, is_named_edat, error);
}
