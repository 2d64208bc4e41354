#include "points/text/points_frames.h"

#include "points/text/text_fields.h"

#include <math.h>
#include <string.h>

enum { AXES = 3 };

pspec_status ps_frame_line(ps_point_reader *reader, const char **line, ps_error *error) {
    ps_text_state *const state = reader->state;
    ps_line_kind kind = PS_LINE_NONE;
    PS_TRY(ps_text_next_line(state, &kind, error));
    *line = state->lines.cursor;
    return kind != PS_LINE_NONE
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "%s is truncated: it ends inside set %llu",
                         reader->input.name, (unsigned long long)reader->num_sets + 1);
}

pspec_status ps_frame_count(ps_point_reader *reader, const char *otherwise, uint64_t *count,
                            ps_error *error) {
    const double most = 1e15; /* counts in doubles are exact */
    ps_text_state *const state = reader->state;
    const char *line = NULL;
    double value = 0;
    PS_TRY(ps_frame_line(reader, &line, error));
    if (ps_line_numbers(line, false, 1, &value) != 1 || !(value >= 1 && value <= most) ||
        value != floor(value)) {
        return ps_lines_fail(&state->lines, error, "%s", otherwise);
    }
    *count = (uint64_t)value;
    ps_lines_skip(&state->lines);
    return PSPEC_OK;
}

/* ---- which columns ----------------------------------------------------------------------- */

/* The first num of the names "x,y,z". */
static void shorten(char text[32], const char *names, unsigned num) {
    size_t length = 0;
    for (unsigned i = 0; i < num; i++) {
        length += (i > 0) + strcspn(names + length + (i > 0), ",");
    }
    snprintf(text, 32, "%.*s", (int)length, names);
}

/* Which axis the columns with these names are of. */
static void find_axes(const ps_text_state *state, const ps_frame *frame, const char *names,
                      short axes[PS_MAX_COLUMNS]) {
    const char *name = names;
    for (int i = 0; frame->has_box && *name != '\0'; i++) {
        const size_t length = strcspn(name, ",");
        const int column = ps_field_find(frame->names, ' ', name, length);
        if (column >= 0 && state->header.places[column] >= 0) {
            axes[state->header.places[column]] = (short)(i % AXES);
        }
        name += length + (name[length] == ',');
    }
}

/* Columns that have the units of the box, and the intervals of all that are of one of its axes. */
static void take_box(ps_point_reader *reader, const ps_frame *frame) {
    ps_text_state *const state = reader->state;
    short axes[PS_MAX_COLUMNS];
    for (unsigned i = 0; i < PS_MAX_COLUMNS; i++) {
        state->axes[i] = -1;
    }
    find_axes(state, frame, frame->absolute, state->axes);
    memcpy(axes, state->axes, sizeof axes);
    find_axes(state, frame, frame->relative, axes);
    reader->own_box = (ps_box){0};
    for (unsigned i = 0; i < PS_MAX_DIMENSION && axes[i] >= 0; i++) {
        reader->own_box.low[i] = state->lower[axes[i]];
        reader->own_box.high[i] = state->upper[axes[i]];
        reader->own_box.num_axes++;
    }
}

pspec_status ps_frame_begin(ps_point_reader *reader, const ps_frame *frame, ps_error *error) {
    ps_text_state *const state = reader->state;
    const ps_point_options *const options = &reader->options;
    const char *wanted = options->column_names;
    char chosen[32];
    if (frame->has_box && options->box.num_axes > 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s, line %zu: --box, and the file states the box itself",
                       reader->input.name, state->lines.line_number);
    }
    if (wanted == NULL) {
        const unsigned told = options->dimension;
        shorten(chosen, frame->chosen, told > 0 && told < AXES ? told : AXES);
        wanted = told == 1 ? strcat(chosen, ",") : chosen;
    }
    const ps_text_choice choice = {wanted, options->select, frame->filter};
    PS_TRY(ps_text_header_read(&state->header, frame->names, frame->row, ' ', &choice,
                               &state->lines, error));
    if (state->header.lacks_name) {
        return ps_lines_fail(&state->lines, error, "%u names of columns, and the row after has %u",
                             state->header.num_columns - 1, state->header.num_columns);
    }
    state->header.chooses = true;
    take_box(reader, frame);
    state->rows_left = frame->num_rows;
    state->num_corners = frame->has_box ? AXES : 0;
    state->num_kept = 0;
    return reader->columns == 0 || reader->columns == state->header.num_chosen
               ? PSPEC_OK
               : ps_lines_fail(&state->lines, error, "%u columns after sets of %u",
                               state->header.num_chosen, reader->columns);
}

