#include "tasks/points_drawing.h"

#include "report/output_check.h"
#include "results/picture.h"

static bool is_all(const ps_request *request) {
    return ps_picture_is_all(request, false);
}

pspec_status ps_points_drawing_check(const ps_request *request, const ps_answer_hooks *hooks,
                                     ps_error *error) {
    if (request->plot == NULL) {
        return PSPEC_OK;
    }
    PS_TRY(ps_picture_check(request, is_all(request), hooks, error));
    return ps_outputs_check(request, false, error);
}

/* The sampler, how many points, which realization: as pictures of spectra have them. */
static void write_title(ps_text *title, const ps_points_picture *picture,
                        const ps_request *request) {
    if (request->num_samplers > 1) {
        ps_text_append(title, "%zu samplers", request->num_samplers);
    } else {
        ps_text_append(title, "%s, N = %zu", request->samplers[0], picture->num_points);
    }
    ps_text_append(title, ", seed %llu", (unsigned long long)request->seed);
    if (request->num_realizations > 1) {
        ps_text_append(title, ", the first of %llu realizations",
                       (unsigned long long)request->num_realizations);
    }
}

static pspec_status draw(ps_points_picture *picture, const ps_request *request, ps_error *error) {
    ps_text title = {0};
    ps_figure figure;
    pspec_status status = PSPEC_OK;
    write_title(&title, picture, request);
    PS_TRY_OUT(status, ps_text_check(&title, error));
    PS_TRY_OUT(status, ps_points_picture_figure(picture, ps_text_string(&title), &figure, error));
    PS_TRY_OUT(status, ps_figure_write(request->plot, &figure, error));
out:
    ps_text_free(&title);
    return status;
}

pspec_status ps_points_draw(ps_points_picture *picture, const ps_request *request,
                            const ps_answer_hooks *hooks, ps_error *error) {
    return ps_picture_settle(request, is_all(request), hooks, draw(picture, request, error), error);
}
