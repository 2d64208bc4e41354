/* The pixels of HEALPix (K. M. Gorski et al. 2005), which healpix and healpix-jittered share: 12
 * nside^2 cells of equal area, in RING order, for any nside >= 1.
 */
#ifndef PS_SAMPLERS_SPHERE_HEALPIX_PIXELS_H
#define PS_SAMPLERS_SPHERE_HEALPIX_PIXELS_H

#include "samplers/sampler.h"

#define PS_NSIDE_AUTO "auto"
#define PS_NSIDE_PARAMETER                                                                         \
    { "nside", PS_NSIDE_AUTO, "N = 12 nside^2, any nside >= 1; auto: from N" }

/* nside of the request. In these functions the sampler's only parameter is PS_NSIDE_PARAMETER. */
pspec_status ps_healpix_nside(const ps_sampler_request *request, uint64_t *nside,
                              ps_error *error) PS_MUST_CHECK;
/* The sampler's open_points and check. */
pspec_status ps_healpix_open_points(const ps_sampler_request *request, size_t *num_points,
                                    ps_error *error) PS_MUST_CHECK;
pspec_status ps_healpix_check(const ps_sampler_request *request, ps_error *error) PS_MUST_CHECK;
/* Its by_index.fill. */
pspec_status ps_healpix_fill(const ps_sampler_request *request, ps_sampler_places *out,
                             ps_error *error) PS_MUST_CHECK;

/* Turns offsets in the pixels, [num_points][2] in [0,1) at the beginning of the array, into unit
 * vectors [num_points][3]. The map from offsets to the sphere preserves area, (1/2, 1/2) is the
 * centre of a pixel; the axes of offsets go north-east and north-west. PSPEC_ERROR_CANCELLED where
 * the watch asks to stop. */
pspec_status ps_healpix_place(const ps_sampler_request *request, uint64_t nside, double *points,
                              ps_error *error) PS_MUST_CHECK;

#endif
