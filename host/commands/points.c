/* Points of a sampler, and point files in another format. */
#include "commands/points.h"

#include "answers/output_check.h"
#include "answers/picture.h"
#include "answers/points/points.h"
#include "answers/points/points_picture.h"
#include "base/memory.h"
#include "base/process/memory_limit.h"
#include "commands/convert.h"
#include "plan/specs.h"
#include "request/point_source.h"

#include <stdlib.h>
#include <string.h>

/* ---- pictures ---------------------------------------------------------------------------- */

static bool is_picture_all(const ps_request *request) {
    return ps_picture_is_all(request, false);
}

/* Before the work: can the picture be drawn and written, is it no other file of the request? */
static pspec_status check_picture(const ps_request *request, const ps_answer_hooks *hooks,
                                  ps_error *error) {
    if (request->plot == NULL) {
        return PSPEC_OK;
    }
    if (request->num_files > PS_MAX_SAMPLERS && ps_request_only_draws(request) && !request->merge) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%zu files are more than %d, which a picture shows side by side",
                       request->num_files, PS_MAX_SAMPLERS);
    }
    PS_TRY(ps_picture_check(request, is_picture_all(request), hooks, error));
    return ps_outputs_check(request, false, error);
}

/* Adds a set of a file: points of the sphere none of which is below the equator are those of a
 * hemisphere. */
static pspec_status add_file(ps_points_picture *picture, const char *path, const ps_point_set *set,
                             const ps_watch *watch, ps_error *error) {
    bool is_above = set->coordinates == PS_UNIT_VECTORS;
    for (size_t i = 0; is_above && i < set->num_points; i++) {
        is_above = set->points[i * set->dimension + 2] >= 0;
    }
    const ps_drawn_set drawn = {path,
                                is_above                              ? PS_SAMPLES_HEMISPHERE
                                : set->coordinates == PS_UNIT_VECTORS ? PS_SAMPLES_SPHERE
                                                                      : PS_SAMPLES_TORUS,
                                set->dimension, set->num_points, set->points};
    return ps_points_picture_add(picture, &drawn, watch, error);
}

/* The sampler, how many points, which realization: as pictures of spectra have them. */
static void write_title(ps_text *title, const ps_points_picture *picture,
                        const ps_request *request) {
    const bool is_of_files = request->num_files > 0;
    if (picture->num_sets > 1 && !is_of_files && request->num_sources == 1) {
        ps_text_append(title, "%s", ps_request_source_name(request, 0));
    } else if (picture->num_sets > 1) {
        ps_text_append(title, "%zu %s", picture->num_sets,
                       is_of_files                ? "files"
                       : request->num_counts == 1 ? "samplers"
                                                  : "sets");
    } else if (is_of_files && request->merge && request->num_files > 1) {
        ps_text_append(title, "%zu files, N = %zu", request->num_files, picture->num_points);
    } else {
        ps_text_append(title, "%s, N = %zu",
                       is_of_files ? request->files[0] : ps_request_source_name(request, 0),
                       picture->num_points);
    }
    if (is_of_files) {
        return;
    }
    ps_text_append(title, ", seed %llu", (unsigned long long)request->seed);
    if (request->num_realizations > 1) {
        ps_text_append(title, ", the first of %llu realizations",
                       (unsigned long long)request->num_realizations);
    }
}

static pspec_status write_picture(const ps_points_picture *picture, const ps_request *request,
                                  ps_error *error) {
    ps_text title = {0};
    write_title(&title, picture, request);
    pspec_status status = ps_text_check(&title, error);
    if (status == PSPEC_OK) {
        const ps_figure figure = ps_points_picture_figure(picture, ps_text_string(&title));
        status = ps_figure_write(request->plot, &figure, error);
    }
    ps_text_free(&title);
    return status;
}

/* Draws what was added to the picture, after the points are written: a failure is then told, and no
 * error. */
