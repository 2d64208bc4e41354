/* Points of each realization in the order of the fine-grid cells where their windows begin: a counting
 * sort, stable, by one work-item for each realization. Launch: (realizations), rounded up at will.
 *
 *   points   [..][dimension] fixed point, realization r at offsets[r] .. offsets[r + 1]
 *   places   where the sorted points of realization r begin
 *   previous [place]: order that points of one cell keep, if has_previous (of an earlier sort)
 *   order    [place]: which point of the realization stands there; NO_POINT up to the next realization
 *   starts   [realization][n + 2]: cell m has the points starts[m] .. starts[m + 1] of the realization
 *   n, width, axis, factor  of the fine grid: the coordinate is factor * x[axis] mod 1
 */
#include "nufft/cell.h"
#include "nufft/place.h"

__kernel void nufft_sort(__global const ulong *restrict points,
                         __global const ulong *restrict offsets,
                         __global const ulong *restrict places,
                         __global const uint *restrict previous, const uint has_previous,
                         __global uint *restrict order, __global uint *restrict starts,
                         const ulong num_realizations, const uint dimension, const uint n,
                         const uint width, const uint axis, const ulong factor) {
    const size_t realization = get_global_id(0);
    if (realization >= num_realizations) {
        return;
    }
    __global const ulong *own = points + offsets[realization] * dimension + axis;
    __global uint *place = order + places[realization];
    __global uint *start = starts + realization * (n + 2);
    const uint count = (uint)(offsets[realization + 1] - offsets[realization]);
    ulong fraction;
    for (uint m = 0; m < n + 2; m++) {
        start[m] = 0;
    }
    for (uint j = 0; j < count; j++) { /* cell m is counted two places on, ... */
        start[first_cell(factor * own[(size_t)j * dimension], n, width, &fraction) + 2]++;
    }
    for (uint m = 2; m < n + 2; m++) { /* ... so that its beginning comes one place on ... */
        start[m] += start[m - 1];
    }
    __global const uint *before = previous + places[realization];
    for (uint i = 0; i < count; i++) { /* ... and has moved to its end, the next beginning, here */
        const uint j = has_previous ? before[i] : i;
        const uint m = first_cell(factor * own[(size_t)j * dimension], n, width, &fraction);
        place[start[m + 1]++] = j;
    }
    for (uint j = count; j < places[realization + 1] - places[realization]; j++) {
        place[j] = NO_POINT;
    }
}
