/* The pixels of HEALPix, 12 nside^2 of equal area, in RING order; nside is counts[0]. Needs
 * doubles.
 *
 * The twelve faces are squares whose diagonals point north. In face f a position (x, y) of [0,1]^2
 * has the distance j = JR[f] - x - y from the north pole along a meridian, in units of a diagonal's
 * half:
 *
 *   j < 1:  nr = j,      1 - z = nr^2/3            north cap
 *   else:   nr = 1,      z = (2 - j) 2/3           belt
 *   j > 3:  nr = 4 - j,  1 + z = nr^2/3            south cap
 *   azimuth (JP[f] nr + x - y)/(8 nr) of a turn, JR = 2 2 2 2 3 3 3 3 4 4 4 4, JP = 1 3 5 7 0 2 4 6 1 3 5 7
 *
 * Everything below is in units of a pixel, 1/nside, in which pixels are whole numbers.
 */
#ifndef PS_SAMPLERS_HEALPIX_H
#define PS_SAMPLERS_HEALPIX_H

#include "samplers/white.h"
#include "shared/sphere_point.h"

/* Pixel (ix, iy) of the face with these JR and JP. */
typedef struct healpix_pixel {
    ps_i64 jr, jp, ix, iy;
} healpix_pixel;

/* From the caps, ring i = 1, 2, .. counted from the nearer pole, position k = 0 .. 4i - 1. */
static inline void healpix_of_cap(healpix_pixel *p, const ps_i64 nside, const ps_i64 ring,
                                  const ps_i64 k, const bool is_south) {
    const ps_i64 jp = 2 * (k / ring) + 1; /* each of the four faces has i pixels of the ring */
    const ps_i64 sum = is_south ? ring - 1 : 2 * nside - 1 - ring; /* ix + iy */
    const ps_i64 difference = 2 * k + 1 - jp * ring;               /* ix - iy */
    p->jr = is_south ? 4 : 2;
    p->jp = jp;
    p->ix = (sum + difference) / 2;
    p->iy = (sum - difference) / 2;
}

static inline ps_i64 healpix_floor(const ps_i64 a, const ps_i64 b) {
    return (a - ((a % b) + b) % b) / b;
}

/* From the belt, ring i = nside .. 3 nside counted from the north, position k = 0 .. 4 nside - 1.
 * The definition above, solved for ix and iy:
 *     2 ix = c - i - 1 + (JR - JP) nside,  2 iy = -c - i - 1 + (JR + JP) nside,  c the azimuth in units of
 * pixels. JR - JP = 2m + 1 and JR + JP = 2n + 1 are always odd, and 0 <= ix, iy < nside leaves one
 * choice of each. */
static inline void healpix_of_belt(healpix_pixel *p, const ps_i64 nside, const ps_i64 ring,
                                   const ps_i64 k) {
    const ps_i64 c = 2 * k + (ring - nside + 1) % 2;
    const ps_i64 a = (c - ring - 1 + nside) / 2;  /* the numerators are even, */
    const ps_i64 b = (-c - ring - 1 + nside) / 2; /* so that nothing is rounded */
    const ps_i64 m = -healpix_floor(a, nside);
    const ps_i64 n = -healpix_floor(b, nside);
    p->jr = m + n + 1;
    p->jp = n - m;
    p->ix = a + m * nside;
    p->iy = b + n * nside;
}

/* Position k of ring 1 .. 4 nside - 1 from the north. */
static inline void healpix_of_ring(healpix_pixel *p, const ps_i64 nside, const ps_i64 ring,
                                   const ps_i64 k) {
    const ps_i64 to_south = 4 * nside - ring;
    const ps_i64 to_pole = ring < to_south ? ring : to_south;
    if (to_pole < nside) {
        healpix_of_cap(p, nside, to_pole, k, to_south < ring);
    } else {
        healpix_of_belt(p, nside, ring, k);
    }
}

/* The ring of a cap that pixel j of it lies in, counted from the pole: 2i(i - 1) come before it. */
static inline ps_i64 healpix_cap_ring(const ps_i64 j) {
    ps_i64 ring = (ps_i64)(0.5 * (1 + sqrt(1 + 2 * (double)j)));
    while (2 * ring * (ring - 1) > j) {
        ring--;
    }
    while (2 * ring * (ring + 1) <= j) {
        ring++;
    }
    return ring;
}

/* Pixel j in RING order. */
static inline void healpix_of_index(healpix_pixel *p, const ps_i64 nside, const ps_i64 j) {
    const ps_i64 cap = 2 * nside * (nside - 1), from_end = 12 * nside * nside - 1 - j;
    if (j < cap) {
        const ps_i64 ring = healpix_cap_ring(j);
        healpix_of_ring(p, nside, ring, j - 2 * ring * (ring - 1));
    } else if (from_end < cap) {
        const ps_i64 ring = healpix_cap_ring(from_end);
        healpix_of_ring(p, nside, 4 * nside - ring, 2 * ring * (ring + 1) - 1 - from_end);
    } else {
        healpix_of_ring(p, nside, nside + (j - cap) / (4 * nside), (j - cap) % (4 * nside));
    }
}

/* difference/(8 nr) of a turn from the meridian at JP eighths, which are quarters when JP is
 * even. */
static inline void healpix_place(const double z, const double t, const ps_i64 jp,
                                 const double difference, const double nr, double *point) {
    const double near = nr > 0 ? difference / (8 * nr) : 0;
    double cosine = 0, sine = 0;
    ps_turn_any_cosine_sine((ps_u32)((jp + 8) % 8) / 2, jp % 2 == 0 ? near : near + 0.125, &cosine,
                            &sine);
    ps_sphere_point_of(z, t, cosine, sine, point);
}

/* The offset (ox, oy) of a pixel, (1/2, 1/2) for its centre. nr is formed from the corner that lies
 * at the pole, so that it keeps its digits there; centres are exact up to the last division. */
static inline void healpix_offset(const healpix_pixel *p, const ps_i64 nside, const double ox,
                                  const double oy, double *point) {
    const double side = (double)nside;
    const double difference = (double)(p->ix - p->iy) + (ox - oy);
    const double from_south = (double)(p->ix + p->iy) + (ox + oy); /* x + y */
    const double from_north = (double)(2 * nside - 2 - p->ix - p->iy) + ((1 - ox) + (1 - oy));
    const bool is_north = p->jr == 2 && from_north < side;
    const bool is_south = p->jr == 4 && from_south < side;
    if (is_north || is_south) {
        const double nr = is_north ? from_north : from_south;
        const double t = nr * nr / (3 * side * side);
        healpix_place(is_north ? 1 - t : t - 1, t, p->jp, difference, nr, point);
    } else {
        const double height = 2 * (from_south + (double)((2 - p->jr) * nside)); /* 2 (2 - j) */
        const double most = 3 * side;
        healpix_place(height / most, (most - fabs(height)) / most, p->jp, difference, side, point);
    }
}

SAMPLER_INLINE void healpix_jittered_point(const sampler_numbers *of, const bool on_hemisphere,
                                           const ps_u64 realization, const ps_u64 j,
                                           double *point) {
    healpix_pixel p;
    double offset[SAMPLER_PLANE];
    (void)on_hemisphere;
    white_coordinates(of, realization, j, offset);
    healpix_of_index(&p, (ps_i64)of->counts[0], (ps_i64)j);
    healpix_offset(&p, (ps_i64)of->counts[0], offset[0], offset[1], point);
}

#endif
