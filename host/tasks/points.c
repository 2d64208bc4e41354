/* Points of a sampler, and point files in another format. */
#include "tasks/points.h"

#include "base/memory.h"
#include "base/process/memory_limit.h"
#include "jobs/convert.h"
#include "jobs/parts/source.h"
#include "questions/question.h"
#include "report/output_check.h"

#include <stdlib.h>
#include <string.h>

/* ---- sample ------------------------------------------------------------------------------ */

static pspec_status fail_without_sampler(ps_error *error) {
    ps_text names = {0};
    ps_sampler_names(&names);
    ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "--sampler NAME is needed; there are %s",
            ps_text_string(&names));
    ps_text_free(&names);
    return PSPEC_ERROR_INVALID_ARGUMENT;
}

static pspec_status check_words(const ps_request *request, ps_error *error) {
    if (request->num_files > 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "no input file is read, but %s was given; -o FILE names the output",
                       request->files[0]);
    }
    if (request->num_samplers == 0) {
        return fail_without_sampler(error);
    }
    if (request->num_samplers > 1) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%zu samplers were given; one output holds the points of one",
                       request->num_samplers);
    }
    return ps_sample_check_counts(request, error);
}

pspec_status ps_points_find_sampler(ps_sampler_request *out, const ps_request *request,
                                    ps_error *error) {
    PS_TRY(check_words(request, error));
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

/* set: the points' place, of one realization. */
static pspec_status write_realizations(ps_sets *sets, uint64_t num_realizations, ps_point_set *set,
                                       ps_point_writer *writer, const ps_answer_hooks *hooks,
                                       ps_error *error) {
    realizations all = {&hooks->watch, 0, num_realizations};
    const ps_watch watch = {tell_realizations, &all};
    for (uint64_t r = 0; r < num_realizations; r++) {
        all.done = r;
        PS_TRY(ps_sets_next(sets, set->points, &set->num_points, &watch, error));
        PS_TRY(write_points(set, writer, &watch, error));
        PS_TRY(ps_watch_tell(&hooks->watch, "realizations", r + 1, num_realizations, NULL, error));
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

/* One realization is in memory at a time. */
static pspec_status check_memory(const ps_sampler_request *sampler, uint64_t limit,
                                 ps_error *error) {
    const double bytes =
        (double)ps_sampler_most_points(sampler) * sampler->dimension * (double)sizeof(double);
    char needed[PS_SIZE_TEXT];
    char allowed[PS_SIZE_TEXT];
    return limit == 0 || bytes <= (double)limit
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_MEMORY,
                         "%zu points in %u dimensions take %s of memory, above the limit of %s",
                         sampler->num_points, sampler->dimension, ps_size_show(needed, bytes),
                         ps_size_show(allowed, (double)limit));
}

/* points: the place of one realization. */
static pspec_status write_sets(const ps_request *request, const ps_sampler_request *sampler,
                               ps_sets *sets, double *points, const ps_answer_hooks *hooks,
                               ps_error *error) {
    ps_point_writer *writer = NULL;
    const ps_coordinates coordinates =
        ps_sampler_is_on_sphere(sampler) ? PS_UNIT_VECTORS : PS_TORUS_COORDINATES;
    ps_point_set set = {
        .coordinates = coordinates, .dimension = sampler->dimension, .points = points};
    const ps_point_shape shape = {.num_sets = (size_t)request->num_realizations,
                                  .num_points =
                                      ps_sampler_varies(sampler) ? 0 : sampler->num_points,
                                  .coordinates = coordinates,
                                  .dimension = sampler->dimension};
    PS_TRY(ps_points_create(&writer, request->output, request->format, &shape, error));
    ps_answer_begin_next(hooks);
    pspec_status status =
        write_realizations(sets, request->num_realizations, &set, writer, hooks, error);
    if (status == PSPEC_OK) {
        tell_loss(writer, hooks);
        status = ps_points_commit(writer, error);
    }
    ps_answer_end(hooks);
    ps_points_discard(writer);
    return status;
}

pspec_status ps_points_sample(const ps_request *request, const ps_answer_hooks *hooks,
                              ps_error *error) {
    ps_sampler_request sampler = {0};
    void *points = NULL;
    ps_sets *sets = NULL;
    PS_TRY(ps_points_find_sampler(&sampler, request, error));
    PS_TRY(check_memory(&sampler, request->limits.constraints.memory_limit, error));
    const ps_sets_options options = ps_source_sets(&request->limits, false);
    const size_t most = ps_sampler_most_points(&sampler);
    PS_TRY(ps_allocate(&points, most, sampler.dimension * sizeof(double), "points", error));
    /* gigabytes in small pages take half a second to give back, also where a signal ends it */
    ps_memory_use_large_pages(points, most * sampler.dimension * sizeof(double));
    pspec_status status =
        ps_sets_create(&sets, &sampler, request->num_realizations, &options, error);
    if (status == PSPEC_OK) {
        status = write_sets(request, &sampler, sets, points, hooks, error);
        ps_answer_warn_of(hooks, status == PSPEC_OK ? ps_sets_trouble(sets) : "");
    }
    ps_sets_destroy(sets);
    free(points);
    return status;
}

/* ---- convert ----------------------------------------------------------------------------- */

pspec_status ps_points_convert(const ps_request *request, const ps_answer_hooks *hooks,
                               ps_error *error) {
    ps_text loss = {0};
    if (request->num_files == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "nothing to convert: name point files (- for standard input)");
    }
    PS_TRY(ps_point_options_check(request, error));
    PS_TRY(ps_outputs_check(request, false, error));
    ps_answer_begin_next(hooks);
    const ps_conversion conversion = {
        .paths = request->files,
        .num_paths = request->num_files,
        .options = ps_point_options_make(request),
        .points = request->points,
        .merge = request->merge,
        .output = request->output,
        .format = request->format,
        .columns = request->to_columns,
        .watch = hooks->watch,
    };
    const pspec_status status = ps_convert(&conversion, &loss, error);
    ps_answer_end(hooks);
    if (status == PSPEC_OK && loss.length > 0) {
        ps_answer_warn(hooks, "%s", ps_text_string(&loss));
    }
    ps_text_free(&loss);
    return status;
}
