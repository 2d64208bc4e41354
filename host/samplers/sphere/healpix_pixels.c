/* The twelve faces are squares whose diagonals point north. In face f a position (x, y) of [0,1]^2
 * has the distance j = JR[f] - x - y from the north pole along a meridian, in units of a diagonal's
 * half:
 *
 *   j < 1:  nr = j,      1 - z = nr^2/3            north cap
 *   else:   nr = 1,      z = (2 - j) 2/3           belt
 *   j > 3:  nr = 4 - j,  1 + z = nr^2/3            south cap
 *   azimuth (JP[f] nr + x - y)/(8 nr) of a turn, JR = 2 2 2 2 3 3 3 3 4 4 4 4, JP = 1 3 5 7 0 2 4 6 1 3 5 7
 *
 * Everything below is in units of a pixel, 1/nside, in which pixels are whole numbers. */
#include "samplers/sphere/healpix_pixels.h"

#include "base/text.h"
#include "math/lift.h"
#include "samplers/pace.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    NUM_FACES = 12,
    EIGHTHS = 8, /* of a turn: unit of JP */
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

/* ---- pixels -------------------------------------------------------------------------------- */

/* Pixel (ix, iy) of the face with these JR and JP. */
typedef struct pixel {
    int64_t jr, jp, ix, iy;
} pixel;

/* From the caps, ring i = 1, 2, .. counted from the nearer pole, position k = 0 .. 4i - 1. */
static pixel pixel_of_cap(int64_t nside, int64_t ring, int64_t k, bool is_south) {
    const int64_t jp = 2 * (k / ring) + 1; /* each of the four faces has i pixels of the ring */
    const int64_t sum = is_south ? ring - 1 : 2 * nside - 1 - ring; /* ix + iy */
    const int64_t difference = 2 * k + 1 - jp * ring;               /* ix - iy */
    return (pixel){is_south ? 4 : 2, jp, (sum + difference) / 2, (sum - difference) / 2};
}

static int64_t floor_divide(int64_t a, int64_t b) {
    return (a - ((a % b) + b) % b) / b;
}

/* From the belt, ring i = nside .. 3 nside counted from the north, position k = 0 .. 4 nside - 1.
 * The definition above, solved for ix and iy:
 *     2 ix = c - i - 1 + (JR - JP) nside,  2 iy = -c - i - 1 + (JR + JP) nside,  c the azimuth in units of
 * pixels. JR - JP = 2m + 1 and JR + JP = 2n + 1 are always odd, and 0 <= ix, iy < nside leaves one
 * choice of each. */
static pixel pixel_of_belt(int64_t nside, int64_t ring, int64_t k) {
    const int64_t c = 2 * k + (ring - nside + 1) % 2;
    const int64_t a = (c - ring - 1 + nside) / 2;  /* the numerators are even, */
    const int64_t b = (-c - ring - 1 + nside) / 2; /* so that nothing is rounded */
    const int64_t m = -floor_divide(a, nside);
    const int64_t n = -floor_divide(b, nside);
    return (pixel){m + n + 1, n - m, a + m * nside, b + n * nside};
}

/* ---- points -------------------------------------------------------------------------------- */

/* difference/(8 nr) of a turn from the meridian at JP eighths, which are quarters when JP is
 * even. */
static ps_turns azimuth(int64_t jp, double difference, double nr) {
    const double eighth = 0.125;
    const double rest = nr > 0 ? difference / (EIGHTHS * nr) : 0;
    const unsigned quarters = (unsigned)((jp + EIGHTHS) % EIGHTHS) / 2;
    return (ps_turns){quarters, jp % 2 == 0 ? rest : rest + eighth};
}

/* The offset (ox, oy) of a pixel. nr is formed from the corner that lies at the pole, so that it
 * keeps its digits there; centres are exact up to the last division. */
static void place(int64_t nside, const pixel *p, double ox, double oy, double *point) {
    const double side = (double)nside;
    const double difference = (double)(p->ix - p->iy) + (ox - oy);
    const double from_south = (double)(p->ix + p->iy) + (ox + oy); /* x + y */
    const double from_north = (double)(2 * nside - 2 - p->ix - p->iy) + ((1 - ox) + (1 - oy));
    const bool is_north = p->jr == 2 && from_north < side;
    const bool is_south = p->jr == 4 && from_south < side;
    if (is_north || is_south) {
        const double nr = is_north ? from_north : from_south;
        const double t = nr * nr / (3 * side * side);
        ps_sphere_point((ps_height){is_north ? 1 - t : t - 1, t}, azimuth(p->jp, difference, nr),
                        point);
        return;
    }
    const double height = from_south + (double)((2 - p->jr) * nside); /* 2 - j */
    ps_sphere_point(ps_height_of_ratio(2 * height, 3 * side), azimuth(p->jp, difference, side),
                    point);
}

/* Rings 1 .. 4 nside - 1 from the north. Backwards, since a vector takes more room than its
 * offset. */
pspec_status ps_healpix_place(const ps_sampler_request *request, uint64_t num_side, double *points,
                              ps_error *error) {
    const int64_t nside = (int64_t)num_side;
    size_t j = (size_t)points_of(num_side);
    for (int64_t ring = 4 * nside - 1; ring > 0; ring--) {
        const int64_t to_south = 4 * nside - ring;
        const int64_t to_pole = ring < to_south ? ring : to_south;
        const bool is_cap = to_pole < nside;
        for (int64_t k = 4 * (is_cap ? to_pole : nside); k-- > 0;) {
            const pixel p = is_cap ? pixel_of_cap(nside, to_pole, k, to_south < ring)
                                   : pixel_of_belt(nside, ring, k);
            j--;
            PS_TRY(ps_sampler_go_on(request, "sampler: points in pixels",
                                    request->num_points - 1 - j, error));
            place(nside, &p, points[2 * j], points[2 * j + 1], points + PS_VECTOR_DIMENSION * j);
        }
    }
    return PSPEC_OK;
}
