#include "job/source.h"

#include "base/memory.h"
#include "base/text.h"

#include <stdlib.h>
#include <string.h>

struct ps_source {
    /* sampler */
    ps_sampler_request request;
    uint64_t num_realizations, next_realization;
    /* files: paths is NULL for a sampler */
    const char *const *paths;
    size_t num_paths, next_path;
    const ps_point_options *options;
    ps_point_reader *reader;
    ps_text formats, columns; /* of the files read so far, each once */
};

static pspec_status create(ps_source **out, ps_error *error) {
    void *memory = NULL;
    PS_TRY(ps_allocate(&memory, 1, sizeof(ps_source), "a source of points", error));
    *out = memory;
    return PSPEC_OK;
}

pspec_status ps_source_sampler(ps_source **out, const ps_sampler_request *request,
                               uint64_t num_realizations, ps_error *error) {
    *out = NULL;
    PS_TRY(ps_sampler_check(request, error));
    PS_TRY(create(out, error));
    (*out)->request = *request;
    (*out)->num_realizations = num_realizations;
    return PSPEC_OK;
}

pspec_status ps_source_files(ps_source **out, const char *const *paths, size_t num_paths,
                             const ps_point_options *options, ps_error *error) {
    PS_TRY(create(out, error));
    (*out)->paths = paths;
    (*out)->num_paths = num_paths;
    (*out)->options = options;
    return PSPEC_OK;
}

static pspec_status next_sample(ps_source *source, ps_point_set *set, bool *has_set,
                                ps_error *error) {
    const ps_sampler_request *request = &source->request;
    *has_set = source->next_realization < source->num_realizations;
    if (!*has_set) {
        return PSPEC_OK;
    }
    size_t count = 0;
    void *points = set->points;
    if (!ps_size_multiply(request->num_points, request->dimension, &count)) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "%zu points are too many", request->num_points);
    }
    PS_TRY(ps_grow(&points, &set->points_capacity, count, sizeof(double), "points", error));
    set->points = points;
    set->dimension = request->dimension;
    set->num_points = request->num_points;
    set->has_weights = false;
    return ps_sampler_generate(request, source->next_realization++, set->points, error);
}

/* Appends a name to a list unless it is there. */
static pspec_status add_name(ps_text *list, const char *name, ps_error *error) {
    static const char separator[] = ", ";
    const size_t length = strlen(name);
    for (const char *word = ps_text_string(list); *word != '\0';) {
        const char *const end = strstr(word, separator);
        const size_t word_length = end != NULL ? (size_t)(end - word) : strlen(word);
        if (word_length == length && strncmp(word, name, length) == 0) {
            return PSPEC_OK;
        }
        word += word_length + (end != NULL ? sizeof separator - 1 : 0);
    }
    ps_text_append(list, "%s%s", list->length > 0 && length > 0 ? separator : "", name);
    return ps_text_check(list, error);
}

static pspec_status next_from_files(ps_source *source, ps_point_set *set, bool *has_set,
                                    ps_error *error) {
    *has_set = false;
    while (!*has_set) {
        if (source->reader == NULL) {
            if (source->next_path == source->num_paths) {
                return PSPEC_OK;
            }
            PS_TRY(ps_points_open(&source->reader, source->paths[source->next_path++],
                                  source->options, error));
            PS_TRY(add_name(&source->formats, ps_points_format(source->reader), error));
        }
        PS_TRY(ps_points_next(source->reader, set, has_set, error));
        PS_TRY(add_name(&source->columns, ps_points_columns(source->reader), error));
        if (!*has_set) {
            ps_points_close(source->reader);
            source->reader = NULL;
        }
    }
    return PSPEC_OK;
}

pspec_status ps_source_next(ps_source *source, ps_point_set *set, bool *has_set, ps_error *error) {
    return source->paths == NULL ? next_sample(source, set, has_set, error)
                                 : next_from_files(source, set, has_set, error);
}

bool ps_source_can_rewind(const ps_source *source) {
    for (size_t i = 0; i < source->num_paths; i++) {
        if (strcmp(source->paths[i], "-") == 0) {
            return false;
        }
    }
    return true;
}

pspec_status ps_source_rewind(ps_source *source, ps_error *error) {
    if (!ps_source_can_rewind(source)) {
        return ps_fail(error, PSPEC_ERROR_IO, "standard input cannot be read twice");
    }
    ps_points_close(source->reader);
    source->reader = NULL;
    source->next_path = 0;
    source->next_realization = 0;
    return PSPEC_OK;
}

const char *ps_source_format(const ps_source *source) {
    return ps_text_string(&source->formats);
}

const char *ps_source_columns(const ps_source *source) {
    return ps_text_string(&source->columns);
}

void ps_source_destroy(ps_source *source) {
    if (source != NULL) {
        ps_points_close(source->reader);
        ps_text_free(&source->formats);
        ps_text_free(&source->columns);
        free(source);
    }
}
