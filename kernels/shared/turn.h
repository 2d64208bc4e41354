/* Cosine and sine of an angle given as a fraction of a turn in fixed point: 2 pi u / 2^PRECISION.
 *
 * k.x mod 1 in fixed point is integer arithmetic that wraps, so the phase is exact for any k
 * (docs/mathematics/numerics.md#phases); here it becomes a cosine and a sine with absolute errors
 * below 1.8e-7 (float, all words; root mean square 5e-8) and 4e-16 (double, 1e8 random words;
 * 1e-16): tests/kernels/shared_cases.h.
 */
#ifndef PS_SHARED_TURN_H
#define PS_SHARED_TURN_H

#include "shared/real.h"

/* Minimax polynomials in h^2, |h| <= 1/2, of sin(pi h)/h and cos(pi h), lowest degree first, found
 * by a Remez exchange in 50 digits; absolute errors of the function 3.4e-9 and 2.2e-10 (float),
 * 1.7e-19 and 4e-18 (double), so rounding alone decides. */
#if PRECISION == 64
#define TURN_SINE(z)                                                                               \
    TURN_POLY9(z, 3.1415926535897932323, -5.1677127800499685514, 2.5501640398772413317,            \
               -0.5992645293174579466, 0.08214588655328290833, -0.0073704303560258947014,          \
               0.00046629917057965882949, -0.00002190202154154045492, 7.6839406118287095982e-7)
#define TURN_COSINE(z)                                                                             \
    TURN_POLY9(z, 0.99999999999999999609, -4.9348022005446767738, 4.0587121264164975479,           \
               -1.3352627688434646421, 0.2353306301298086091, -0.025806888739355262726,            \
               0.0019295562836051162881, -0.00010456658076791897926, 4.1495917341685692767e-6)
#define TURN_ONE_HALF_TURN 5.42101086242752217e-20 /* 2^-64 */
#define TURN_QUARTER ((word)1 << 62)
#define TURN_HALF ((word)1 << 63)
#else
#define TURN_SINE(z)                                                                               \
    TURN_POLY5(z, 3.14159258f, -5.16770688f, 2.55003138f, -0.598045175f, 0.0772201304f)
#define TURN_COSINE(z)                                                                             \
    TURN_POLY6(z, 1.0f, -4.93480214f, 4.05870916f, -1.33521206f, 0.234937559f, -0.0243967167f)
#define TURN_ONE_HALF_TURN 2.32830643654e-10f /* 2^-32 */
#define TURN_QUARTER ((word)1 << 30)
#define TURN_HALF ((word)1 << 31)
#endif

/* Horner's rule; the names say how many coefficients. */
#define TURN_POLY2(z, a, b) fma(z, (realv)(b), (realv)(a))
#define TURN_POLY3(z, a, b, c) fma(z, TURN_POLY2(z, b, c), (realv)(a))
#define TURN_POLY4(z, a, b, c, d) fma(z, TURN_POLY3(z, b, c, d), (realv)(a))
#define TURN_POLY5(z, a, b, c, d, e) fma(z, TURN_POLY4(z, b, c, d, e), (realv)(a))
#define TURN_POLY6(z, a, b, c, d, e, f) fma(z, TURN_POLY5(z, b, c, d, e, f), (realv)(a))
#define TURN_POLY7(z, a, b, c, d, e, f, g) fma(z, TURN_POLY6(z, b, c, d, e, f, g), (realv)(a))
#define TURN_POLY8(z, a, b, c, d, e, f, g, h) fma(z, TURN_POLY7(z, b, c, d, e, f, g, h), (realv)(a))
#define TURN_POLY9(z, a, b, c, d, e, f, g, h, i)                                                   \
    fma(z, TURN_POLY8(z, b, c, d, e, f, g, h, i), (realv)(a))

/* The angle is reduced by half turns, u = n 2^(W-1) + r/2 with |r| < 2^(W-1): both functions then
 * change sign with n, and no branch or blend is needed. */
static inline void turn_cosine_sine(wordv u, realv *cosine, realv *sine) {
    const swordv r = AS_SWORDV(u << 1);
    const wordv sign = (u + (wordv)TURN_QUARTER) & (wordv)TURN_HALF;
    const realv h = TO_REALV(r) * (realv)TURN_ONE_HALF_TURN;
    const realv z = h * h;
    *sine = FLIP_SIGN(h * TURN_SINE(z), sign);
    *cosine = FLIP_SIGN(TURN_COSINE(z), sign);
}

#endif
