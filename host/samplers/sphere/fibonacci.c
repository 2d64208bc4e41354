/* Spherical Fibonacci points: z_j = 1 - (2j+1)/N, phi_j = 2 pi frac(j/Phi) (R. Swinbank, R. J.
 * Purser 2006; R. Marques et al. 2013). */
#include "samplers/list.h"

#include "samplers/fibonacci.h"
#include "samplers/sphere/spherical_fibonacci.h"
#include "samplers/values.h"

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    (void)realization;
    return ps_fibonacci_generate(request, request->num_points, points, error);
}

static pspec_status fill(const ps_sampler_request *request, ps_sampler_places *out,
                         ps_error *error) {
    (void)error;
    out->numbers.counts[0] = request->num_points;
    return PSPEC_OK;
}

const ps_sampler ps_sampler_fibonacci = {
    .name = "fibonacci",
    .stands_beside = true,
    .summary = "spherical Fibonacci points",
    .aliases = {"spherical-fibonacci", "sf"},
    .domain = PS_SAMPLES_SPHERE,
    .nanoseconds = 15,
    .is_deterministic = ps_sampler_always,
    .generate = generate,
    .by_index = {.name = "fibonacci", .fill = fill, .point = fibonacci_point},
};
