/* Raw float32, little-endian, x0 y0 x1 y1 ..., no header: .rps of PSA, stdin.binary of pbrt's
 * pspec. Nothing in the file tells the number of points of a set (points_per_set) or the dimension
 * (2). */
#include "base/memory.h"
#include "files/bytes.h"
#include "files/elements.h"
#include "points/points_format.h"

#include <math.h>
#include <string.h>

static const ps_element_type float32 = {PS_ELEMENT_FLOAT, sizeof(float), false};

static pspec_status open_rps(ps_point_reader *reader, ps_error *error) {
    uint64_t num_bytes = 0;
    const ps_point_options *options = &reader->options;
    reader->columns = options->dimension != 0 ? options->dimension : 2;
    const size_t row_bytes = reader->columns * sizeof(float);
    const size_t set_rows = options->points_per_set;
    if (!ps_input_bytes_left(&reader->input, &num_bytes)) {
        return PSPEC_OK;
    }
    if (num_bytes % row_bytes != 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: %llu bytes are not whole points of %u float32", reader->input.name,
                       (unsigned long long)num_bytes, reader->columns);
    }
    const uint64_t num_rows = num_bytes / row_bytes;
    if (set_rows > 0 && num_rows % set_rows != 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s: %llu points are not whole sets of %zu",
                       reader->input.name, (unsigned long long)num_rows, set_rows);
    }
    reader->rows_per_set = set_rows > 0 ? set_rows : (size_t)num_rows;
    return PSPEC_OK;
}

/* After the last element: a pipe may end anywhere. */
static pspec_status check_end(const ps_point_reader *reader, size_t num_values, size_t num_rows,
                              ps_error *error) {
    const size_t set_rows = reader->options.points_per_set;
    const size_t rows_in_set = reader->rows_in_set + num_rows;
    if (num_values % reader->columns != 0 ||
        (set_rows > 0 && rows_in_set > 0 && rows_in_set != set_rows)) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s is truncated: it ends inside set %llu",
                       reader->input.name, (unsigned long long)reader->num_sets + 1);
    }
    return PSPEC_OK;
}

static pspec_status read_rps(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    size_t num_values = 0;
    size_t num_rows = out->capacity;
    const size_t set_rows = reader->options.points_per_set;
    if (set_rows > 0 && set_rows - reader->rows_in_set < num_rows) {
        num_rows = set_rows - reader->rows_in_set;
    }
    PS_TRY(ps_elements_read(&reader->input, float32, out->rows, num_rows * reader->columns,
                            &num_values, error));
    out->num = num_values / reader->columns;
    if (out->num < num_rows) {
        out->end = PS_END_OF_INPUT;
        return check_end(reader, num_values, out->num, error);
    }
    out->end =
        set_rows > 0 && reader->rows_in_set + out->num == set_rows ? PS_END_OF_SET : PS_MORE_ROWS;
    return PSPEC_OK;
}

/* ---- writing ----------------------------------------------------------------------------- */

/* The nearest float below 1: rounding up would leave the torus. */
static float narrow(double value) {
    const float rounded = (float)value;
    return rounded < 1 ? rounded : nextafterf(1, 0);
}

static void write_rps(ps_point_writer *writer, const double *rows, size_t num_rows) {
    enum { BLOCK = 4096 };
    unsigned char block[BLOCK * sizeof(float)];
    const size_t count = num_rows * writer->columns;
    for (size_t first = 0; first < count; first += BLOCK) {
        const size_t num = count - first < BLOCK ? count - first : BLOCK;
        for (size_t i = 0; i < num; i++) {
            const float value = narrow(rows[first + i]);
            const double rounding = fabs((double)value - rows[first + i]);
            uint32_t bits = 0;
            memcpy(&bits, &value, sizeof bits);
            ps_bytes_put(block + i * sizeof bits, bits, sizeof bits);
            writer->num_rounded += rounding > 0;
            writer->largest_rounding = fmax(writer->largest_rounding, rounding);
        }
        ps_output_write(writer->file, block, sizeof(float), num);
    }
}

const ps_point_format ps_format_rps = {.name = "rps",
                                       .endings = {".rps", ".binary"},
                                       .open = open_rps,
                                       .read = read_rps,
                                       .abilities = PS_HOLDS_SETS | PS_HOLDS_TORUS | PS_EQUAL_SETS,
                                       .write = write_rps};
