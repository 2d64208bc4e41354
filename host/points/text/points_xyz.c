/* XYZ and extended XYZ: the number of atoms, a line of comment, then "Ar 1.0 2.0 3.0" and perhaps
 * more for every atom, frame after frame. The comment of an extended one has Lattice="...", nine
 * numbers, and Properties=species:S:1:pos:R:3, the columns. */
#include "files/decimal.h"
#include "points/text/points_frames.h"
#include "points/text/text_fields.h"

#include <math.h>
#include <string.h>
#include <strings.h>

enum { AXES = 3, NAMES_BYTES = 1024 };

/* Behind "KEY=" of a line, or NULL. */
static const char *find_value(const char *line, const char *key) {
    const size_t length = strlen(key);
    for (; *line != '\n'; line++) {
        if (strncasecmp(line, key, length) == 0 && line[length] == '=') {
            return line + length + 1;
        }
    }
    return NULL;
}

static unsigned parse_numbers(const char *text, double *out, unsigned most) {
    unsigned num = 0;
    while (text != NULL && num < most) {
        text += *text == '"';
        const char *const end = ps_decimal_parse(ps_skip_blanks(text), &out[num]);
        if (end == NULL) {
            break;
        }
        text = end;
        num++;
    }
    return num;
}

static pspec_status read_lattice(ps_point_reader *reader, const char *comment, bool *has_box,
                                 ps_error *error) {
    enum { NUMBERS = AXES * AXES };
    ps_text_state *const state = reader->state;
    const char *const lattice = find_value(comment, "Lattice");
    double cell[NUMBERS];
    double origin[AXES] = {0};
    *has_box = lattice != NULL;
    if (lattice == NULL) {
        return PSPEC_OK;
    }
    bool is_good = parse_numbers(lattice, cell, NUMBERS) == NUMBERS;
    parse_numbers(find_value(comment, "Origin"), origin, AXES);
    for (int i = 0; is_good && i < NUMBERS; i++) {
        const bool is_edge = i % (AXES + 1) == 0;
        is_good = is_edge ? cell[i] > 0 && isfinite(cell[i]) : cell[i] == 0;
    }
    for (int axis = 0; is_good && axis < AXES; axis++) {
        state->lower[axis] = origin[axis];
        state->upper[axis] = origin[axis] + cell[axis * (AXES + 1)];
    }
    return is_good ? PSPEC_OK
                   : ps_lines_fail(&state->lines, error,
                                   "a lattice that is no cuboid along the axes, which is not read");
}

static void append(char names[NAMES_BYTES], const char *name, size_t length, unsigned number) {
    const size_t used = strlen(names);
    char suffix[16] = "";
    if (number > 0) {
        snprintf(suffix, sizeof suffix, "_%u", number);
    }
    snprintf(names + used, NAMES_BYTES - used, "%s%.*s%s", used > 0 ? " " : "", (int)length, name,
             suffix);
}

/* "species:S:1:pos:R:3" becomes "species x y z"; false when it is something else. */
static bool name_properties(char names[NAMES_BYTES], const char *text) {
    static const char position[] = "pos";
    static const char *const axes[] = {"x", "y", "z"};
    while (*text != '\0' && strchr(" \t\r\n", *text) == NULL) {
        const size_t length = strcspn(text, ":\r\n");
        const char *const count = text[length] == ':' && strchr("SRIL", text[length + 1]) != NULL &&
                                          text[length + 2] == ':'
                                      ? text + length + 3
                                      : NULL;
        if (count == NULL || length == 0 || *count < '1' || *count > '9') {
            return false;
        }
        const unsigned num = (unsigned)(*count - '0');
        const bool is_position =
            num == AXES && length == sizeof position - 1 && strncmp(text, position, length) == 0;
        for (unsigned i = 0; i < num; i++) {
            if (is_position) {
                append(names, axes[i], 1, 0);
            } else {
                append(names, text, length, num > 1 ? i + 1 : 0);
            }
        }
        text = count + 1 + (count[1] == ':');
    }
    return names[0] != '\0';
}

/* Names of the columns where nothing says them. */
static void name_plainly(char names[NAMES_BYTES], const char *row) {
    enum { FIRST_OTHER = 5 };
    static const char others[] = "column";
    snprintf(names, NAMES_BYTES, "species x y z");
    const unsigned num = ps_fields_count(row, ' ');
    for (unsigned i = FIRST_OTHER; i <= num && i <= PS_MOST_FILE_COLUMNS; i++) {
        append(names, others, sizeof others - 1, i);
    }
}

static pspec_status read_header(ps_point_reader *reader, ps_error *error) {
    ps_text_state *const state = reader->state;
    ps_frame frame = {.chosen = "x,y,z", .absolute = "x,y,z", .relative = "", .filter = "species"};
    const char *line = NULL;
    char names[NAMES_BYTES + 1] = "";
    PS_TRY(ps_frame_count(reader, "the number of atoms should be here, as XYZ has it",
                          &frame.num_rows, error));
    PS_TRY(ps_frame_line(reader, &line, error));
    PS_TRY(ps_lines_peek(&state->lines, 1, &frame.row, error));
    if (frame.row == NULL) {
        return ps_lines_fail(&state->lines, error, "the file ends before the atoms");
    }
    PS_TRY(read_lattice(reader, state->lines.cursor, &frame.has_box, error));
    const char *const properties = find_value(state->lines.cursor, "Properties");
    if (properties == NULL) {
        name_plainly(names, frame.row);
    } else if (!name_properties(names, properties)) {
        return ps_lines_fail(&state->lines, error,
                             "Properties are no NAME:TYPE:COUNT, as in pos:R:3");
    }
    names[strlen(names)] = '\n';
    frame.names = names;
    PS_TRY(ps_frame_begin(reader, &frame, error));
    ps_lines_skip(&state->lines);
    return PSPEC_OK;
}

/* An element and three numbers. */
static bool is_atom(const char *row) {
    ps_field field;
    bool is_more = true;
    unsigned num = 0;
    bool is_one = ps_field_next(&row, ' ', &is_more, &field) && ps_field_is_name(field);
    while (is_one && num < AXES && ps_field_next(&row, ' ', &is_more, &field)) {
        is_one = ps_field_is_number(field);
        num++;
    }
    return is_one && num == AXES;
}

pspec_status ps_xyz_detect(ps_point_reader *reader, ps_error *error) {
    ps_text_state *const state = reader->state;
    const char *comment = NULL;
    const char *row = NULL;
    if (ps_line_numbers(state->lines.cursor, false, 0, NULL) != 1) {
        return PSPEC_OK;
    }
    PS_TRY(ps_lines_peek(&state->lines, 2, &row, error));
    PS_TRY(ps_lines_peek(&state->lines, 1, &comment, error));
    const bool is_extended = comment != NULL && find_value(comment, "Properties") != NULL;
    if (row != NULL && (is_extended || is_atom(row))) {
        reader->format = &ps_format_xyz;
    }
    return PSPEC_OK;
}

const ps_point_format ps_format_xyz = {.name = "xyz",
                                       .open = ps_frame_open,
                                       .read = ps_frame_read,
                                       .close = ps_text_close,
                                       .read_header = read_header};
