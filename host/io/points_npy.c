/* NPY arrays of points: (N,) is one set in one dimension, (N, d) one set, (M, N, d) M sets; with a
 * weight column the last axis is one longer. Set and row are counted from 1 in messages. */
#include "base/memory.h"
#include "io/npy.h"
#include "io/points_format.h"

#include <math.h>
#include <stdlib.h>

enum {
    BLOCK_ELEMENTS = 1 << 16, /* converted and checked while still in the cache */
    CACHE_ELEMENTS = 1 << 23  /* sets kept of one pass over an array in Fortran order: 64 MiB */
};

typedef struct npy_state {
    ps_npy_header header;
    size_t num_sets, num_points, columns;
    unsigned dimension;
    double *block; /* [BLOCK_ELEMENTS] */
    /* Fortran order only: where the array starts (-1: a pipe), and sets from first_cached on. */
    off_t data_position;
    double *cache;
    size_t cache_capacity, first_cached, num_cached;
} npy_state;

static pspec_status interpret_shape(ps_point_reader *reader, npy_state *state, ps_error *error) {
    const ps_npy_header *const header = &state->header;
    if (header->rank < 1 || header->rank > 3) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: an array with %u axes; points are (N, d), (M, N, d) or (N)",
                       reader->input.name, header->rank);
    }
    const size_t *const extent = header->shape;
    state->num_sets = header->rank == 3 ? extent[0] : 1;
    state->num_points = header->rank == 3 ? extent[1] : extent[0];
    state->columns = header->rank == 1 ? 1 : extent[header->rank - 1];
    if (header->num_elements == 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s holds no points", reader->input.name);
    }
    return ps_points_dimension(reader, reader->input.name, state->columns, &state->dimension,
                               error);
}

static pspec_status npy_open(ps_point_reader *reader, ps_error *error) {
    PS_TRY(ps_allocate(&reader->state, 1, sizeof(npy_state), "NPY reader", error));
    npy_state *const state = reader->state;
    ungetc(reader->input.first_byte, reader->input.stream);
    PS_TRY(ps_npy_read_header(reader->input.stream, reader->input.name, &state->header, error));
    PS_TRY(interpret_shape(reader, state, error));
    state->data_position = ftello(reader->input.stream);
    void *memory = NULL;
    PS_TRY(ps_allocate(&memory, BLOCK_ELEMENTS, sizeof(double), "NPY block", error));
    state->block = memory;
    return PSPEC_OK;
}

static void npy_close(ps_point_reader *reader) {
    npy_state *const state = reader->state;
    if (state != NULL) {
        free(state->block);
        free(state->cache);
        free(state);
    }
}

/* ---- checks ---- */

static pspec_status refuse_value(const ps_point_reader *reader, size_t row, bool is_weight,
                                 double value, ps_error *error) {
    char where[512];
    char text[32];
    snprintf(where, sizeof where, "%.440s, set %zu, row %zu", reader->input.name,
             reader->num_sets + 1, row + 1);
    snprintf(text, sizeof text, "%.17g", value);
    return is_weight ? ps_weight_refuse(where, text, error)
                     : ps_coordinate_refuse(where, text, value, error);
}

/* Checks coordinates [first, first + count) of the set; a loop without branches, since nearly
 * always all are good. */
static pspec_status check_coordinates(const ps_point_reader *reader, ps_point_set *set,
                                      size_t first, size_t count, ps_error *error) {
    double *const values = set->points + first;
    int are_good = 1;
    for (size_t i = 0; i < count; i++) {
        are_good &= (values[i] >= 0) & (values[i] < 1);
    }
    for (size_t i = 0; !are_good && i < count; i++) {
        const double value = values[i];
        if (!ps_coordinate_accept(&values[i], reader->options.wrap)) {
            return refuse_value(reader, (first + i) / set->dimension, false, value, error);
        }
    }
    return PSPEC_OK;
}

/* ---- C order ---- */

