/* Directions as places on a torus: turns of the longitude and of the angle from the north pole, in
 * units of 2^-64. Device only.
 */
#ifndef PS_SPHERE_TURNS_H
#define PS_SPHERE_TURNS_H

#include "nufft/cells.h"
#include "sphere/doubles.h"

#define AS_ULONGV(x) PS_JOIN(as_, PS_VECTOR(ulong))(x)

/* atan(t) / t in units of 2^-62 turns, by powers of t^2 for |t| <= tan(pi / 8): off by 2^-54.7 of
 * itself. */
static inline doublev units_over_tangent(const doublev square) {
    doublev sum = (doublev)1.5512785322349102e+16;
    sum = fma(sum, square, (doublev)-3.191351301002454e+16);
    sum = fma(sum, square, (doublev)4.175092618248711e+16);
    sum = fma(sum, square, (doublev)-4.873749933915388e+16);
    sum = fma(sum, square, (doublev)5.644215360114483e+16);
    sum = fma(sum, square, (doublev)-6.6723785844549096e+16);
    sum = fma(sum, square, (doublev)8.155247779039618e+16);
    sum = fma(sum, square, (doublev)-1.0485323149132454e+17);
    sum = fma(sum, square, (doublev)1.467945251556969e+17);
    sum = fma(sum, square, (doublev)-2.4465754194013085e+17);
    return fma(sum, square, (doublev)7.339726258205002e+17);
}

#define EIGHTH_TURN ((ulongv)(1UL << 61))

/* Turns of the angle of (x, y), which is 0 at the origin. An angle below an eighth of a turn is
 * that of a tangent, or differs from an eighth by one; what is left is done in whole numbers. The
 * atan2 of PoCL 3.1 takes twice the time (Zen 4), and devices have other bits of it. Two bits fewer
 * than there are, so that a quarter of a turn still is a signed number. */
static inline __attribute__((always_inline)) ulongv turns_of(const doublev y, const doublev x) {
    const doublev width = fabs(x), height = fabs(y);
    const doublev large = fmax(fmax(width, height), (doublev)DBL_MIN);
    const doublev small = fmin(width, height);
    const longv is_steep = small > large * (doublev)0.4142135623730951; /* true is -1 */
    const doublev tangent = (is_steep ? small - large : small) / (is_steep ? small + large : large);
    const doublev units = tangent * units_over_tangent(tangent * tangent);
    ulongv turns = AS_ULONGV(TO_LONGV(units)) << (ulongv)2;
    turns += is_steep ? EIGHTH_TURN : (ulongv)0;
    turns = height > width ? EIGHTH_TURN * (ulongv)2 - turns : turns;
    turns = x < (doublev)0 ? EIGHTH_TURN * (ulongv)4 - turns : turns;
    return y < (doublev)0 ? (ulongv)0 - turns : turns;
}

/* LANES points from `first` on, the last of num_points again behind the end: turns [point][2], room
 * for whole vectors. shift is added to the angle from the pole. */
static inline __attribute__((always_inline)) void
make_turns(__global const double *points, __global ulong *turns, const size_t first,
           const size_t num_points, const ulong shift) {
    double x[LANES], y[LANES], z[LANES];
#pragma unroll
    for (uint i = 0; i < LANES; i++) {
        const size_t at = min(first + i, num_points - 1) * 3;
        x[i] = points[at];
        y[i] = points[at + 1];
        z[i] = points[at + 2];
    }
    const doublev from_x = LOADV(0, x), from_y = LOADV(0, y);
    const doublev rho = sqrt(fma(from_x, from_x, from_y * from_y));
    union {
        ulongv together;
        ulong each[LANES];
    } around, along;
    around.together = turns_of(from_y, from_x);
    along.together = turns_of(rho, LOADV(0, z)) + (ulongv)shift;
#pragma unroll
    for (uint i = 0; i < LANES; i++) {
        turns[(first + i) * 2] = around.each[i];
        turns[(first + i) * 2 + 1] = along.each[i];
    }
}

#endif
