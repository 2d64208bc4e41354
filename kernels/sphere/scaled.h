/* Numbers too small for a float or a double: (high + low) 2^(SCALE_BITS scale), in pairs for powers
 * that keep their digits. sin^m(theta) needs them (docs/mathematics/numerics.md#high-order). Works
 * in either precision, in C11 too.
 *
 * A normalised number has SCALED_LOW <= high < SCALED_HIGH, or is 0.
 */
#ifndef PS_SPHERE_SCALED_H
#define PS_SPHERE_SCALED_H

#include "shared/real.h"

#if PRECISION == 64
#define SCALE_BITS 256
#define SCALED_UP 1.157920892373162e77    /* 2^256 */
#define SCALED_DOWN 8.636168555094445e-78 /* 2^-256 */
#define SCALED_LOW 1.5930919111324523e-58 /* 2^-192 */
#define SCALED_HIGH 1.8446744073709552e19 /* 2^64 */
#else
#define SCALE_BITS 64
#define SCALED_UP 1.8446744073709552e19f   /* 2^64 */
#define SCALED_DOWN 5.421010862427522e-20f /* 2^-64 */
#define SCALED_LOW 3.552713678800501e-15f  /* 2^-48 */
#define SCALED_HIGH 65536.0f               /* 2^16 */
#endif

/* The smallest number that one normalisation takes back into range after a product, and all that
 * matters of sin theta: |Y_lm| < rho l^(3/2) for m > 0. */
#if PRECISION == 64
#define SCALED_SMALLEST 7.888609052210118e-31 /* 2^-100 */
#else
#define SCALED_SMALLEST 5.421010862427522e-20f /* 2^-64 */
#endif

typedef struct scaled {
    realv high, low;
    swordv scale;
} scaled;

/* Out through pointers: Oclgrind does not know what inlining makes of structures that are returned.
 */
static inline void scaled_normalize(scaled *x) {
    const realv high = x->high;
    const realv raise = high < (realv)SCALED_LOW ? (realv)SCALED_UP : (realv)1;
    const realv factor = high >= (realv)SCALED_HIGH ? (realv)SCALED_DOWN : raise;
    const swordv lower = high < (realv)SCALED_LOW ? x->scale - (swordv)1 : x->scale;
    x->scale = high >= (realv)SCALED_HIGH ? x->scale + (swordv)1 : lower;
    x->high *= factor;
    x->low *= factor;
}

static inline void scaled_make(scaled *out, const realv high, const realv low) {
    out->high = high;
    out->low = low;
    out->scale = (swordv)0;
    scaled_normalize(out);
}

/* *x times b; b may be x. */
static inline void scaled_multiply(scaled *x, const scaled *b) {
    const realv product = x->high * b->high;
    const realv rest = fma(x->low, b->high, fma(x->high, b->low, fma(x->high, b->high, -product)));
    const realv sum = product + rest;
    x->scale += b->scale;
    x->low = rest - (sum - product);
    x->high = sum;
    scaled_normalize(x);
}

/* x times a pair, SCALED_SMALLEST <= high <= 1 or 0, without a low part: off by half a unit. */
static inline void scaled_step(scaled *x, const realv high, const realv low) {
    const realv product = fma(x->high, high, x->high * low);
    const realv raised = product * (realv)SCALED_UP;
    x->scale = product < (realv)SCALED_LOW ? x->scale - (swordv)1 : x->scale;
    x->high = product < (realv)SCALED_LOW ? raised : product;
}

/* out = base^exponent, by squaring: relative error about exponent times that of the pair. From the
 * top bit down: the base need not be squared. */
static inline void scaled_power(scaled *out, const scaled *base, const uint exponent) {
    uint bit = 1;
    while (bit <= exponent / 2) {
        bit *= 2;
    }
    out->high = (realv)1;
    out->low = (realv)0;
    out->scale = (swordv)0;
    for (; bit > 0; bit /= 2) {
        scaled_multiply(out, out);
        if (exponent & bit) {
            scaled_multiply(out, base);
        }
    }
}

#endif
