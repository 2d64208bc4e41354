/* The table of point formats, and how the format of a file is found. */
#include "points/points.h"

#include "base/memory.h"
#include "base/text.h"
#include "files/output_file.h"
#include "points/points_foreign.h"
#include "points/points_format.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* In the order of PS_INPUT_FORMATS. The first is the one that is meant when nothing tells. */
static const ps_point_format *const formats[] = {
    &ps_format_utk_text, &ps_format_csv,      &ps_format_psa_text,   &ps_format_gbn,
    &ps_format_edat,     &ps_format_eps,      &ps_format_utk_binary, &ps_format_rps,
    &ps_format_npy,      &ps_format_openquad, &ps_format_utk1,       &ps_format_lammps,
    &ps_format_xyz,      &ps_format_ply,      &ps_format_obj};
enum { NUM_FORMATS = sizeof formats / sizeof formats[0] };

static const ps_point_format *find_named(const char *name) {
    for (size_t i = 0; i < NUM_FORMATS; i++) {
        if (strcmp(formats[i]->name, name) == 0) {
            return formats[i];
        }
    }
    return NULL;
}

pspec_status ps_point_format_find(const char *name, const ps_point_format **out, ps_error *error) {
    *out = find_named(name);
    return *out != NULL && (*out)->write != NULL
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "point format \"%s\" is none of " PS_POINT_FORMATS, name);
}

static bool ends_in(const char *path, const char *ending) {
    const size_t length = strlen(path);
    return length > strlen(ending) && strcasecmp(path + length - strlen(ending), ending) == 0;
}

/* The format whose files end like this; NULL: none. */
static const ps_point_format *find_ending(const char *path) {
    for (size_t i = 0; i < NUM_FORMATS; i++) {
        for (size_t j = 0; j < 3 && formats[i]->endings[j] != NULL; j++) {
            if (ends_in(path, formats[i]->endings[j])) {
                return formats[i];
            }
        }
    }
    return NULL;
}

pspec_status ps_points_check_ending(const char *path, ps_error *error) {
    static const char *const texts[] = {"", ".txt", ".dat", ".pts", ".tsv", ".xyz"};
    const char *const ending = ps_output_ending(path);
    bool is_known = find_ending(path) != NULL;
    is_known = is_known || strcasecmp(ending, ".gz") == 0; /* refused with a reason of its own */
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        is_known = is_known || strcasecmp(ending, texts[i]) == 0;
    }
    return is_known
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "\"%s\": no format of points has the ending %s, by which it is chosen "
                         "(.txt is text); with --format the name is free",
                         path, ending);
}

const char *ps_points_format_by_ending(const char *path) {
    const ps_point_format *format = find_ending(path);
    return format != NULL ? format->name : formats[0]->name;
}

/* ---- detection --------------------------------------------------------------------------- */

/* Looks no further than needed: a pipe may bring a few bytes and wait. */
static pspec_status find_magic(ps_point_reader *reader, ps_error *error) {
    const unsigned char *bytes = NULL;
    size_t num_bytes = 0;
    bool needs_more = true;
    for (size_t wanted = 2; needs_more; wanted = num_bytes + 1) {
        PS_TRY(ps_input_peek(&reader->input, wanted, &bytes, &num_bytes, error));
        const bool are_all = num_bytes < wanted;
        needs_more = false;
        const ps_foreign_format *const foreign =
            ps_foreign_find(bytes, num_bytes, are_all, &needs_more);
        if (foreign != NULL) {
            return ps_foreign_refuse(reader->input.name, foreign, error);
        }
        for (size_t i = 0; i < NUM_FORMATS; i++) {
            const char *const magic = formats[i]->magic;
            if (magic != NULL &&
                ps_magic_begins(magic, strlen(magic), bytes, num_bytes, &needs_more)) {
                reader->format = formats[i];
                return PSPEC_OK;
            }
        }
        needs_more = needs_more && !are_all;
    }
    return PSPEC_OK;
}

