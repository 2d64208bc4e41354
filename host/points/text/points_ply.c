/* Vertices of PLY, as ASCII or binary: a header up to "end_header", of which the element vertex, the
 * first one, has properties that are numbers; faces and what else follows are not read. */
#include "base/memory.h"
#include "files/elements.h"
#include "points/text/points_frames.h"
#include "points/text/text_fields.h"

#include <string.h>

enum { LINE_BYTES = 512, NAMES_BYTES = 2048, MOST_LINES = 10000, BLOCK_BYTES = 1 << 16 };

typedef struct ply_state {
    ps_text_state text; /* first, for what reads lines */
    bool is_binary, is_big_endian;
    bool has_vertices, is_in_vertices;
    unsigned num_properties;
    ps_element_type types[PS_MOST_FILE_COLUMNS];
    unsigned offsets[PS_MOST_FILE_COLUMNS + 1]; /* in bytes of a row; the last is its size */
    char names[NAMES_BYTES];
    unsigned char block[BLOCK_BYTES];
} ply_state;

/* ---- header ------------------------------------------------------------------------------ */

/* A line with its '\n', byte by byte, since binary numbers may follow it. */
static pspec_status read_line(ps_point_reader *reader, char line[LINE_BYTES], ps_error *error) {
    ps_text_state *const state = reader->state;
    size_t length = 0;
    size_t count = 1;
    state->lines.line_number++;
    while (length < LINE_BYTES - 1 && (length == 0 || line[length - 1] != '\n')) {
        PS_TRY(ps_input_read(&reader->input, line + length, 1, &count, error));
        if (count == 0) {
            return ps_lines_fail(&state->lines, error, "the file ends inside the header of PLY");
        }
        length++;
    }
    line[length] = '\0';
    return line[length - 1] == '\n' && state->lines.line_number < MOST_LINES
               ? PSPEC_OK
               : ps_lines_fail(&state->lines, error, "too long for a header of PLY");
}

static bool is_word(ps_field field, const char *word) {
    return field.length == strlen(word) && strncmp(field.text, word, field.length) == 0;
}

static bool find_type(ps_field name, ps_element_type *out) {
    static const struct {
        const char *names[2];
        ps_element_type type;
    } known[] = {{{"float", "float32"}, {PS_ELEMENT_FLOAT, 4, false}},
                 {{"double", "float64"}, {PS_ELEMENT_FLOAT, 8, false}},
                 {{"char", "int8"}, {PS_ELEMENT_SIGNED, 1, false}},
                 {{"uchar", "uint8"}, {PS_ELEMENT_UNSIGNED, 1, false}},
                 {{"short", "int16"}, {PS_ELEMENT_SIGNED, 2, false}},
                 {{"ushort", "uint16"}, {PS_ELEMENT_UNSIGNED, 2, false}},
                 {{"int", "int32"}, {PS_ELEMENT_SIGNED, 4, false}},
                 {{"uint", "uint32"}, {PS_ELEMENT_UNSIGNED, 4, false}}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (is_word(name, known[i].names[0]) || is_word(name, known[i].names[1])) {
            *out = known[i].type;
            return true;
        }
    }
    return false;
}

/* "property float x" */
static pspec_status take_property(ps_point_reader *reader, const ps_field *words, unsigned num,
                                  ps_error *error) {
    enum { WORDS = 3 };
    ply_state *const state = reader->state;
    const unsigned index = state->num_properties;
    const size_t used = strlen(state->names);
    if (num != WORDS || index == PS_MOST_FILE_COLUMNS ||
        used + words[2].length + 2 > sizeof state->names || words[2].is_quoted ||
        !ps_field_is_printable(words[2]) || !find_type(words[1], &state->types[index])) {
        return ps_lines_fail(&state->text.lines, error,
                             "a property of vertices that is no number, or too many");
    }
    snprintf(state->names + used, sizeof state->names - used, "%.*s ", (int)words[2].length,
             words[2].text);
    state->offsets[index + 1] = state->offsets[index] + state->types[index].num_bytes;
    state->num_properties++;
    return PSPEC_OK;
}

/* "element vertex 12" */
static pspec_status take_element(ps_point_reader *reader, const ps_field *words, unsigned num,
                                 uint64_t *num_vertices, ps_error *error) {
    enum { WORDS = 3 };
    ply_state *const state = reader->state;
    state->is_in_vertices = num == WORDS && is_word(words[1], "vertex");
    if (!state->is_in_vertices && !state->has_vertices) {
        return ps_lines_fail(&state->text.lines, error,
                             "vertices must be the first element of PLY");
    }
    if (state->is_in_vertices &&
        (state->has_vertices || !ps_field_is_whole(words[2], num_vertices) || *num_vertices == 0)) {
        return ps_lines_fail(&state->text.lines, error, "this is no number of vertices");
    }
    state->has_vertices = true;
    return PSPEC_OK;
}

static pspec_status take_format(ps_point_reader *reader, ps_field name, ps_error *error) {
    ply_state *const state = reader->state;
    state->is_big_endian = is_word(name, "binary_big_endian");
    state->is_binary = state->is_big_endian || is_word(name, "binary_little_endian");
    return state->is_binary || is_word(name, "ascii")
               ? PSPEC_OK
               : ps_lines_fail(&state->text.lines, error, "a format of PLY that is not known");
}

