/* The Phong lobe about z, divided by its integral: a multiple of max(0, z)^n. */
#ifndef PS_INTEGRANDS_PHONG_H
#define PS_INTEGRANDS_PHONG_H

#include "shared/real.h"

enum { PHONG_EXPONENT = 0, PHONG_SCALE = 1 }; /* places among the numbers */

static inline realv phong_value(const realv *x, const unsigned dimension, const real *numbers) {
    const realv z = x[2];
    const realv exponent = numbers[PHONG_EXPONENT];
    (void)dimension;
    return numbers[PHONG_SCALE] * (z > 0 ? pow(z, exponent) : (realv)0);
}

#endif
