/* Window values of a point on one axis (nufft/place.h says how they are laid out). Device only. */
#ifndef PS_NUFFT_WINDOW_H
#define PS_NUFFT_WINDOW_H

#include "nufft/cell.h"
#include "nufft/place.h"
#include "shared/real.h"

typedef PS_JOIN(REAL, 8) real8;
typedef PS_JOIN(REAL, 4) real4;

/* An axis of the fine grid, and its window: bin i is a polynomial in u = 2 f - 1, f as in nufft/cell.h.
 * coefficients [degree + 1][bins], lowest degree first; bins, a multiple of 8, is at least the width, pitch at
 * least 2 GAP + width. */
typedef struct window_axis {
    __global const real *coefficients;
    uint n, width, axis, degree, bins, pitch;
    ulong factor; /* the coordinate is factor * x[axis] mod 1 */
} window_axis;

static inline real centred(const ulong fraction) {
    const real two_to_minus_63 = (real)1.0842021724855044e-19;
    return (real)as_long(fraction ^ ((ulong)1 << 63)) * two_to_minus_63;
}

/* Bins bin .. bin + 7. */
static inline real8 window_bins(const window_axis axis, const real centre, const uint bin) {
    const real8 u = (real8)centre;
    real8 value = vload8(0, axis.coefficients + axis.degree * axis.bins + bin);
    for (uint i = axis.degree; i-- > 0;) {
        value = fma(value, u, vload8(0, axis.coefficients + i * axis.bins + bin));
    }
    return value;
}

static inline void make_window(const window_axis axis, const real centre, const real weight,
                               __local real *window) {
    vstore4((real4)0, 0, window);
    for (uint bin = 0; bin < axis.bins; bin += 8) {
        vstore8(window_bins(axis, centre, bin) * (real8)weight, 0, window + GAP + bin);
    }
    for (uint i = GAP + axis.bins; i < axis.pitch; i++) {
        window[i] = 0;
    }
}

/* One value. */
static inline real window_bin(const window_axis axis, const real centre, const uint bin) {
    real value = axis.coefficients[axis.degree * axis.bins + bin];
    for (uint i = axis.degree; i-- > 0;) {
        value = fma(value, centre, axis.coefficients[i * axis.bins + bin]);
    }
    return value;
}

#endif
