/* UTK binary: a header of 20 bytes, little-endian (magic "UTK!", type, 3 reserved bytes, sets,
 * points, dimension), then the values set by set, point by point. Whole numbers are values like any
 * other, not scaled to [0,1). */
#include "base/memory.h"
#include "files/bytes.h"
#include "files/elements.h"
#include "points/points_format.h"

#include <string.h>
#include <zlib.h>

enum {
    TYPE = 4, /* places in the header */
    SETS = 8,
    POINTS = 12,
    DIMENSION = 16,
    COUNT_BYTES = 4,
    HEADER_BYTES = 20,
    TYPE_DOUBLE = 5
};
static const char magic[] = "UTK!";

/* In the order of the type codes of UTK. */
static const ps_element_type types[] = {
    {PS_ELEMENT_SIGNED, 4, false},   {PS_ELEMENT_SIGNED, 8, false}, {PS_ELEMENT_UNSIGNED, 4, false},
    {PS_ELEMENT_UNSIGNED, 8, false}, {PS_ELEMENT_FLOAT, 4, false},  {PS_ELEMENT_FLOAT, 8, false}};

typedef struct utk_state {
    ps_element_type type;
    uint32_t num_sets, num_points, dimension;
    unsigned long first_sum, sum; /* CRC-32 of the values of the first set, and of this one */
} utk_state;

/* The size of the file, where it is known, must be what the header says. */
static pspec_status check_size(ps_point_reader *reader, ps_error *error) {
    const utk_state *const state = reader->state;
    uint64_t present = 0;
    uint64_t needed = (uint64_t)state->num_sets * state->num_points;
    if (needed > UINT64_MAX / state->dimension / state->type.num_bytes) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s: its header promises %u sets of %u points",
                       reader->input.name, state->num_sets, state->num_points);
    }
    needed *= (uint64_t)state->dimension * state->type.num_bytes;
    if (!ps_input_bytes_left(&reader->input, &present)) {
        return PSPEC_OK;
    }
    if (state->type.num_bytes == sizeof(double) && present == 2 * needed) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s holds values of 16 bytes (long double) under the type of double; write "
                       "it with double",
                       reader->input.name);
    }
    if (present != needed) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s %s: its header promises %llu bytes of values, there are %llu",
                       reader->input.name, present < needed ? "is truncated" : "is too long",
                       (unsigned long long)needed, (unsigned long long)present);
    }
    reader->rows_per_set = state->num_points;
    return PSPEC_OK;
}

static pspec_status read_header(ps_point_reader *reader, ps_error *error) {
    utk_state *const state = reader->state;
    unsigned char header[HEADER_BYTES];
    size_t count = 0;
    PS_TRY(ps_input_read(&reader->input, header, HEADER_BYTES, &count, error));
    if (count < HEADER_BYTES || memcmp(header, magic, sizeof magic - 1) != 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s does not begin with the header of UTK binary",
                       reader->input.name);
    }
    if (header[TYPE] >= sizeof types / sizeof types[0]) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: its values have the type %u; 0 to %d are known", reader->input.name,
                       header[TYPE], TYPE_DOUBLE);
    }
    state->type = types[header[TYPE]];
    state->num_sets = (uint32_t)ps_bytes_number(header + SETS, COUNT_BYTES);
    state->num_points = (uint32_t)ps_bytes_number(header + POINTS, COUNT_BYTES);
    state->dimension = (uint32_t)ps_bytes_number(header + DIMENSION, COUNT_BYTES);
    return PSPEC_OK;
}

