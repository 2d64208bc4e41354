/* Tiles of pairs of points of the plane's torus, for step blue noise
 * (docs/samplers/forces.md#step).
 *
 * Points come in blocks; a tile is all pairs of two blocks, once. Everything is double precision in
 * vectors of eight, whatever the device: sums are of the same numbers in the same order, and
 * devices differ in nothing that is used here: sums, products, fma, sqrt, whole numbers.
 */
#ifndef PS_SAMPLERS_STEP_H
#define PS_SAMPLERS_STEP_H

#include "shared/fixed.h"

/* Numbers of a vector. Coordinates have room for a whole vector at the end of the last block. */
#define STEP_LANES 8

/* Bins of distances from 0 to 1/2; one more is for all others. */
typedef struct step_layout {
    ps_u32 num_points, stride; /* stride: between the coordinates of axes */
    ps_u32 block, num_blocks;  /* points of a block, a multiple of STEP_LANES */
    ps_u32 num_bins;
    ps_u32 first,
        num_firsts; /* points of the first block of every tile: a launch has some of all */
} step_layout;
SAME_SIZE(step_layout, 28);

#ifdef __OPENCL_C_VERSION__

#pragma OPENCL FP_CONTRACT OFF
#pragma OPENCL EXTENSION cl_khr_fp64 : enable

#define STEP_INLINE static inline __attribute__((always_inline))

/* Buffers are aligned as numbers, not always as vectors. */
typedef double8 unaligned_double8 __attribute__((aligned(sizeof(double))));

STEP_INLINE double8 step_load(__global const double *from) {
    return *(__global const unaligned_double8 *)from;
}

STEP_INLINE void step_store(__global double *to, const double8 x) {
    *(__global unaligned_double8 *)to = x;
}

/* Differences of coordinates to the nearest image: what is added leaves no place for a fraction. */
STEP_INLINE double8 step_wrap(const double8 d) {
    const double8 whole = (double8)6755399441055744.0; /* 1.5 2^52 */
    return d - ((d + whole) - whole);
}

/* Bins of eight pairs whose points are so far apart. */
STEP_INLINE int8 step_bins(const step_layout *layout, const double8 dx, const double8 dy) {
    const double8 r = sqrt(fma(dy, dy, dx * dx));
    const double8 place = r * (double8)(2.0 * layout->num_bins);
    return convert_int8(min(place, (double8)layout->num_bins));
}

/* The last bin for those that are not pairs of points from `first` on. */
STEP_INLINE int8 step_keep(const step_layout *layout, const int8 bin, const uint j,
                           const uint first) {
    const int8 other = (int8)((int)j) + (int8)(0, 1, 2, 3, 4, 5, 6, 7);
    const int8 is_pair = (other < (int8)((int)layout->num_points)) & (other >= (int8)((int)first));
    return is_pair ? bin : (int8)((int)layout->num_bins);
}

/* The point behind the last of a block. */
STEP_INLINE uint step_block_end(const step_layout *layout, const uint block) {
    return min((block + 1) * layout->block, layout->num_points);
}

/* Points of a block that the launch has as the first of a pair. */
STEP_INLINE uint step_first(const step_layout *layout, const uint block) {
    return block * layout->block + layout->first;
}

STEP_INLINE uint step_first_end(const step_layout *layout, const uint block) {
    return min(step_first(layout, block) + layout->num_firsts, step_block_end(layout, block));
}

#endif

#endif
