#include "jobs/source.h"

#include "base/memory.h"
#include "base/process/memory_limit.h"
#include "base/text.h"
#include "sets/files_ahead.h"
#include "sets/kept_inputs.h"
#include "sets/program_sets.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct ps_source {
    bool is_turned; /* ps_source_turn */
    /* sampler: NULL for others */
    ps_sets *sampled;
    ps_sampler_request request;
    ps_watch watch;
    uint64_t num_realizations, next_realization;
    /* files: paths is NULL for others */
    const char *const *paths;
    size_t num_paths, next_path;
    ps_source_options options;
    ps_point_reader *reader;
    ps_files_ahead *ahead;    /* NULL: the next file is opened here */
    size_t first_ahead;       /* path that is its first */
    uint64_t set_bytes;       /* of the largest so far, or of its part that came first */
    uint64_t sets_of_file;    /* begun by the reader */
    uint64_t num_sets;        /* begun of all files */
    bool is_inside;           /* of a set, whose end has not come yet */
    ps_scout scout;           /* of the same file, ahead of the reader to count a set */
    ps_text formats, columns; /* of the files read so far, each once */
    ps_kept_inputs kept;      /* sets of streams */
    bool is_lost;             /* there were more of them than are kept */
    ps_program_sets programs; /* where the paths are some */
    /* Of a stream that had not ended when the source was rewound: it goes on after its kept sets */
    ps_point_reader *unfinished;
    size_t unfinished_path;
};

pspec_status ps_source_sampler(ps_source **out, const ps_sampler_request *request,
                               uint64_t num_realizations, const ps_sets_options *options,
                               const ps_watch *watch, ps_error *error) {
    ps_sets *sets = NULL;
    *out = NULL;
    PS_TRY(ps_sets_create(&sets, request, num_realizations, options, error));
    const pspec_status status = PS_NEW(out, 1, "a source of points", error);
    if (status != PSPEC_OK) {
        ps_sets_destroy(sets);
        return status;
    }
    (*out)->sampled = sets;
    (*out)->request = *request;
    (*out)->watch = watch != NULL ? *watch : (ps_watch){0};
    (*out)->num_realizations = num_realizations;
    return PSPEC_OK;
}

void ps_source_leave(ps_source *source, uint64_t taken) {
    ps_sets_leave(source->sampled, taken);
}

const char *ps_source_trouble(ps_source *source) {
    return source->sampled != NULL ? ps_sets_trouble(source->sampled) : "";
}

pspec_status ps_source_files(ps_source **out, const char *const *paths, size_t num_paths,
                             const ps_source_options *options, ps_error *error) {
    PS_TRY(PS_NEW(out, 1, "a source of points", error));
    (*out)->paths = paths;
    (*out)->num_paths = num_paths;
    (*out)->options = *options;
    if (options->whole_bytes == 0) {
        (*out)->options.whole_bytes = PS_SOURCE_WHOLE_BYTES;
    }
    if (options->kept_bytes == 0) {
        const uint64_t limit = options->points.memory_limit / 4; /* leaves room, as for blocks */
        const bool is_less = limit > 0 && limit < PS_SOURCE_WHOLE_BYTES;
        (*out)->options.kept_bytes = is_less ? limit : PS_SOURCE_WHOLE_BYTES;
    }
    (*out)->kept.memory_limit = options->points.memory_limit;
    (*out)->programs = ps_program_sets_make(paths, num_paths, &options->points);
    return PSPEC_OK;
}

void ps_source_turn(ps_source *source) {
    source->is_turned = true;
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
    if (!ps_size_multiply(ps_sampler_most_points(request), request->dimension, &count)) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "%zu points are too many", request->num_points);
    }
    PS_TRY(ps_grow(&points, &set->points_capacity, count, sizeof(double), "points", error));
    set->points = points;
    set->coordinates = ps_sampler_is_on_sphere(request) ? PS_UNIT_VECTORS : PS_TORUS_COORDINATES;
    set->dimension = request->dimension;
    set->has_weights = false;
    source->next_realization++;
    PS_TRY(ps_sets_next(source->sampled, set->points, &set->num_points, &source->watch, error));
    ps_point_set_turn(set, source->is_turned ? 0 : set->num_points);
    return PSPEC_OK;
}

