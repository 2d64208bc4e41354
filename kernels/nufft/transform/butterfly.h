/* Discrete Fourier transforms of 2, 3, 4, 5, 7 and 8 complex numbers in registers, LANES of them
 * side by side: x[k] <- sum_j x[j] exp(-2 pi i j k / r). Device only.
 */
#ifndef PS_NUFFT_TRANSFORM_BUTTERFLY_H
#define PS_NUFFT_TRANSFORM_BUTTERFLY_H

#include "shared/lanes.h"

typedef struct complexv {
    realv re, im;
} complexv;

static inline complexv complex_add(const complexv a, const complexv b) {
    return (complexv){a.re + b.re, a.im + b.im};
}

static inline complexv complex_subtract(const complexv a, const complexv b) {
    return (complexv){a.re - b.re, a.im - b.im};
}

static inline complexv complex_multiply_lanes(const complexv a, const realv re, const realv im) {
    return (complexv){fma(a.re, re, -(a.im * im)), fma(a.re, im, a.im * re)};
}

static inline complexv complex_multiply(const complexv a, const real re, const real im) {
    return complex_multiply_lanes(a, (realv)re, (realv)im);
}

/* a - i b, a + i b */
static inline complexv complex_minus_i(const complexv a, const complexv b) {
    return (complexv){a.re + b.im, a.im - b.re};
}

static inline complexv complex_plus_i(const complexv a, const complexv b) {
    return (complexv){a.re - b.im, a.im + b.re};
}

static inline void butterfly_2(complexv *x) {
    const complexv sum = complex_add(x[0], x[1]);
    x[1] = complex_subtract(x[0], x[1]);
    x[0] = sum;
}

static inline void butterfly_4(complexv *x) {
    const complexv a = complex_add(x[0], x[2]), b = complex_subtract(x[0], x[2]);
    const complexv c = complex_add(x[1], x[3]), d = complex_subtract(x[1], x[3]);
    x[0] = complex_add(a, c);
    x[1] = complex_minus_i(b, d);
    x[2] = complex_subtract(a, c);
    x[3] = complex_plus_i(b, d);
}

static inline void butterfly_8(complexv *x) {
    const realv half_root = (realv)(real)0.70710678118654752440;
    complexv even[4] = {x[0], x[2], x[4], x[6]};
    complexv odd[4] = {x[1], x[3], x[5], x[7]};
    butterfly_4(even);
    butterfly_4(odd);
    const complexv first = odd[1], last = odd[3]; /* times (1 - i) and (-1 - i) over sqrt(2) */
    odd[1] = (complexv){(first.re + first.im) * half_root, (first.im - first.re) * half_root};
    odd[3] = (complexv){(last.im - last.re) * half_root, -(last.re + last.im) * half_root};
    x[0] = complex_add(even[0], odd[0]);
    x[4] = complex_subtract(even[0], odd[0]);
    x[1] = complex_add(even[1], odd[1]);
    x[5] = complex_subtract(even[1], odd[1]);
    x[2] = complex_minus_i(even[2], odd[2]);
    x[6] = complex_plus_i(even[2], odd[2]);
    x[3] = complex_add(even[3], odd[3]);
    x[7] = complex_subtract(even[3], odd[3]);
}

/* An odd prime r: with sums and differences of x[j] and x[r - j], half of the products of each
 * kind. cosines and sines of 2 pi j / r. Always inlined: loops of a copy for any r do not unroll,
 * and users would see the compiler's warnings. */
static inline __attribute__((always_inline)) void
butterfly_odd(complexv *x, const int r, const real *cosines, const real *sines) {
    const int half_r = r / 2;
    const complexv first = x[0];
    complexv sum[3], difference[3];
#pragma unroll
    for (int j = 1; j <= half_r; j++) {
        sum[j - 1] = complex_add(x[j], x[r - j]);
        difference[j - 1] = complex_subtract(x[j], x[r - j]);
        x[0] = complex_add(x[0], sum[j - 1]);
    }
#pragma unroll
    for (int k = 1; k <= half_r; k++) {
        complexv a = first, b = {(realv)0, (realv)0};
#pragma unroll
        for (int j = 1; j <= half_r; j++) {
            const realv cosine = (realv)cosines[j * k % r], sine = (realv)sines[j * k % r];
            a.re = fma(cosine, sum[j - 1].re, a.re);
            a.im = fma(cosine, sum[j - 1].im, a.im);
            b.re = fma(sine, difference[j - 1].re, b.re);
            b.im = fma(sine, difference[j - 1].im, b.im);
        }
        x[k] = complex_minus_i(a, b);
        x[r - k] = complex_plus_i(a, b);
    }
}

static inline void butterfly_3(complexv *x) {
    const real cosines[3] = {1, (real)-0.5, (real)-0.5};
    const real sines[3] = {0, (real)0.86602540378443864676, (real)-0.86602540378443864676};
    butterfly_odd(x, 3, cosines, sines);
}

static inline void butterfly_5(complexv *x) {
    const real c1 = (real)0.30901699437494742410, c2 = (real)-0.80901699437494742410;
    const real s1 = (real)0.95105651629515357212, s2 = (real)0.58778525229247312917;
    const real cosines[5] = {1, c1, c2, c2, c1};
    const real sines[5] = {0, s1, s2, -s2, -s1};
    butterfly_odd(x, 5, cosines, sines);
}

static inline void butterfly_7(complexv *x) {
    const real c1 = (real)0.62348980185873353053, c2 = (real)-0.22252093395631440429;
    const real c3 = (real)-0.90096886790241912624, s1 = (real)0.78183148246802980871;
    const real s2 = (real)0.97492791218182360702, s3 = (real)0.43388373911755812048;
    const real cosines[7] = {1, c1, c2, c3, c3, c2, c1};
    const real sines[7] = {0, s1, s2, s3, -s3, -s2, -s1};
    butterfly_odd(x, 7, cosines, sines);
}

#endif
