/* Dumps of LAMMPS: items "ITEM: NAME", of which BOX BOUNDS are the box and ATOMS the names of the
 * columns, before the atoms of every time step. */
#include "points/text/points_frames.h"
#include "points/text/text_fields.h"

#include <math.h>
#include <string.h>

static const char item[] = "ITEM: ";

static bool begins(const char *line, const char *text) {
    return strncmp(line, text, strlen(text)) == 0;
}

static bool has_word(const char *line, const char *word) {
    return ps_field_find(line, ' ', word, strlen(word)) >= 0;
}

static pspec_status read_bounds(ps_point_reader *reader, ps_error *error) {
    enum { AXES = 3, BOUNDS = 2 };
    ps_text_state *const state = reader->state;
    for (int axis = 0; axis < AXES; axis++) {
        const char *line = NULL;
        double row[BOUNDS];
        PS_TRY(ps_frame_line(reader, &line, error));
        if (ps_line_numbers(line, false, BOUNDS, row) != BOUNDS || !(row[1] > row[0]) ||
            !isfinite(row[1] - row[0])) {
            return ps_lines_fail(&state->lines, error,
                                 "two bounds of the box should be here, the lower one first");
        }
        state->lower[axis] = row[0];
        state->upper[axis] = row[1];
        ps_lines_skip(&state->lines);
    }
    return PSPEC_OK;
}

/* The names of the columns are at the cursor. */
static pspec_status begin_atoms(ps_point_reader *reader, ps_frame *frame, ps_error *error) {
    static const char *const choices[] = {"xs,ys,zs", "x,y,z", "xsu,ysu,zsu", "xu,yu,zu"};
    ps_text_state *const state = reader->state;
    PS_TRY(ps_lines_peek(&state->lines, 1, &frame->row, error));
    if (frame->row == NULL) {
        return ps_lines_fail(&state->lines, error, "the file ends before the atoms");
    }
    frame->names = ps_skip_blanks(state->lines.cursor + sizeof "ITEM: ATOMS" - 1);
    for (size_t i = 0; i < sizeof choices / sizeof choices[0] && frame->chosen == NULL; i++) {
        char first[8];
        snprintf(first, sizeof first, "%.*s", (int)strcspn(choices[i], ","), choices[i]);
        frame->chosen = has_word(frame->names, first) ? choices[i] : NULL;
    }
    if (frame->chosen == NULL && reader->options.column_names == NULL) {
        return ps_lines_fail(&state->lines, error,
                             "no columns x y z, xs ys zs, xu yu zu or xsu ysu zsu");
    }
    frame->absolute = "x,y,z,xu,yu,zu";
    frame->relative = "xs,ys,zs,xsu,ysu,zsu";
    PS_TRY(ps_frame_begin(reader, frame, error));
    ps_lines_skip(&state->lines);
    return PSPEC_OK;
}

static pspec_status read_item(ps_point_reader *reader, ps_frame *frame, bool *is_complete,
                              ps_error *error) {
    ps_text_state *const state = reader->state;
    const char *line = NULL;
    PS_TRY(ps_frame_line(reader, &line, error));
    const char *const name = begins(line, item) ? line + sizeof item - 1 : line;
    const bool is_bounds = name != line && begins(name, "BOX BOUNDS");
    const bool is_count = name != line && begins(name, "NUMBER OF ATOMS");
    if (name != line && begins(name, "ATOMS")) {
        *is_complete = true;
        return frame->num_rows > 0 && frame->has_box
                   ? begin_atoms(reader, frame, error)
                   : ps_lines_fail(&state->lines, error,
                                   "atoms before their number and the bounds of the box");
    }
    if (is_bounds && (has_word(name, "xy") || has_word(name, "origin"))) {
        return ps_lines_fail(
            &state->lines, error,
            "a box that is no cuboid (xy xz yz), which is not read; write the atoms "
            "of a cuboid box");
    }
    if (!is_bounds && !is_count &&
        (name == line || !(begins(name, "TIME") || begins(name, "UNITS")))) {
        return ps_lines_fail(&state->lines, error,
                             "an item of a LAMMPS dump should be here (ITEM: TIMESTEP)");
    }
    ps_lines_skip(&state->lines);
    if (is_bounds) {
        frame->has_box = true;
        return read_bounds(reader, error);
    }
    if (is_count) {
        return ps_frame_count(reader, "this is no number of atoms", &frame->num_rows, error);
    }
    PS_TRY(ps_frame_line(reader, &line, error)); /* a time step, or a word */
    ps_lines_skip(&state->lines);
    return PSPEC_OK;
}

static pspec_status read_header(ps_point_reader *reader, ps_error *error) {
    ps_frame frame = {.filter = "type"};
    bool is_complete = false;
    while (!is_complete) {
        PS_TRY(read_item(reader, &frame, &is_complete, error));
    }
    return PSPEC_OK;
}

const ps_point_format ps_format_lammps = {.name = "lammps",
                                          .magic = "ITEM: ",
                                          .open = ps_frame_open,
                                          .read = ps_frame_read,
                                          .close = ps_text_close,
                                          .read_header = read_header};
