/* A Gaussian of height 1: the sum over its images, which is a product over axes, or cut at the
 * distance 1/2 from its centre on every axis, which leaves the nearest image. */
#ifndef PS_INTEGRANDS_GAUSSIAN_H
#define PS_INTEGRANDS_GAUSSIAN_H

#include "integrands/fold.h"

/* Places among the numbers. IMAGES: how many on each side of the nearest are added up. */
enum { GAUSSIAN_CENTRE = 0, GAUSSIAN_RATE = 6, GAUSSIAN_IMAGES = 7 }; /* rate: 1/(2 sigma^2) */

static inline realv gaussian_axis(const realv difference, const real rate, const real images) {
    realv sum = exp(-rate * difference * difference);
    for (real n = 1; n <= images; n += 1) {
        const realv below = difference - n;
        const realv above = difference + n;
        sum += exp(-rate * below * below) + exp(-rate * above * above);
    }
    return sum;
}

static inline realv gaussian_nearest(const realv *x, const unsigned dimension,
                                     const real *numbers) {
    realv norm2 = 0;
    for (unsigned i = 0; i < dimension; i++) {
        const realv difference = fold_difference(x[i], numbers[GAUSSIAN_CENTRE + i]);
        norm2 += difference * difference;
    }
    return exp(-numbers[GAUSSIAN_RATE] * norm2);
}

static inline realv gaussian_value(const realv *x, const unsigned dimension, const real *numbers) {
    if (numbers[GAUSSIAN_IMAGES] < (real)1) {
        return gaussian_nearest(x, dimension, numbers);
    }
    realv product = 1;
    for (unsigned i = 0; i < dimension; i++) {
        product *= gaussian_axis(fold_difference(x[i], numbers[GAUSSIAN_CENTRE + i]),
                                 numbers[GAUSSIAN_RATE], numbers[GAUSSIAN_IMAGES]);
    }
    return product;
}

#endif
