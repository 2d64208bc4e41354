/* Transforms of 9 and 16 complex numbers in registers, by twice as many of 3 and 4: for devices
 * whose work-items have registers for them. Device only. */
#ifndef PS_NUFFT_TRANSFORM_SQUARES_H
#define PS_NUFFT_TRANSFORM_SQUARES_H

#include "nufft/transform/butterfly.h"

/* x[k + R q] <- sum_j w^(j k) w_R^(j q) sum_i w_R^(i k) x[R i + j], w = exp(-2 pi i / R^2);
 * cosines and sines of w^m. */
#define SQUARE_BUTTERFLY(SQUARE, R)                                                                \
    static inline __attribute__((always_inline)) void square_of_##R(                               \
        complexv *x, const real *cosines, const real *sines) {                                     \
        complexv y[R][R];                                                                          \
        _Pragma("unroll") for (int j = 0; j < R; j++) {                                            \
            _Pragma("unroll") for (int i = 0; i < R; i++) {                                        \
                y[j][i] = x[R * i + j];                                                            \
            }                                                                                      \
            butterfly_##R(y[j]);                                                                   \
        }                                                                                          \
        _Pragma("unroll") for (int k = 0; k < R; k++) {                                            \
            complexv z[R];                                                                         \
            _Pragma("unroll") for (int j = 0; j < R; j++) {                                        \
                z[j] = j * k == 0 ? y[j][k]                                                        \
                                  : complex_multiply(y[j][k], cosines[j * k], sines[j * k]);       \
            }                                                                                      \
            butterfly_##R(z);                                                                      \
            _Pragma("unroll") for (int q = 0; q < R; q++) {                                        \
                x[k + R * q] = z[q];                                                               \
            }                                                                                      \
        }                                                                                          \
    }

SQUARE_BUTTERFLY(9, 3)
SQUARE_BUTTERFLY(16, 4)

static inline __attribute__((always_inline)) void butterfly_9(complexv *x) {
    const real c1 = (real)0.76604444311897803520, s1 = (real)-0.64278760968653932632;
    const real c2 = (real)0.17364817766693034885, s2 = (real)-0.98480775301220805937;
    const real c4 = (real)-0.93969262078590838405, s4 = (real)-0.34202014332566873304;
    const real cosines[5] = {1, c1, c2, 0, c4};
    const real sines[5] = {0, s1, s2, 0, s4};
    square_of_3(x, cosines, sines);
}

static inline __attribute__((always_inline)) void butterfly_16(complexv *x) {
    const real c1 = (real)0.92387953251128675613, s1 = (real)-0.38268343236508977173;
    const real r = (real)0.70710678118654752440;
    const real cosines[10] = {1, c1, r, -s1, 0, 0, -r, 0, 0, -c1};
    const real sines[10] = {0, s1, -r, -c1, -1, 0, -r, 0, 0, -s1};
    square_of_4(x, cosines, sines);
}

#endif
