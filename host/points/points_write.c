/* Writing, as far as it is the same for all formats. */
#include "base/memory.h"
#include "points/points_format.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STAGING_VALUES = 1 << 16 };

/* ---- what a format can hold -------------------------------------------------------------- */

static pspec_status check_counts(const ps_point_format *format, const ps_point_shape *shape,
                                 ps_error *error) {
    if (shape->num_sets > 1 && (format->abilities & PS_HOLDS_SETS) == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s holds one set per file, and there are %zu", format->name,
                       shape->num_sets);
    }
    const uint64_t largest =
        shape->num_sets > shape->num_points ? shape->num_sets : shape->num_points;
    if (format->max_count != 0 && largest > format->max_count) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s counts to %llu, not to %llu",
                       format->name, (unsigned long long)format->max_count,
                       (unsigned long long)largest);
    }
    return PSPEC_OK;
}

static pspec_status check_points(const ps_point_writer *writer, ps_error *error) {
    const ps_point_format *const format = writer->format;
    const ps_point_shape *const shape = &writer->shape;
    const ps_coordinates coordinates =
        writer->layout.angles != PS_NO_ANGLES ? PS_ANGLES : writer->layout.coordinates;
    static const struct {
        ps_format_ability ability;
        const char *what;
    } kinds[] = {[PS_TORUS_COORDINATES] = {PS_HOLDS_TORUS, "points of the torus"},
                 [PS_UNIT_VECTORS] = {PS_HOLDS_VECTORS, "vectors"},
                 [PS_ANGLES] = {PS_HOLDS_ANGLES, "angles"}};
    if ((format->abilities & kinds[coordinates].ability) == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s does not hold %s", format->name,
                       kinds[coordinates].what);
    }
    const unsigned most =
        format->only_dimension != 0 ? format->only_dimension : (unsigned)PS_MAX_DIMENSION;
    if (coordinates == PS_TORUS_COORDINATES &&
        (shape->dimension > most || shape->dimension < format->only_dimension)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s does not hold points in %u dimension%s", format->name, shape->dimension,
                       shape->dimension == 1 ? "" : "s");
    }
    if (shape->has_weights && (format->abilities & PS_HOLDS_WEIGHTS) == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s does not hold weights; --weights equal drops them", format->name);
    }
    return PSPEC_OK;
}

/* ---- create ------------------------------------------------------------------------------ */

/* openquad holds theta, phi whatever the points are. */
static pspec_status make_layout(ps_point_writer *writer, ps_error *error) {
    if (writer->format == &ps_format_openquad && writer->shape.columns == NULL &&
        writer->shape.coordinates == PS_UNIT_VECTORS) {
        writer->shape.columns = writer->shape.has_weights ? "theta-phi-w" : "theta-phi";
    }
    PS_TRY(ps_columns_for_writing(&writer->layout, &writer->shape, error));
    writer->columns = ps_layout_columns(&writer->layout);
    return check_points(writer, error);
}

static pspec_status open_output(ps_point_writer *writer, const char *path, ps_error *error) {
    PS_TRY(ps_output_open(&writer->file, path, error));
    writer->completes_header = (writer->format->abilities & PS_NEEDS_COUNTS) != 0 &&
                               (writer->shape.num_sets == 0 || writer->shape.num_points == 0);
    if (writer->completes_header) {
        PS_TRY(ps_output_make_seekable(writer->file, error));
    }
    if (writer->format->begin != NULL) {
        writer->format->begin(writer);
    }
    return PSPEC_OK;
}

pspec_status ps_points_create(ps_point_writer **out, const char *path, const char *format,
                              const ps_point_shape *shape, ps_error *error) {
    *out = NULL;
    const ps_point_format *chosen = NULL;
    if (format == NULL) {
        PS_TRY(ps_points_check_ending(path, error));
    }
    PS_TRY(ps_point_format_find(format != NULL ? format : ps_points_format_by_ending(path), &chosen,
                                error));
    PS_TRY(check_counts(chosen, shape, error));
    ps_point_writer *writer = NULL;
    PS_TRY(PS_NEW(&writer, 1, "point writer", error));
    *writer = (ps_point_writer){.format = chosen, .shape = *shape};
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, make_layout(writer, error));
    PS_TRY_OUT(status, PS_NEW(&writer->staging, STAGING_VALUES, "rows", error));
    PS_TRY_OUT(status, open_output(writer, path, error));
    *out = writer;
    return PSPEC_OK;