/* Names tell formats without a magic; a compressed file's is the one before ".gz". */
static pspec_status find_by_name(ps_point_reader *reader, const char *path, ps_error *error) {
    static const char compressed[] = ".gz";
    ps_text name = {0};
    const size_t length = strlen(path) - (ends_in(path, compressed) ? sizeof compressed - 1 : 0);
    ps_text_append_bytes(&name, path, length);
    PS_TRY(ps_text_check(&name, error));
    const ps_point_format *format = find_ending(ps_text_string(&name));
    ps_text_free(&name);
    if (format != NULL && format->magic == NULL) {
        reader->format = format;
    }
    if (format != NULL && format->magic != NULL) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s ends in %s, but does not begin like %s; what is it? --input-format "
                       "NAME tells",
                       reader->input.name, format->endings[0], format->name);
    }
    return PSPEC_OK;
}

/* Files of these formats have a magic, which is refused here rather than misread as numbers. */
static pspec_status find_format(ps_point_reader *reader, const char *path, ps_error *error) {
    if (reader->options.format != NULL) {
        reader->format = find_named(reader->options.format);
        return reader->format != NULL ? PSPEC_OK
                                      : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                                                "point format \"%s\" is none of " PS_INPUT_FORMATS,
                                                reader->options.format);
    }
    PS_TRY(find_magic(reader, error));
    if (reader->format == NULL) {
        PS_TRY(find_by_name(reader, path, error));
    }
    const bool may_have_header = reader->format == &ps_format_edat; /* or be bare points */
    return reader->format == NULL || may_have_header ? ps_text_detect(reader, error) : PSPEC_OK;
}

/* ---- opening and closing ----------------------------------------------------------------- */

static pspec_status check_options(const ps_point_options *options, ps_error *error) {
    if (options->dimension > PS_MAX_DIMENSION) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "dimension %u is not between 1 and %d",
                       options->dimension, PS_MAX_DIMENSION);
    }
    if (options->sets.last != 0 &&
        (options->sets.first == 0 || options->sets.first > options->sets.last)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "sets %llu to %llu: they count from 1, and the first comes first",
                       (unsigned long long)options->sets.first,
                       (unsigned long long)options->sets.last);
    }
    return PSPEC_OK;
}

/* Columns are chosen by names in texts, and by numbers in arrays, too. */
static pspec_status check_chosen(const ps_point_reader *reader, bool may_have_names,
                                 ps_error *error) {
    const char *const names = reader->options.column_names;
    const bool are_numbers = ps_columns_are_numbers(names);
    if (names == NULL || may_have_names || (are_numbers && reader->format == &ps_format_npy)) {
        return PSPEC_OK;
    }
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   are_numbers
                       ? "%s: --columns chooses columns (%s), and %s has none to choose among"
                       : "%s: --columns names columns (%s), and %s has no names",
                   reader->input.name, names, reader->format->name);
}

static pspec_status check_names(const ps_point_reader *reader, ps_error *error) {
    const ps_point_options *const options = &reader->options;
    const bool may_have_names =
        reader->format == &ps_format_utk_text || reader->format == &ps_format_csv;
    const bool has_names = may_have_names || reader->format == &ps_format_lammps ||
                           reader->format == &ps_format_xyz || reader->format == &ps_format_ply;
    PS_TRY(check_chosen(reader, has_names, error));
    if (options->select != NULL && !has_names) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: --select %s is about a column with a name, and %s has no names",
                       reader->input.name, options->select, reader->format->name);
    }
    if (options->transpose && reader->format != &ps_format_npy &&
        reader->format != &ps_format_openquad) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: --transpose is for arrays, and this is %s", reader->input.name,
                       reader->format->name);
    }
    return may_have_names || options->header == NULL || strcmp(options->header, "yes") != 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s: --header yes is about names of columns, and %s has no names",
                         reader->input.name, reader->format->name);
}

void ps_given_name(ps_text *out, const char *curve, size_t count) {
    ps_text_append(out, "%s", curve);
    if (count > 0) {
        ps_text_append(out, "=%zu", count + 1);
    }
}

ps_given_set *ps_given_sets_find(const ps_given_sets *given, const char *path) {
    size_t i = 0;
    while (i < given->num && strcmp(given->sets[i].name, path) != 0) {
        i++;
    }
    return i < given->num ? &given->sets[i] : NULL;
}

