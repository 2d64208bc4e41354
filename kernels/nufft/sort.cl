/* Points of each realization in the order of the fine-grid cells where their windows begin: a counting
 * sort, stable, by one work-item for each realization. Launch: (realizations), rounded up at will.
 *
 *   points, weights  [..][dimension] fixed point, realization r at offsets[r] .. offsets[r + 1]
 *   places           where the sorted points of realization r begin
 *   sorted, heights  [place][dimension], [place]: coordinates and weights; up to the next realization the
 *                    last point again, without weight
 *   starts           [realization][n + 2]: cell m has the points starts[m] .. starts[m + 1] of the realization
 *   n, width, axis, factor  of the fine grid: the coordinate is factor * x[axis] mod 1
 */
#include "nufft/cell.h"
#include "nufft/place.h"
#include "shared/real.h"

/* One to three coordinates, without a loop: its branches cost as much as all the rest. */
static inline void copy_point(__global ulong *to, __global const ulong *from,
                              const uint dimension) {
    const ulong first = from[0], second = from[dimension / 2], last = from[dimension - 1];
    to[0] = first;
    to[dimension / 2] = second;
    to[dimension - 1] = last;
}

__kernel void nufft_sort(__global const ulong *restrict points,
                         __global const real *restrict weights,
                         __global const ulong *restrict offsets,
                         __global const ulong *restrict places, __global ulong *restrict sorted,
                         __global real *restrict heights, __global uint *restrict starts,
                         const ulong num_realizations, const uint dimension, const uint n,
                         const uint width, const uint axis, const ulong factor) {
    const size_t realization = get_global_id(0);
    if (realization >= num_realizations) {
        return;
    }
    const size_t first = offsets[realization];
    const uint count = (uint)(offsets[realization + 1] - first);
    __global const ulong *own = points + first * dimension;
    __global ulong *out = sorted + places[realization] * dimension;
    __global real *height = heights + places[realization];
    __global uint *start = starts + realization * (n + 2);
    ulong fraction;
    for (uint m = 0; m < n + 2; m++) {
        start[m] = 0;
    }
    for (uint j = 0; j < count; j++) { /* cell m is counted two places on, ... */
        start[first_cell(factor * own[(size_t)j * dimension + axis], n, width, &fraction) + 2]++;
    }
    for (uint m = 2; m < n + 2; m++) { /* ... so that its beginning comes one place on ... */
        start[m] += start[m - 1];
    }
    for (uint j = 0; j < count; j++) { /* ... and has moved to its end, the next beginning, here */
        __global const ulong *x = own + (size_t)j * dimension;
        const uint m = first_cell(factor * x[axis], n, width, &fraction);
        const size_t place = start[m + 1]++;
        copy_point(out + place * dimension, x, dimension);
        height[place] = weights[first + j];
    }
    for (size_t place = count; place < places[realization + 1] - places[realization]; place++) {
        copy_point(out + place * dimension, out + (count - 1) * (size_t)dimension, dimension);
        height[place] = 0;
    }
}
