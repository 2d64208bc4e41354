/* HEALPix: the centres of 12 nside^2 pixels of equal area, in RING order; P(l) = 0 for odd l. */
#include "samplers/list.h"

#include "samplers/sphere/healpix_pixels.h"
#include "samplers/values.h"

static const double CENTRE = 0.5;

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    (void)realization;
    uint64_t nside = 0;
    PS_TRY(ps_healpix_nside(request, &nside, error));
    for (size_t i = 0; i < 2 * request->num_points; i++) {
        points[i] = CENTRE;
    }
    ps_healpix_place(nside, points);
    return PSPEC_OK;
}

const ps_sampler ps_sampler_healpix = {
    .name = "healpix",
    .summary = "centres of the pixels of HEALPix, RING order",
    .domain = PS_SAMPLES_SPHERE,
    .parameters = {PS_NSIDE_PARAMETER},
    .is_deterministic = ps_sampler_always,
    .open_points = ps_healpix_open_points,
    .check = ps_healpix_check,
    .generate = generate,
};
