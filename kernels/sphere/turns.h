/* Directions as places on a torus: turns of the longitude and of the angle from the north pole, in
 * units of 2^-64. Device only.
 */
#ifndef PS_SPHERE_TURNS_H
#define PS_SPHERE_TURNS_H

#include "nufft/cells.h"

#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef PS_VECTOR(double) doublev;
#define TO_DOUBLEV(x) PS_JOIN(convert_, PS_VECTOR(double))(x)
#define TO_LONGV(x) PS_JOIN(convert_, PS_VECTOR(long))(x)
#define AS_ULONGV(x) PS_JOIN(as_, PS_VECTOR(ulong))(x)

/* An angle between -pi and pi. Two bits fewer than there are, so that half a turn still is a signed
 * number; an angle in double precision has no more. */
static inline ulongv turns_of(const doublev angle) {
    const doublev turns = angle * (doublev)0.15915494309189533577;
    const doublev units = turns * (doublev)4611686018427387904.0;
    return AS_ULONGV(TO_LONGV(units)) << (ulongv)2;
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
    around.together = turns_of(atan2(from_y, from_x));
    along.together = turns_of(atan2(rho, LOADV(0, z))) + (ulongv)shift;
#pragma unroll
    for (uint i = 0; i < LANES; i++) {
        turns[(first + i) * 2] = around.each[i];
        turns[(first + i) * 2 + 1] = along.each[i];
    }
}

#endif
