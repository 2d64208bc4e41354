/* Window values of a point on one axis (nufft/place.h says how they are laid out). Device only. */
#ifndef PS_NUFFT_WINDOW_H
#define PS_NUFFT_WINDOW_H

#include "nufft/cell.h"
#include "nufft/place.h"
#include "shared/real.h"

typedef PS_JOIN(REAL, 8) real8;
typedef PS_JOIN(REAL, 4) real4;

static inline real centred(const ulong fraction) {
    const real two_to_minus_63 = (real)1.0842021724855044e-19;
    return (real)as_long(fraction ^ ((ulong)1 << 63)) * two_to_minus_63;
}

/* coefficients [degree + 1][bins] of polynomials in u = 2 f - 1, lowest degree first; bins, a multiple of
 * 8, is at least the width, pitch at least 2 GAP + width. */
static inline void make_window(__global const real *coefficients, const uint degree,
                               const uint bins, const uint pitch, const ulong fraction,
                               const real weight, __global real *window) {
    const real8 u = (real8)centred(fraction);
    vstore4((real4)0, 0, window);
    for (uint bin = 0; bin < bins; bin += 8) {
        real8 value = vload8(0, coefficients + degree * bins + bin);
        for (uint i = degree; i-- > 0;) {
            value = fma(value, u, vload8(0, coefficients + i * bins + bin));
        }
        vstore8(value * (real8)weight, 0, window + GAP + bin);
    }
    for (uint i = GAP + bins; i < pitch; i++) {
        window[i] = 0;
    }
}

#endif
