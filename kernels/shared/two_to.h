/* 2^t = 2^n 2^f, n the nearest whole number, |f| <= 1/2, for t from TWO_TO_LEAST to 100; smaller t
 * give what that does. Off by less than 1 unit in the last place where its steps are fused
 * (tests/kernels/shared_cases.h), as they are on devices. No branches, no calls and no conversions,
 * so that compilers make vectors of it on the host, too.
 */
#ifndef PS_SHARED_TWO_TO_H
#define PS_SHARED_TWO_TO_H

#include "shared/real.h"

#define TWO_TO_LOG2E 1.44269504088896340736 /* e^x = 2^(x log2 e) */

/* ROUND leaves no place for a fraction, and its last bits are the whole number that is added to it;
 * those above them are 0 where they go to the exponent. */
#if PRECISION == 64
#define TWO_TO_LEAST ((real)-1021.5)            /* 2^t is a normal number */
#define TWO_TO_ROUND ((real)6755399441055744.0) /* 1.5 2^52 */
#define TWO_TO_MANTISSA 52
#else
#define TWO_TO_LEAST ((real)-125.5)
#define TWO_TO_ROUND ((real)12582912.0) /* 1.5 2^23 */
#define TWO_TO_MANTISSA 23
#endif

#ifdef __OPENCL_C_VERSION__
#define TWO_TO_INLINE static inline __attribute__((always_inline))
#else
#define TWO_TO_INLINE static inline
#endif

/* sum x + next. Tests on the host define it as fused, which is a call on plain x86-64. */
#ifndef SERIES_STEP
#ifdef __OPENCL_C_VERSION__
#define SERIES_STEP(sum, x, next) fma(sum, x, next)
#else
#define SERIES_STEP(sum, x, next) ((sum) * (x) + (next))
#endif
#endif

/* a + b f + (c + d f) f^2: few steps that wait for each other, since a vector that waits for eleven
 * takes longer than their arithmetic. */
#define SERIES_FOUR(f, f2, a, b, c, d)                                                             \
    SERIES_STEP(SERIES_STEP((realv)(d), f, (realv)(c)), f2, SERIES_STEP((realv)(b), f, (realv)(a)))

/* Minimax polynomials of 2^f by a Remez exchange in 60 digits; relative errors 3.1e-18 and 1.9e-9,
 * so rounding alone decides. */
TWO_TO_INLINE realv two_to_fraction(const realv f) {
    const realv f2 = f * f;
#if PRECISION == 64
    const realv f4 = f2 * f2;
    const realv low = SERIES_FOUR(f, f2, 0.69314718055994533046, 0.24022650695910156205,
                                  0.055504108664819921475, 0.0096181291075883350392);
    const realv middle = SERIES_FOUR(f, f2, 0.0013333558146789952573, 0.00015403530462514668493,
                                     0.000015252733489958517137, 1.3215433089567187741e-6);
    const realv high = SERIES_STEP(
        (realv)4.4352807904353443278e-10, f2,
        SERIES_STEP((realv)7.0741056308632987575e-9, f, (realv)1.0178198034321091515e-7));
    const realv sum = SERIES_STEP(SERIES_STEP(high, f4, middle), f4, low);
#else
    const realv low = SERIES_FOUR(f, f2, 0.69314720573726808139f, 0.24022646890634086029f,
                                  0.055503287769647253084f, 0.0096184889571152173907f);
    const realv high =
        SERIES_STEP((realv)0.0001534581200286857502f, f, (realv)0.0013399931219340945221f);
    const realv sum = SERIES_STEP(high, f2 * f2, low);
#endif
    return SERIES_STEP(sum, f, (realv)1);
}

/* Of t that is no less than TWO_TO_LEAST. */
TWO_TO_INLINE realv two_to_normal(const realv t) {
    const realv whole = t + (realv)TWO_TO_ROUND;
    const realv fraction = t - (whole - (realv)TWO_TO_ROUND);
    /* the last bits of `whole` are n */
    return REAL_OF(BITS_OF(two_to_fraction(fraction)) + (BITS_OF(whole) << (wordv)TWO_TO_MANTISSA));
}

TWO_TO_INLINE realv two_to(const realv t) {
    return two_to_normal(t < (realv)TWO_TO_LEAST ? (realv)TWO_TO_LEAST : t);
}

#endif