uint64_t ps_source_skip(ps_source *source, uint64_t num) {
    const uint64_t left = source->num_realizations - source->next_realization;
    if (source->sampled == NULL) {
        return 0;
    }
    num = num < left ? num : left;
    ps_sets_skip(source->sampled, num);
    source->next_realization += num;
    return num;
}

static const char between_names[] = "; "; /* which have commas */

/* ---- sets that are too large ------------------------------------------------------------- */

pspec_status ps_source_more(ps_source *source, ps_point_set *set, size_t max_points, bool *ends,
                            ps_error *error) {
    const size_t before = set->num_points;
    *ends = !source->is_inside;
    if (!*ends) {
        PS_TRY(ps_points_read_on(source->reader, set, max_points, ends, NULL, error));
    }
    source->is_inside = !*ends;
    ps_point_set_turn(set, source->is_turned ? before : set->num_points);
    return PSPEC_OK;
}

/* A set that has begun: the rest of it, or what there is to know about the rest. */
static pspec_status complete_set(ps_source *source, ps_point_set *set, ps_source_part *part,
                                 ps_error *error) {
    const bool is_stream = !ps_points_can_reopen(source->reader);
    const bool is_counted = ps_points_per_set(source->reader) > 0 && !set->has_weights;
    part->block_points = ps_points_fitting(set, source->options.whole_bytes);
    if (is_stream && (!is_counted || source->options.kept_bytes == UINT64_MAX)) {
        return ps_source_more(source, set, SIZE_MAX, &part->is_whole, error);
    }
    part->count = (ps_pattern_count){.realization = source->num_sets - 1,
                                     .num_points = ps_points_per_set(source->reader)};
    return is_counted ? PSPEC_OK
                      : ps_scout_count(&source->scout, source->paths[source->next_path - 1],
                                       &source->options, source->sets_of_file, &part->count, error);
}

/* ---- files ------------------------------------------------------------------------------- */

static int ask(const ps_watch_report *report, void *payload) {
    const ps_source_options *const options = payload;
    (void)report;
    return options->should_stop != NULL && options->should_stop(options->payload);
}

/* From this path on. The first of all is read alone: it tells how large sets are. */
static pspec_status begin_ahead(ps_source *source, ps_error *error) {
    const size_t next = source->next_path;
    const ps_files_plan plan = {.paths = source->paths + next,
                                .num = source->num_paths - next,
                                .options = &source->options.points,
                                .set_bytes = source->set_bytes,
                                .most_bytes = source->options.whole_bytes};
    source->first_ahead = next;
    return source->num_sets > 0 ? ps_files_ahead_create(&source->ahead, &plan, error) : PSPEC_OK;
}

/* Perhaps with the beginning of its first set. */
static pspec_status open_next(ps_source *source, ps_point_set *set, bool *ends, ps_error *error) {
    const ps_watch watch = {ask, &source->options};
    const char *const path = source->paths[source->next_path];
    ps_scout_close(&source->scout);
    source->sets_of_file = 0;
    if (source->formats.length == 0) {
        PS_TRY(ps_program_sets_try(&source->programs, source->paths, &source->num_paths,
                                   &source->options.points, &source->formats, error));
    }
    PS_TRY(source->ahead == NULL ? begin_ahead(source, error) : PSPEC_OK);
    if (source->ahead != NULL) {
        PS_TRY(ps_files_ahead_take(source->ahead, source->next_path - source->first_ahead, &watch,
                                   &source->reader, set, ends, error));
    }
    source->next_path++;
    if (source->reader == NULL) {
        PS_TRY(ps_points_open(&source->reader, path, &source->options.points, error));
    }
    ps_text_append_once(&source->formats, ps_points_format(source->reader), between_names);
    return ps_text_check(&source->formats, error);
}

