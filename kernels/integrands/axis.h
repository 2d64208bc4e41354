/* Unit vectors and an axis: the square of the chord between them, (1 - cos)*2, keeps the digits of
 * small angles, which the cosine loses. */
#ifndef PS_INTEGRANDS_AXIS_H
#define PS_INTEGRANDS_AXIS_H

#include "shared/real.h"

/* |x - sign axis|^2, three components each. */
static inline realv axis_chord2(const realv *x, const real *axis, const real sign) {
    realv chord2 = 0;
    for (unsigned i = 0; i < 3; i++) {
        const realv difference = x[i] - sign * axis[i];
        chord2 += difference * difference;
    }
    return chord2;
}

#endif
