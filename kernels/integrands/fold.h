/* Differences of coordinates of the torus, to the nearest image. */
#ifndef PS_INTEGRANDS_FOLD_H
#define PS_INTEGRANDS_FOLD_H

#include "shared/real.h"

/* x - c in [-1/2,1/2]. */
static inline realv fold_difference(const realv x, const real c) {
    const realv difference = x - c;
    return difference - rint(difference);
}

#endif
