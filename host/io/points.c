/* The table of point formats, and what all formats share. */
#include "io/points.h"

#include "base/memory.h"
#include "io/points_format.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* The first format is the one that is meant when nothing tells. */
static const ps_point_format *const formats[] = {&ps_format_utk_text, &ps_format_npy};
enum { NUM_FORMATS = sizeof formats / sizeof formats[0] };

static pspec_status find_format(const char *name, const ps_point_format **out, ps_error *error) {
    for (size_t i = 0; i < NUM_FORMATS; i++) {
        if (strcmp(formats[i]->name, name) == 0) {
            *out = formats[i];
            return PSPEC_OK;
        }
    }
    char known[128] = "";
    for (size_t i = 0; i < NUM_FORMATS; i++) {
        strncat(known, i > 0 ? ", " : "", sizeof known - strlen(known) - 1);
        strncat(known, formats[i]->name, sizeof known - strlen(known) - 1);
    }
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "point format \"%s\" is not known; there are %s", name, known);
}

/* ---- sets ---- */

void ps_point_set_free(ps_point_set *set) {
    free(set->points);
    free(set->weights);
    *set = (ps_point_set){0};
}

pspec_status ps_points_reserve(ps_point_set *set, size_t num_points, ps_error *error) {
    size_t num_coordinates = 0;
    if (!ps_size_multiply(num_points, set->dimension, &num_coordinates)) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for %zu points", num_points);
    }
    void *memory = set->points;
    PS_TRY(
        ps_grow(&memory, &set->points_capacity, num_coordinates, sizeof(double), "points", error));
    set->points = memory;
    if (set->has_weights) {
        memory = set->weights;
        PS_TRY(
            ps_grow(&memory, &set->weights_capacity, num_points, sizeof(double), "weights", error));
        set->weights = memory;
    }
    return PSPEC_OK;
}

pspec_status ps_points_dimension(const ps_point_reader *reader, const char *where, size_t columns,
                                 unsigned *dimension, ps_error *error) {
    const bool has_weights = reader->options.weight_column;
    const unsigned asked = reader->options.dimension;
    if (columns <= has_weights) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: 1 column; with a weight column there must be at least 2", where);
    }
    if (columns - has_weights > PS_MAX_DIMENSION) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: %zu columns%s; at most %d dimensions are read", where, columns,
                       has_weights ? ", one of them the weight" : "", PS_MAX_DIMENSION);
    }
    *dimension = (unsigned)columns - has_weights;
    if (asked != 0 && *dimension != asked) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: %zu column%s%s, but the dimension asked for is %u%s", where, columns,
                       columns > 1 ? "s" : "", has_weights ? ", one of them the weight" : "", asked,
                       columns == asked + 1 && !has_weights ? " (is the last one a weight?)" : "");
    }
    return PSPEC_OK;
}

bool ps_coordinate_wrap(double *coordinate) {
    if (!isfinite(*coordinate)) {
        return false;
    }
    const double reduced = *coordinate - floor(*coordinate);
    *coordinate = reduced < 1 ? reduced : 0; /* -1e-20 rounds to 1, which is 0 on the torus */
    return true;
}

pspec_status ps_coordinate_refuse(const char *where, const char *text, double coordinate,
                                  ps_error *error) {
    if (!isfinite(coordinate)) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s: coordinate %s is not a finite number", where,
                       text);
    }
    return ps_fail(error, PSPEC_ERROR_INPUT,
                   "%s: coordinate %s is outside [0,1); --wrap would reduce it mod 1", where, text);
}

pspec_status ps_weight_refuse(const char *where, const char *text, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s: weight %s is not a finite number", where, text);
}

/* ---- reading ---- */

static pspec_status detect_format(ps_point_reader *reader, ps_error *error) {
    if (reader->options.format != NULL) {
        return find_format(reader->options.format, &reader->format, error);
    }
    reader->format = formats[0];
    for (size_t i = 0; i < NUM_FORMATS; i++) {
        if (formats[i]->first_byte == reader->input.first_byte) {
            reader->format = formats[i];
        }
    }
    return PSPEC_OK;
}

