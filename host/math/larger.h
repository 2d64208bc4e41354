/* The larger of two numbers, of which nan is larger than any: what is not known stays so. */
#ifndef PS_MATH_LARGER_H
#define PS_MATH_LARGER_H

#include <math.h>

static inline double ps_larger(double a, double b) {
    return a >= b || isnan(a) ? a : b;
}

#endif