static pspec_status draw(const ps_points_picture *picture, const ps_request *request,
                         const ps_answer_hooks *hooks, ps_error *error) {
    return ps_picture_settle(request, is_picture_all(request), hooks,
                             write_picture(picture, request, error), error);
}

/* ---- sample ------------------------------------------------------------------------------ */

static pspec_status fail_without_sampler(ps_error *error) {
    ps_text names = {0};
    ps_sampler_names(&names);
    ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "--sampler NAME is needed; there are %s",
            ps_text_string(&names));
    ps_text_free(&names);
    return PSPEC_ERROR_INVALID_ARGUMENT;
}

pspec_status ps_points_check_words(const ps_request *request, bool may_be_several,
                                   ps_error *error) {
    if (request->num_files > 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "no input file is read, but %s was given; -o FILE names the output",
                       request->files[0]);
    }
    if (request->num_sources == 0) {
        return fail_without_sampler(error);
    }
    if (may_be_several) {
        return PSPEC_OK;
    }
    return request->num_sources == 1
               ? ps_sample_check_counts(request, error)
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%zu samplers were given; one output holds the points of one",
                         request->num_sources);
}

pspec_status ps_points_find_sampler(ps_sampler_request *out, const ps_request *request,
                                    ps_error *error) {
    PS_TRY(ps_points_check_words(request, false, error));
    return ps_sampler_request_make(out, request, 0, error);
}

/* Block by block: the system takes gigabytes in one call, too, but no signal before it has them. */
static pspec_status write_points(const ps_point_set *set, ps_point_writer *writer,
                                 const ps_watch *watch, ps_error *error) {
    enum { BLOCK_POINTS = 1 << 17 }; /* some megabytes: hundredths of a second as text */
    ps_point_set block = *set;
    for (size_t first = 0; first < set->num_points; first += BLOCK_POINTS) {
        const size_t left = set->num_points - first;
        const bool is_last = left <= BLOCK_POINTS;
        block.points = set->points + first * set->dimension;
        block.num_points = is_last ? left : BLOCK_POINTS;
        PS_TRY(ps_points_write(writer, &block, is_last, error));
        if (!is_last) {
            PS_TRY(ps_watch_tell(watch, "points written", first + BLOCK_POINTS, set->num_points,
                                 NULL, error));
        }
    }
    return PSPEC_OK;
}

/* Where there are several realizations, they are what is counted. */
typedef struct realizations {
    const ps_watch *watch;
    uint64_t done, num;
} realizations;

static int tell_realizations(const ps_watch_report *report, void *payload) {
    const realizations *const self = payload;
    const ps_watch_report whole = {"realizations", self->done, self->num, NULL};
    return self->watch->tell == NULL
               ? 0
               : self->watch->tell(self->num > 1 ? &whole : report, self->watch->payload);
}

/* Where realizations go. */
typedef struct sink {
    ps_point_writer *writer;    /* NULL: the first one is only drawn */
    ps_points_picture *picture; /* NULL: none */
    const char *name;           /* of the sampler, for the picture */
    ps_sampler_domain where;    /* are its points */
} sink;

/* set: the points' place, of one realization. */
static pspec_status write_realizations(ps_sets *sets, uint64_t num_realizations, ps_point_set *set,
                                       const sink *outlet, const ps_answer_hooks *hooks,
                                       ps_error *error) {
    realizations all = {&hooks->watch, 0, num_realizations};
    const ps_watch watch = {tell_realizations, &all};
    for (uint64_t r = 0; r < num_realizations; r++) {
        all.done = r;
        PS_TRY(ps_sets_next(sets, set->points, &set->num_points, &watch, error));
        if (r == 0 && outlet->picture != NULL) {
            const ps_drawn_set drawn = {outlet->name, outlet->where, set->dimension,
                                        set->num_points, set->points};
            PS_TRY(ps_points_picture_add(outlet->picture, &drawn, &watch, error));
        }
        if (outlet->writer != NULL) {
            PS_TRY(write_points(set, outlet->writer, &watch, error));
        }
        const pspec_status status =
            ps_watch_tell(&hooks->watch, "realizations", r + 1, num_realizations, NULL, error);
        PS_TRY(ps_sets_say_kept(sets, status, error));
    }
    return PSPEC_OK;
}

