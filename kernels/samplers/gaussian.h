/* Gaussians of the distances of a point from all others of the torus, and the force that they have
 * on it: Gaussian blue noise (docs/samplers/forces.md#gaussian-blue-noise), for OpenCL C and C11
 * with the same bits on both sides.
 *
 * Points stand by cells, x[axis][point], axes `stride` numbers apart. There are `cells` cells along
 * each axis, those along the first axis next to each other, and cell i has the points begins[i] to
 * begins[i + 1] - 1. Whatever is within reach of a point is taken, every periodic image by itself;
 * of cells at the rim some points beyond, too.
 *
 * Sums are made in four lanes, point by point of each run of cells, on any device: that is what
 * their bits depend on. Nothing is fused, since plain x86-64 has no instruction for it; kernels are
 * compiled with contraction off.
 */
#ifndef PS_SAMPLERS_GAUSSIAN_H
#define PS_SAMPLERS_GAUSSIAN_H

#include "shared/fixed.h"
#include "shared/real.h"

#undef SERIES_STEP
#define SERIES_STEP(sum, x, next) ((sum) * (x) + (next))
#include "shared/two_to.h"

#define GAUSSIAN_LANES 4
#define GAUSSIAN_AXES 3
#define GAUSSIAN_SUMS (1 + GAUSSIAN_AXES) /* of Gaussians; of these times differences */

#ifdef __OPENCL_C_VERSION__
#define GAUSSIAN_GLOBAL __global
#else
#define GAUSSIAN_GLOBAL
#endif

typedef struct gaussian_grid {
    real reach;    /* distance beyond which a term is nothing */
    real exponent; /* of 2, of a Gaussian at the distance 1: negative */
    ps_u64 num_points, stride;
    ps_u32 dimension, cells; /* 2 or 3 */
} gaussian_grid;

#if PRECISION == 64
SAME_SIZE(gaussian_grid, 40);
#endif

/* Sums of the lanes, and the point that they are of. */
typedef struct gaussian_lanes {
    real at[GAUSSIAN_AXES];
#ifdef __OPENCL_C_VERSION__
    realv sums[GAUSSIAN_SUMS];
#else
    real sums[GAUSSIAN_SUMS][GAUSSIAN_LANES];
#endif
} gaussian_lanes;

#ifdef __OPENCL_C_VERSION__

/* Points begin to end - 1, the image of the point being at self->at. Arrays have room for a vector
 * behind the last point. Loops over axes are unrolled: what they index would be in memory. */
TWO_TO_INLINE void gaussian_run(const gaussian_grid *grid, const uint dimension,
                                __global const real *x, const uint begin, const uint end,
                                gaussian_lanes *self) {
    realv sums[GAUSSIAN_SUMS];
#pragma unroll
    for (uint k = 0; k < GAUSSIAN_SUMS; k++) {
        sums[k] = self->sums[k];
    }
    for (uint j = begin; j < end; j += GAUSSIAN_LANES) {
        realv away[GAUSSIAN_AXES];
        realv square = (realv)0;
#pragma unroll
        for (uint axis = 0; axis < GAUSSIAN_AXES; axis++) {
            if (axis < dimension) {
                away[axis] = (realv)self->at[axis] - vload4(0, x + axis * grid->stride + j);
                square += away[axis] * away[axis];
            }
        }
        const realv term = two_to_normal(square * (realv)grid->exponent);
        const swordv lane = (swordv)(0, 1, 2, 3);
        const realv mine = lane < (swordv)(end - j) ? term : (realv)0;
        sums[0] += mine;
#pragma unroll
        for (uint axis = 0; axis < GAUSSIAN_AXES; axis++) {
            if (axis < dimension) {
                sums[1 + axis] += away[axis] * mine;
            }
        }
    }
#pragma unroll
    for (uint k = 0; k < GAUSSIAN_SUMS; k++) {
        self->sums[k] = sums[k];
    }
}

#else

/* One vector of points of which `num` count: the loops have a fixed length where it is four, which
 * is what compilers make vectors of. */
TWO_TO_INLINE void gaussian_vector(const gaussian_grid *grid, unsigned dimension, const real *x,
                                   size_t num, gaussian_lanes *self) {
    real away[GAUSSIAN_AXES][GAUSSIAN_LANES];
    real square[GAUSSIAN_LANES] = {0};
    real term[GAUSSIAN_LANES];
    for (unsigned axis = 0; axis < dimension; axis++) {
        for (size_t lane = 0; lane < num; lane++) {
            away[axis][lane] = self->at[axis] - x[axis * grid->stride + lane];
            square[lane] += away[axis][lane] * away[axis][lane];
        }
    }
    for (size_t lane = 0; lane < num; lane++) {
        term[lane] = two_to_normal(square[lane] * grid->exponent);
    }
    for (size_t lane = 0; lane < num; lane++) {
        self->sums[0][lane] += term[lane];
    }
    for (unsigned axis = 0; axis < dimension; axis++) {
        for (size_t lane = 0; lane < num; lane++) {
            self->sums[1 + axis][lane] += away[axis][lane] * term[lane];
        }
    }
}

