/* EDAT, the extended text of UTK: before every set three lines, the lower and the upper corner of
 * the domain and whether it is a torus (1 or 0); then points as in utk-text, with a column more
 * where they have weights. The domain becomes [0,1)^d, torus or not. Files without these lines
 * are called .edat, too: they are utk-text. */
#include "files/text_lines.h"
#include "points/text/points_text.h"

#include <math.h>
#include <string.h>

typedef struct edat_header {
    size_t lower_columns, upper_columns; /* 0: the line has no numbers */
    bool has_toricity;
    double lower[PS_MAX_DIMENSION], upper[PS_MAX_DIMENSION], toricity;
} edat_header;

/* The three lines at the cursor, which stays. */
static pspec_status peek_header(ps_point_reader *reader, edat_header *out, ps_error *error) {
    ps_text_state *const state = reader->state;
    const char *third = NULL;
    const char *second = NULL;
    *out = (edat_header){0};
    PS_TRY(ps_lines_peek(&state->lines, 2, &third, error));
    PS_TRY(ps_lines_peek(&state->lines, 1, &second, error));
    out->lower_columns = ps_line_numbers(state->lines.cursor, false, PS_MAX_DIMENSION, out->lower);
    if (second != NULL) {
        out->upper_columns = ps_line_numbers(second, false, PS_MAX_DIMENSION, out->upper);
    }
    if (third != NULL && ps_line_numbers(third, false, 1, &out->toricity) == 1) {
        third = ps_skip_blanks(third);
        out->has_toricity = ps_token_length(third) == 1 && (*third == '0' || *third == '1');
    }
    return PSPEC_OK;
}

static bool has_corners(const edat_header *header) {
    return header->lower_columns >= 1 && header->lower_columns <= PS_MAX_DIMENSION &&
           header->lower_columns == header->upper_columns;
}

static bool encloses_something(const edat_header *header) {
    bool is_box = true;
    for (unsigned j = 0; j < header->lower_columns; j++) {
        const double size = header->upper[j] - header->lower[j];
        is_box = is_box && size > 0 && isfinite(size);
    }
    return is_box;
}

/* ---- detection --------------------------------------------------------------------------- */

static bool are_whole(const edat_header *header) {
    bool are = true;
    for (unsigned j = 0; j < header->lower_columns; j++) {
        are = are && header->lower[j] == floor(header->lower[j]) &&
              header->upper[j] == floor(header->upper[j]);
    }
    return are;
}

/* Three numbers, each on a line: points in one dimension? */
static bool may_be_points(const edat_header *header, const ps_point_options *options) {
    const bool has_any_units = options->wrap || options->box.num_axes > 0;
    const bool is_unit = header->lower[0] == 0 && header->upper[0] == 1;
    const bool is_inside = header->lower[0] >= 0 && header->upper[0] < 1 && header->toricity == 0;
    return header->lower_columns == 1 && (has_any_units ? !is_unit : is_inside);
}

static pspec_status fail_either(const ps_point_reader *reader, const char *what, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s: %s? --input-format utk-text or edat",
                   reader->input.name, what);
}

pspec_status ps_edat_detect(ps_point_reader *reader, bool is_named, ps_error *error) {
    edat_header header;
    PS_TRY(peek_header(reader, &header, error));
    const bool is_box = has_corners(&header) && encloses_something(&header);
    const bool is_bare = header.lower_columns > 1; /* no row of such a text is one number */
    if (has_corners(&header) && header.has_toricity && (is_named || (is_bare && is_box))) {
        if (may_be_points(&header, &reader->options)) {
            return fail_either(reader,
                               "are the first three lines points, or corners of a domain and "
                               "whether it is a torus",
                               error);
        }
        reader->format = &ps_format_edat;
    } else if (is_box && are_whole(&header) && is_named) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: its first two lines look like corners of a domain, and the third is "
                       "not whether it is a torus (0 or 1), as in EDAT; --input-format utk-text "
                       "reads all lines as points",
                       reader->input.name);
    } else if (is_box && header.has_toricity && are_whole(&header) && reader->options.wrap) {
        return fail_either(reader,
                           "are the first three lines points to be wrapped, or corners of a "
                           "domain and whether it is a torus",
                           error);
    }
    return PSPEC_OK;
}

/* ---- read -------------------------------------------------------------------------------- */

