#include "samplers/darts/blue_noise.h"

pspec_status ps_blue_noise_tell(const ps_blue_noise *asked, size_t num_points, double expected,
                                ps_error *error) {
    const uint64_t total = (uint64_t)expected;
    const uint64_t done = num_points < total ? num_points : total;
    return ps_watch_tell(asked->watch, "sampler: points", done, total, NULL, error);
}

pspec_status ps_blue_noise_fail_room(const ps_blue_noise *asked, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_MEMORY,
                   "radius %g: there is room for %zu points, and more are at this distance",
                   asked->radius, asked->most_points);
}
