/* The row of Gaussian blue noise: docs/samplers/forces.md#gaussian-blue-noise. */
#include "samplers/list.h"

#include "base/text.h"
#include "samplers/forces/gaussian.h"
#include "samplers/values.h"

#include <math.h>

enum { SIGMA, PLANE = 2, SPACE = 3 };

static pspec_status sigma_of(const ps_sampler_request *request, double *sigma, ps_error *error) {
    return ps_parse_number(request->values[SIGMA], "sampler gaussian-blue-noise: sigma",
                           PS_GAUSSIAN_LEAST_SIGMA, PS_GAUSSIAN_MOST_SIGMA, sigma, error);
}

static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    double sigma = 0;
    PS_TRY(ps_sampler_limit_points(request, PS_GAUSSIAN_MOST_POINTS, error));
    return sigma_of(request, &sigma, error);
}

/* Steps: 2000 to 2800 for N from 256 to 4096 at sigma = 1, 8000 at 0.7, as many as may be at 0.5,
 * 1370 at 1.5 and 2. */
static double steps_of(double sigma) {
    const double steps = 2400;
    const double s2 = sigma * sigma;
    return sigma >= 1 ? steps / sigma : fmin(steps / (s2 * s2), PS_GAUSSIAN_MOST_STEPS);
}

/* Microseconds of a point and step are 0.64, 1.75 and 5.2 in the plane at sigma = 0.5, 1 and 2, and
 * 26 in space at 1 (an EPYC with AVX2, gcc 12 -O2, 2026-11). */
static double seconds(const ps_sampler_request *request) {
    double sigma = 1;
    if (sigma_of(request, &sigma, NULL) != PSPEC_OK) {
        return 0;
    }
    const double s2 = sigma * sigma;
    const double microseconds = request->dimension == PLANE ? 0.3 + 1.3 * s2 : 1 + 25 * s2 * sigma;
    return (double)request->num_points * steps_of(sigma) * microseconds * 1e-6;
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    double sigma = 1;
    PS_TRY(sigma_of(request, &sigma, error));
    return ps_gaussian_make(request->num_points, request->dimension, sigma, &random, request->watch,
                            points, error);
}

const ps_sampler ps_sampler_gaussian_blue_noise = {
    .name = "gaussian-blue-noise",
    .summary = "points at a low of the sum of Gaussians of their distances",
    .aliases = {"gbn"},
    .minimum_dimension = PLANE,
    .maximum_dimension = SPACE,
    .parameters = {{"sigma", "1",
                    "0.5 to 2, width of the Gaussians in N^(-1/d); larger ones order more"}},
    .version = 1,
    .seconds = seconds,
    .is_deterministic = ps_sampler_never,
    .check = check,
    .generate = generate,
};