static pspec_status check_header(const ps_point_reader *reader, const edat_header *header,
                                 ps_error *error) {
    const ps_text_state *const state = reader->state;
    if (!has_corners(header) || !header->has_toricity) {
        return ps_lines_fail(
            &state->lines, error,
            "set %llu does not begin with the three lines of EDAT, two "
            "corners of the domain and whether it is a torus (0 or 1)%s",
            (unsigned long long)reader->num_sets + 1,
            reader->num_sets == 0 ? "; --input-format utk-text reads all lines as points" : "");
    }
    if (!encloses_something(header)) {
        return ps_lines_fail(&state->lines, error, "the corners of the domain enclose nothing");
    }
    return state->num_corners == 0 || header->lower_columns == state->num_corners
               ? PSPEC_OK
               : ps_lines_fail(&state->lines, error, "a domain of dimension %u after one of %u",
                               (unsigned)header->lower_columns, state->num_corners);
}

/* Points must follow. */
static pspec_status read_header(ps_point_reader *reader, ps_error *error) {
    enum { LINES = 3 };
    ps_box *const box = &reader->own_box;
    ps_text_state *const state = reader->state;
    edat_header header;
    ps_line_kind kind = PS_LINE_NONE;
    PS_TRY(peek_header(reader, &header, error));
    PS_TRY(check_header(reader, &header, error));
    state->num_corners = box->num_axes = (unsigned)header.lower_columns;
    memcpy(box->low, header.lower, sizeof box->low);
    memcpy(box->high, header.upper, sizeof box->high);
    for (int i = 0; i < LINES; i++) {
        ps_lines_skip(&state->lines);
    }
    PS_TRY(ps_text_next_line(state, &kind, error));
    return kind == PS_LINE_POINT ? PSPEC_OK
                                 : ps_lines_fail(&state->lines, error, "set %llu has no points",
                                                 (unsigned long long)reader->num_sets + 1);
}

static pspec_status open_edat(ps_point_reader *reader, ps_error *error) {
    PS_TRY(ps_text_open_lines(reader, ' ', error));
    const ps_text_state *const state = reader->state;
    PS_TRY(read_header(reader, error));
    PS_TRY(ps_text_fix_columns(reader, error));
    if (reader->columns == state->num_corners + 1) {
        reader->options.weight_column = true; /* the corners tell that it is no coordinate */
    }
    return reader->columns == state->num_corners || reader->columns == state->num_corners + 1
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "%s, line %zu: %u columns in a domain of dimension %u", reader->input.name,
                         state->columns_line, reader->columns, state->num_corners);
}

static void scale_rows(const ps_point_reader *reader, double *rows, size_t num) {
    const ps_text_state *const state = reader->state;
    for (size_t i = 0; i < num; i++) {
        double *const row = rows + i * reader->columns;
        for (unsigned j = 0; j < state->num_corners; j++) {
            row[j] = ps_box_scale(row[j], reader->own_box.low[j], reader->own_box.high[j]);
        }
    }
}

static pspec_status read_edat(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    ps_text_state *const state = reader->state;
    ps_line_kind kind = PS_LINE_NONE;
    if (state->needs_header) {
        PS_TRY(ps_text_next_line(state, &kind, error));
        if (kind == PS_LINE_POINT) { /* else the input ends, or goes on wrongly */
            PS_TRY(read_header(reader, error));
        }
        state->needs_header = false;
    }
    PS_TRY(ps_text_read(reader, out, error));
    scale_rows(reader, out->rows, out->num);
    state->needs_header = out->end == PS_END_OF_SET;
    return PSPEC_OK;
}

/* ---- write ------------------------------------------------------------------------------- */

static void begin_set(ps_point_writer *writer) {
    ps_text_begin_set(writer);
    for (char corner = '0'; corner <= '1'; corner++) {
        for (unsigned j = 0; j < writer->shape.dimension; j++) {
            const char text[] = {corner, j + 1 < writer->shape.dimension ? ' ' : '\n'};
            ps_output_write(writer->file, text, 1, sizeof text);
        }
    }
    ps_output_write(writer->file, "1\n", 1, 2);
}

const ps_point_format ps_format_edat = {.name = "edat",
                                        .endings = {".edat"},
                                        .open = open_edat,
                                        .read = read_edat,
                                        .close = ps_text_close,
                                        .abilities =
                                            PS_HOLDS_SETS | PS_HOLDS_WEIGHTS | PS_HOLDS_TORUS,
                                        .begin_set = begin_set,
                                        .write = ps_text_write_rows};
