/* Points of a realization on the device, for kernels that go through its pairs;
 * host/engines/pairs/pairs_state.h has the same numbers.
 *
 * Pairs are (i, i + k mod N) for k = 1 .. N / 2, all i: every pair once, but for k = N / 2 with N
 * even, where each comes twice and counts half. Lanes are consecutive i, so both points of LANES
 * pairs are consecutive numbers of the same arrays, which go on behind N with the first points
 * again.
 *
 *   points  [realization][POINT_ARRAYS][stride]: the unit vector in two parts (high, low), weights that go on like the
 *           points, and weights that are 0 from N on
 */
#ifndef PS_PAIRS_LAYOUT_H
#define PS_PAIRS_LAYOUT_H

#include "shared/lanes.h"

#define ARRAY_HIGH 0
#define ARRAY_LOW 3
#define ARRAY_WEIGHT 6
#define ARRAY_OWN_WEIGHT 7
#define POINT_ARRAYS 8

#ifdef __OPENCL_C_VERSION__

#define PAIRS_INLINE static inline __attribute__((always_inline))

/* Where a walk through the vectors of pairs of a realization is. */
typedef struct pair_place {
    __global const real *points;
    ulong stride, num_points;
    ulong vectors; /* of lanes in a round of all i */
    ulong vector, distance;
} pair_place;

PAIRS_INLINE ulong pair_vectors(const ulong num_points) {
    return num_points / 2 * ((num_points + LANES - 1) / LANES);
}

/* By a pointer: Oclgrind's compiler marks the place of a returned struct with a call that Oclgrind
 * does not know. */
PAIRS_INLINE void pair_begin(pair_place *at, __global const real *points, const ulong stride,
                             const ulong num_points, const ulong index) {
    at->points = points;
    at->stride = stride;
    at->num_points = num_points;
    at->vectors = (num_points + LANES - 1) / LANES;
    at->distance = 1 + index / at->vectors;
    at->vector = index % at->vectors;
}

PAIRS_INLINE void pair_next(pair_place *at) {
    at->vector++;
    at->distance += at->vector == at->vectors;
    at->vector = at->vector == at->vectors ? 0 : at->vector;
}

PAIRS_INLINE realv first_of_pair(const pair_place *at, const int array) {
    return load_global(at->points + array * at->stride, at->vector);
}

PAIRS_INLINE realv second_of_pair(const pair_place *at, const int array) {
    return load_global(at->points + array * at->stride + at->distance, at->vector);
}

/* w_i w_j; 0 where there is no pair. */
PAIRS_INLINE realv weight_of_pair(const pair_place *at) {
    const real share = 2 * at->distance == at->num_points ? (real)0.5 : (real)1;
    return first_of_pair(at, ARRAY_OWN_WEIGHT) * second_of_pair(at, ARRAY_WEIGHT) * share;
}

PAIRS_INLINE realv difference_of_pair(const pair_place *at, const realv side, const int axis) {
    return fma(-side, second_of_pair(at, ARRAY_HIGH + axis), first_of_pair(at, ARRAY_HIGH + axis)) +
           fma(-side, second_of_pair(at, ARRAY_LOW + axis), first_of_pair(at, ARRAY_LOW + axis));
}

/* |u - v|^2 from differences of coordinates, which lose nothing where points are close. Written
 * out, here and below: loops over axes stay loops. */
PAIRS_INLINE realv square_of_pair(const pair_place *at, const realv side) {
    const realv x = difference_of_pair(at, side, 0);
    const realv y = difference_of_pair(at, side, 1);
    const realv z = difference_of_pair(at, side, 2);
    return fma(z, z, fma(y, y, x * x));
}

/* -1 where u.v < 0: the pair is then taken as (u, -v), since P_l(-x) = (-1)^l P_l(x). */
PAIRS_INLINE realv side_of_pair(const pair_place *at) {
    const realv x = first_of_pair(at, ARRAY_HIGH) * second_of_pair(at, ARRAY_HIGH);
    const realv y = fma(first_of_pair(at, ARRAY_HIGH + 1), second_of_pair(at, ARRAY_HIGH + 1), x);
    const realv z = fma(first_of_pair(at, ARRAY_HIGH + 2), second_of_pair(at, ARRAY_HIGH + 2), y);
    return z < (realv)0 ? (realv)-1 : (realv)1;
}

#endif

#endif
