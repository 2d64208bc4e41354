
#include "verify/bench/host_probes.h"

/* A probe should not take longer, and cannot be timed well far below. */
static const double most_seconds = 10e-3;

/* May it be, and is there room? */
static bool fits(ps_sampler_request *request, size_t num_points) {
    request->num_points = num_points;
    return ps_sampler_resolve(request, NULL) == PSPEC_OK &&
           ps_sampler_most_points(request) <= PS_PROBE_POINTS &&
           ps_sampler_seconds(request) <= most_seconds;
}

/* Every sampler has some of the powers of two, or of three quarters of them: HEALPix has 12 nside^2
 * points. False: it takes too long even for the fewest points. */
static bool choose_points(ps_sampler_request *request) {
    for (size_t num = PS_PROBE_POINTS; num > 0; num /= 2) {
        if (fits(request, num) || fits(request, num - num / 4)) {
            return true;
        }
    }
    return false;
}

pspec_status ps_probe_sampler(const ps_sampler *sampler, double *room, double *predicted,
                              ps_error *error) {
    ps_sampler_request request = {.seed = 1};
    size_t num = 0;
    PS_TRY(ps_sampler_parse(&request, sampler->name, error));
    if (!choose_points(&request)) {
        *predicted = 0;
        return PSPEC_OK;
    }
    *predicted = ps_sampler_seconds(&request);
    return ps_sampler_generate(&request, 0, room, &num, NULL, error);
}
