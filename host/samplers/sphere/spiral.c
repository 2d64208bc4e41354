/* Bauer's spiral: z_j = 1 - (2j+1)/N, phi_j = sqrt(N pi) asin(z_j) (R. Bauer, "Distribution of
 * points on a sphere with application to star catalogs", J. Guidance Control Dynamics 23, 2000). */
#include "samplers/list.h"

#include "math/pi.h"
#include "math/lift.h"
#include "samplers/pace.h"
#include "samplers/values.h"

#include <math.h>

static const long double FRACTIONS = 0x1p64L; /* of a turn, in ps_turns_of_fraction */

/* Azimuth in turns: sqrt(N/(4 pi)) asin(z) of many turns, of which long double leaves an error of
 * 1e-19 sqrt(N). The numerator of z and the square root are cosine and sine of the polar angle,
 * times N: so asin does not lose digits towards the poles. */
static ps_turns azimuth(double num_points, double j) {
    const long double below = 2 * (long double)j + 1;              /* N (1 - z) */
    const long double above = 2 * (long double)num_points - below; /* N (1 + z) */
    const long double latitude = atan2l(num_points - below, sqrtl(below * above));
    const long double turns = sqrtl(num_points / PS_FOUR_PI_L) * latitude;
    const long double fraction = (turns - floorl(turns)) * FRACTIONS;
    return ps_turns_of_fraction(fraction < FRACTIONS ? (uint64_t)fraction : 0);
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    (void)realization;
    const double num_points = (double)request->num_points;
    for (size_t j = 0; j < request->num_points; j++) {
        PS_TRY(ps_sampler_go_on(request, PS_PACE_POINTS_MADE, j, error));
        const ps_height height = ps_height_of_ratio(num_points - (2 * (double)j + 1), num_points);
        ps_sphere_point(height, azimuth(num_points, (double)j), points + PS_VECTOR_DIMENSION * j);
    }
    return PSPEC_OK;
}

const ps_sampler ps_sampler_spiral = {
    .name = "spiral",
    .summary = "Bauer's generalised spiral",
    .aliases = {"bauer"},
    .domain = PS_SAMPLES_SPHERE,
    .nanoseconds = 87,
    .is_deterministic = ps_sampler_always,
    .generate = generate,
};
