/* NPY arrays of points: (N,) is one set in one dimension, (N, c) one set of c columns, (M, N, c) M
 * sets. Where the options or the numbers tell, (c, N) is one set whose points are the columns:
 * so an array (N, c) in Fortran order lies in the file. openquad is such an array, of theta, phi
 * and perhaps weights. Set and row are counted from 1. */
#include "base/memory.h"
#include "files/npy_array.h"
#include "points/points_format.h"

#include <stdlib.h>
#include <string.h>

enum {
    BLOCK_ELEMENTS = 1 << 16, /* converted while still in the cache */
    CACHE_ELEMENTS = 1 << 23  /* sets kept of one pass over an array in Fortran order: 64 MiB */
};

typedef struct npy_state {
    ps_npy_header header;
    size_t num_sets, num_points;
    size_t file_columns;             /* of the array */
    unsigned picked[PS_MAX_COLUMNS]; /* of these, those of a row */
    bool is_fortran_order;
    off_t data_position; /* where the array starts; -1: a pipe */
    double *block;       /* [BLOCK_ELEMENTS], of Fortran order or picked columns */
    double *cache;       /* sets from first_cached on */
    size_t cache_capacity, first_cached, num_cached;
} npy_state;

/* ---- open -------------------------------------------------------------------------------- */

static pspec_status fail_shape(const ps_point_reader *reader, const char *what, ps_error *error) {
    const ps_npy_header *const header = &((const npy_state *)reader->state)->header;
    char shape[PS_NPY_PLACE_BYTES];
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s: an array of shape %s: %s", reader->input.name,
                   ps_npy_show(header->rank, header->shape, shape), what);
}

/* The columns are points, or would have to be: do the options or the first column tell? */
static pspec_status check_columns(ps_point_reader *reader, bool *are_points, ps_error *error) {
    const ps_npy_header *const header = &((const npy_state *)reader->state)->header;
    const ps_point_options *const options = &reader->options;
    const size_t rows = header->shape[0];
    const bool may_be_sphere = options->domain != PS_DOMAIN_TORUS && !options->wrap;
    *are_points = true;
    if (ps_columns_told(options) > 0) {
        return PSPEC_OK;
    }
    if (may_be_sphere && rows == 2) {
        return fail_shape(
            reader,
            "are its columns points of the plane, or its rows angles? --transpose, or "
            "--columns theta-phi, phi-theta or lon-lat",
            error);
    }
    reader->by_shape = options->domain == PS_DOMAIN_SPHERE ||
                       (may_be_sphere && rows == 3U + options->weight_column);
    return reader->by_shape
               ? PSPEC_OK
               : fail_shape(reader, "are its columns the points? --transpose reads them", error);
}

/* Rows of an array of two axes are points, (N, d), unless nothing but its columns could be; which
 * of both is open where it has no more rows than columns, and few. */
static pspec_status find_points(ps_point_reader *reader, bool *are_columns, ps_error *error) {
    const ps_npy_header *const header = &((const npy_state *)reader->state)->header;
    const ps_point_options *const options = &reader->options;
    *are_columns = options->transpose;
    if (options->transpose && header->rank != 2) {
        return fail_shape(reader, "--transpose is for arrays of two axes", error);
    }
    if (options->transpose || options->format != NULL || header->rank != 2) {
        return PSPEC_OK;
    }
    const size_t num_rows = header->shape[0];
    const size_t num_columns = header->shape[1];
    if (options->column_names != NULL) { /* more rows than columns are points */
        return num_rows > num_columns
                   ? PSPEC_OK
                   : fail_shape(reader,
                                "are its rows the points, or its columns? --input-format npy or "
                                "--transpose",
                                error);
    }
    const bool may_be_rows = ps_columns_agree(options, num_columns);
    const bool may_be_columns = ps_columns_agree(options, num_rows);
    if (may_be_rows && may_be_columns && num_rows <= num_columns && num_columns > 1) {
        return fail_shape(reader,
                          "are its rows the points, or its columns? --input-format npy or "
                          "--transpose, or openquad for rows of angles",
                          error);
    }
    /* what -d says could lack a column of weights */
    const bool is_refused =
        options->columns == NULL && options->dimension > 0 && num_columns <= PS_MAX_COLUMNS;
    const bool are_angles = num_rows == 2 && num_columns > PS_MAX_COLUMNS;
    return !may_be_rows && (may_be_columns || are_angles) && !is_refused
               ? check_columns(reader, are_columns, error)
               : PSPEC_OK;
}

