/* Points of each realization in the order of the fine-grid cells where their windows begin: a counting
 * sort, stable, by one work-item for each realization. Launch: (realizations), rounded up at will.
 *
 *   points, weights  [..][dimension] fixed point, realization r at offsets[r] .. offsets[r + 1]
 *   places           where the sorted points of realization r begin
 *   sorted, heights  [place][dimension], [place]: coordinates and weights; up to the next realization the
 *                    last point again, without weight
 *   starts           [realization][n second_n + 2]: cell m has the points starts[m] .. starts[m + 1] of it
 *   n, width, axis, factor  of the fine grid: the coordinate is factor * x[axis] mod 1
 *   second_*         of another axis, for cells m = cell * second_n + second cell; second_n 1: none
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

typedef struct sorting_keys {
    uint n, width, axis, second_n, second_width, second_axis;
    ulong factor;
} sorting_keys;

static inline uint sorting_key(const sorting_keys keys, __global const ulong *x) {
    ulong fraction;
    const uint cell = first_cell(keys.factor * x[keys.axis], keys.n, keys.width, &fraction);
    return keys.second_n == 1
               ? cell
               : cell * keys.second_n +
                     first_cell(x[keys.second_axis], keys.second_n, keys.second_width, &fraction);
}

__kernel void nufft_sort(__global const ulong *restrict points,
                         __global const real *restrict weights,
                         __global const ulong *restrict offsets,
                         __global const ulong *restrict places, __global ulong *restrict sorted,
                         __global real *restrict heights, __global uint *restrict starts,
                         const ulong num_realizations, const uint dimension, const uint n,
                         const uint width, const uint axis, const ulong factor, const uint second_n,
                         const uint second_width, const uint second_axis) {
    const size_t realization = get_global_id(0);
    if (realization >= num_realizations) {
        return;
    }
    const uint num_keys = n * second_n;
    const size_t first = offsets[realization];
    const uint count = (uint)(offsets[realization + 1] - first);
    __global const ulong *own = points + first * dimension;
    __global ulong *out = sorted + places[realization] * dimension;
    __global real *height = heights + places[realization];
    __global uint *start = starts + realization * ((size_t)num_keys + 2);
    const sorting_keys keys = {n, width, axis, second_n, second_width, second_axis, factor};
    for (uint m = 0; m < num_keys + 2; m++) {
        start[m] = 0;
    }
    for (uint j = 0; j < count; j++) { /* cell m is counted two places on, ... */
        start[sorting_key(keys, own + (size_t)j * dimension) + 2]++;
    }
    for (uint m = 2; m < num_keys + 2; m++) { /* ... so that its beginning comes one place on ... */
        start[m] += start[m - 1];
    }
    for (uint j = 0; j < count; j++) { /* ... and has moved to its end, the next beginning, here */
        __global const ulong *x = own + (size_t)j * dimension;
        const uint m = sorting_key(keys, x);
        const size_t place = start[m + 1]++;
        copy_point(out + place * dimension, x, dimension);
        height[place] = weights[first + j];
    }
    for (size_t place = count; place < places[realization + 1] - places[realization]; place++) {
        copy_point(out + place * dimension, out + (count - 1) * (size_t)dimension, dimension);
        height[place] = 0;
    }
}
