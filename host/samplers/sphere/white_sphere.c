/* White noise on the sphere: independent uniform points; P(l) = 1 for every l >= 1. The same points
 * as white:lift=sphere. */
#include "samplers/list.h"

#include "math/random/random.h"
#include "math/lift.h"
#include "samplers/values.h"

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    (void)error;
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    ps_random_fill_uniform(&random, points, 2 * request->num_points);
    ps_sphere_lift(false, request->num_points, points);
    return PSPEC_OK;
}

const ps_sampler ps_sampler_white_sphere = {
    .name = "white-sphere",
    .summary = "independent uniform points",
    .domain = PS_SAMPLES_SPHERE,
    .is_deterministic = ps_sampler_never,
    .generate = generate,
};
