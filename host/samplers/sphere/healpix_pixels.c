/* Requests, and all pixels of a set, one after the other (kernels/samplers/healpix.h). */
#include "samplers/sphere/healpix_pixels.h"

#include "base/text.h"
#include "math/lift.h"
#include "samplers/healpix.h"
#include "samplers/pace.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    NUM_FACES = 12,
    MAXIMUM_NSIDE =
        302697,       /* the largest with 12 nside^2 <= 2^40, the most points of any request */
    EXAMPLE_NSIDE = 9 /* nearest to 1024 points, the default of other samplers */
};

static uint64_t points_of(uint64_t nside) {
    return NUM_FACES * nside * nside;
}

/* ---- requests ------------------------------------------------------------------------------ */

static const char *given_nside(const ps_sampler_request *request) {
    return request->values[0];
}

static bool is_given(const ps_sampler_request *request) {
    return strcmp(given_nside(request), PS_NSIDE_AUTO) != 0;
}

static pspec_status read_nside(const ps_sampler_request *request, uint64_t *nside,
                               ps_error *error) {
    char what[64];
    snprintf(what, sizeof what, "sampler %s: nside", request->sampler->name);
    return ps_parse_count(given_nside(request), what, 1, MAXIMUM_NSIDE, nside, error);
}

static pspec_status fail_number(const ps_sampler_request *request, uint64_t nside_below,
                                ps_error *error) {
    const uint64_t low = nside_below > 0 ? nside_below : 1;
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "sampler %s: %zu points are not 12 nside^2; use %llu (nside=%llu) or %llu "
                   "(nside=%llu)",
                   request->sampler->name, request->num_points, (unsigned long long)points_of(low),
                   (unsigned long long)low, (unsigned long long)points_of(low + 1),
                   (unsigned long long)low + 1);
}

pspec_status ps_healpix_nside(const ps_sampler_request *request, uint64_t *nside, ps_error *error) {
    if (!is_given(request)) {
        *nside = (uint64_t)sqrt((double)request->num_points / NUM_FACES);
        return points_of(*nside) == request->num_points ? PSPEC_OK
                                                        : fail_number(request, *nside, error);
    }
    PS_TRY(read_nside(request, nside, error));
    if (points_of(*nside) != request->num_points) {
        return ps_fail(
            error, PSPEC_ERROR_INVALID_ARGUMENT,
            "sampler %s: nside=%llu makes %llu points, but %zu were asked for; leave one "
            "of the two away",
            request->sampler->name, (unsigned long long)*nside,
            (unsigned long long)points_of(*nside), request->num_points);
    }
    return PSPEC_OK;
}

pspec_status ps_healpix_check(const ps_sampler_request *request, ps_error *error) {
    uint64_t nside = 0;
    return ps_healpix_nside(request, &nside, error);
}

pspec_status ps_healpix_open_points(const ps_sampler_request *request, size_t *num_points,
                                    ps_error *error) {
    uint64_t nside = 0;
    if (!is_given(request)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "sampler %s needs a number of points 12 nside^2, or nside=, as in nside=%d "
                       "for %llu points",
                       request->sampler->name, EXAMPLE_NSIDE,
                       (unsigned long long)points_of(EXAMPLE_NSIDE));
    }
    PS_TRY(read_nside(request, &nside, error));
    *num_points = (size_t)points_of(nside);
    return PSPEC_OK;
}

/* ---- points -------------------------------------------------------------------------------- */

/* Rings 1 .. 4 nside - 1 from the north. Backwards, since a vector takes more room than its
 * offset. */
pspec_status ps_healpix_place(const ps_sampler_request *request, uint64_t num_side, double *points,
                              ps_error *error) {
    const int64_t nside = (int64_t)num_side;
    size_t j = (size_t)points_of(num_side);
    for (int64_t ring = 4 * nside - 1; ring > 0; ring--) {
        const int64_t to_south = 4 * nside - ring;
        const int64_t to_pole = ring < to_south ? ring : to_south;
        for (int64_t k = 4 * (to_pole < nside ? to_pole : nside); k-- > 0;) {
            healpix_pixel p;
            healpix_of_ring(&p, nside, ring, k);
            j--;
            PS_TRY(ps_sampler_go_on(request, "sampler: points in pixels",
                                    request->num_points - 1 - j, error));
            healpix_offset(&p, nside, points[2 * j], points[2 * j + 1],
                           points + PS_VECTOR_DIMENSION * j);
        }
    }
    return PSPEC_OK;
}

pspec_status ps_healpix_fill(const ps_sampler_request *request, ps_sampler_places *out,
                             ps_error *error) {
    return ps_healpix_nside(request, &out->numbers.counts[0], error);
}
