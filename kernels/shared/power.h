/* x^q for distances of points, 0 <= x <= 4 and 0 < q < 1: x^q = 2^(q log2 x), x = 2^e m, sqrt(1/2)
 * <= m < sqrt 2,
 *
 *     log2 m = (2/ln 2) (f + f^3/3 + f^5/5 + ..),   f = (m-1)/(m+1),   |f| <= 0.172
 *
 * Numbers below the smallest normal one become 0, and others have q log2 x > -1021.5 (q < 0.9995).
 * In double precision the error is below 1e-15 (tests/math/test_sobolev.c); series end where terms
 * are below 1e-17. No branches and no conversions, so that compilers make vectors of it on a host,
 * where pow of libm takes four times as long; PoCL's exp and log take 1.3 times as long
 * (bench_weights). In single precision on a device: its own functions.
 */
#ifndef PS_SHARED_POWER_H
#define PS_SHARED_POWER_H

#include "shared/two_to.h"

#if PRECISION == 64

#define POWER_MANTISSA 52
#define POWER_TOP_BIT 63
#define POWER_TWO_OVER_LN2 2.88539008177792681471984936200
#define POWER_ROOT_BITS 0x3fe6a09e667f3bcdul /* sqrt(1/2) */
#define POWER_SHIFT 0x4000000000000000ul     /* 1024 in the exponent, which stays above 0 */
#define POWER_INTEGERS_BITS 0x4330000000000000ul
#define POWER_INTEGERS 4503599627370496.0 /* 2^52, whose mantissa is an integer */
#define POWER_TINY_BITS 0x0010000000000000ul

TWO_TO_INLINE realv power_log2(const realv x) {
    const wordv bits = BITS_OF(x);
    const wordv shifted = bits - (wordv)POWER_ROOT_BITS + (wordv)POWER_SHIFT;
    const wordv exponent = shifted >> (wordv)POWER_MANTISSA;
    const realv m = REAL_OF(bits - ((exponent << (wordv)POWER_MANTISSA) - (wordv)POWER_SHIFT));
    const realv f = (m - (realv)1) / (m + (realv)1);
    const realv g = f * f;
    const realv g2 = g * g;
    const realv g4 = g2 * g2;
    const realv low = SERIES_FOUR(g, g2, 1.0 / 3, 1.0 / 5, 1.0 / 7, 1.0 / 9);
    const realv high = SERIES_FOUR(g, g2, 1.0 / 11, 1.0 / 13, 1.0 / 15, 1.0 / 17);
    const realv last = SERIES_STEP((realv)(1.0 / 21), g, (realv)(1.0 / 19));
    const realv sum = SERIES_STEP(SERIES_STEP(last, g4, high), g4, low);
    return REAL_OF(exponent | (wordv)POWER_INTEGERS_BITS) - (realv)(POWER_INTEGERS + 1024) +
           (realv)POWER_TWO_OVER_LN2 * (f + f * g * sum);
}

TWO_TO_INLINE realv power_of(const realv x, const realv exponent) {
    const wordv is_tiny = (BITS_OF(x) - (wordv)POWER_TINY_BITS) >> (wordv)POWER_TOP_BIT;
    const realv power = two_to_normal(exponent * power_log2(x));
    return REAL_OF(BITS_OF(power) & (is_tiny - (wordv)1));
}

#elif defined __OPENCL_C_VERSION__

static inline realv power_of(const realv x, const realv exponent) {
    return x > (realv)0 ? exp(exponent * log(x)) : (realv)0;
}

#endif

#endif
