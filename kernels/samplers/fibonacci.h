/* Spherical Fibonacci points: azimuth j/Phi of a turn, height 1 - (2j + 1)/counts[0], which is the
 * number of points of the sphere, and twice that of the hemisphere. Needs doubles.
 */
#ifndef PS_SAMPLERS_FIBONACCI_H
#define PS_SAMPLERS_FIBONACCI_H

#include "samplers/numbers.h"
#include "shared/sphere_point.h"

/* The upper 64 bits of the product, by halves: no 128-bit integers in C11. */
static inline ps_u64 fibonacci_product_high(const ps_u64 a, const ps_u64 b) {
    const ps_u64 a_low = (ps_u32)a, a_high = a >> 32;
    const ps_u64 b_low = (ps_u32)b, b_high = b >> 32;
    const ps_u64 cross = a_high * b_low + (a_low * b_low >> 32);
    const ps_u64 other = a_low * b_high + (ps_u32)cross;
    return a_high * b_high + (cross >> 32) + (other >> 32);
}

/* 2^64 frac(j/Phi), rounded down or to the next whole number, for any j, by 2^128/Phi: j times its
 * error stays below one unit of 2^-64 for any j of 64 bits, where a constant of 64 bits is off by
 * 2.5e-14 of a turn at j = 1e7 already. */
static inline ps_u64 fibonacci_fraction(const ps_u64 j) {
    const ps_u64 high = 0x9E3779B97F4A7C15, low = 0xF39CC0605CEDC834;
    return j * high + fibonacci_product_high(j, low); /* whole turns drop out */
}

static inline void fibonacci_point_of(const ps_u64 j, const ps_u64 num_heights, double *point) {
    const double denominator = (double)num_heights;
    const double numerator = denominator - (2 * (double)j + 1);
    double cosine = 0, sine = 0, rest = 0;
    ps_u32 quarters = 0;
    ps_turn_of_fraction(fibonacci_fraction(j), &quarters, &rest);
    ps_turn_any_cosine_sine(quarters, rest, &cosine, &sine);
    ps_sphere_point_of(numerator / denominator, (denominator - fabs(numerator)) / denominator,
                       cosine, sine, point);
}

SAMPLER_INLINE void fibonacci_point(const sampler_numbers *of, const bool on_hemisphere,
                                    const ps_u64 realization, const ps_u64 j, double *point) {
    (void)on_hemisphere;
    (void)realization;
    fibonacci_point_of(j, of->counts[0], point);
}

#endif