/* A pipe may promise more than it brings: memory then grows with what has come. */
static pspec_status reserve_rows(const npy_state *state, ps_point_set *set, size_t num_rows,
                                 ps_error *error) {
    return ps_points_reserve(set, state->data_position >= 0 ? state->num_points : num_rows, error);
}

/* Coordinates only: the file has them as the set does. */
static pspec_status read_coordinates(ps_point_reader *reader, ps_point_set *set, ps_error *error) {
    const npy_state *const state = reader->state;
    const size_t rows_per_block = BLOCK_ELEMENTS / state->columns;
    for (size_t row = 0; row < state->num_points; row += rows_per_block) {
        const size_t left = state->num_points - row;
        const size_t num_rows = left < rows_per_block ? left : rows_per_block;
        const size_t first = row * state->columns;
        PS_TRY(reserve_rows(state, set, row + num_rows, error));
        PS_TRY(ps_npy_read_elements(reader->input.stream, reader->input.name, &state->header,
                                    set->points + first, num_rows * state->columns, error));
        PS_TRY(check_coordinates(reader, set, first, num_rows * state->columns, error));
    }
    return PSPEC_OK;
}

/* Takes num_rows rows of columns values apart; row is the number of the first. */
static pspec_status split_rows(const ps_point_reader *reader, const double *rows, size_t row,
                               size_t num_rows, ps_point_set *set, ps_error *error) {
    const unsigned d = set->dimension;
    const size_t columns = d + (size_t)set->has_weights;
    for (size_t i = 0; i < num_rows; i++) {
        for (unsigned j = 0; j < d; j++) {
            set->points[(row + i) * d + j] = rows[i * columns + j];
        }
        if (set->has_weights) {
            const double weight = rows[i * columns + d];
            set->weights[row + i] = weight;
            if (!isfinite(weight)) {
                return refuse_value(reader, row + i, true, weight, error);
            }
        }
    }
    return check_coordinates(reader, set, row * d, num_rows * d, error);
}

static pspec_status read_rows(ps_point_reader *reader, ps_point_set *set, ps_error *error) {
    const npy_state *const state = reader->state;
    const size_t rows_per_block = BLOCK_ELEMENTS / state->columns;
    for (size_t row = 0; row < state->num_points; row += rows_per_block) {
        const size_t left = state->num_points - row;
        const size_t num_rows = left < rows_per_block ? left : rows_per_block;
        PS_TRY(reserve_rows(state, set, row + num_rows, error));
        PS_TRY(ps_npy_read_elements(reader->input.stream, reader->input.name, &state->header,
                                    state->block, num_rows * state->columns, error));
        PS_TRY(split_rows(reader, state->block, row, num_rows, set, error));
    }
    return PSPEC_OK;
}

/* ---- Fortran order: set fastest, then point, then column ---- */

/* Puts num elements of the file, from number first on, where target has them: sets from
 * first_cached on, each in C order. */
static void scatter_block(const npy_state *state, size_t first, size_t num, double *target) {
    size_t set = first % state->num_sets;
    size_t point = first / state->num_sets % state->num_points;
    size_t column = first / state->num_sets / state->num_points;
    for (size_t i = 0; i < num; i++) {
        const size_t slot = set - state->first_cached; /* earlier sets wrap around to large ones */
        if (slot < state->num_cached) {
            target[(slot * state->num_points + point) * state->columns + column] = state->block[i];
        }
        if (++set == state->num_sets) {
            set = 0;
            if (++point == state->num_points) {
                point = 0;
                column++;
            }
        }
    }
}

static pspec_status scatter_array(ps_point_reader *reader, double *target, ps_error *error) {
    const npy_state *const state = reader->state;
    for (size_t first = 0; first < state->header.num_elements; first += BLOCK_ELEMENTS) {
        const size_t rest = state->header.num_elements - first;
        const size_t num = rest < BLOCK_ELEMENTS ? rest : BLOCK_ELEMENTS;
        PS_TRY(ps_npy_read_elements(reader->input.stream, reader->input.name, &state->header,
                                    state->block, num, error));
        scatter_block(state, first, num, target);
    }
    return PSPEC_OK;
}

