/* A Gaussian of height 1: the sum over its images, which is a product over axes, or cut at the
 * distance 1/2 from its centre on every axis, which leaves the nearest image. */
#ifndef PS_INTEGRANDS_GAUSSIAN_H
#define PS_INTEGRANDS_GAUSSIAN_H

#include "integrands/fold.h"

/* Places among the numbers. IMAGES: how many on each side of the nearest are added up. */
enum { GAUSSIAN_CENTRE = 0, GAUSSIAN_RATE = 6, GAUSSIAN_IMAGES = 7 }; /* rate: 1/(2 sigma^2) */

#if defined __OPENCL_C_VERSION__ && LANES > 1
#define ANY_BELOW(x, limit) any((x) < (realv)(limit))
#else
#define ANY_BELOW(x, limit) ((x) < (limit))
#endif

/* Beyond that exponent there is nothing beside a height of 1: 3e-17, in single precision 1.5e-8. */
#if PRECISION == 64
#define GAUSSIAN_NOTHING ((real)38)
#else
#define GAUSSIAN_NOTHING ((real)18)
#endif

/* The images of an axis over the nearest: (n -+ f)^2 - f^2 = n (n -+ 2 f), f = |x - c|. For most
 * points, and vectors of few of them, none but the nearest is near enough to count. Those at the
 * other side are n and more away. */
static inline realv gaussian_images(const realv difference, const real rate, const real images) {
    const realv far = fabs(difference);
    realv sum = 1;
    for (real n = 1; n <= images; n += 1) {
        const realv near = n - far;
        if (ANY_BELOW(rate * near * near, GAUSSIAN_NOTHING)) {
            sum += exp(-rate * n * (n - 2 * far));
        }
        if (rate * n * n < GAUSSIAN_NOTHING) {
            sum += exp(-rate * n * (n + 2 * far));
        }
    }
    return sum;
}

static inline realv gaussian_nearest(const realv *x, const unsigned dimension,
                                     const real *numbers) {
    realv norm2 = 0;
    FOR_AXES(unsigned i = 0; i < dimension; i++) {
        const realv difference = fold_difference(x[i], numbers[GAUSSIAN_CENTRE + i]);
        norm2 += difference * difference;
    }
    return exp(-numbers[GAUSSIAN_RATE] * norm2);
}

static inline realv gaussian_value(const realv *x, const unsigned dimension, const real *numbers) {
    const real rate = numbers[GAUSSIAN_RATE];
    const real side = (real)0.5; /* all images but the nearest are as far away */
    realv product = gaussian_nearest(x, dimension, numbers);
    if (numbers[GAUSSIAN_IMAGES] >= (real)1 && rate * side * side < GAUSSIAN_NOTHING) {
        FOR_AXES(unsigned i = 0; i < dimension; i++) {
            product *= gaussian_images(fold_difference(x[i], numbers[GAUSSIAN_CENTRE + i]), rate,
                                       numbers[GAUSSIAN_IMAGES]);
        }
    }
    return product;
}

#endif
