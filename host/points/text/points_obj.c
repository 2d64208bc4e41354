/* Vertices of OBJ: the three numbers of every line "v x y z", behind which a weight or a colour may
 * stand; what other lines say of names, normals and faces is not read. All vertices are one set. */
#include "files/decimal.h"
#include "points/text/points_text.h"

#include <string.h>

enum { AXES = 3 };

static bool is_blank(char character) {
    return character == ' ' || character == '\t';
}

/* Goes to the next vertex, or to the end. */
static pspec_status find_vertex(ps_text_state *state, bool *is_there, ps_error *error) {
    ps_line_kind kind = PS_LINE_BLANK;
    *is_there = false;
    PS_TRY(ps_text_next_line(state, &kind, error));
    while (kind != PS_LINE_NONE && !*is_there) {
        const char *const text = ps_skip_blanks(state->lines.cursor);
        *is_there = text[0] == 'v' && is_blank(text[1]);
        if (!*is_there) {
            ps_lines_skip(&state->lines);
            PS_TRY(ps_text_next_line(state, &kind, error));
        }
    }
    return PSPEC_OK;
}

static pspec_status open_obj(ps_point_reader *reader, ps_error *error) {
    bool is_there = false;
    PS_TRY(ps_text_open_lines(reader, ' ', error));
    PS_TRY(find_vertex(reader->state, &is_there, error));
    ps_text_set_columns(reader, AXES);
    return is_there ? PSPEC_OK
                    : ps_fail(error, PSPEC_ERROR_INPUT, "%s is an OBJ file without vertices",
                              reader->input.name);
}

static bool parse_vertex(const char *line, double row[AXES]) {
    const char *text = ps_skip_blanks(line) + 1;
    for (int axis = 0; text != NULL && axis < AXES; axis++) {
        text = is_blank(*text) ? ps_decimal_parse(ps_skip_blanks(text), &row[axis]) : NULL;
    }
    return text != NULL && (is_blank(*text) || ps_ends_line(text));
}

static pspec_status read_obj(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    ps_text_state *const state = reader->state;
    bool is_there = true;
    while (out->num < out->capacity) {
        PS_TRY(find_vertex(state, &is_there, error));
        if (!is_there) {
            out->end = PS_END_OF_INPUT;
            return PSPEC_OK;
        }
        if (!parse_vertex(state->lines.cursor, out->rows + out->num * AXES)) {
            return out->num > 0 ? PSPEC_OK
                                : ps_lines_fail(&state->lines, error,
                                                "a vertex of OBJ is v and three numbers");
        }
        out->num++;
        ps_lines_skip(&state->lines);
    }
    return PSPEC_OK;
}

/* "v 0 0 1": a letter, where other texts have the name of a column, before a number. */
static bool is_number_of_vertex(const char *line) {
    double value = 0;
    return ps_token_is_one_of(line, "v|vn|vt|vp") &&
           ps_decimal_parse(ps_skip_blanks(line + ps_token_length(line)), &value) != NULL;
}

pspec_status ps_obj_detect(ps_point_reader *reader, ps_error *error) {
    enum { MOST_LINES = 64 }; /* before the first that is nothing else: a few groups and comments */
    ps_lines *const lines = &((ps_text_state *)reader->state)->lines;
    for (size_t i = 0; i < MOST_LINES; i++) {
        const char *line = NULL;
        PS_TRY(ps_lines_peek(lines, i, &line, error));
        const char *const text = line != NULL ? ps_skip_blanks(line) : "\n";
        const char *const after = ps_skip_blanks(text + ps_token_length(text));
        const bool may_be_more =
            ps_token_is_one_of(text, "o|g|s") || *text == '#' || ps_ends_line(text);
        if (is_number_of_vertex(text) ||
            (ps_token_is_one_of(text, "mtllib|usemtl") && is_blank(text[ps_token_length(text)]) &&
             !ps_ends_line(after))) {
            reader->format = &ps_format_obj;
        }
        if (line == NULL || !may_be_more || reader->format == &ps_format_obj) {
            return PSPEC_OK;
        }
    }
    return PSPEC_OK;
}

const ps_point_format ps_format_obj = {
    .name = "obj", .open = open_obj, .read = read_obj, .close = ps_text_close};