out:
    ps_points_discard(writer);
    return status;
}

/* ---- write ------------------------------------------------------------------------------- */

static pspec_status begin_set(ps_point_writer *writer, ps_error *error) {
    const ps_point_shape *const shape = &writer->shape;
    if (shape->num_sets != 0 && writer->num_sets == shape->num_sets && !writer->completes_header) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "one point set more than the %zu that were announced", shape->num_sets);
    }
    if (writer->num_sets > 0 && (writer->format->abilities & PS_HOLDS_SETS) == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s holds one set per file, and there are more; --select-sets takes one, "
                       "--merge makes one of all",
                       writer->format->name);
    }
    if (writer->format->begin_set != NULL) {
        writer->format->begin_set(writer);
    }
    return PSPEC_OK;
}

/* Arrays are rectangular: all sets have the points of the first. */
static pspec_status end_set(ps_point_writer *writer, ps_error *error) {
    ps_point_shape *const shape = &writer->shape;
    if (shape->num_points == 0) {
        shape->num_points = writer->rows_in_set;
    }
    if ((writer->format->abilities & (PS_NEEDS_COUNTS | PS_EQUAL_SETS)) != 0 &&
        writer->rows_in_set != shape->num_points) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "set %zu has %zu points instead of %zu, and all sets of %s have the same "
                       "number",
                       writer->num_sets + 1, writer->rows_in_set, shape->num_points,
                       writer->format->name);
    }
    writer->num_sets++;
    writer->rows_in_set = 0;
    return PSPEC_OK;
}

static void write_staged(ps_point_writer *writer, const ps_point_set *block) {
    const size_t fitting = STAGING_VALUES / writer->columns;
    for (size_t first = 0; first < block->num_points; first += fitting) {
        const size_t left = block->num_points - first;
        const size_t num = left < fitting ? left : fitting;
        ps_columns_join(&writer->layout, block->coordinates,
                        block->points + first * block->dimension,
                        block->has_weights ? block->weights + first : NULL, num, writer->staging);
        writer->format->write(writer, writer->staging, num);
    }
}

/* What a format keeps until the set is complete, with the block and its rows on their way there. */
static pspec_status check_kept(const ps_point_writer *writer, const ps_point_set *block,
                               ps_error *error) {
    const double limit = (double)writer->shape.memory_limit;
    const double rows = (double)block->num_points * writer->columns * (double)sizeof(double);
    char size[PS_SIZE_TEXT];
    return limit == 0 || writer->format->finish == NULL ||
                   (double)writer->kept.length + 2 * rows <= limit
               ? PSPEC_OK
               : ps_fail(
                     error, PSPEC_ERROR_MEMORY,
                     "set %zu takes more than %s, the limit of --memory, and %s needs it whole, "
                     "for its columns follow one another",
                     writer->num_sets + 1, ps_size_show(size, limit), writer->format->name);
}

/* Are the points of the block rows as they stand? */
static bool is_plain(const ps_point_writer *writer, const ps_point_set *block) {
    return ps_layout_is_plain(&writer->layout) && writer->layout.coordinates == block->coordinates;
}

pspec_status ps_points_write(ps_point_writer *writer, const ps_point_set *block, bool ends_set,
                             ps_error *error) {
    if (block->coordinates != writer->shape.coordinates ||
        block->dimension != writer->shape.dimension ||
        block->has_weights != writer->shape.has_weights) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "set %zu has other columns than the sets before it", writer->num_sets + 1);
    }
    if (writer->rows_in_set == 0) {
        PS_TRY(begin_set(writer, error));
    }
    PS_TRY(check_kept(writer, block, error));
    if (is_plain(writer, block)) {
        writer->format->write(writer, block->points, block->num_points);
    } else {
        write_staged(writer, block);
    }
    writer->rows_in_set += block->num_points;
    writer->num_values += (uint64_t)block->num_points * writer->columns;
    if (ends_set) {
        PS_TRY(end_set(writer, error));
    }
    return ferror(ps_output_stream(writer->file)) ? ps_output_check(writer->file, error) : PSPEC_OK;
}

