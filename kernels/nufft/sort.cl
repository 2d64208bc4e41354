/* Points of each realization in the order of the fine-grid cells where their windows begin: a
 * counting sort, stable, by one work-item for each realization. Launch: (realizations), rounded up
 * at will. DIMENSION is a constant: loops over axes would cost as much as all the rest.
 *
 *   numbers          sort_numbers of nufft/numbers.h
 *   points, weights  [..][DIMENSION] fixed point, realization r at offsets[r] .. offsets[r + 1]
 *   places           where the sorted points of realization r begin
 *   sorted, heights  [place][DIMENSION], [place]: coordinates and weights; up to the next realization the
 *                    last point again, without weight
 *   starts           [realization][n second_n + 2]: cell m has the points starts[m] .. starts[m + 1] of it
 */
#ifndef DIMENSION
#define DIMENSION 2
#endif

#include "nufft/cells.h"
#include "nufft/numbers.h"
#include "nufft/place.h"

typedef struct sorting_keys {
    uint n, width, axis, second_n, second_width, second_axis;
    ulong factor;
} sorting_keys;

typedef struct point_list {
    __global const ulong *points;
    __global const real *weights;
    uint has_weights, count;
} point_list;

typedef struct sorted_list {
    __global ulong *points;
    __global real *heights;
    __global uint *start;
} sorted_list;

typedef union key_list {
    uintv together;
    uint key[LANES];
} key_list;

/* Makes the keys of points j .. j + LANES - 1 and returns how many of them there are. Inlined, its
 * constants stay in registers. */
__attribute__((always_inline)) static inline uint make_keys(key_list *to, const sorting_keys keys,
                                                            const point_list from, const uint j) {
    __global const ulong *points = from.points + (size_t)j * DIMENSION;
    const uint rest = from.count - j;
    wordv fraction;
    const ulongv x = load_some_coordinates(points, DIMENSION, keys.axis, rest);
    uintv cell = first_cells((ulongv)keys.factor * x, keys.n, keys.width, &fraction);
    if (keys.second_n != 1) {
        const ulongv second = load_some_coordinates(points, DIMENSION, keys.second_axis, rest);
        cell = cell * (uintv)keys.second_n +
               first_cells(second, keys.second_n, keys.second_width, &fraction);
    }
    to->together = cell;
    return min((uint)LANES, rest);
}

static inline void copy_point(__global ulong *to, __global const ulong *from) {
#pragma unroll
    for (uint axis = 0; axis < DIMENSION; axis++) {
        to[axis] = from[axis];
    }
}

static inline void sort_points(const sorted_list to, const point_list from,
                               const sorting_keys keys) {
    const uint num_keys = keys.n * keys.second_n;
    key_list next;
    for (uint m = 0; m < num_keys + 2; m++) {
        to.start[m] = 0;
    }
    for (uint j = 0; j < from.count; j += LANES) { /* cell m is counted two places on, ... */
        const uint num = make_keys(&next, keys, from, j);
        for (uint i = 0; i < num; i++) {
            to.start[next.key[i] + 2]++;
        }
    }
    for (uint m = 2; m < num_keys + 2; m++) { /* ... so that its beginning comes one place on ... */
        to.start[m] += to.start[m - 1];
    }
    for (uint j = 0; j < from.count; j += LANES) { /* ... and has moved to its end, the next */
        const uint num = make_keys(&next, keys, from, j); /* beginning, here */
        for (uint i = 0; i < num; i++) {
            const size_t place = to.start[next.key[i] + 1]++;
            copy_point(to.points + place * DIMENSION, from.points + (size_t)(j + i) * DIMENSION);
            if (from.has_weights) {
                to.heights[place] = from.weights[j + i];
            }
        }
    }
}

__kernel void nufft_sort(const sort_numbers numbers, __global const ulong *restrict points,
                         __global const real *restrict weights,
                         __global const ulong *restrict offsets,
                         __global const ulong *restrict places, __global ulong *restrict sorted,
                         __global real *restrict heights, __global uint *restrict starts) {
    const uint n = numbers.n, second_n = numbers.second_n, has_weights = numbers.has_weights;
    const size_t realization = get_global_id(0);
    if (realization >= numbers.num_realizations) {
        return;
    }
    const size_t first = offsets[realization];
    const uint count = (uint)(offsets[realization + 1] - first);
    const sorting_keys keys = {n,
                               numbers.width,
                               numbers.axis,
                               second_n,
                               numbers.second_width,
                               numbers.second_axis,
                               numbers.factor};
    const point_list from = {points + first * DIMENSION, weights + first, has_weights, count};
    const sorted_list to = {sorted + places[realization] * DIMENSION, heights + places[realization],
                            starts + realization * ((size_t)n * second_n + 2)};
    sort_points(to, from, keys);
    for (uint place = 0; !has_weights && place < count; place++) {
        to.heights[place] = 1;
    }
    for (size_t place = count; place < places[realization + 1] - places[realization]; place++) {
        copy_point(to.points + place * DIMENSION, to.points + (count - 1) * (size_t)DIMENSION);
        to.heights[place] = 0;
    }
}
