/* White noise: independent uniform points; P(k) = 1 at every k != 0, the unit of all spectra. */
#include "samplers/list.h"

#include "samplers/pace.h"
#include "samplers/values.h"
#include "samplers/lifted.h"

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    return ps_sampler_fill_uniform(request, &random, request->dimension, points, error);
}

const ps_sampler ps_sampler_white = {
    .name = "white",
    .stands_beside = true,
    .summary = "independent uniform points",
    .aliases = {"whitenoise", "random", "uniform"},
    .minimum_dimension = 1,
    .maximum_dimension = PS_MAX_DIMENSION,
    .nanoseconds = 2.2,
    .is_deterministic = ps_sampler_never,
    .most_power = ps_sampler_white_power,
    .generate = generate,
    .by_index = {.name = "white", .places = white_places, .point = white_point},
};
