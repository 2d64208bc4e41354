/* pointspec sample: writes realizations of the only sampler, one of them in memory at a time, and
 * draws the first. Without an output the first of every sampler is only drawn. hooks->warn hears
 * what the format could not keep, hooks->watch of realizations. */
#include "answers/output_check.h"
#include "answers/points/points.h"
#include "base/memory.h"
#include "base/process/memory_limit.h"
#include "commands/points_drawing.h"
#include "commands/prefetch.h"
#include "jobs/point_phases.h"
#include "jobs/spectrum/power_phases.h"
#include "plan/specs.h"
#include "request/point_source.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- what is asked ------------------------------------------------------------------------ */

static pspec_status fail_without_sampler(ps_error *error) {
    ps_text names = {0};
    ps_sampler_names(&names);
    ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "--sampler NAME is needed; there are %s",
            ps_text_string(&names));
    ps_text_free(&names);
    return PSPEC_ERROR_INVALID_ARGUMENT;
}

/* Several samplers and numbers of points may be where no points are written. */
static pspec_status check_words(const ps_request *request, ps_error *error) {
    PS_TRY(ps_request_check_no_files(request, "; -o FILE names the output", error));
    if (request->num_sources == 0) {
        return fail_without_sampler(error);
    }
    if (request->prefetch || ps_request_only_draws(request)) {
        return PSPEC_OK;
    }
    return request->num_sources == 1
               ? ps_sample_check_counts(request, error)
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%zu samplers were given; one output holds the points of one",
                         request->num_sources);
}

/* ---- points ------------------------------------------------------------------------------- */

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

static pspec_status sample(const ps_request *request, const ps_answer_hooks *hooks,
                           ps_error *error) {
    const size_t num = ps_request_num_questions(request);
    ps_pool memory = {0};
    ps_points_picture picture = {.num_sets = num, .memory = &memory};
    pspec_status status = PSPEC_OK;
    PS_TRY(ps_points_drawing_check(request, hooks, error));
    PS_TRY(check_samplers(request, error));
    for (size_t i = 0; status == PSPEC_OK && i < num; i++) {
        status = sample_one(request, i, request->plot != NULL ? &picture : NULL, hooks, error);
    }
    if (status == PSPEC_OK && request->plot != NULL) {
        status = ps_points_draw(&picture, request, hooks, error);
    }
    ps_pool_free(&memory);
    return status;
}

/* ---- what it would take: there is nothing to choose --------------------------------------- */

/* Points that are only drawn are of one realization, and not written. */
static pspec_status add_sampler(ps_phases *phases, const ps_request *request, size_t question,
                                bool is_drawn, double *bytes, ps_error *error) {
    const uint64_t limit = request->limits.constraints.memory_limit;
    ps_sampler_request sampler;
    PS_TRY(ps_sampler_request_make(&sampler, request, question, error));
    const double own_bytes = ps_points_bytes(&sampler, 1);
    PS_TRY(limit > 0 ? ps_points_check_memory(&sampler, 1, limit, error) : PSPEC_OK);
    *bytes = fmax(*bytes, own_bytes);
    const double sets = is_drawn ? 1 : (double)request->num_realizations;
    const ps_sets_options kept = ps_limits_sets(&request->limits, request->accuracy.no_skip);
    ps_phases_sample(phases, &sampler, sets, &kept);
    ps_phases_touch(phases, own_bytes);
    if (!is_drawn) {
        ps_phases_write(phases, request->output != NULL ? request->output : "-", request->format,
                        sets * (double)sampler.num_points * sampler.dimension);
    }
    return PSPEC_OK;
}

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    ps_phases phases = ps_plan_table_begin_phases(planner);
    const bool is_drawn = ps_request_only_draws(request);
    double bytes = 0; /* of the largest */
    ps_memory_room room;
    if (request->num_sources != 1 && !(is_drawn && request->num_sources > 0)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "one --sampler NAME is needed");
    }
    if (!is_drawn) {
        PS_TRY(ps_sample_check_counts(request, error));
    }
    ps_phases_start(&phases, NULL, NULL);
    for (size_t i = 0; i < ps_request_num_questions(request); i++) {
        PS_TRY(add_sampler(&phases, request, i, is_drawn, &bytes, error));
    }
    ps_plan_table_add_picture(&phases, request);
    ps_memory_room_find(&room, 0);
    return ps_plan_table_add_host(
        planner, &phases, bytes,
        bytes <= (double)room.bytes ? "points of one sampler, one realization at a time"
                                    : "one realization at a time, but there is no room for it now",
        error);
}

/* ---- the command --------------------------------------------------------------------------- */

/* Writes no table. */
static pspec_status run(ps_answer *out, const ps_request *request, const ps_answer_hooks *hooks,
                        ps_error *error) {
    (void)out;
    PS_TRY(check_words(request, error));
    return request->prefetch ? ps_points_prefetch(request, hooks, error)
                             : sample(request, hooks, error);
}

const ps_command ps_command_sample = {
    .name = "sample",
    .purpose = "generate point sets of the torus or the sphere",
    .usage = "sample --sampler NAME[:key=value,...] [options]",
    .description =
        "Writes realizations of a sampler of the torus [0,1)^D, or of the sphere or hemisphere, "
        "where "
        "points are unit vectors x, y, z. Realization r depends on nothing but the sampler, its "
        "parameters, N, D, the seed and r. UTK text has one point per line, coordinates with 17 "
        "digits, and a line \"#\" between two realizations; an NPY array has the shape (M, N, D), "
        "D = 3 on the sphere. --homogenize shifts points of the torus and rotates those of the "
        "sphere, at random. --plot draws the first realization: the unit square, a line, every "
        "pair of coordinates of more dimensions, both sides of the sphere. Without -o and --format "
        "the picture is all that is made, and several samplers or N are drawn side by side. Sets "
        "that "
        "take long to make, of blue noise, are kept on the disk, for this command and all others, "
        "up to --kept-sets; --prefetch only fills that store, on all processors, and goes on where "
        "it was stopped.",
    .takes = PS_COMMAND_BIT(sample),
    .samples = PS_DOMAIN_ANY,
    .examples = {"pointspec sample --sampler jittered -n 1024 -m 10 --seed 7 -o points.txt",
                 "pointspec sample --sampler sobol:scramble=owen -n 4096 -d 3 -o points.npy"},
    .formats = PS_POINT_FORMATS,
    .counted = "realizations",
    .speaker = "pointspec sample",
    .makes_points = true,
    .run = run,
    .look_at_shares = ps_points_look_at_shares,
    .plan = plan,
};