pspec_status ps_points_open(ps_point_reader **out, const char *path,
                            const ps_point_options *options, ps_error *error) {
    *out = NULL;
    if (options->dimension > PS_MAX_DIMENSION) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "dimension %u is not between 1 and %d",
                       options->dimension, PS_MAX_DIMENSION);
    }
    void *memory = NULL;
    PS_TRY(ps_allocate(&memory, 1, sizeof(ps_point_reader), "point reader", error));
    ps_point_reader *reader = memory;
    reader->options = *options;
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, ps_input_open(&reader->input, path, error));
    PS_TRY_OUT(status, detect_format(reader, error));
    PS_TRY_OUT(status, reader->format->open(reader, error));
    *out = reader;
    return PSPEC_OK;
out:
    ps_points_close(reader);
    return status;
}

pspec_status ps_points_next(ps_point_reader *reader, ps_point_set *set, bool *has_set,
                            ps_error *error) {
    *has_set = false;
    set->num_points = 0;
    set->has_weights = reader->options.weight_column;
    PS_TRY(reader->format->next(reader, set, has_set, error));
    if (!*has_set && reader->num_sets == 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s holds no points", reader->input.name);
    }
    reader->num_sets += *has_set;
    return PSPEC_OK;
}

const char *ps_points_format(const ps_point_reader *reader) {
    return reader->format->name;
}

void ps_points_close(ps_point_reader *reader) {
    if (reader != NULL) {
        if (reader->format != NULL) {
            reader->format->close(reader);
        }
        ps_input_close(&reader->input);
        free(reader);
    }
}

/* ---- writing ---- */

static const ps_point_format *format_by_ending(const char *path) {
    for (size_t i = 0; i < NUM_FORMATS; i++) {
        const char *const ending = formats[i]->ending;
        if (ending != NULL && strlen(path) > strlen(ending) &&
            strcasecmp(path + strlen(path) - strlen(ending), ending) == 0) {
            return formats[i];
        }
    }
    return formats[0];
}

pspec_status ps_points_create(ps_point_writer **out, const char *path, const char *format,
                              size_t num_sets, size_t num_points, unsigned dimension,
                              ps_error *error) {
    *out = NULL;
    const ps_point_format *chosen = format_by_ending(path);
    if (format != NULL) {
        PS_TRY(find_format(format, &chosen, error));
    }
    if (chosen->write == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "point format \"%s\" is only read",
                       chosen->name);
    }
    if (dimension < 1 || dimension > PS_MAX_DIMENSION || num_sets == 0 || num_points == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: cannot write %zu sets of %zu points in %u dimensions", path, num_sets,
                       num_points, dimension);
    }
    void *memory = NULL;
    PS_TRY(ps_allocate(&memory, 1, sizeof(ps_point_writer), "point writer", error));
    ps_point_writer *writer = memory;
    *writer = (ps_point_writer){
        .format = chosen, .num_sets = num_sets, .num_points = num_points, .dimension = dimension};
    const pspec_status status = ps_output_open(&writer->file, path, error);
    if (status != PSPEC_OK) {
        ps_points_discard(writer);
        return status;
    }
    writer->format->begin(writer);
    *out = writer;
    return PSPEC_OK;
}

pspec_status ps_points_write(ps_point_writer *writer, const double *points, ps_error *error) {
    if (writer->num_written == writer->num_sets) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "one point set more than the %zu that were announced", writer->num_sets);
    }
    PS_TRY(writer->format->write(writer, points, error));
    writer->num_written++;
    return ferror(ps_output_stream(writer->file)) ? ps_output_check(writer->file, error) : PSPEC_OK;
}

pspec_status ps_points_commit(ps_point_writer *writer, ps_error *error) {
    if (writer->num_written != writer->num_sets) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%zu point sets written of the %zu that were announced", writer->num_written,
                       writer->num_sets);
    }
    return ps_output_commit(&writer->file, error);
}

void ps_points_discard(ps_point_writer *writer) {
    if (writer != NULL) {
        ps_output_discard(&writer->file);
        free(writer);
    }
}