/* "xy", or "xy (columns x,y)" where a text has others. */
static pspec_status add_columns(ps_source *source, ps_error *error) {
    char text[192];
    const char *const chosen = ps_points_chosen(source->reader);
    snprintf(text, sizeof text, "%s%s%s%s", ps_points_columns(source->reader),
             chosen != NULL ? " (columns " : "", chosen != NULL ? chosen : "",
             chosen != NULL ? ")" : "");
    ps_text_append_once(&source->columns, text, between_names);
    return ps_text_check(&source->columns, error);
}

/* The stream goes on behind its kept sets, if it has not ended. */
static void pass_kept(ps_source *source) {
    if (source->unfinished != NULL && source->unfinished_path == source->next_path) {
        source->reader = source->unfinished;
        source->unfinished = NULL;
    }
    source->next_path++;
}

/* Of inputs that were read before and are kept, from next_path on. */
static pspec_status next_kept(ps_source *source, ps_point_set *set, bool *has_set,
                              ps_error *error) {
    while (!*has_set && source->reader == NULL && source->next_path < source->num_paths &&
           ps_kept_inputs_have(&source->kept, source->next_path)) {
        PS_TRY(ps_kept_inputs_next(&source->kept, source->next_path, set, has_set, error));
        if (!*has_set) {
            pass_kept(source);
        }
    }
    return PSPEC_OK;
}

/* A set of a stream that has come, whole or in part: those that are kept are all or none. */
static pspec_status keep(ps_source *source, const ps_point_set *set, bool is_whole,
                         ps_error *error) {
    const size_t input = source->next_path - 1;
    const uint64_t limit = source->options.kept_bytes;
    if (source->is_lost || ps_points_can_reopen(source->reader)) {
        return PSPEC_OK;
    }
    if (!is_whole || source->kept.bytes + ps_kept_inputs_bytes(set) > limit) {
        ps_kept_inputs_free(&source->kept);
        source->is_lost = true;
        return PSPEC_OK;
    }
    return ps_kept_inputs_add(&source->kept, input, source->paths[input], set, error);
}

/* As much of the next set as is read as a whole, what has come with the reader included. */
static pspec_status begin_set(ps_source *source, ps_point_set *set, bool *ends, ps_error *error) {
    if (!*ends) {
        PS_TRY(ps_points_fill(source->reader, set, source->options.whole_bytes, ends, NULL, error));
    }
    const uint64_t bytes = ps_kept_inputs_bytes(set);
    source->set_bytes = bytes > source->set_bytes ? bytes : source->set_bytes;
    source->is_inside = !*ends;
    ps_point_set_turn(set, source->is_turned ? 0 : set->num_points);
    return PSPEC_OK;
}

static void close_reader(ps_source *source) {
    ps_points_close(source->reader);
    source->reader = NULL;
}

static pspec_status take_set(ps_source *source, ps_point_set *set, ps_source_part *part,
                             ps_error *error) {
    const char *const path = source->paths[source->next_path - 1];
    source->sets_of_file++;
    source->num_sets++;
    PS_TRY(ps_program_sets_check(&source->programs, source->sets_of_file, path, error));
    PS_TRY(part->is_whole ? PSPEC_OK : complete_set(source, set, part, error));
    PS_TRY(keep(source, set, part->is_whole, error));
    return part->is_whole ? ps_program_sets_end_run(&source->programs, source->num_sets, path,
                                                    &source->reader, error)
                          : PSPEC_OK;
}