static void tell_loss(const ps_point_writer *writer, const ps_answer_hooks *hooks) {
    enum { LOSS_BYTES = 256 };
    char loss[LOSS_BYTES];
    ps_points_describe_loss(writer, loss, sizeof loss);
    if (loss[0] != '\0') {
        ps_answer_warn(hooks, "%s", loss);
    }
}

/* Points that are only drawn are of the first realization. */
static uint64_t count_sets(const ps_request *request) {
    return ps_request_only_draws(request) ? 1 : request->num_realizations;
}

static pspec_status write_sets(const ps_request *request, const ps_sampler_request *sampler,
                               ps_sets *sets, ps_point_set *set, sink *outlet,
                               const ps_answer_hooks *hooks, ps_error *error) {
    const ps_point_shape shape = {.num_sets = (size_t)request->num_realizations,
                                  .num_points =
                                      ps_sampler_varies(sampler) ? 0 : sampler->num_points,
                                  .coordinates = set->coordinates,
                                  .dimension = sampler->dimension};
    if (!ps_request_only_draws(request)) {
        PS_TRY(ps_points_create(&outlet->writer, request->output, request->format, &shape, error));
    }
    ps_answer_begin_next(hooks);
    pspec_status status = write_realizations(sets, count_sets(request), set, outlet, hooks, error);
    if (status == PSPEC_OK && outlet->writer != NULL) {
        tell_loss(outlet->writer, hooks);
        status = ps_points_commit(outlet->writer, error);
    }
    ps_answer_end(hooks);
    ps_points_discard(outlet->writer);
    return status;
}

/* points: the place of one realization. */
static pspec_status sample_to(const ps_request *request, const ps_sampler_request *sampler,
                              double *points, sink *outlet, const ps_answer_hooks *hooks,
                              ps_error *error) {
    const ps_sets_options options = ps_limits_sets(&request->limits, false);
    ps_point_set set = {.coordinates = ps_sampler_is_on_sphere(sampler) ? PS_UNIT_VECTORS
                                                                        : PS_TORUS_COORDINATES,
                        .dimension = sampler->dimension,
                        .points = points};
    ps_sets *sets = NULL;
    PS_TRY(ps_sets_create(&sets, sampler, count_sets(request), &options, error));
    const pspec_status status = write_sets(request, sampler, sets, &set, outlet, hooks, error);
    ps_answer_warn_of(hooks, status == PSPEC_OK ? ps_sets_trouble(sets) : "");
    ps_sets_destroy(sets);
    return status;
}

/* picture: NULL where nothing is drawn. */
static pspec_status sample_one(const ps_request *request, size_t question,
                               ps_points_picture *picture, const ps_answer_hooks *hooks,
                               ps_error *error) {
    ps_sampler_request sampler = {0};
    void *points = NULL;
    PS_TRY(ps_sampler_request_make(&sampler, request, question, error));
    const size_t most = ps_sampler_most_points(&sampler);
    PS_TRY(ps_allocate(&points, most, sampler.dimension * sizeof(double), "points", error));
    /* gigabytes in small pages take half a second to give back, also where a signal ends it */
    ps_memory_use_large_pages(points, most * sampler.dimension * sizeof(double));
    sink outlet = {NULL, picture, ps_request_sampler(request, question),
                   ps_sampler_where(&sampler)};
    const pspec_status status = sample_to(request, &sampler, points, &outlet, hooks, error);
    free(points);
    return status;
}