/* One pass over the array fills the cache with as many sets as it is meant to hold, at least the
 * one that is wanted. */
static pspec_status fill_cache(ps_point_reader *reader, size_t wanted, ps_error *error) {
    npy_state *const state = reader->state;
    const size_t set_elements = state->num_points * state->columns;
    const size_t fitting = set_elements < CACHE_ELEMENTS ? CACHE_ELEMENTS / set_elements : 1;
    const size_t left = state->num_sets - wanted;
    state->first_cached = wanted;
    state->num_cached = left < fitting ? left : fitting;
    if (wanted > 0 && fseeko(reader->input.stream, state->data_position, SEEK_SET) != 0) {
        return ps_input_fail(reader->input.name, error);
    }
    void *memory = state->cache;
    PS_TRY(ps_grow(&memory, &state->cache_capacity, state->num_cached * set_elements,
                   sizeof(double), "sets in Fortran order", error));
    state->cache = memory;
    return scatter_array(reader, state->cache, error);
}

/* A single set needs no cache; numpy.array([x, y]).T is saved like this. */
static pspec_status read_transposed(ps_point_reader *reader, ps_point_set *set, ps_error *error) {
    npy_state *const state = reader->state;
    state->num_cached = 1;
    PS_TRY(scatter_array(reader, set->points, error));
    return check_coordinates(reader, set, 0, state->header.num_elements, error);
}

static pspec_status read_fortran(ps_point_reader *reader, ps_point_set *set, ps_error *error) {
    npy_state *const state = reader->state;
    const size_t wanted = reader->num_sets;
    if (state->data_position < 0 && state->header.num_elements > CACHE_ELEMENTS) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: an array in Fortran order of more than %d elements cannot be read from "
                       "a pipe; save it in C order",
                       reader->input.name, CACHE_ELEMENTS);
    }
    PS_TRY(ps_points_reserve(set, state->num_points, error));
    if (state->num_sets == 1 && !set->has_weights) {
        return read_transposed(reader, set, error);
    }
    if (wanted - state->first_cached >= state->num_cached) {
        PS_TRY(fill_cache(reader, wanted, error));
    }
    const size_t set_elements = state->num_points * state->columns;
    const double *const rows = state->cache + (wanted - state->first_cached) * set_elements;
    return split_rows(reader, rows, 0, state->num_points, set, error);
}

/* ---- the format ---- */

static pspec_status npy_next(ps_point_reader *reader, ps_point_set *set, bool *has_set,
                             ps_error *error) {
    const npy_state *const state = reader->state;
    if (reader->num_sets == state->num_sets) {
        return ps_npy_check_end(reader->input.stream, reader->input.name, error);
    }
    set->dimension = state->dimension;
    PS_TRY(state->header.is_fortran_order ? read_fortran(reader, set, error)
           : set->has_weights             ? read_rows(reader, set, error)
                                          : read_coordinates(reader, set, error));
    set->num_points = state->num_points;
    *has_set = true;
    return PSPEC_OK;
}

static void npy_begin(ps_point_writer *writer) {
    const size_t shape[] = {writer->num_sets, writer->num_points, writer->dimension};
    ps_npy_write_header(ps_output_stream(writer->file), 3, shape);
}

static pspec_status npy_write(ps_point_writer *writer, const double *points, ps_error *error) {
    size_t count = 0;
    if (!ps_size_multiply(writer->num_points, writer->dimension, &count)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%zu points are too many",
                       writer->num_points);
    }
    ps_output_write(writer->file, points, sizeof *points, count);
    return PSPEC_OK;
}

const ps_point_format ps_format_npy = {.name = "npy",
                                       .ending = ".npy",
                                       .first_byte = 0x93,
                                       .open = npy_open,
                                       .next = npy_next,
                                       .close = npy_close,
                                       .begin = npy_begin,
                                       .write = npy_write};