static pspec_status next_from_files(ps_source *source, ps_point_set *set, ps_source_part *part,
                                    bool *has_set, ps_error *error) {
    *has_set = false;
    *part = (ps_source_part){0};
    set->num_points = 0;
    while (!*has_set && !ps_program_sets_are_all(&source->programs, source->num_sets)) {
        PS_TRY(next_kept(source, set, has_set, error));
        if (*has_set) {
            part->is_whole = true;
            source->num_sets++;
            return PSPEC_OK;
        }
        part->is_whole = false;
        if (source->reader == NULL) {
            if (source->next_path == source->num_paths) {
                return ps_program_sets_end(&source->programs, source->num_sets, error);
            }
            PS_TRY(open_next(source, set, &part->is_whole, error));
        }
        PS_TRY(begin_set(source, set, &part->is_whole, error));
        *has_set = set->num_points > 0;
        PS_TRY(source->sets_of_file == 0 ? add_columns(source, error) : PSPEC_OK);
        if (!*has_set) {
            close_reader(source);
        }
    }
    return *has_set ? take_set(source, set, part, error) : PSPEC_OK;
}

pspec_status ps_source_next(ps_source *source, ps_point_set *set, ps_source_part *part,
                            bool *has_set, ps_error *error) {
    if (source->paths == NULL) {
        *part = (ps_source_part){.is_whole = true};
        return next_sample(source, set, has_set, error);
    }
    return next_from_files(source, set, part, has_set, error);
}

pspec_status ps_source_next_whole(ps_source *source, ps_point_set *set, bool *has_set,
                                  ps_error *error) {
    ps_source_part part;
    PS_TRY(ps_source_next(source, set, &part, has_set, error));
    return !*has_set || part.is_whole
               ? PSPEC_OK
               : ps_source_more(source, set, SIZE_MAX, &part.is_whole, error);
}

uint64_t ps_source_num_sets(const ps_source *source) {
    const ps_point_options *const options = &source->options.points;
    return source->programs.are_programs ? source->programs.num_sets
           : options->sets.last > 0
               ? 0
               : ps_given_sets_count(&options->given, source->paths, source->num_paths);
}

bool ps_source_can_rewind(const ps_source *source) {
    return !source->is_lost || source->programs.repeats;
}

pspec_status ps_source_check_rewind(const ps_source *source, const char *why, ps_error *error) {
    char size[PS_SIZE_TEXT];
    return ps_source_can_rewind(source)
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_TOLERANCE,
                         "%s; they are to be read again, but standard input and pipes come once, "
                         "and more than %s of points are not kept: give a file",
                         why, ps_size_show(size, (double)source->options.kept_bytes));
}

/* A stream that has not ended is not closed, but for a program that is run again. */
static void leave_reader(ps_source *source) {
    const bool is_kept = !(source->is_lost && source->programs.repeats);
    if (source->reader != NULL && !ps_points_can_reopen(source->reader) && is_kept) {
        source->unfinished = source->reader;
        source->unfinished_path = source->next_path - 1;
    } else {
        ps_points_close(source->reader);
    }
    source->reader = NULL;
}

pspec_status ps_source_rewind(ps_source *source, ps_error *error) {
    if (!ps_source_can_rewind(source)) {
        return ps_fail(error, PSPEC_ERROR_IO, "standard input cannot be read twice");
    }
    ps_scout_close(&source->scout);
    ps_files_ahead_destroy(source->ahead);
    source->ahead = NULL;
    leave_reader(source);
    source->next_path = 0;
    source->next_realization = 0;
    if (source->sampled != NULL) {
        ps_sets_rewind(source->sampled);
    }
    source->num_sets = 0;
    ps_kept_inputs_rewind(&source->kept);
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
        ps_scout_close(&source->scout);
        ps_files_ahead_destroy(source->ahead);
        ps_sets_destroy(source->sampled);
        ps_points_close(source->reader);
        ps_points_close(source->unfinished);
        ps_text_free(&source->formats);
        ps_text_free(&source->columns);
        ps_kept_inputs_free(&source->kept);
        free(source);
    }
}
