/* EPS pictures as PSA draws them: the lines that are "x y p" hold points, all others are drawing.
 * One set per file. */
#include "files/decimal.h"
#include "points/text/points_text.h"

#include <math.h>
#include <string.h>

/* Is the line a point? Then row gets its coordinates. */
static bool parse_point(const char *line, double *row) {
    const char *text = line;
    for (int j = 0; j < 2; j++) {
        text = ps_decimal_parse(ps_skip_blanks(text), &row[j]);
        if (text == NULL || (*text != ' ' && *text != '\t')) {
            return false;
        }
    }
    text = ps_skip_blanks(text);
    return *text == 'p' && ps_ends_line(ps_skip_blanks(text + 1));
}

static pspec_status open_eps(ps_point_reader *reader, ps_error *error) {
    PS_TRY(ps_text_open_lines(reader, ' ', error));
    reader->columns = 2;
    reader->own_columns = "xy";
    return PSPEC_OK;
}

static pspec_status read_eps(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    ps_lines *const lines = &((ps_text_state *)reader->state)->lines;
    bool has_line = true;
    while (has_line && out->num < out->capacity) {
        PS_TRY(ps_lines_fill(lines, &has_line, error));
        if (has_line) {
            out->num += parse_point(lines->cursor, out->rows + 2 * out->num);
            ps_lines_skip(lines);
        }
    }
    out->end = has_line ? PS_MORE_ROWS : PS_END_OF_INPUT;
    return PSPEC_OK;
}

/* ---- writing ----------------------------------------------------------------------------- */

/* A square of 500 points (7 inches), dots of a size that 1000 points do not fill. */
static void begin_eps(ps_point_writer *writer) {
    static const char header[] = "%!PS-Adobe-3.0 EPSF-3.0\n"
                                 "%%BoundingBox: 0 0 500 500\n"
                                 "%%EndComments\n"
                                 "/p { 0.004 0 360 arc fill } def\n"
                                 "500 500 scale\n";
    ps_output_write(writer->file, header, 1, sizeof header - 1);
}

static void write_eps(ps_point_writer *writer, const double *rows, size_t num_rows) {
    for (size_t i = 0; i < num_rows; i++) {
        char line[2 * PS_DECIMAL_BYTES + 4];
        size_t used = ps_decimal_format(line, rows[2 * i]);
        line[used++] = ' ';
        used += ps_decimal_format(line + used, rows[2 * i + 1]);
        memcpy(line + used, " p\n", 3);
        ps_output_write(writer->file, line, 1, used + 3);
    }
}

static pspec_status finish_eps(ps_point_writer *writer, ps_error *error) {
    static const char trailer[] = "showpage\n%%EOF\n";
    (void)error;
    ps_output_write(writer->file, trailer, 1, sizeof trailer - 1);
    return PSPEC_OK;
}

const ps_point_format ps_format_eps = {.name = "eps",
                                       .endings = {".eps"},
                                       .magic = "%!",
                                       .open = open_eps,
                                       .read = read_eps,
                                       .close = ps_text_close,
                                       .abilities = PS_HOLDS_TORUS,
                                       .only_dimension = 2,
                                       .begin = begin_eps,
                                       .write = write_eps,
                                       .finish = finish_eps};