static pspec_status read_header(ps_point_reader *reader, uint64_t *num_vertices, ps_error *error) {
    enum { MOST_WORDS = 4 };
    ply_state *const state = reader->state;
    char line[LINE_BYTES + 1] = "";
    for (bool is_first = true; strncmp(line, "end_header", sizeof "end_header" - 1) != 0;
         is_first = false) {
        ps_field words[MOST_WORDS] = {{.text = NULL}};
        unsigned num = 0;
        bool is_more = true;
        PS_TRY(read_line(reader, line, error));
        const char *at = line;
        while (num < MOST_WORDS && ps_field_next(&at, ' ', &is_more, &words[num])) {
            num++;
        }
        if (is_first && (num != 1 || !is_word(words[0], "ply"))) {
            return ps_lines_fail(&state->text.lines, error,
                                 "a file of PLY begins with a line \"ply\"");
        }
        if (num > 1 && is_word(words[0], "format")) {
            PS_TRY(take_format(reader, words[1], error));
        } else if (num > 0 && is_word(words[0], "element")) {
            PS_TRY(take_element(reader, words, num, num_vertices, error));
        } else if (num > 0 && is_word(words[0], "property") && state->is_in_vertices) {
            PS_TRY(take_property(reader, words, num, error));
        }
    }
    return state->has_vertices && state->num_properties > 0
               ? PSPEC_OK
               : ps_lines_fail(&state->text.lines, error, "a header of PLY without vertices");
}

/* ---- vertices ---------------------------------------------------------------------------- */

static pspec_status open_ply(ps_point_reader *reader, ps_error *error) {
    ps_frame frame = {.chosen = "x,y,z", .absolute = ""};
    PS_TRY(ps_allocate(&reader->state, 1, sizeof(ply_state), "PLY reader", error));
    ply_state *const state = reader->state;
    state->text.lines.input = &reader->input;
    PS_TRY(read_header(reader, &frame.num_rows, error));
    const size_t num_lines = state->text.lines.line_number;
    const size_t length = strlen(state->names);
    state->names[length - 1] = '\n'; /* behind the last name */
    frame.names = frame.row = state->names;
    if (!state->is_binary) {
        PS_TRY(ps_lines_open(&state->text.lines, &reader->input, error));
        PS_TRY(ps_text_open_lines(reader, ' ', error));
        state->text.lines.line_number += num_lines;
    }
    PS_TRY(ps_frame_begin(reader, &frame, error));
    ps_text_set_columns(reader, state->text.header.num_chosen);
    reader->own_columns = ps_columns_meaning(reader->options.column_names);
    reader->chosen = reader->options.column_names != NULL ? state->text.header.used : NULL;
    return PSPEC_OK;
}

/* The numbers of a vertex that are read; false: --select does not take it. */
static bool take_vertex(const ply_state *state, const unsigned char *bytes, double *row) {
    const ps_row_filter *const filter = &state->text.header.filter;
    for (unsigned j = 0; j < state->num_properties; j++) {
        const short place = state->text.header.places[j];
        const bool is_filter = filter->value != NULL && filter->column == j;
        if (place < 0 && !is_filter) {
            continue;
        }
        ps_element_type type = state->types[j];
        type.is_big_endian = state->is_big_endian;
        const double value = ps_element_number(type, bytes + state->offsets[j]);
        const bool is_single = type.kind == PS_ELEMENT_FLOAT && type.num_bytes == sizeof(float);
        if (is_filter && !ps_row_filter_takes_number(filter, value, is_single)) {
            return false;
        }
        if (place >= 0) {
            row[place] = value;
        }
    }
    return true;
}

static pspec_status read_binary(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    ply_state *const state = reader->state;
    const size_t row_bytes = state->offsets[state->num_properties];
    const size_t fitting = BLOCK_BYTES / row_bytes;
    size_t num = fitting < out->capacity ? fitting : out->capacity;
    size_t num_bytes = 0;
    num = num < state->text.rows_left ? num : (size_t)state->text.rows_left;
    PS_TRY(ps_input_read(&reader->input, state->block, num * row_bytes, &num_bytes, error));
    num = num_bytes / row_bytes;
    for (size_t i = 0; i < num; i++) {
        out->num += take_vertex(state, state->block + i * row_bytes,
                                out->rows + out->num * reader->columns);
    }
    state->text.rows_left -= num;
    if (num == 0 && state->text.rows_left > 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s is truncated: %llu vertices are not there",
                       reader->input.name, (unsigned long long)state->text.rows_left);
    }
    if (state->text.rows_left == 0 && reader->rows_in_set + out->num == 0) {
        return ps_text_fail_selection(reader, error);
    }
    out->end = state->text.rows_left == 0 ? PS_END_OF_INPUT : PS_MORE_ROWS;
    return PSPEC_OK;
}

/* What follows the vertices is no other set. */
static pspec_status read_ply(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    if (((const ply_state *)reader->state)->is_binary) {
        return read_binary(reader, out, error);
    }
    PS_TRY(ps_frame_read(reader, out, error));
    out->end = out->end == PS_END_OF_SET ? PS_END_OF_INPUT : out->end;
    return PSPEC_OK;
}

const ps_point_format ps_format_ply = {
    .name = "ply", .magic = "ply", .open = open_ply, .read = read_ply, .close = ps_text_close};
