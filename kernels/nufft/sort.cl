/* Points of each realization in the order of the fine-grid cells, or with BOXES of the boxes of
 * cells (nufft/boxes.h), where their windows begin: a counting sort, stable, by one work-item for
 * each realization, as CPUs want it. Launch: (realizations), rounded up at will. DIMENSION is a
 * constant: loops over axes would cost as much as all the rest.
 *
 *   numbers          sort_numbers of nufft/numbers.h
 *   points, weights  [..][DIMENSION] fixed point, realization r at offsets[r] .. offsets[r + 1]
 *   places           where the sorted points of realization r begin
 *   sorted, heights  [place][DIMENSION], [place]: coordinates and weights; up to the next realization the
 *                    last point again, without weight
 *   starts           [realization][num_keys + 2]: cell or box m has the points starts[m] .. starts[m + 1] of it;
 *                    two axes make cells m = cell * n + second cell
 *
 * GPUs have the keys alone of here, and nufft/order.cl for the rest.
 */
#ifndef DIMENSION
#define DIMENSION 2
#endif
#ifndef BOXES
#define BOXES 0
#endif

#include "nufft/cells.h"
#include "nufft/numbers.h"
#include "nufft/place.h"

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

#if BOXES
/* The boxes where windows begin. */
static inline uintv keys_of(const sort_numbers numbers, __global const ulong *points,
                            const uint num) {
    uintv key = 0;
#pragma unroll
    for (uint axis = 0; axis < DIMENSION; axis++) {
        const sort_axis own = numbers.axes[axis];
        wordv fraction;
        const uintv cells = first_cells(load_some_coordinates(points, DIMENSION, axis, num), own.n,
                                        own.width, &fraction);
        const ulongv boxes = TO_ULONGV(cells) * (ulongv)own.per_cell >> (ulongv)32; /* box_of */
        key = key * (uintv)own.keys + TO_UINTV(boxes);
    }
    return key;
}
#else
/* The cells where windows begin. */
static inline uintv keys_of(const sort_numbers numbers, __global const ulong *points,
                            const uint num) {
    const sort_axis first = numbers.axes[0], second = numbers.axes[1];
    wordv fraction;
    const ulongv x = load_some_coordinates(points, DIMENSION, first.axis, num);
    uintv cell = first_cells((ulongv)numbers.factor * x, first.n, first.width, &fraction);
    if (second.keys != 1) {
        const ulongv y = load_some_coordinates(points, DIMENSION, second.axis, num);
        cell = cell * (uintv)second.n + first_cells(y, second.n, second.width, &fraction);
    }
    return cell;
}
#endif

/* Makes the keys of points j .. j + LANES - 1 and returns how many of them there are. Inlined, its
 * constants stay in registers. */
__attribute__((always_inline)) static inline uint
make_keys(key_list *to, const sort_numbers numbers, const point_list from, const uint j) {
    const uint rest = from.count - j;
    to->together = keys_of(numbers, from.points + (size_t)j * DIMENSION, rest);
    return min((uint)LANES, rest);
}

static inline void copy_point(__global ulong *to, __global const ulong *from) {
#pragma unroll
    for (uint axis = 0; axis < DIMENSION; axis++) {
        to[axis] = from[axis];
    }
}

static inline void sort_points(const sorted_list to, const point_list from,
                               const sort_numbers numbers) {
    const uint num_keys = numbers.num_keys;
    key_list next;
    for (uint m = 0; m < num_keys + 2; m++) {
        to.start[m] = 0;
    }
    for (uint j = 0; j < from.count; j += LANES) { /* cell m is counted two places on, ... */
        const uint num = make_keys(&next, numbers, from, j);
        for (uint i = 0; i < num; i++) {
            to.start[next.key[i] + 2]++;
        }
    }
    for (uint m = 2; m < num_keys + 2; m++) { /* ... so that its beginning comes one place on ... */
        to.start[m] += to.start[m - 1];
    }
    for (uint j = 0; j < from.count; j += LANES) { /* ... and has moved to its end, the next */
        const uint num = make_keys(&next, numbers, from, j); /* beginning, here */
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
    const uint has_weights = numbers.has_weights;
    const size_t realization = get_global_id(0);
    if (realization >= numbers.num_realizations) {
        return;
    }
    const size_t first = offsets[realization];
    const uint count = (uint)(offsets[realization + 1] - first);
    const point_list from = {points + first * DIMENSION, weights + first, has_weights, count};
    const sorted_list to = {sorted + places[realization] * DIMENSION, heights + places[realization],
                            starts + realization * ((size_t)numbers.num_keys + 2)};
    sort_points(to, from, numbers);
    for (uint place = 0; !has_weights && place < count; place++) {
        to.heights[place] = 1;
    }
    for (size_t place = count; place < places[realization + 1] - places[realization]; place++) {
        copy_point(to.points + place * DIMENSION, to.points + (count - 1) * (size_t)DIMENSION);
        to.heights[place] = 0;
    }
}

/* Launch: (points / LANES), rounded up at will. keys: [num_points] */
__kernel void nufft_keys(const sort_numbers numbers, const ulong num_points,
                         __global const ulong *restrict points, __global uint *restrict keys) {
    const size_t first = get_global_id(0) * (size_t)LANES;
    if (first >= num_points) {
        return;
    }
    const uint num = (uint)min((size_t)LANES, (size_t)num_points - first);
    key_list own;
    own.together = keys_of(numbers, points + first * DIMENSION, num);
    for (uint i = 0; i < num; i++) {
        keys[first + i] = own.key[i];
    }
}
