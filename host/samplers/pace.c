#include "samplers/pace.h"

static size_t end_of_piece(const ps_sampler_request *request, size_t first) {
    const size_t left = request->num_points - first;
    return first + (left < PS_PACE_POINTS ? left : PS_PACE_POINTS);
}

pspec_status ps_sampler_pieces(const ps_sampler_request *request, const char *phase,
                               ps_piece_task *task, const void *payload, double *points,
                               ps_error *error) {
    for (size_t first = 0; first < request->num_points; first = end_of_piece(request, first)) {
        PS_TRY(ps_sampler_go_on(request, phase, first, error));
        task(payload, first, end_of_piece(request, first), points);
    }
    return PSPEC_OK;
}

pspec_status ps_sampler_fill_uniform(const ps_sampler_request *request, ps_random *random,
                                     unsigned per_point, double *numbers, ps_error *error) {
    for (size_t first = 0; first < request->num_points; first = end_of_piece(request, first)) {
        const size_t num = end_of_piece(request, first) - first;
        PS_TRY(ps_sampler_go_on(request, PS_PACE_POINTS_MADE, first, error));
        ps_random_fill_uniform(random, numbers + first * per_point, num * per_point);
    }
    return PSPEC_OK;
}

static void fill_centres(const void *payload, size_t first, size_t end, double *numbers) {
    const double centre = 0.5;
    const size_t per_point = *(const unsigned *)payload;
    for (size_t i = first * per_point; i < end * per_point; i++) {
        numbers[i] = centre;
    }
}

pspec_status ps_sampler_fill_centres(const ps_sampler_request *request, unsigned per_point,
                                     double *numbers, ps_error *error) {
    return ps_sampler_pieces(request, PS_PACE_POINTS_MADE, fill_centres, &per_point, numbers,
                             error);
}

/* From the last piece, since a vector takes more room than its pair. */
pspec_status ps_sampler_lift(const ps_sampler_request *request, bool on_hemisphere, double *points,
                             ps_error *error) {
    for (size_t end = request->num_points; end > 0;) {
        const size_t first = (end - 1) / PS_PACE_POINTS * PS_PACE_POINTS;
        const size_t done = (request->num_points - end) / PS_PACE_POINTS * PS_PACE_POINTS;
        PS_TRY(ps_sampler_go_on(request, "sampler: points lifted", done, error));
        ps_sphere_lift(on_hemisphere, first, end, points);
        end = first;
    }
    return PSPEC_OK;
}