static pspec_status open_utk(ps_point_reader *reader, ps_error *error) {
    PS_TRY(ps_allocate(&reader->state, 1, sizeof(utk_state), "UTK reader", error));
    utk_state *const state = reader->state;
    PS_TRY(read_header(reader, error));
    if (state->num_sets == 0 || state->num_points == 0 || state->dimension == 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s holds no points", reader->input.name);
    }
    if (state->dimension > PS_MAX_COLUMNS) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s: dimension %u; at most %d are read",
                       reader->input.name, state->dimension, PS_MAX_DIMENSION);
    }
    if (state->type.kind != PS_ELEMENT_FLOAT && reader->options.wrap) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s holds whole numbers, which --wrap would all make 0; divide them by "
                       "their range first",
                       reader->input.name);
    }
    reader->columns = state->dimension;
    return check_size(reader, error);
}

/* After the last set of an input whose size is not known. */
static pspec_status check_end(ps_point_reader *reader, ps_error *error) {
    const unsigned char *bytes = NULL;
    size_t count = 0;
    PS_TRY(ps_input_peek(&reader->input, 1, &bytes, &count, error));
    return count == 0 ? PSPEC_OK
                      : ps_fail(error, PSPEC_ERROR_INPUT, "%s goes on after its last set",
                                reader->input.name);
}

/* UTK 2.0.1 writes its first set over and over. Averages of that would have no standard error, and
 * only whoever made the file knows whether the sets are equal by right. */
static pspec_status end_set(ps_point_reader *reader, ps_error *error) {
    utk_state *const state = reader->state;
    if (reader->num_sets == 0) {
        state->first_sum = state->sum;
    } else if (reader->num_sets == 1 && state->sum == state->first_sum &&
               reader->options.sets.last == 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: set 2 repeats set 1, as in files that UTK 2.0.1 wrote; "
                       "--select-sets 1 reads the first, --select-sets 1..%u all of them",
                       reader->input.name, state->num_sets);
    }
    state->sum = 0;
    return reader->num_sets + 1 < state->num_sets ? PSPEC_OK : check_end(reader, error);
}

static pspec_status read_utk(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    utk_state *const state = reader->state;
    const size_t left = state->num_points - reader->rows_in_set;
    const size_t num = left < out->capacity ? left : out->capacity;
    size_t num_values = 0;
    PS_TRY(ps_elements_read(&reader->input, state->type, out->rows, num * reader->columns,
                            &num_values, error));
    if (num_values < num * reader->columns) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s is truncated: it ends inside set %llu of %u",
                       reader->input.name, (unsigned long long)reader->num_sets + 1,
                       state->num_sets);
    }
    out->num = num;
    if (state->num_sets > 1 && reader->num_sets < 2) {
        state->sum =
            crc32_z(state->sum, (const unsigned char *)out->rows, num_values * sizeof *out->rows);
    }
    if (num < left) {
        return PSPEC_OK;
    }
    out->end = reader->num_sets + 1 == state->num_sets ? PS_END_OF_INPUT : PS_END_OF_SET;
    return end_set(reader, error);
}

/* ---- writing ----------------------------------------------------------------------------- */

static void begin_utk(ps_point_writer *writer) {
    unsigned char header[HEADER_BYTES] = {0};
    memcpy(header, magic, sizeof magic - 1);
    header[TYPE] = TYPE_DOUBLE;
    ps_bytes_put(header + SETS, writer->shape.num_sets, COUNT_BYTES);
    ps_bytes_put(header + POINTS, writer->shape.num_points, COUNT_BYTES);
    ps_bytes_put(header + DIMENSION, writer->columns, COUNT_BYTES);
    ps_output_write(writer->file, header, 1, sizeof header);
}

static void write_utk(ps_point_writer *writer, const double *rows, size_t num_rows) {
    ps_elements_write(writer->file, rows, num_rows * writer->columns);
}

const ps_point_format ps_format_utk_binary = {.name = "utk-binary",
                                              .endings = {".bin"},
                                              .magic = magic,
                                              .open = open_utk,
                                              .read = read_utk,
                                              .abilities = PS_HOLDS_SETS | PS_HOLDS_TORUS |
                                                           PS_HOLDS_VECTORS | PS_NEEDS_COUNTS,
                                              .max_count = UINT32_MAX,
                                              .begin = begin_utk,
                                              .write = write_utk};
