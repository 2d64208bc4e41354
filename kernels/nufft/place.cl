/* What spreading needs of each place: first cell, window values, phases of the lanes. Launch: (places
 * of the largest realization, realizations), the first rounded up at will.
 *
 *   points, weights, offsets, places, order  as in nufft/sort.cl
 *   coefficients  [degree + 1][bins], bins a multiple of 8: bin i is a polynomial in u = 2 f - 1, f as in
 *                 nufft/cell.h, lowest degree first
 *   n, width, axis, factor, pitch  of the fine grid
 *   cells         [place]
 *   windows       [place][pitch], see nufft/place.h
 *   along         [place]: coordinate on axis 0
 *   phases        [place][re, im][LANES]: exp(-2 pi i lane x_0)
 */
#include "nufft/phase.h"
#include "nufft/place.h"
#include "nufft/window.h"

__constant word lane_numbers[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

static inline void make_phases(const ulong x, const size_t place, __global real *phases) {
    const wordv lanes = LOADV(0, lane_numbers);
    realv cosine, sine;
    turn_cosine_sine(phases_of_lanes(lanes, x), &cosine, &sine);
    STOREV(cosine, 2 * place, phases);
    STOREV(-sine, 2 * place + 1, phases);
}

__kernel void
nufft_place(__global const ulong *restrict points, __global const real *restrict weights,
            __global const ulong *restrict offsets, __global const ulong *restrict places,
            __global const uint *restrict order, __global const real *restrict coefficients,
            const uint dimension, const uint n, const uint width, const uint axis,
            const ulong factor, const uint degree, const uint bins, const uint pitch,
            __global uint *restrict cells, __global real *restrict windows,
            __global ulong *restrict along, __global real *restrict phases) {
    const size_t realization = get_global_id(1);
    const size_t place = places[realization] + get_global_id(0);
    if (place >= places[realization + 1]) {
        return;
    }
    const bool is_point = order[place] != NO_POINT;
    const size_t point = offsets[realization] + (is_point ? order[place] : 0);
    const real weight = is_point ? weights[point] : 0;
    __global const ulong *x = points + point * dimension;
    ulong fraction;
    const uint cell = first_cell(factor * x[axis], n, width, &fraction);
    cells[place] = is_point ? cell : n - 1; /* in order */
    make_window(coefficients, degree, bins, pitch, fraction, weight, windows + place * pitch);
    along[place] = x[0];
    make_phases(x[0], place, phases);
}

/* Cells and windows of another axis. */
__kernel void nufft_window(__global const ulong *restrict points,
                           __global const ulong *restrict offsets,
                           __global const ulong *restrict places,
                           __global const uint *restrict order,
                           __global const real *restrict coefficients, const uint dimension,
                           const uint n, const uint width, const uint axis, const ulong factor,
                           const uint degree, const uint bins, const uint pitch,
                           __global uint *restrict cells, __global real *restrict windows) {
    const size_t realization = get_global_id(1);
    const size_t place = places[realization] + get_global_id(0);
    if (place >= places[realization + 1]) {
        return;
    }
    const size_t point = offsets[realization] + (order[place] != NO_POINT ? order[place] : 0);
    ulong fraction;
    cells[place] = first_cell(factor * points[point * dimension + axis], n, width, &fraction);
    make_window(coefficients, degree, bins, pitch, fraction, 1, windows + place * pitch);
}
