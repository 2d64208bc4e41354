/* The harmonic Y_l0 about an axis, by the recurrence of P_l in the form of differences
 * (docs/mathematics/numerics.md#legendre-sums). */
#ifndef PS_INTEGRANDS_HARMONIC_H
#define PS_INTEGRANDS_HARMONIC_H

#include "integrands/axis.h"

/* Places among the numbers; SCALE: sqrt((2l+1)/(4 pi)); PARITY: (-1)^l. */
enum { HARMONIC_AXIS = 0, HARMONIC_DEGREE = 3, HARMONIC_SCALE = 4, HARMONIC_PARITY = 5 };

/* P_l(1 - t), 0 <= t <= 1. */
static inline realv harmonic_legendre(const realv t, const real degree) {
    realv value = 1;
    realv step = 0;
    for (real l = 0; l < degree; l += 1) {
        step = (l * step - (2 * l + 1) * (t * value)) / (l + 1);
        value += step;
    }
    return value;
}

static inline realv harmonic_value(const realv *x, const unsigned dimension, const real *numbers) {
    const realv ahead = axis_chord2(x, numbers + HARMONIC_AXIS, 1);
    const realv behind = axis_chord2(x, numbers + HARMONIC_AXIS, -1);
    const realv nearest = ahead < behind ? ahead : behind;
    const realv sign = ahead < behind ? (realv)1 : (realv)numbers[HARMONIC_PARITY];
    (void)dimension;
    return numbers[HARMONIC_SCALE] * sign *
           harmonic_legendre((real)0.5 * nearest, numbers[HARMONIC_DEGREE]);
}

#endif
