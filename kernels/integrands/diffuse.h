/* The diffuse lobe about z, divided by its integral: max(0, z)/pi. */
#ifndef PS_INTEGRANDS_DIFFUSE_H
#define PS_INTEGRANDS_DIFFUSE_H

#include "shared/real.h"

static inline realv diffuse_value(const realv *x, const unsigned dimension, const real *numbers) {
    const realv z = x[2];
    (void)dimension;
    (void)numbers;
    return (real)0.318309886183790671538 * (z > 0 ? z : (realv)0);
}

#endif
