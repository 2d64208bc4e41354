/* The Gaussian lobe about z, cut at the horizon or not, divided by its integral. */
#ifndef PS_INTEGRANDS_GLOSSY_H
#define PS_INTEGRANDS_GLOSSY_H

#include "integrands/lobe.h"

/* Places among the numbers, after those of the lobe; LEAST: of z, below which it is 0. */
enum { GLOSSY_SCALE = 4, GLOSSY_LEAST = 5 };

static inline realv glossy_value(const realv *x, const unsigned dimension, const real *numbers) {
    const realv value = numbers[GLOSSY_SCALE] * lobe_value(x, dimension, numbers);
    return x[2] < numbers[GLOSSY_LEAST] ? (realv)0 : value;
}

#endif
