/* The same everywhere. */
#ifndef PS_INTEGRANDS_CONSTANT_H
#define PS_INTEGRANDS_CONSTANT_H

#include "shared/real.h"

enum { CONSTANT_VALUE = 0 }; /* place among the numbers */

static inline realv constant_value(const realv *x, const unsigned dimension, const real *numbers) {
    (void)x;
    (void)dimension;
    return numbers[CONSTANT_VALUE];
}

#endif
