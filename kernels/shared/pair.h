/* Sums in pairs (high, low): twice the digits of the working precision, on devices without fp64
 * too.
 *
 * high + low is the sum; every rounding error of high is caught exactly (Knuth's two-sum) and added
 * to low. Needs IEEE addition and no contraction, which shared/real.h switches off.
 */
#ifndef PS_SHARED_PAIR_H
#define PS_SHARED_PAIR_H

#include "shared/real.h"

/* *high + *low += x */
static inline void pair_add(realv *high, realv *low, realv x) {
    const realv sum = *high + x;
    const realv x_part = sum - *high;
    *low += (*high - (sum - x_part)) + (x - x_part);
    *high = sum;
}

/* *high + *low += x * y, the product exact. */
static inline void pair_add_product(realv *high, realv *low, realv x, realv y) {
    const realv product = x * y;
    *low += fma(x, y, -product);
    pair_add(high, low, product);
}

/* *high + *low += x * x, the product exact. */
static inline void pair_add_square(realv *high, realv *low, realv x) {
    pair_add_product(high, low, x, x);
}

#endif