/* All columns, or those that --columns numbers. */
static pspec_status pick_columns(ps_point_reader *reader, size_t num, ps_error *error) {
    npy_state *const state = reader->state;
    const char *const numbers = reader->options.column_names;
    unsigned num_picked = (unsigned)num;
    for (unsigned i = 0; i < PS_MAX_COLUMNS; i++) {
        state->picked[i] = i + 1;
    }
    if (numbers != NULL) {
        ps_columns_numbers(numbers, state->picked, PS_MAX_COLUMNS, &num_picked);
        reader->own_columns = ps_columns_meaning(numbers);
        reader->chosen = numbers;
    }
    if (num_picked > PS_MAX_COLUMNS || num > BLOCK_ELEMENTS) {
        return fail_shape(reader,
                          "points are rows of at most 6 dimensions; --columns 1,2 chooses columns",
                          error);
    }
    for (unsigned i = 0; i < num_picked; i++) {
        if (state->picked[i]-- > num) {
            return fail_shape(reader, "--columns asks for a column that is not there", error);
        }
    }
    state->file_columns = num;
    reader->columns = num_picked;
    return PSPEC_OK;
}

static pspec_status take_columns(ps_point_reader *reader, ps_error *error) {
    npy_state *const state = reader->state;
    const ps_npy_header *const header = &state->header;
    state->num_sets = 1;
    state->num_points = header->shape[1];
    state->is_fortran_order = !header->is_fortran_order;
    return pick_columns(reader, header->shape[0], error);
}

static pspec_status interpret_openquad(ps_point_reader *reader, ps_error *error) {
    const ps_npy_header *const header = &((const npy_state *)reader->state)->header;
    if (header->rank != 2 || header->shape[0] < 2 || header->shape[0] > 3) {
        return fail_shape(reader, "openquad has (2, N) or (3, N): theta, phi, and perhaps weights",
                          error);
    }
    if (reader->options.transpose) {
        return fail_shape(reader, "--transpose does not go with openquad, whose rows are angles",
                          error);
    }
    PS_TRY(take_columns(reader, error));
    reader->own_columns = reader->columns == 3 ? "theta-phi-w" : "theta-phi";
    return PSPEC_OK;
}

static pspec_status interpret_points(ps_point_reader *reader, ps_error *error) {
    npy_state *const state = reader->state;
    const ps_npy_header *const header = &state->header;
    const size_t *const extent = header->shape;
    bool are_columns = false;
    PS_TRY(find_points(reader, &are_columns, error));
    if (are_columns && (extent[0] <= PS_MAX_COLUMNS || reader->options.column_names != NULL)) {
        return take_columns(reader, error);
    }
    if (header->rank < 1 || header->rank > 3) {
        return fail_shape(reader, "points are (N, d), (M, N, d) or (N)", error);
    }
    const size_t columns = header->rank == 1 ? 1 : extent[header->rank - 1];
    state->num_sets = header->rank == 3 ? extent[0] : 1;
    state->num_points = header->rank == 3 ? extent[1] : extent[0];
    state->is_fortran_order = header->is_fortran_order && header->rank > 1;
    return pick_columns(reader, columns, error);
}

static pspec_status open_npy(ps_point_reader *reader, ps_error *error) {
    PS_TRY(ps_allocate(&reader->state, 1, sizeof(npy_state), "NPY reader", error));
    npy_state *const state = reader->state;
    PS_TRY(ps_npy_read_header(&reader->input, &state->header, false, error));
    if (state->header.num_elements == 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s holds no points", reader->input.name);
    }
    PS_TRY(reader->format == &ps_format_openquad ? interpret_openquad(reader, error)
                                                 : interpret_points(reader, error));
    state->data_position = reader->input.is_seekable ? ps_input_position(&reader->input) : -1;
    reader->rows_per_set = state->data_position >= 0 ? state->num_points : 0;
    reader->is_scattered =
        state->is_fortran_order && (state->num_sets > 1 || state->data_position < 0);
    if (state->is_fortran_order || reader->chosen != NULL) {
        PS_TRY(PS_NEW(&state->block, BLOCK_ELEMENTS, "NPY block", error));
    }
    return PSPEC_OK;
}

