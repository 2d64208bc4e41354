/* Window values of a point on one axis (nufft/place.h says how they are laid out). Device only. */
#ifndef PS_NUFFT_WINDOW_H
#define PS_NUFFT_WINDOW_H

#include "shared/lanes.h"
#include "nufft/numbers.h"
#include "nufft/place.h"

typedef PS_JOIN(REAL, 8) real8;
typedef real8 unaligned_real8 __attribute__((aligned(sizeof(real)))); /* shared/lanes.h says why */

/* An axis of the fine grid, and its window: bin i is a polynomial in u = 2 f - 1, f as in
 * nufft/cells.h. coefficients [degree + 1][bins], lowest degree first; bins, a multiple of 8, is at
 * least the width, pitch at least 2 GAP + width. The degree is odd; bin i is bin width - 1 - i at
 * -u, to the bit. */
typedef struct window_axis {
    __global const real *coefficients;
    uint n, width, axis, degree, bins, pitch;
    ulong factor; /* the coordinate is factor * x[axis] mod 1 */
} window_axis;

static inline window_axis make_window(__global const real *coefficients, const axis_numbers axis) {
    const window_numbers window = axis.window;
    return (window_axis){coefficients,  window.n,    window.width, axis.axis,
                         window.degree, window.bins, axis.pitch,   axis.factor};
}

/* For chunks (nufft/chunk.h), which have no gaps, of coordinates as they are. */
static inline window_axis make_chunk_window(__global const real *coefficients,
                                            const window_numbers window, const uint axis) {
    return (window_axis){
        coefficients, window.n, window.width, axis, window.degree, window.bins, 0, 1};
}

/* Pairs pair and pair + 1 of bins of LANES points, bins pair and width - 1 - pair, to[bin * apart].
 * Bins of a pair are each other's mirror: one polynomial in u^2 and u times another, added and
 * subtracted. Beyond the middle pairs repeat, to the bit. */
static inline void make_two_pairs(const window_axis axis, const uint pair, const realv centre,
                                  const realv weight, __local real *to, const uint apart) {
    const realv square = centre * centre, weighted = centre * weight;
    __global const real *from = axis.coefficients + axis.degree * axis.bins + pair;
    realv odd = (realv)from[0], next_odd = (realv)from[1];
    from -= axis.bins;
    realv even = (realv)from[0], next_even = (realv)from[1];
    for (uint i = 0; i < axis.degree / 2; i++) {
        from -= axis.bins;
        odd = fma(odd, square, (realv)from[0]);
        next_odd = fma(next_odd, square, (realv)from[1]);
        from -= axis.bins;
        even = fma(even, square, (realv)from[0]);
        next_even = fma(next_even, square, (realv)from[1]);
    }
    even *= weight;
    next_even *= weight;
    store_local(to + pair * apart, 0, fma(odd, weighted, even));
    store_local(to + (axis.width - 1 - pair) * apart, 0, fma(-odd, weighted, even));
    store_local(to + (pair + 1) * apart, 0, fma(next_odd, weighted, next_even));
    store_local(to + (axis.width - 2 - pair) * apart, 0, fma(-next_odd, weighted, next_even));
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