/* ---- the end ----------------------------------------------------------------------------- */

static void append_hint(char *text, size_t text_bytes, const char *what, const char *option) {
    const size_t used = strlen(text);
    snprintf(text + used, text_bytes - used, "%sthe file does not say %s: read it with %s",
             used > 0 ? "; " : "", what, option);
}

/* What the reader of the file must be told, since the file does not. */
static void describe_reading(const ps_point_writer *writer, char *text, size_t text_bytes) {
    char what[64];
    char option[32];
    const bool is_torus = writer->shape.coordinates == PS_TORUS_COORDINATES;
    if (writer->format == &ps_format_rps && writer->num_sets > 1) {
        snprintf(what, sizeof what, "that its sets have %zu points", writer->shape.num_points);
        snprintf(option, sizeof option, "-n %zu", writer->shape.num_points);
        append_hint(text, text_bytes, what, option);
    }
    if (writer->format == &ps_format_rps && writer->shape.dimension != 2) {
        snprintf(what, sizeof what, "that its points have %u dimensions", writer->shape.dimension);
        snprintf(option, sizeof option, "-d %u", writer->shape.dimension);
        append_hint(text, text_bytes, what, option);
    }
    const unsigned several = 4; /* as in points_detect.c */
    if (is_torus && writer->format == &ps_format_utk_text && writer->shape.num_points == 1 &&
        writer->columns >= several) {
        snprintf(option, sizeof option, "-d %u", writer->shape.dimension);
        append_hint(text, text_bytes, "that a line is one point", option);
    }
    if (writer->format == &ps_format_openquad) {
        append_hint(text, text_bytes, "that its rows are angles", "--input-format openquad");
    }
    if (is_torus && writer->shape.has_weights && writer->format != &ps_format_edat) {
        append_hint(text, text_bytes, "that its last column holds weights", "--weights column");
    }
}

void ps_points_describe_loss(const ps_point_writer *writer, char *text, size_t text_bytes) {
    const bool turned = writer->layout.angles != PS_NO_ANGLES
                            ? writer->shape.coordinates == PS_UNIT_VECTORS
                            : writer->shape.coordinates == PS_ANGLES;
    text[0] = '\0';
    if (writer->num_rounded > 0) {
        snprintf(text, text_bytes,
                 "%llu of %llu coordinates were rounded to float32, by at most %.2g",
                 (unsigned long long)writer->num_rounded, (unsigned long long)writer->num_values,
                 writer->largest_rounding);
    } else if (turned || writer->layout.in_degrees) {
        snprintf(text, text_bytes, "directions were computed anew, rounded in their last digits");
    }
    describe_reading(writer, text, text_bytes);
}

static pspec_status complete_header(ps_point_writer *writer, ps_error *error) {
    writer->shape.num_sets = writer->num_sets;
    PS_TRY(check_counts(writer->format, &writer->shape, error));
    PS_TRY(ps_output_rewind(writer->file, error));
    writer->format->begin(writer);
    return PSPEC_OK;
}

pspec_status ps_points_commit(ps_point_writer *writer, ps_error *error) {
    const size_t announced = writer->shape.num_sets;
    if (writer->num_sets == 0 || writer->rows_in_set != 0 ||
        (announced != 0 && writer->num_sets != announced)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%zu point sets written of the %zu that were announced", writer->num_sets,
                       announced);
    }
    if (writer->format->finish != NULL) {
        PS_TRY(writer->format->finish(writer, error));
    }
    if (writer->completes_header) {
        PS_TRY(complete_header(writer, error));
    }
    return ps_output_commit(&writer->file, error);
}

void ps_points_discard(ps_point_writer *writer) {
    if (writer != NULL) {
        ps_output_discard(&writer->file);
        ps_text_free(&writer->kept);
        free(writer->staging);
        free(writer);
    }
}