pspec_status ps_frame_open(ps_point_reader *reader, ps_error *error) {
    PS_TRY(ps_text_open_lines(reader, ' ', error));
    PS_TRY(reader->format->read_header(reader, error));
    ps_text_state *const state = reader->state;
    ps_text_set_columns(reader, state->header.num_chosen);
    reader->has_own_box = state->num_corners > 0;
    reader->own_columns = ps_columns_meaning(reader->options.column_names);
    reader->chosen = reader->options.column_names != NULL ? state->header.used : NULL;
    ps_point_options *const options = &reader->options;
    const bool is_told = options->columns != NULL || reader->own_columns != NULL ||
                         options->dimension > 0 || options->lift != PS_NO_LIFT;
    if (!is_told && state->num_corners > 0) { /* the box tells that they are no vectors */
        options->dimension =
            reader->columns - (options->weight_column && options->column_names != NULL);
    }
    return PSPEC_OK;
}

/* ---- rows -------------------------------------------------------------------------------- */

static void scale_row(const ps_text_state *state, unsigned columns, double *row) {
    for (unsigned i = 0; i < columns; i++) {
        const int axis = state->axes[i];
        if (axis >= 0) {
            row[i] = ps_box_scale(row[i], state->lower[axis], state->upper[axis]);
        }
    }
}

static pspec_status read_row(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    ps_text_state *const state = reader->state;
    double *const row = out->rows + out->num * reader->columns;
    const char *line = NULL;
    PS_TRY(ps_frame_line(reader, &line, error));
    bool is_taken = false;
    if (ps_text_header_row(&state->header, line, ' ', row, &is_taken) == NULL) {
        return ps_text_header_refuse(&state->header, line, ' ', &state->lines, error);
    }
    if (is_taken) {
        scale_row(state, reader->columns, row);
        out->num++;
        state->num_kept++;
    }
    ps_lines_skip(&state->lines);
    state->rows_left--;
    return PSPEC_OK;
}

/* Behind the last row of a frame: another one, or blank lines and the end. */
static pspec_status end_frame(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    ps_text_state *const state = reader->state;
    ps_line_kind kind = PS_LINE_NONE;
    if (state->num_kept == 0) {
        return ps_text_fail_selection(reader, error);
    }
    PS_TRY(ps_text_next_line(state, &kind, error));
    while (kind == PS_LINE_BLANK) {
        ps_lines_skip(&state->lines);
        PS_TRY(ps_text_next_line(state, &kind, error));
    }
    out->end = kind == PS_LINE_NONE ? PS_END_OF_INPUT : PS_END_OF_SET;
    return PSPEC_OK;
}

pspec_status ps_frame_read(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    ps_text_state *const state = reader->state;
    if (state->rows_left == 0 && state->num_kept == 0) {
        PS_TRY(reader->format->read_header(reader, error));
    }
    reader->first_line = state->header.filter.value == NULL ? state->lines.line_number : 0;
    while (state->rows_left > 0 && out->num < out->capacity) {
        const pspec_status status = read_row(reader, out, error);
        if (status != PSPEC_OK) { /* which the next call finds again */
            return out->num > 0 ? PSPEC_OK : status;
        }
    }
    if (state->rows_left > 0) {
        return PSPEC_OK;
    }
    const pspec_status status = end_frame(reader, out, error);
    state->num_kept = 0;
    return status;
}
