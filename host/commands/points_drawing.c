#include "commands/points_drawing.h"

#include "answers/output_check.h"
#include "answers/picture.h"

static bool is_all(const ps_request *request) {
    return ps_picture_is_all(request, false);
}

pspec_status ps_points_drawing_check(const ps_request *request, const ps_answer_hooks *hooks,
                                     ps_error *error) {
    if (request->plot == NULL) {
        return PSPEC_OK;
    }
    if (request->num_files > PS_MAX_SAMPLERS && ps_request_only_draws(request) && !request->merge) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%zu files are more than %d, which a picture shows side by side",
                       request->num_files, PS_MAX_SAMPLERS);
    }
    PS_TRY(ps_picture_check(request, is_all(request), hooks, error));
    return ps_outputs_check(request, false, error);
}

pspec_status ps_points_draw_file(ps_points_picture *picture, const char *path,
                                 const ps_point_set *set, const ps_watch *watch, ps_error *error) {
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

static pspec_status draw(const ps_points_picture *picture, const ps_request *request,
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

pspec_status ps_points_draw(const ps_points_picture *picture, const ps_request *request,
                            const ps_answer_hooks *hooks, ps_error *error) {
    return ps_picture_settle(request, is_all(request), hooks, draw(picture, request, error), error);
}
