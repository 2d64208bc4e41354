/* From c_lm of LANES degrees to powers. Device only. */
#ifndef PS_SPHERE_ORDERS_FINISH_H
#define PS_SPHERE_ORDERS_FINISH_H

#include "sphere/doubles.h"

/* 1: coefficients of one realization instead of powers. */
#ifndef KEEP
#define KEEP 0
#endif

/* |c|^2 of both signs of the order, whose weight is 2 or 1, in double precision, to what lower
 * orders left; or c, imaginary parts powers_apart further. */
static inline void finish_sums(__global double *powers, const size_t powers_apart,
                               const double weight, const bool is_lowest, const doublev a,
                               const doublev b) {
    __global unaligned_doublev *at = (__global unaligned_doublev *)powers;
#if KEEP
    (void)weight;
    (void)is_lowest;
    *at = a;
    *(__global unaligned_doublev *)(powers + powers_apart) = b;
#else
    (void)powers_apart;
    *at = fma(fma(a, a, b * b), (doublev)weight, is_lowest ? (doublev)0 : *at);
#endif
}

#endif
