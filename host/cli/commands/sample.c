/* pointspec sample: point sets to a file or standard output, one realization in memory at a time.
 */
#include "base/memory.h"
#include "base/memory_limit.h"
#include "base/text.h"
#include "cli/command.h"
#include "points/points.h"
#include "questions/question.h"
#include "samplers/sampler.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static pspec_status fail_without_sampler(ps_error *error) {
    ps_text names = {0};
    for (size_t i = 0; ps_samplers[i] != NULL; i++) {
        ps_text_append(&names, "%s%s", i > 0 ? ", " : "", ps_samplers[i]->name);
    }
    ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "--sampler NAME is needed; there are %s",
            ps_text_string(&names));
    ps_text_free(&names);
    return PSPEC_ERROR_INVALID_ARGUMENT;
}

static pspec_status check_words(const ps_request *arguments, ps_error *error) {
    if (arguments->num_files > 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "no input file is read, but %s was given; -o FILE names the output",
                       arguments->files[0]);
    }
    if (arguments->num_samplers == 0) {
        return fail_without_sampler(error);
    }
    if (arguments->num_samplers > 1) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%zu samplers were given; one output holds the points of one",
                       arguments->num_samplers);
    }
    return PSPEC_OK;
}

/* A progress line would run into points that go to the same terminal. */
static ps_progress *begin_progress(const ps_request *arguments, const char *path) {
    const bool shares_terminal = strcmp(path, "-") == 0 && isatty(STDOUT_FILENO);
    return shares_terminal ? NULL : ps_progress_begin(arguments, "realizations");
}

/* set: the points' place, of one realization. */
static pspec_status write_realizations(const ps_sampler_request *request, uint64_t num_realizations,
                                       const ps_point_set *set, ps_point_writer *writer,
                                       ps_progress *progress, ps_error *error) {
    for (uint64_t r = 0; r < num_realizations; r++) {
        PS_TRY(ps_sampler_generate(request, r, set->points, error));
        PS_TRY(ps_points_write(writer, set, true, error));
        ps_progress_update(progress, r + 1, num_realizations);
        if (ps_interrupted) {
            return ps_fail(error, PSPEC_ERROR_CANCELLED,
                           "interrupted after %llu of %llu realizations", (unsigned long long)r + 1,
                           (unsigned long long)num_realizations);
        }
    }
    return PSPEC_OK;
}

static void print_loss(const ps_request *arguments, const ps_point_writer *writer) {
    char loss[256];
    ps_points_describe_loss(writer, loss, sizeof loss);
    if (loss[0] != '\0' && !arguments->quiet) {
        fprintf(stderr, "pointspec sample: %s\n", loss);
    }
}

/* One realization is in memory at a time. */
static pspec_status check_memory(const ps_sampler_request *request, uint64_t limit,
                                 ps_error *error) {
    const double bytes = (double)request->num_points * request->dimension * (double)sizeof(double);
    char needed[PS_SIZE_TEXT];
    char allowed[PS_SIZE_TEXT];
    return limit == 0 || bytes <= (double)limit
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_MEMORY,
                         "%zu points in %u dimensions take %s of memory, above the limit of %s",
                         request->num_points, request->dimension, ps_size_show(needed, bytes),
                         ps_size_show(allowed, (double)limit));
}

static pspec_status run(const ps_request *arguments, ps_error *error) {
    const char *const path = arguments->output;
    ps_sampler_request request = {0};
    void *points = NULL;
    ps_point_writer *writer = NULL;
    ps_progress *progress = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY(check_words(arguments, error));
    PS_TRY(ps_sampler_request_make(&request, arguments, 0, error));
    PS_TRY(check_memory(&request, arguments->limits.constraints.memory_limit, error));
    PS_TRY(ps_allocate(&points, request.num_points, request.dimension * sizeof(double), "points",
                       error));
    const ps_coordinates coordinates =
        ps_sampler_is_on_sphere(&request) ? PS_UNIT_VECTORS : PS_TORUS_COORDINATES;
    const ps_point_set set = {.coordinates = coordinates,
                              .dimension = request.dimension,
                              .num_points = request.num_points,
                              .points = points};
    const ps_point_shape shape = {.num_sets = (size_t)arguments->num_realizations,
                                  .num_points = request.num_points,
                                  .coordinates = coordinates,
                                  .dimension = request.dimension};
    PS_TRY_OUT(status, ps_points_create(&writer, path, arguments->format, &shape, error));
    progress = begin_progress(arguments, path);
    PS_TRY_OUT(status, write_realizations(&request, arguments->num_realizations, &set, writer,
                                          progress, error));
    print_loss(arguments, writer);
    status = ps_points_commit(writer, error);
out:
    ps_progress_end(progress);
    ps_points_discard(writer);
    free(points);
    return status;
}

const ps_command ps_command_sample = {
    .name = "sample",
    .summary = "generate point sets of the torus or the sphere",
    .usage = "sample --sampler NAME[:key=value,...] [options]",
    .description =
        "Writes realizations of a sampler of the torus [0,1)^D, or of the sphere or hemisphere, "
        "where "
        "points are unit vectors x, y, z. Realization r depends on nothing but the sampler, its "
        "parameters, N, D, the seed and r. UTK text has one point per line, coordinates with 17 "
        "digits, and a line \"#\" between two realizations; an NPY array has the shape (M, N, D), "
        "D = 3 on the sphere. --homogenize shifts points of the torus and rotates those of the "
        "sphere, at random.",
    .takes = PS_TAKER_BIT(sample),
    .formats = PS_POINT_FORMATS,
    .samples = PS_DOMAIN_ANY,
    .examples = {"pointspec sample --sampler jittered -n 1024 -m 10 --seed 7 -o points.txt",
                 "pointspec sample --sampler sobol:scramble=owen -n 4096 -d 3 -o points.npy"},
    .run = run,
    .plan = ps_plan_table_add_sample,
};
