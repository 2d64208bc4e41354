/* White noise on the sphere: independent uniform points; P(l) = 1 for every l >= 1. The same points
 * as white:lift=sphere. */
#include "samplers/list.h"

#include "samplers/pace.h"
#include "samplers/values.h"
#include "samplers/lifted.h"

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    PS_TRY(ps_sampler_fill_uniform(request, &random, 2, points, error));
    return ps_sampler_lift(request, false, points, error);
}

const ps_sampler ps_sampler_white_sphere = {
    .name = "white-sphere",
    .stands_beside = true,
    .summary = "independent uniform points",
    .domain = PS_SAMPLES_SPHERE,
    .nanoseconds = 13,
    .is_deterministic = ps_sampler_never,
    .most_power = ps_sampler_white_power,
    .generate = generate,
    .by_index = {.name = "white", .point = white_point},
};
