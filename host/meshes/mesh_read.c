/* Reads meshes, a statement a line: a word and what it says.
 *
 *     v X Y Z                 a corner of OBJ; more numbers are not looked at
 *     f I J K ..              a face of such corners, from 1 on, or from -1 back; I/T, I//N, I/T/N
 *     quad NAME MATERIAL X Y Z  X Y Z  X Y Z  X Y Z
 *     camera position X Y Z direction X Y Z up X Y Z focal F width W height H
 *
 * A backslash at the end continues a line, but not a comment, which # begins, nor a name, which may
 * be a path. Words for names, groups, materials, normals and textures are passed over.
 */
#include "base/memory.h"
#include "base/text.h"
#include "files/decimal.h"
#include "files/text_lines.h"
#include "meshes/mesh.h"
#include "meshes/vectors.h"

#include <stdlib.h>
#include <string.h>

#define NAME_WORDS "o|g|mtllib|usemtl|usemap|maplib|shadow_obj|trace_obj|rgb"
#define NUMBER_WORDS "vt|vn|vp|s|l|p|mg|lod|bevel|c_interp|d_interp"

/* Squares and products of three of them are numbers still. */
static const double MOST_COORDINATE = 1e30;

typedef struct reader {
    ps_input input;
    ps_lines lines;
    const char *text; /* what was not read yet of the statement */
    size_t num_vertices;
    double (*vertices)[3]; /* [PS_MESH_MOST_VERTICES] */
    ps_mesh *mesh;
} reader;

/* ---- tokens -------------------------------------------------------------------------------- */

static bool has_comment(const char *text, const char *end) {
    for (const char *at = text; at < end; at++) {
        if (*at == '#' && (at == text || at[-1] == ' ' || at[-1] == '\t')) {
            return true;
        }
    }
    return false;
}

/* Does a backslash end the line at text, which has no comment and does not begin with a name? */
static bool is_continued(const reader *self, const char *text) {
    const char *last = memchr(text, '\n', (size_t)(self->lines.lines_end - text));
    last -= last > text && last[-1] == '\r' ? 1 : 0;
    return last > text && last[-1] == '\\' && !has_comment(text, last) &&
           !(text == self->lines.cursor && ps_token_is_one_of(ps_skip_blanks(text), NAME_WORDS));
}

/* To the next token of the statement; false at its end. */
static bool next_token(reader *self) {
    const char *text = ps_skip_blanks(self->text);
    while (text[0] == '\\' && ps_ends_line(text + 1)) {
        text = ps_skip_blanks(text + (text[1] == '\r' ? 3 : 2));
    }
    self->text = text;
    return !ps_ends_line(text) && *text != '#';
}

/* A backslash may end a token, too: "v 1 2 3\". */
static size_t token_length(const char *text) {
    const size_t length = ps_token_length(text);
    return length > 1 && text[length - 1] == '\\' && ps_ends_line(text + length) ? length - 1
                                                                                 : length;
}

static pspec_status fail_token(const reader *self, const char *what, ps_error *error) {
    char shown[PS_TOKEN_BYTES];
    return ps_lines_fail(&self->lines, error, "\"%s\" is no %s",
                         ps_token_show(shown, self->text, token_length(self->text)), what);
}

static pspec_status read_numbers(reader *self, const char *what, size_t num, double *out,
                                 ps_error *error) {
    for (size_t i = 0; i < num; i++) {
        if (!next_token(self)) {
            return ps_lines_fail(&self->lines, error, "%s has %zu numbers, not %zu", what, num, i);
        }
        const char *const end = ps_decimal_parse(self->text, &out[i]);
        if (end == NULL || end != self->text + token_length(self->text)) {
            return fail_token(self, "number", error);
        }
        if (!(fabs(out[i]) <= MOST_COORDINATE)) {
            return ps_lines_fail(&self->lines, error, "numbers of meshes go up to %g",
                                 MOST_COORDINATE);
        }
        self->text = end;
    }
    return PSPEC_OK;
}

/* ---- what there is -------------------------------------------------------------------------- */

