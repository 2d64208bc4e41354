/* Jittered HEALPix: one uniform point in each of 12 nside^2 pixels of equal area, in RING order. In
 * expectation P(l) is docs/mathematics/samplers.md#spectra-on-the-sphere, about (pi/3) l(l+1)/N for
 * small l. */
#include "samplers/list.h"

#include "samplers/healpix.h"
#include "samplers/pace.h"
#include "samplers/sphere/healpix_pixels.h"
#include "samplers/values.h"

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    uint64_t nside = 0;
    PS_TRY(ps_healpix_nside(request, &nside, error));
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    PS_TRY(ps_sampler_fill_uniform(request, &random, 2, points, error));
    return ps_healpix_place(request, nside, points, error);
}

const ps_sampler ps_sampler_healpix_jittered = {
    .name = "healpix-jittered",
    .stands_beside = true,
    .summary = "one uniform point in each pixel of HEALPix, RING order",
    .domain = PS_SAMPLES_SPHERE,
    .parameters = {PS_NSIDE_PARAMETER},
    .nanoseconds = 25,
    .is_deterministic = ps_sampler_never,
    .most_power = ps_sampler_white_power,
    .open_points = ps_healpix_open_points,
    .check = ps_healpix_check,
    .generate = generate,
    .by_index = {.name = "healpix_jittered",
                 .fill = ps_healpix_fill,
                 .point = healpix_jittered_point},
};
