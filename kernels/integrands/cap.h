/* 1 in a cap of the sphere, else 0. A cap of more than a hemisphere is what the opposite one
 * leaves. */
#ifndef PS_INTEGRANDS_CAP_H
#define PS_INTEGRANDS_CAP_H

#include "integrands/axis.h"

/* Places among the numbers. CENTRE, CHORD2: of the smaller of the two caps, the square of the chord
 * from its centre to its rim; INSIDE: the value in it. The host keeps the ANGLE of it. */
enum { CAP_CENTRE = 0, CAP_CHORD2 = 3, CAP_INSIDE = 4, CAP_ANGLE = 5 };

static inline realv cap_value(const realv *x, const unsigned dimension, const real *numbers) {
    const real inside = numbers[CAP_INSIDE];
    (void)dimension;
    return axis_chord2(x, numbers + CAP_CENTRE, 1) < numbers[CAP_CHORD2] ? (realv)inside
                                                                         : (realv)(1 - inside);
}

#endif