static void close_npy(ps_point_reader *reader) {
    const npy_state *const state = reader->state;
    free(state->block);
    free(state->cache);
}

/* ---- Fortran order: set fastest, then point, then column --------------------------------- */

/* Puts num elements of the file, from number first on, where the cache has them: sets from
 * first_cached on, each in C order. */
static void scatter_block(const ps_point_reader *reader, size_t first, size_t num) {
    const npy_state *const state = reader->state;
    size_t set = first % state->num_sets;
    size_t point = first / state->num_sets % state->num_points;
    size_t column = first / state->num_sets / state->num_points;
    for (size_t i = 0; i < num; i++) {
        const size_t slot = set - state->first_cached; /* earlier sets wrap around to large ones */
        for (unsigned j = 0; slot < state->num_cached && j < reader->columns; j++) {
            if (state->picked[j] == column) {
                state->cache[(slot * state->num_points + point) * reader->columns + j] =
                    state->block[i];
            }
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

/* Half of a limit that was typed: the other half is for the points that are handed out. */
static size_t cache_elements(const ps_point_reader *reader) {
    const uint64_t limit = reader->options.memory_limit;
    const uint64_t half = limit / 2 / sizeof(double);
    return limit > 0 && half < CACHE_ELEMENTS ? (size_t)half : CACHE_ELEMENTS;
}

static pspec_status check_set(const ps_point_reader *reader, size_t set_elements, ps_error *error) {
    const uint64_t limit = reader->options.memory_limit;
    char size[PS_SIZE_TEXT];
    char most[PS_SIZE_TEXT];
    return limit == 0 || set_elements <= limit / 2 / sizeof(double)
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_MEMORY,
                         "%.440s: a set takes %s, and sets in Fortran order half of %s at most, "
                         "the limit of --memory; save the array in C order",
                         reader->input.name,
                         ps_size_show(size, (double)set_elements * (double)sizeof(double)),
                         ps_size_show(most, (double)limit));
}

/* One pass over the array fills the cache with as many sets as it is meant to hold, at least the
 * one that is wanted. */
static pspec_status fill_cache(ps_point_reader *reader, size_t wanted, ps_error *error) {
    npy_state *const state = reader->state;
    const size_t set_elements = state->num_points * reader->columns;
    const size_t most = cache_elements(reader);
    const size_t fitting = set_elements < most ? most / set_elements : 1;
    PS_TRY(check_set(reader, set_elements, error));
    const size_t left = state->num_sets - wanted;
    state->first_cached = wanted;
    state->num_cached = left < fitting ? left : fitting;
    if (wanted > 0) {
        PS_TRY(ps_input_seek(&reader->input, state->data_position, error));
    }
    void *memory = state->cache;
    PS_TRY(ps_grow(&memory, &state->cache_capacity, state->num_cached * set_elements,
                   sizeof(double), "sets in Fortran order", error));
    state->cache = memory;
    for (size_t first = 0; first < state->header.num_elements; first += BLOCK_ELEMENTS) {
        const size_t rest = state->header.num_elements - first;
        const size_t num = rest < BLOCK_ELEMENTS ? rest : BLOCK_ELEMENTS;
        PS_TRY(ps_npy_read_elements(&reader->input, &state->header, state->block, num, error));
        scatter_block(reader, first, num);
    }
    return PSPEC_OK;
}

static pspec_status read_cached(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    npy_state *const state = reader->state;
    const size_t wanted = (size_t)reader->num_sets;
    if (state->data_position < 0 && state->header.num_elements > cache_elements(reader)) {
        return ps_fail(
            error, PSPEC_ERROR_INPUT,
            "%s: an array in Fortran order of more than %zu elements cannot be read from "
            "a pipe%s; save it in C order",
            reader->input.name, cache_elements(reader),
            cache_elements(reader) < CACHE_ELEMENTS ? " with this --memory" : "");
    }
    if (wanted - state->first_cached >= state->num_cached) {
        PS_TRY(fill_cache(reader, wanted, error));
    }
    const size_t row = (wanted - state->first_cached) * state->num_points + reader->rows_in_set;
    memcpy(out->rows, state->cache + row * reader->columns,
           out->num * reader->columns * sizeof(double));
    return PSPEC_OK;
}

/* One set lies column by column in the file: the rows are gathered from as many places. */
static pspec_status gather_columns(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    const npy_state *const state = reader->state;
    for (unsigned column = 0; column < reader->columns; column++) {
        for (size_t first = 0; first < out->num; first += BLOCK_ELEMENTS) {
            const size_t left = out->num - first;
            const size_t num = left < BLOCK_ELEMENTS ? left : BLOCK_ELEMENTS;
            const size_t element =
                state->picked[column] * state->num_points + reader->rows_in_set + first;
            PS_TRY(ps_input_seek(
                &reader->input,
                state->data_position + (off_t)(element * state->header.type.num_bytes), error));
            PS_TRY(ps_npy_read_elements(&reader->input, &state->header, state->block, num, error));
            for (size_t i = 0; i < num; i++) {
                out->rows[(first + i) * reader->columns + column] = state->block[i];
            }
        }
    }
    return PSPEC_OK;
}

/* Rows of C order, of which some columns are picked. */
static pspec_status read_picked(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    const npy_state *const state = reader->state;
    const size_t fitting = BLOCK_ELEMENTS / state->file_columns;
    for (size_t first = 0; first < out->num; first += fitting) {
        const size_t num = out->num - first < fitting ? out->num - first : fitting;
        PS_TRY(ps_npy_read_elements(&reader->input, &state->header, state->block,
                                    num * state->file_columns, error));
        for (size_t i = 0; i < num; i++) {
            for (unsigned j = 0; j < reader->columns; j++) {
                out->rows[(first + i) * reader->columns + j] =
                    state->block[i * state->file_columns + state->picked[j]];
            }
        }
    }
    return PSPEC_OK;
}

/* ---- read -------------------------------------------------------------------------------- */

static pspec_status read_npy(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    const npy_state *const state = reader->state;
    const size_t left = state->num_points - reader->rows_in_set;
    out->num = left < out->capacity ? left : out->capacity;
    if (!state->is_fortran_order && reader->chosen != NULL) {
        PS_TRY(read_picked(reader, out, error));
    } else if (!state->is_fortran_order) {
        PS_TRY(ps_npy_read_elements(&reader->input, &state->header, out->rows,
                                    out->num * reader->columns, error));
    } else if (!reader->is_scattered) {
        PS_TRY(gather_columns(reader, out, error));
    } else {
        PS_TRY(read_cached(reader, out, error));
    }
    if (out->num < left) {
        return PSPEC_OK;
    }
    const bool is_last = reader->num_sets + 1 == state->num_sets;
    out->end = is_last ? PS_END_OF_INPUT : PS_END_OF_SET;
    return is_last && !reader->input.is_seekable ? ps_npy_check_end(&reader->input, error)
                                                 : PSPEC_OK;
}

/* ---- write ------------------------------------------------------------------------------- */

static void begin_npy(ps_point_writer *writer) {
    const size_t shape[] = {writer->shape.num_sets, writer->shape.num_points, writer->columns};
    ps_npy_write_header(writer->file, "f8", 3, shape);
}

static void write_npy(ps_point_writer *writer, const double *rows, size_t num_rows) {
    ps_output_write(writer->file, rows, sizeof *rows, num_rows * writer->columns);
}

const ps_point_format ps_format_npy = {.name = "npy",
                                       .endings = {".npy"},
                                       .magic = "\x93NUMPY",
                                       .open = open_npy,
                                       .read = read_npy,
                                       .close = close_npy,
                                       .abilities = PS_HOLDS_SETS | PS_HOLDS_WEIGHTS |
                                                    PS_HOLDS_TORUS | PS_HOLDS_VECTORS |
                                                    PS_HOLDS_ANGLES | PS_NEEDS_COUNTS,
                                       .begin = begin_npy,
                                       .write = write_npy};

const ps_point_format ps_format_openquad = {.name = "openquad",
                                            .open = open_npy,
                                            .read = read_npy,
                                            .close = close_npy,
                                            .abilities = PS_HOLDS_WEIGHTS | PS_HOLDS_ANGLES,
                                            .write = ps_openquad_write,
                                            .finish = ps_openquad_finish};