static pspec_status add_triangle(reader *self, const double *a, const double *b, const double *c,
                                 ps_error *error) {
    const double least = 1e-12; /* of the square of the longest side: rounding of coordinates */
    ps_mesh *const mesh = self->mesh;
    double sides[3][3];
    double normal[3];
    if (mesh->num_triangles >= PS_MESH_MOST_TRIANGLES) {
        return ps_lines_fail(&self->lines, error, "a mesh has at most %d triangles",
                             PS_MESH_MOST_TRIANGLES);
    }
    ps_vector_subtract(sides[0], b, a);
    ps_vector_subtract(sides[1], c, a);
    ps_vector_subtract(sides[2], c, b);
    ps_vector_cross(normal, sides[0], sides[1]);
    const double longest = fmax(ps_vector_length(sides[0]),
                                fmax(ps_vector_length(sides[1]), ps_vector_length(sides[2])));
    if (!(ps_vector_length(normal) > least * longest * longest)) {
        return ps_lines_fail(&self->lines, error,
                             "a triangle of this face has no area: its corners are on one line");
    }
    double(*const corners)[3] = mesh->triangles[mesh->num_triangles++];
    memcpy(corners[0], a, sizeof corners[0]);
    memcpy(corners[1], b, sizeof corners[1]);
    memcpy(corners[2], c, sizeof corners[2]);
    return PSPEC_OK;
}

static pspec_status read_vertex(reader *self, ps_error *error) {
    if (self->num_vertices >= PS_MESH_MOST_VERTICES) {
        return ps_lines_fail(&self->lines, error, "a mesh has at most %d vertices",
                             PS_MESH_MOST_VERTICES);
    }
    return read_numbers(self, "a vertex", 3, self->vertices[self->num_vertices++], error);
}

/* The corner that a token of a face names. */
static pspec_status read_corner(reader *self, const double **out, ps_error *error) {
    const size_t length = token_length(self->text);
    double number = 0;
    const char *const end = ps_decimal_parse(self->text, &number);
    if (end == NULL || number != floor(number) ||
        end + strspn(end, "/-0123456789") != self->text + length ||
        (*end != '/' && end != self->text + length)) {
        return fail_token(self, "number of a vertex", error);
    }
    const double index = number < 0 ? (double)self->num_vertices + number : number - 1;
    if (!(index >= 0 && index < (double)self->num_vertices)) {
        return ps_lines_fail(&self->lines, error,
                             "vertex %g of a face is none of the %zu before it", number,
                             self->num_vertices);
    }
    *out = self->vertices[(size_t)index];
    self->text += length;
    return PSPEC_OK;
}

static pspec_status read_face(reader *self, ps_error *error) {
    const double *first = NULL;
    const double *before = NULL;
    size_t num = 0;
    for (; next_token(self); num++) {
        const double *corner = NULL;
        PS_TRY(read_corner(self, &corner, error));
        if (num >= 2) {
            PS_TRY(add_triangle(self, first, before, corner, error));
        }
        first = num == 0 ? corner : first;
        before = corner;
    }
    return num >= 3
               ? PSPEC_OK
               : ps_lines_fail(&self->lines, error, "a face has %zu corners, not 3 or more", num);
}

static pspec_status read_quad(reader *self, ps_error *error) {
    double corners[4][3];
    for (int i = 0; i < 2 && next_token(self); i++) { /* name and material */
        self->text += token_length(self->text);
    }
    PS_TRY(read_numbers(self, "a quad", 4 * 3, corners[0], error));
    if (next_token(self)) {
        return ps_lines_fail(&self->lines, error,
                             "a quad is a name, a material and 12 numbers, and has more");
    }
    PS_TRY(add_triangle(self, corners[0], corners[1], corners[2], error));
    return add_triangle(self, corners[0], corners[2], corners[3], error);
}

