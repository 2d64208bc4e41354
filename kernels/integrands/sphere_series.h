/* sum_lm F_lm Y_lm of a real function, Y_lm = q_lm e^{i m phi}, by the recurrences of q_lm
 * (docs/mathematics/sphere.md): for every order m >= 0, and there for every l >= m, the table has
 * a, b, and F_lm, with q_lm = a (z q_l-1,m - b q_l-2,m); a of l = m makes q_mm of the order before.
 *
 * In double precision alone: in floats sin^m would be 0 where its harmonics are not. */
#ifndef PS_INTEGRANDS_SPHERE_SERIES_H
#define PS_INTEGRANDS_SPHERE_SERIES_H

#include "integrands/table.h"

/* Place among the numbers; what the table has of each harmonic. */
enum { SPHERE_SERIES_DEGREE = 0, SPHERE_SERIES_NUMBERS = 4 };
#define sphere_series_has_table 1

static inline realv sphere_series_value(const realv *x, const unsigned dimension,
                                        const real *numbers, TABLE *table) {
    const int degree = (int)numbers[SPHERE_SERIES_DEGREE];
    const realv z = x[2];
    const realv sine = sqrt(x[0] * x[0] + x[1] * x[1]);
    const realv c = sine > (realv)0 ? x[0] / sine : (realv)1; /* at the poles only m = 0 is not 0 */
    const realv s = sine > (realv)0 ? x[1] / sine : (realv)0;
    realv top = (real)0.28209479177387814347; /* 1/sqrt(4 pi) */
    realv cosine = 1, imaginary = 0, total = 0;
    (void)dimension;
    for (int m = 0; m <= degree; m++) {
        if (m > 0) {
            const realv next = cosine * c - imaginary * s;
            imaginary = cosine * s + imaginary * c;
            cosine = next;
            top *= table[0] * sine;
        }
        realv before = 0, value = top;
        realv re = table[2] * value, im = table[3] * value;
        table += SPHERE_SERIES_NUMBERS;
        for (int l = m + 1; l <= degree; l++) {
            const realv next = table[0] * (z * value - table[1] * before);
            re += table[2] * next;
            im += table[3] * next;
            before = value;
            value = next;
            table += SPHERE_SERIES_NUMBERS;
        }
        total += (m > 0 ? 2 : 1) * (re * cosine - im * imaginary);
    }
    return total;
}

#endif
