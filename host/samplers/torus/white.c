/* White noise: independent uniform points; P(k) = 1 at every k != 0, the unit of all spectra. */
#include "samplers/list.h"

#include "math/random/random.h"
#include "samplers/values.h"

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    (void)error;
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    ps_random_fill_uniform(&random, points, request->num_points * request->dimension);
    return PSPEC_OK;
}

const ps_sampler ps_sampler_white = {
    .name = "white",
    .summary = "independent uniform points",
    .aliases = {"whitenoise", "random", "uniform"},
    .minimum_dimension = 1,
    .maximum_dimension = PS_MAX_DIMENSION,
    .is_deterministic = ps_sampler_never,
    .generate = generate,
};
