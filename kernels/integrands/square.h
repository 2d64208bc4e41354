/* (x.e)^2, e a unit vector. */
#ifndef PS_INTEGRANDS_SQUARE_H
#define PS_INTEGRANDS_SQUARE_H

#include "shared/real.h"

enum { SQUARE_AXIS = 0 }; /* place among the numbers */

static inline realv square_value(const realv *x, const unsigned dimension, const real *numbers) {
    realv product = 0;
    for (unsigned i = 0; i < dimension; i++) {
        product += x[i] * numbers[SQUARE_AXIS + i];
    }
    return product * product;
}

#endif
