/* A point of the sphere from its height and azimuth, by + - * / and sqrt alone: the same bits on
 * any machine, and on devices with doubles.
 */
#ifndef PS_SHARED_SPHERE_POINT_H
#define PS_SHARED_SPHERE_POINT_H

#include "shared/fixed.h"

#ifdef __OPENCL_C_VERSION__
#pragma OPENCL FP_CONTRACT OFF
#else
#include <math.h>
#include <stdbool.h>
#endif

/* Taylor's series of sin(2 pi x) / x - 2 pi and of cos(2 pi x) in x^2, up to |x| = 1/8 of a turn:
 * what is left out is below 9e-20 and 3e-18. 2 pi itself has a low part, so that one rounding of
 * the product is all that the sine has beside that of the sum. */
static inline double ps_turn_sine(const double x, const double z) {
    double sum = 0.10422916220813984;
    sum = sum * z + -0.7181223017785006;
    sum = sum * z + 3.819952584848282;
    sum = sum * z + -15.09464257682299;
    sum = sum * z + 42.058693944897655;
    sum = sum * z + -76.70585975306139;
    sum = sum * z + 81.60524927607506;
    sum = sum * z + -41.34170224039976;
    sum = sum * z + 2.4492935982947064e-16;
    return x * 6.283185307179586 + x * sum;
}

static inline double ps_turn_cosine(const double z) {
    double sum = 0.28200596845579123;
    sum = sum * z + -1.714390711088672;
    sum = sum * z + 7.903536371318469;
    sum = sum * z + -26.4262567833744;
    sum = sum * z + 60.24464137187666;
    sum = sum * z + -85.45681720669373;
    sum = sum * z + 64.9393940226683;
    sum = sum * z + -19.739208802178716;
    return 1 + sum * z;
}

/* The nearest whole number, of two the even one, |x| < 2^51: floor would keep loops from being
 * vectorised. */
static inline double ps_turn_whole(const double x) {
    const double rounder = 6755399441055744.0; /* 1.5 * 2^52: its last bit is a unit */
    return (x + rounder) - rounder;
}

/* Cosine and sine of quarters/4 + rest of a turn, quarters a whole number of 0 .. 7, |rest| <= 1/8.
 * Without branches, for the same reason: products with 0, 1 and -1 are exact, and so are their
 * sums. */
static inline void ps_turn_cosine_sine(const double quarters, const double rest, double *cosine,
                                       double *sine) {
    const double z = rest * rest;
    const double s = ps_turn_sine(rest, z);
    const double c = ps_turn_cosine(z);
    const double halves = ps_turn_whole(0.5 * quarters - 0.25); /* rounded down */
    const double odd = quarters - 2 * halves;
    const double sign = 1 - 2 * (halves - 2 * ps_turn_whole(0.5 * halves - 0.25));
    *cosine = sign * (c * (1 - odd) - s * odd);
    *sine = sign * (s * (1 - odd) + c * odd);
}

/* fraction/2^64 of a turn as quarters/4 + rest, |rest| <= 1/8, to the last place. */
static inline void ps_turn_of_fraction(const ps_u64 fraction, ps_u32 *quarters, double *rest) {
    const ps_u64 eighth = (ps_u64)1 << 61;
    const ps_u64 whole = (fraction + eighth) >> 62;         /* 0 again for the last eighth */
    const ps_u64 above = fraction - (whole << 62) + eighth; /* 0 .. 2 eighths */
    *quarters = (ps_u32)whole;
    *rest = (double)((ps_i64)above - (ps_i64)eighth) * 0x1p-64;
}

/* Of |rest| <= 1/4 and any number of quarters. */
static inline void ps_turn_any_cosine_sine(const ps_u32 quarters, const double rest, double *cosine,
                                           double *sine) {
    const bool is_far = fabs(rest) > 0.125; /* between 1/8 and 1/4 the difference is exact */
    const ps_u32 more = !is_far ? 0 : rest > 0 ? 1 : 3;
    const double near = !is_far ? rest : rest > 0 ? rest - 0.25 : rest + 0.25;
    ps_turn_cosine_sine((double)((quarters + more) % 4), near, cosine, sine);
}

/* z, with t = 1 - |z|. No coordinate is -0. */
static inline void ps_sphere_point_of(const double z, const double t, const double cosine,
                                      const double sine, double *point) {
    const double sine_theta = sqrt(t * (2 - t));
    point[0] = sine_theta * cosine + 0.0;
    point[1] = sine_theta * sine + 0.0;
    point[2] = z + 0.0;
}

/* Lambert's cylindrical equal-area map of (x, y) in [0,1]^2: height x of the hemisphere, 2x - 1 of
 * the sphere, azimuth y turns. */
static inline void ps_sphere_point_of_area(const bool on_hemisphere, const double x, const double y,
                                           double *point) {
    /* Doubling is exact, and so is 1 - x from 1/2 on: each number is rounded once at most. */
    const double below = 1 - x, is_low = copysign(0.5, 0.5 - x) + 0.5;
    const double z = on_hemisphere ? x : 2 * x - 1;
    const double t = on_hemisphere ? below : 2 * (is_low * x + (1 - is_low) * below);
    const double quarters = ps_turn_whole(4 * y); /* the rest is exact */
    double cosine = 0;
    double sine = 0;
    ps_turn_cosine_sine(quarters, y - quarters * 0.25, &cosine, &sine);
    ps_sphere_point_of(z, t, cosine, sine, point);
}

/* A point of the hemisphere, of equal areas, to where their density is z: its height h becomes
 * sqrt(h), and 1 - h^2 = (1 - h) (1 + h) says what that makes of the other two. */
static inline void ps_sphere_point_to_diffuse(double *point) {
    const double stretch = 1 / sqrt(1 + point[2]);
    point[0] = point[0] * stretch + 0.0;
    point[1] = point[1] * stretch + 0.0;
    point[2] = sqrt(point[2]) + 0.0;
}

#endif
