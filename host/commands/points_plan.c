/* What making points, or rewriting them, takes: there is nothing to choose. */
#include "commands/points.h"

#include "answers/points/points.h"
#include "base/process/memory_limit.h"
#include "jobs/point_phases.h"
#include "jobs/spectrum/power_phases.h"
#include "plan/specs.h"
#include "request/point_source.h"

#include <math.h>

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

pspec_status ps_points_plan_sample(ps_planner *planner, const ps_request *request,
                                   ps_error *error) {
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

pspec_status ps_points_plan_convert(ps_planner *planner, const ps_request *request,
                                    ps_error *error) {
    ps_phases phases = ps_plan_table_begin_phases(planner);
    ps_point_set set = {0};
    ps_point_reader *reader = NULL;
    const ps_point_options options = ps_point_options_make(request);
    bool has_block = false;
    bool ends_set = false;
    if (request->num_files == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "nothing to convert: name point files (- for standard input)");
    }
    pspec_status status = ps_points_open(&reader, request->files[0], &options, error);
    if (status == PSPEC_OK) { /* one point tells how many numbers each has */
        status = ps_points_next_block(reader, &set, 1, &has_block, &ends_set, error);
    }
    if (status == PSPEC_OK) {
        const unsigned numbers = set.dimension + (set.has_weights ? 1 : 0);
        ps_phases_start(&phases, NULL, NULL);
        const double points =
            ps_phases_read(&phases, request->files, request->num_files, &options, numbers);
        if (!ps_request_only_draws(request)) {
            ps_phases_write(&phases, request->output != NULL ? request->output : "-",
                            request->format, points * numbers);
        }
        ps_plan_table_add_picture(&phases, request);
        status = ps_plan_table_add_host(planner, &phases, 0, "a block of points at a time", error);
    }
    ps_points_close(reader);
    ps_point_set_free(&set);
    return status;
}
