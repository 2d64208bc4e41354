/* x^q for distances of points, 0 <= x <= 4 and 0 < q < 1: x^q = 2^(q log2 x), x = 2^e m, sqrt(1/2)
 * <= m < sqrt 2,
 *
 *     log2 m = (2/ln 2) (f + f^3/3 + f^5/5 + ..),   f = (m-1)/(m+1),   |f| <= 0.172
 *     2^z = 2^k e^t,   k = round(z),   t = (z-k) ln 2,   |t| <= 0.347
 *
 * Numbers below the smallest normal one become 0. In double precision the error is below 1e-15
 * (tests/math/test_sobolev.c); series end where terms are below 1e-17. No branches and no
 * conversions, so that compilers make vectors of it on the host, where pow of libm takes four times
 * as long; PoCL's exp and log take 1.3 times as long (bench_weights). In single precision on a
 * device: its own functions.
 */
#ifndef PS_SHARED_POWER_H
#define PS_SHARED_POWER_H

#include "shared/real.h"

#if PRECISION == 64

#ifdef __OPENCL_C_VERSION__
#define POWER_INLINE static inline __attribute__((always_inline))
#define POWER_BITS(x) AS_WORDV(x)
#define POWER_NUMBER(bits) PS_JOIN(as_, PS_VECTOR(REAL))(bits)
#define POWER_STEP(sum, x, next) fma(sum, x, next)
#else
#define POWER_INLINE static inline
POWER_INLINE word POWER_BITS(real x) {
    word bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}
POWER_INLINE real POWER_NUMBER(word bits) {
    real x;
    memcpy(&x, &bits, sizeof x);
    return x;
}
#define POWER_STEP(sum, x, next) ((sum) * (x) + (next)) /* x86-64 has no other */
#endif

/* a + b x + c x^2 + d x^3, with few steps that wait for each other. */
#define POWER_FOUR(x, x2, a, b, c, d)                                                              \
    POWER_STEP(POWER_STEP((realv)(d), x, (realv)(c)), x2, POWER_STEP((realv)(b), x, (realv)(a)))

#define POWER_MANTISSA 52
#define POWER_TOP_BIT 63
#define POWER_BIAS 1023
#define POWER_LN2 0.693147180559945309417232121458
#define POWER_TWO_OVER_LN2 2.88539008177792681471984936200
#define POWER_ROOT_BITS 0x3fe6a09e667f3bcdul /* sqrt(1/2) */
#define POWER_SHIFT 0x4000000000000000ul     /* 1024 in the exponent, which stays above 0 */
#define POWER_INTEGERS_BITS 0x4330000000000000ul
#define POWER_INTEGERS 4503599627370496.0 /* 2^52, whose mantissa is an integer */
#define POWER_ROUND 6755399441055744.0    /* 1.5 2^52, which rounds what is added to it */
#define POWER_TINY_BITS 0x0010000000000000ul

POWER_INLINE realv power_log2(const realv x) {
    const wordv bits = POWER_BITS(x);
    const wordv shifted = bits - (wordv)POWER_ROOT_BITS + (wordv)POWER_SHIFT;
    const wordv exponent = shifted >> (wordv)POWER_MANTISSA;
    const realv m = POWER_NUMBER(bits - ((exponent << (wordv)POWER_MANTISSA) - (wordv)POWER_SHIFT));
    const realv f = (m - (realv)1) / (m + (realv)1);
    const realv g = f * f;
    const realv g2 = g * g;
    const realv g4 = g2 * g2;
    const realv low = POWER_FOUR(g, g2, 1.0 / 3, 1.0 / 5, 1.0 / 7, 1.0 / 9);
    const realv high = POWER_FOUR(g, g2, 1.0 / 11, 1.0 / 13, 1.0 / 15, 1.0 / 17);
    const realv last = POWER_STEP((realv)(1.0 / 21), g, (realv)(1.0 / 19));
    const realv sum = POWER_STEP(POWER_STEP(last, g4, high), g4, low);
    return POWER_NUMBER(exponent | (wordv)POWER_INTEGERS_BITS) - (realv)(POWER_INTEGERS + 1024) +
           (realv)POWER_TWO_OVER_LN2 * (f + f * g * sum);
}

POWER_INLINE realv power_exp2(const realv z) {
    const realv shifted = z + (realv)POWER_ROUND;
    const realv t = (z - (shifted - (realv)POWER_ROUND)) * (realv)POWER_LN2;
    const realv t2 = t * t;
    const realv t4 = t2 * t2;
    const realv low = POWER_FOUR(t, t2, 0.5, 1.0 / 6, 1.0 / 24, 1.0 / 120);
    const realv high = POWER_FOUR(t, t2, 1.0 / 720, 1.0 / 5040, 1.0 / 40320, 1.0 / 362880);
    const realv last =
        POWER_FOUR(t, t2, 1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800);
    const realv sum = POWER_STEP(POWER_STEP(POWER_STEP(last, t4, high), t4, low), t2, t);
    const realv scale =
        POWER_NUMBER((POWER_BITS(shifted) + (wordv)POWER_BIAS) << (wordv)POWER_MANTISSA);
    return scale + scale * sum;
}

POWER_INLINE realv power_of(const realv x, const realv exponent) {
    const wordv is_tiny = (POWER_BITS(x) - (wordv)POWER_TINY_BITS) >> (wordv)POWER_TOP_BIT;
    const realv power = power_exp2(exponent * power_log2(x));
    return POWER_NUMBER(POWER_BITS(power) & (is_tiny - (wordv)1));
}

#elif defined __OPENCL_C_VERSION__

static inline realv power_of(const realv x, const realv exponent) {
    return x > (realv)0 ? exp(exponent * log(x)) : (realv)0;
}

#endif

#endif
