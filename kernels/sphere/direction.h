/* The direction of a vector that is nearly a unit vector: what the sums over spherical harmonics
 * need of it, in double precision without cancellation (docs/mathematics/numerics.md#high-order).
 * PRECISION is 64, also in C11.
 *
 * Measured on the host (tests/kernels/sphere_header_cases.h): relative errors of t and rho below
 * 5e-16, of the azimuth below 7e-17 turns.
 */
#ifndef PS_SPHERE_DIRECTION_H
#define PS_SPHERE_DIRECTION_H

#include "shared/real.h"

/* Below it a point is a pole for sums of this precision (SCALED_SMALLEST of sphere/scaled.h). */
#define DIRECTION_SMALLEST(precision)                                                              \
    ((precision) == 64 ? 7.888609052210118e-31 : 5.421010862427522e-20)

/* Fixed point is made of 2^62 ths of a turn, so that half a turn does not overflow a signed word.
 */
#define DIRECTION_QUARTER_WORDS 4.611686018427387904e18 /* 2^62 */

typedef struct direction {
    realv t;            /* 1 - |cos theta| */
    realv rho;          /* sin theta; 0 at a pole */
    realv cosine, sine; /* of the azimuth; 1 and 0 at a pole */
    wordv turn;         /* the azimuth */
} direction;

/* arctan(q) / (2 pi q) for 0 <= q <= 1 in powers of s = q^2: interpolated at 22 Chebyshev nodes in
 * 60 digits, error 1.4e-19. */
static inline realv direction_arctangent(const realv s) {
    realv sum = (realv)-1.3158924037923228018e-6;
    sum = fma(sum, s, (realv)0.000015881134049239378366);
    sum = fma(sum, s, (realv)-0.000091162770175614375998);
    sum = fma(sum, s, (realv)0.00033273466133089833492);
    sum = fma(sum, s, (realv)-0.00087292968512994223905);
    sum = fma(sum, s, (realv)0.0017701236118317054672);
    sum = fma(sum, s, (realv)-0.0029263559673958446349);
    sum = fma(sum, s, (realv)0.0041296101317125581943);
    sum = fma(sum, s, (realv)-0.0051950024285409507952);
    sum = fma(sum, s, (realv)0.0060685477015384822649);
    sum = fma(sum, s, (realv)-0.0068163906695312021923);
    sum = fma(sum, s, (realv)0.0075498425313219632404);
    sum = fma(sum, s, (realv)-0.0083701236432999660297);
    sum = fma(sum, s, (realv)0.0093609323124636363614);
    sum = fma(sum, s, (realv)-0.010610180156030242457);
    sum = fma(sum, s, (realv)0.012242673193477123691);
    sum = fma(sum, s, (realv)-0.014468630154757596114);
    sum = fma(sum, s, (realv)0.017683882516862198692);
    sum = fma(sum, s, (realv)-0.022736420440276716028);
    sum = fma(sum, s, (realv)0.03183098861835703494);
    sum = fma(sum, s, (realv)-0.053051647697298309075);
    return fma(sum, s, (realv)0.15915494309189533563);
}

/* arg(x + i y) as a fraction of a turn in fixed point; 0 for x = y = 0. */
static inline wordv direction_turn(const realv x, const realv y) {
    const realv a = fabs(x), b = fabs(y);
    const realv larger = fmax(a, b), smaller = fmin(a, b);
    const realv q = smaller / (larger > (realv)0 ? larger : (realv)1);
    realv turns = q * direction_arctangent(q * q);
    turns = b > a ? (realv)0.25 - turns : turns;
    turns = x < (realv)0 ? (realv)0.5 - turns : turns;
    turns = y < (realv)0 ? -turns : turns;
    return AS_WORDV(TO_SWORDV(turns * (realv)DIRECTION_QUARTER_WORDS)) << 2;
}

static inline direction direction_of(const realv x, const realv y, const realv z,
                                     const real smallest_rho) {
    const realv flat2 = fma(x, x, y * y);
    const realv flat = sqrt(flat2);
    const realv length = sqrt(fma(z, z, flat2));
    const realv rho = flat / length;
    const realv is_off = rho < (realv)smallest_rho ? (realv)0 : (realv)1;
    const realv divisor = is_off > (realv)0 ? flat : (realv)1;
    direction out;
    out.t = flat2 / (length * (length + fabs(z)));
    out.rho = rho * is_off;
    out.cosine = is_off > (realv)0 ? x / divisor : (realv)1;
    out.sine = is_off > (realv)0 ? y / divisor : (realv)0;
    out.turn = is_off > (realv)0 ? direction_turn(x, y) : (wordv)0;
    return out;
}

#endif
