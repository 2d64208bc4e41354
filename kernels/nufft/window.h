/* Window values of a point on one axis (nufft/place.h says how they are laid out). Device only. */
#ifndef PS_NUFFT_WINDOW_H
#define PS_NUFFT_WINDOW_H

#include "shared/lanes.h"
#include "nufft/place.h"

typedef PS_JOIN(REAL, 8) real8;
typedef real8 unaligned_real8 __attribute__((aligned(sizeof(real)))); /* shared/lanes.h says why */

/* An axis of the fine grid, and its window: bin i is a polynomial in u = 2 f - 1, f as in nufft/cells.h.
 * coefficients [degree + 1][bins], lowest degree first; bins, a multiple of 8, is at least the width, pitch at
 * least 2 GAP + width. */
typedef struct window_axis {
    __global const real *coefficients;
    uint n, width, axis, degree, bins, pitch;
    ulong factor; /* the coordinate is factor * x[axis] mod 1 */
} window_axis;

/* Bins bin .. bin + 3 of LANES points: to[bin - first][apart]. */
static inline void make_four_bins(const window_axis axis, const uint bin, const realv centre,
                                  const realv weight, __local real *to, const uint apart) {
    __global const real *from = axis.coefficients + axis.degree * axis.bins + bin;
    realv a = (realv)from[0], b = (realv)from[1], c = (realv)from[2], d = (realv)from[3];
    for (uint i = 0; i < axis.degree; i++) {
        from -= axis.bins;
        a = fma(a, centre, (realv)from[0]);
        b = fma(b, centre, (realv)from[1]);
        c = fma(c, centre, (realv)from[2]);
        d = fma(d, centre, (realv)from[3]);
    }
    store_local(to, 0, a * weight);
    store_local(to + apart, 0, b * weight);
    store_local(to + 2 * apart, 0, c * weight);
    store_local(to + 3 * apart, 0, d * weight);
}

/* One bin of LANES points. */
static inline realv window_bin_of_points(const window_axis axis, const realv centre,
                                         const uint bin) {
    realv value = (realv)axis.coefficients[axis.degree * axis.bins + bin];
    for (uint i = axis.degree; i-- > 0;) {
        value = fma(value, centre, (realv)axis.coefficients[i * axis.bins + bin]);
    }
    return value;
}

#endif