static pspec_status read_camera(reader *self, ps_error *error) {
    ps_camera *const camera = &self->mesh->camera;
    double focal = 0;
    double width = 0;
    double height = 0;
    double axes[3][3];
    const struct {
        const char *word;
        size_t num;
        double *out;
    } parts[] = {{"position", 3, camera->position},
                 {"direction", 3, camera->direction},
                 {"up", 3, camera->up},
                 {"focal", 1, &focal},
                 {"width", 1, &width},
                 {"height", 1, &height}};
    while (next_token(self)) {
        size_t i = 0;
        while (i < sizeof parts / sizeof parts[0] &&
               !ps_token_is_one_of(self->text, parts[i].word)) {
            i++;
        }
        if (i == sizeof parts / sizeof parts[0]) {
            return fail_token(self, "part of a camera", error);
        }
        self->text += token_length(self->text);
        PS_TRY(read_numbers(self, parts[i].word, parts[i].num, parts[i].out, error));
    }
    camera->width = width / focal;
    self->mesh->has_camera = true;
    return focal > 0 && width > 0 && ps_camera_axes(camera, axes)
               ? PSPEC_OK
               : ps_lines_fail(&self->lines, error,
                               "a camera has position, direction, up beside it, and positive focal "
                               "and width");
}

/* ---- statements ----------------------------------------------------------------------------- */

static const struct {
    const char *words;
    pspec_status (*read)(reader *, ps_error *); /* NULL: passed over */
} statements[] = {{"v", read_vertex},
                  {"f|fo", read_face},
                  {"quad", read_quad},
                  {"camera", read_camera},
                  {NAME_WORDS "|" NUMBER_WORDS, NULL}};

static pspec_status read_statement(reader *self, ps_error *error) {
    for (size_t i = 0; i < sizeof statements / sizeof statements[0]; i++) {
        if (ps_token_is_one_of(self->text, statements[i].words)) {
            self->text += token_length(self->text);
            return statements[i].read != NULL ? statements[i].read(self, error) : PSPEC_OK;
        }
    }
    return fail_token(self, "statement of OBJ, and neither quad nor camera", error);
}

/* All lines of the statement at the cursor into the buffer: how many. */
static pspec_status gather(reader *self, size_t *num_lines, ps_error *error) {
    enum { MOST_LINES = 256 }; /* each is looked for from the first on */
    const char *line = self->lines.cursor;
    *num_lines = 1;
    while (is_continued(self, line)) {
        PS_TRY(ps_lines_peek(&self->lines, *num_lines, &line, error));
        if (line == NULL || *num_lines == MOST_LINES) {
            return ps_lines_fail(&self->lines, error,
                                 "a backslash continues this line, and of at most %d the last has "
                                 "none",
                                 MOST_LINES);
        }
        ++*num_lines;
    }
    self->text = self->lines.cursor;
    return PSPEC_OK;
}

static pspec_status read_all(reader *self, ps_error *error) {
    bool has_line = false;
    PS_TRY(ps_lines_fill(&self->lines, &has_line, error));
    while (has_line) {
        size_t num_lines = 1;
        PS_TRY(gather(self, &num_lines, error));
        if (next_token(self)) {
            PS_TRY(read_statement(self, error));
        }
        for (size_t i = 0; i < num_lines; i++) {
            ps_lines_skip(&self->lines);
        }
        PS_TRY(ps_lines_fill(&self->lines, &has_line, error));
    }
    return self->mesh->num_triangles > 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "%s is a mesh without faces", self->input.name);
}

pspec_status ps_mesh_read(ps_mesh *out, const char *path, ps_error *error) {
    reader self = {.mesh = out};
    pspec_status status = PSPEC_OK;
    *out = (ps_mesh){0};
    PS_TRY_OUT(status, ps_input_open(&self.input, path, error));
    PS_TRY_OUT(status, PS_NEW(&out->triangles, PS_MESH_MOST_TRIANGLES, "triangles", error));
    PS_TRY_OUT(status, PS_NEW(&self.vertices, PS_MESH_MOST_VERTICES, "vertices", error));
    PS_TRY_OUT(status, ps_lines_open(&self.lines, &self.input, error));
    status = read_all(&self, error);
out:
    ps_lines_close(&self.lines);
    ps_input_close(&self.input);
    free(self.vertices);
    return status;
}
