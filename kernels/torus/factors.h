/* The factors of products that work-groups make for themselves, by the operations of torus/list.cl.
 * Device only. */
#ifndef PS_TORUS_FACTORS_H
#define PS_TORUS_FACTORS_H

#include "shared/turn.h"
#include "torus/phase.h"

#ifdef __OPENCL_C_VERSION__

/* What they are made of: arguments of torus/list.cl. */
typedef struct factors {
    __global const ulong *points;
    __global const real *weights;
    __global const word *frequencies;
    size_t num_tiles;
} factors;

/* Cosines and sines of a tile at a point, over the axes of its side, which are constants in every
 * call; zeros of tiles from end_tile on. */
static inline void make_factors(const factors *from, const uint tile, const uint end_tile,
                                const ulong point, const int first_axis, const int last_axis,
                                const int is_weighted, realv *cosine, realv *sine) {
    const size_t there = min(tile, end_tile - 1);
    const realv weight = tile < end_tile ? (realv)from->weights[point] : (realv)0;
    const realv factor = is_weighted || tile >= end_tile ? weight : (realv)1;
    wordv k[DIMENSION];
    realv k_real[DIMENSION];
#pragma unroll
    for (int axis = 0; axis < DIMENSION; axis++) {
        k[axis] = LOADV(axis * from->num_tiles + there, from->frequencies);
        k_real[axis] = TO_REALV(AS_SWORDV(k[axis]));
    }
    turn_cosine_sine(
        phase_of_point(k, k_real, from->points + point * DIMENSION, first_axis, last_axis), cosine,
        sine);
    *cosine *= factor;
    *sine *= factor;
}

#endif

#endif
