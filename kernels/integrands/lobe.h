/* The Gaussian lobe exp(n (x.e - 1)), e a unit vector; of the hemisphere only points of it are
 * asked for. */
#ifndef PS_INTEGRANDS_LOBE_H
#define PS_INTEGRANDS_LOBE_H

#include "integrands/axis.h"

enum { LOBE_AXIS = 0, LOBE_RATE = 3 }; /* places among the numbers; rate: n/2 */

static inline realv lobe_value(const realv *x, const unsigned dimension, const real *numbers) {
    (void)dimension;
    return exp(-numbers[LOBE_RATE] * axis_chord2(x, numbers + LOBE_AXIS, 1));
}

#endif
