/* The row of Gaussian blue noise: docs/samplers/forces.md#gaussian-blue-noise. */
#include "samplers/list.h"

#include "base/text.h"
#include "samplers/forces/gaussian.h"
#include "samplers/forces/gaussian_sums.h"
#include "samplers/forces/loan.h"
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

/* On the host. Microseconds of a point and step are 0.64, 1.65 and 5.2 in the plane at sigma = 0.5,
 * 1 and 2, 26 and 158 in space at 1 and 2 (a core of an EPYC with AVX2, gcc 12 -O2, 2026-11). */
static double host_seconds(const ps_sampler_request *request) {
    double sigma = 1;
    if (sigma_of(request, &sigma, NULL) != PSPEC_OK) {
        return 0;
    }
    const double s2 = sigma * sigma;
    const double microseconds = request->dimension == PLANE ? 0.3 + 1.3 * s2 : 4 + 20 * s2 * sigma;
    return (double)request->num_points * steps_of(sigma) * microseconds * 1e-6;
}

/* Sets that take longer on the host are the device's work. */
static const double LEAST_SECONDS = 1;

static bool is_of_device(const ps_sampler_request *request) {
    return host_seconds(request) >= LEAST_SECONDS;
}

/* A device takes half of the host's time of one core (PoCL 3.1). */
static double seconds(const ps_sampler_request *request) {
    const double host = host_seconds(request);
    return is_of_device(request) ? host / 2 : host;
}

static pspec_status check_device(const ps_sampler_request *request, const char *selector,
                                 ps_error *error) {
    return is_of_device(request) ? ps_loan_check(request, selector, true, error) : PSPEC_OK;
}

/* Points and forces before and after a step, and the sums, which a device has once more. */
static double work_bytes(const ps_sampler_request *request) {
    const double steps = 4 * (double)sizeof(double) * request->dimension;
    return (double)request->num_points * steps +
           2 * ps_gaussian_sums_bytes(request->num_points, request->dimension);
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    ps_loan loan = {0};
    double sigma = 1;
    PS_TRY(sigma_of(request, &sigma, error));
    pspec_status status =
        is_of_device(request) ? ps_loan_begin(&loan, request, true, error) : PSPEC_OK;
    if (status == PSPEC_OK) {
        status = ps_gaussian_make(request->num_points, request->dimension, sigma, &random,
                                  loan.device, request->watch, points, error);
    }
    ps_loan_end(&loan);
    return status;
}

const ps_sampler ps_sampler_gaussian_blue_noise = {
    .name = "gaussian-blue-noise",
    .summary = "points at a low of the sum of Gaussians of their distances",
    .aliases = {"gbn"},
    .minimum_dimension = PLANE,
    .maximum_dimension = SPACE,
    .parameters = {{"sigma", "1",
                    "0.5 to 2, width of the Gaussians in N^(-1/d); larger ones order more"}},
    .version = 2,
    .seconds = seconds,
    .work_bytes = work_bytes,
    .is_deterministic = ps_sampler_never,
    .check = check,
    .check_device = check_device,
    .generate = generate,
};
