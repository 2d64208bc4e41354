/* HEALPix: the centres of 12 nside^2 pixels of equal area, in RING order; P(l) = 0 for odd l. */
#include "samplers/list.h"

#include "samplers/pace.h"
#include "samplers/sphere/healpix_pixels.h"
#include "samplers/values.h"

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    (void)realization;
    uint64_t nside = 0;
    PS_TRY(ps_healpix_nside(request, &nside, error));
    PS_TRY(ps_sampler_fill_centres(request, 2, points, error));
    return ps_healpix_place(request, nside, points, error);
}

const ps_sampler ps_sampler_healpix = {
    .name = "healpix",
    .summary = "centres of the pixels of HEALPix, RING order",
    .domain = PS_SAMPLES_SPHERE,
    .parameters = {PS_NSIDE_PARAMETER},
    .nanoseconds = 22,
    .is_deterministic = ps_sampler_always,
    .open_points = ps_healpix_open_points,
    .check = ps_healpix_check,
    .generate = generate,
};