bool ps_given_sets_are_all(const ps_given_sets *given, const char *const *paths, size_t num_paths) {
    bool are_given = num_paths > 0;
    for (size_t i = 0; i < num_paths && are_given; i++) {
        are_given = ps_given_sets_find(given, paths[i]) != NULL;
    }
    return are_given;
}

uint64_t ps_given_sets_count(const ps_given_sets *given, const char *const *paths,
                             size_t num_paths) {
    uint64_t num = 0;
    for (size_t i = 0; i < num_paths; i++) {
        const ps_given_set *const set = ps_given_sets_find(given, paths[i]);
        if (set == NULL || set->num == 0) {
            return 0;
        }
        num += set->num;
    }
    return num;
}

pspec_status ps_points_check(const char *const *paths, size_t num, const ps_point_options *options,
                             ps_error *error) {
    for (size_t i = 0; i < num; i++) {
        PS_TRY(ps_given_sets_find(&options->given, paths[i]) != NULL ||
                       ps_points_program(paths[i]) != NULL
                   ? PSPEC_OK
                   : ps_input_check(paths[i], error));
    }
    return PSPEC_OK;
}

void ps_point_set_turn(ps_point_set *set, size_t first) {
    for (size_t j = first; j < set->num_points; j++) {
        double *const point = set->points + j * set->dimension;
        const double x = point[0];
        point[0] = point[1];
        point[1] = point[2];
        point[2] = x;
    }
}

const char *ps_points_program(const char *path) {
    static const char begin[] = PS_POINT_PROGRAM;
    return strncmp(path, begin, sizeof begin - 1) == 0 ? path + sizeof begin - 1 : NULL;
}

/* The end of a command tells no format. */
static pspec_status open_program(ps_point_reader *reader, const char *path, const char *command,
                                 ps_error *error) {
    if (!reader->options.programs.may_run) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s is a program, and nobody said that it may be run: --sampler and --set "
                       "of a command line do, and --allow-exec of the command run",
                       path);
    }
    PS_TRY(ps_input_open_program(&reader->input, path, command, error));
    return find_format(reader, "-", error);
}

static pspec_status open_source(ps_point_reader *reader, const char *path, ps_error *error) {
    const char *const command = ps_points_program(path);
    reader->given = ps_given_sets_find(&reader->options.given, path);
    if (reader->given == NULL && command != NULL) {
        return open_program(reader, path, command, error);
    }
    if (reader->given == NULL) {
        PS_TRY(ps_input_open(&reader->input, path, error));
        return find_format(reader, path, error);
    }
    reader->format = &ps_format_memory;
    reader->input = (ps_input){.name = strdup(path), .descriptor = -1, .can_reopen = true};
    return reader->input.name != NULL
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for the name of points");
}

pspec_status ps_points_open(ps_point_reader **out, const char *path,
                            const ps_point_options *options, ps_error *error) {
    *out = NULL;
    PS_TRY(check_options(options, error));
    ps_point_reader *reader = NULL;
    PS_TRY(PS_NEW(&reader, 1, "point reader", error));
    reader->options = *options;
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, open_source(reader, path, error));
    PS_TRY_OUT(status, check_names(reader, error));
    PS_TRY_OUT(status, reader->format->open(reader, error));
    *out = reader;
    return PSPEC_OK;
out:
    ps_points_close(reader);
    return status;
}

const char *ps_points_format(const ps_point_reader *reader) {
    return reader->format->name;
}

const char *ps_points_columns(const ps_point_reader *reader) {
    return reader->has_layout ? ps_layout_name(&reader->layout) : "";
}

const char *ps_points_chosen(const ps_point_reader *reader) {
    return reader->chosen;
}

void ps_points_close(ps_point_reader *reader) {
    if (reader != NULL) {
        if (reader->state != NULL && reader->format->close != NULL) {
            reader->format->close(reader);
        }
        free(reader->state);
        ps_input_close(&reader->input);
        free(reader->staging);
        free(reader);
    }
}