TWO_TO_INLINE void gaussian_run(const gaussian_grid *grid, unsigned dimension, const real *x,
                                ps_u32 begin, ps_u32 end, gaussian_lanes *self) {
    ps_u32 j = begin;
    for (; j + GAUSSIAN_LANES <= end; j += GAUSSIAN_LANES) {
        gaussian_vector(grid, dimension, x + j, GAUSSIAN_LANES, self);
    }
    if (j < end) {
        gaussian_vector(grid, dimension, x + j, end - j, self);
    }
}

#endif

TWO_TO_INLINE void gaussian_clear(gaussian_lanes *self) {
    for (unsigned k = 0; k < GAUSSIAN_SUMS; k++) {
#ifdef __OPENCL_C_VERSION__
        self->sums[k] = (realv)0;
#else
        for (unsigned lane = 0; lane < GAUSSIAN_LANES; lane++) {
            self->sums[k][lane] = 0;
        }
#endif
    }
}

/* The period that an unwrapped cell is in: 0 those of the unit square. */
TWO_TO_INLINE int gaussian_period(int cell, int cells) {
    return cell >= 0 ? cell / cells : -((cells - 1 - cell) / cells);
}

/* How far the unwrapped cell is from a place on its axis; 0: the place is in it. */
TWO_TO_INLINE real gaussian_gap(real x, int cell, int cells) {
    const real before = (real)cell / (real)cells - x;
    const real behind = x - (real)(cell + 1) / (real)cells;
    const real gap = before > behind ? before : behind;
    return gap > 0 ? gap : 0;
}

/* All cells of a row that come as near to the point as `within`: run by run, a period at a time.
 * row: number of the first cell; x: of the point, along the row. */
TWO_TO_INLINE void gaussian_row(const gaussian_grid *grid, unsigned dimension,
                                GAUSSIAN_GLOBAL const real *points,
                                GAUSSIAN_GLOBAL const ps_u32 *begins, ps_u32 row, real x,
                                real within, gaussian_lanes *self) {
    const int cells = (int)grid->cells;
    const int last = (int)floor((x + within) * (real)cells);
    for (int cell = (int)floor((x - within) * (real)cells); cell <= last;) {
        const int period = gaussian_period(cell, cells);
        const int origin = period * cells;
        const int stop = last < origin + cells ? last + 1 : origin + cells;
        const ps_u32 first_cell = row + (ps_u32)(cell - origin);
        const ps_u32 end_cell = row + (ps_u32)(stop - origin);
        self->at[0] = x - (real)period;
        gaussian_run(grid, dimension, points, begins[first_cell], begins[end_cell], self);
        cell = stop;
    }
}

/* All rows of a layer, whose distance has this square. layer: number of the first cell. */
TWO_TO_INLINE void gaussian_layer(const gaussian_grid *grid, unsigned dimension,
                                  GAUSSIAN_GLOBAL const real *points,
                                  GAUSSIAN_GLOBAL const ps_u32 *begins, ps_u32 layer,
                                  const real *from, real rest, gaussian_lanes *self) {
    const int cells = (int)grid->cells;
    const real within = sqrt(rest);
    const int last = (int)floor((from[1] + within) * (real)cells);
    for (int cell = (int)floor((from[1] - within) * (real)cells); cell <= last; cell++) {
        const real gap = gaussian_gap(from[1], cell, cells);
        const real left = rest - gap * gap;
        const int period = gaussian_period(cell, cells);
        self->at[1] = from[1] - (real)period;
        if (left > 0) {
            gaussian_row(grid, dimension, points, begins,
                         layer + (ps_u32)((cell - period * cells) * cells), from[0], sqrt(left),
                         self);
        }
    }
}

/* The sums of point i, itself among its images: sums[0] of Gaussians, the others of differences
 * times Gaussians, by axes. `dimension` is the grid's, as a constant where that helps. */
TWO_TO_INLINE void gaussian_point(const gaussian_grid *grid, unsigned dimension,
                                  GAUSSIAN_GLOBAL const real *points,
                                  GAUSSIAN_GLOBAL const ps_u32 *begins, size_t i, real *sums) {
    const real square = grid->reach * grid->reach;
    const int cells = (int)grid->cells;
    real from[GAUSSIAN_AXES] = {0, 0, 0};
    gaussian_lanes self;
    gaussian_clear(&self);
    for (unsigned axis = 0; axis < dimension; axis++) {
        from[axis] = points[axis * grid->stride + i];
    }
    if (dimension == GAUSSIAN_AXES) {
        const int last = (int)floor((from[2] + grid->reach) * (real)cells);
        for (int cell = (int)floor((from[2] - grid->reach) * (real)cells); cell <= last; cell++) {
            const real gap = gaussian_gap(from[2], cell, cells);
            const real rest = square - gap * gap;
            const int period = gaussian_period(cell, cells);
            self.at[2] = from[2] - (real)period;
            if (rest > 0) {
                gaussian_layer(grid, dimension, points, begins,
                               (ps_u32)((cell - period * cells) * cells * cells), from, rest,
                               &self);
            }
        }
    } else {
        gaussian_layer(grid, dimension, points, begins, 0, from, square, &self);
    }
    for (unsigned k = 0; k < 1 + dimension; k++) {
#ifdef __OPENCL_C_VERSION__
        sums[k] = (self.sums[k].x + self.sums[k].y) + (self.sums[k].z + self.sums[k].w);
#else
        sums[k] = (self.sums[k][0] + self.sums[k][1]) + (self.sums[k][2] + self.sums[k][3]);
#endif
    }
}

#endif
