/* A Gaussian of height 1: the sum over its images, which is a product over axes, or cut at the
 * distance 1/2 from its centre on every axis, which leaves the nearest image. */
#ifndef PS_INTEGRANDS_GAUSSIAN_H
#define PS_INTEGRANDS_GAUSSIAN_H

#include "integrands/fold.h"
#include "shared/two_to.h"

/* Places among the numbers. RATE: 1/(2 sigma^2). IMAGES: how many on each side of the nearest are
 * added up. RATIO: exp(-2 rate). */
enum { GAUSSIAN_CENTRE = 0, GAUSSIAN_RATE = 6, GAUSSIAN_IMAGES = 7, GAUSSIAN_RATIO = 8 };

/* Takes points of any cell. */
#define gaussian_folds 1

/* exp(-rate x). On the host, which is the referee of the device, by libm. */
#ifdef __OPENCL_C_VERSION__
#define GAUSSIAN_FALL(rate, x) two_to((x) * (realv)(-(rate) * (real)TWO_TO_LOG2E))
#else
#define GAUSSIAN_FALL(rate, x) exp(-(rate) * (x))
#endif

/* Beyond that exponent there is nothing beside a height of 1: 3e-17, in single precision 1.5e-8. */
#if PRECISION == 64
#define GAUSSIAN_NOTHING ((real)38)
#else
#define GAUSSIAN_NOTHING ((real)18)
#endif

/* The images of an axis over the nearest: (n -+ f)^2 - f^2 = n (1 -+ 2 f) + n (n - 1), f = |x - c|,
 * so that those of n = 1 on either side give all others by products. On the other side of the
 * point they are 1 and more away. */
static inline realv gaussian_images(const realv difference, const real *numbers) {
    const real rate = numbers[GAUSSIAN_RATE];
    const realv far = fabs(difference);
    const realv near_side = GAUSSIAN_FALL(rate, 1 - 2 * far);
    realv other_side = 0;
    if (rate < GAUSSIAN_NOTHING) {
        other_side = GAUSSIAN_FALL(rate, 1 + 2 * far);
    }
    realv near = near_side, other = other_side, sum = 1 + (near_side + other_side);
    real power = 1, factor = 1;
    for (real n = 2; n <= numbers[GAUSSIAN_IMAGES]; n += 1) {
        power *= numbers[GAUSSIAN_RATIO];
        factor *= power;
        near *= near_side;
        other *= other_side;
        sum += factor * (near + other);
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
    return GAUSSIAN_FALL(numbers[GAUSSIAN_RATE], norm2);
}

static inline realv gaussian_value(const realv *x, const unsigned dimension, const real *numbers) {
    const real rate = numbers[GAUSSIAN_RATE];
    const real side = (real)0.5; /* all images but the nearest are as far away */
    realv product = gaussian_nearest(x, dimension, numbers);
    if (numbers[GAUSSIAN_IMAGES] >= (real)1 && rate * side * side < GAUSSIAN_NOTHING) {
        FOR_AXES(unsigned i = 0; i < dimension; i++) {
            product *=
                gaussian_images(fold_difference(x[i], numbers[GAUSSIAN_CENTRE + i]), numbers);
        }
    }
    return product;
}

#endif