/* All of them before the first is made. */
static pspec_status check_samplers(const ps_request *request, ps_error *error) {
    for (size_t i = 0; i < ps_request_num_questions(request); i++) {
        ps_sampler_request sampler = {0};
        PS_TRY(ps_sampler_request_make(&sampler, request, i, error));
        PS_TRY(
            ps_points_check_memory(&sampler, 1, request->limits.constraints.memory_limit, error));
    }
    return PSPEC_OK;
}

pspec_status ps_points_sample(const ps_request *request, const ps_answer_hooks *hooks,
                              ps_error *error) {
    const size_t num = ps_request_num_questions(request);
    ps_pool memory = {0};
    ps_points_picture picture = {.num_sets = num, .memory = &memory};
    pspec_status status = PSPEC_OK;
    PS_TRY(ps_points_check_words(request, ps_request_only_draws(request), error));
    PS_TRY(check_picture(request, hooks, error));
    PS_TRY(check_samplers(request, error));
    for (size_t i = 0; status == PSPEC_OK && i < num; i++) {
        status = sample_one(request, i, request->plot != NULL ? &picture : NULL, hooks, error);
    }
    if (status == PSPEC_OK && request->plot != NULL) {
        status = draw(&picture, request, hooks, error);
    }
    ps_pool_free(&memory);
    return status;
}

/* ---- convert ----------------------------------------------------------------------------- */

/* first: gets the first set, for the picture; NULL: nothing is drawn. */
static pspec_status convert_files(const ps_request *request, size_t i_file, size_t num_files,
                                  ps_point_set *first, const ps_answer_hooks *hooks,
                                  ps_error *error) {
    ps_text loss = {0};
    const ps_conversion conversion = {
        .paths = request->files + i_file,
        .num_paths = num_files,
        .options = ps_point_options_make(request),
        .points = request->points,
        .merge = request->merge,
        .output = ps_request_only_draws(request) ? NULL : request->output,
        .format = request->format,
        .columns = request->to_columns,
        .watch = hooks->watch,
        .first = first,
    };
    const pspec_status status = ps_convert(&conversion, &loss, error);
    if (status == PSPEC_OK && loss.length > 0) {
        ps_answer_warn(hooks, "%s", ps_text_string(&loss));
    }
    ps_text_free(&loss);
    return status;
}

/* Files into one output; those that are only drawn, one by one. */
static pspec_status convert_all(const ps_request *request, ps_points_picture *picture,
                                const ps_answer_hooks *hooks, ps_error *error) {
    const bool is_drawn = request->plot != NULL;
    const size_t step = request->num_files / picture->num_sets;
    pspec_status status = PSPEC_OK;
    ps_answer_begin_next(hooks);
    for (size_t i = 0; status == PSPEC_OK && i < request->num_files; i += step) {
        ps_point_set first = {0};
        status = convert_files(request, i, step, is_drawn ? &first : NULL, hooks, error);
        if (status == PSPEC_OK && is_drawn) {
            status = add_file(picture, request->files[i], &first, &hooks->watch, error);
        }
        ps_point_set_free(&first);
    }
    ps_answer_end(hooks);
    return status;
}

pspec_status ps_points_convert(const ps_request *request, const ps_answer_hooks *hooks,
                               ps_error *error) {
    const bool is_apart = ps_request_only_draws(request) && !request->merge;
    ps_pool memory = {0};
    ps_points_picture picture = {.num_sets = is_apart ? request->num_files : 1, .memory = &memory};
    if (request->num_files == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "nothing to convert: name point files (- for standard input)");
    }
    PS_TRY(ps_point_options_check(request, error));
    PS_TRY(check_picture(request, hooks, error));
    PS_TRY(ps_outputs_check(request, false, error));
    pspec_status status = convert_all(request, &picture, hooks, error);
    if (status == PSPEC_OK && request->plot != NULL) {
        status = draw(&picture, request, hooks, error);
    }
    ps_pool_free(&memory);
    return status;
}
