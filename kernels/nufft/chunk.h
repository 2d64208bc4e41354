/* Points in chunks, on their way to a grid of real numbers: where they fall, and their windows on
 * each axis. Device only.
 */
#ifndef PS_NUFFT_CHUNK_H
#define PS_NUFFT_CHUNK_H

#include "nufft/cells.h"
#include "nufft/window.h"
#include "shared/group.h"

/* Points of a chunk; LANES divides it. */
#define CHUNK 16

typedef PS_JOIN(REAL, 4) real4;
typedef real4 unaligned_real4 __attribute__((aligned(sizeof(real))));
typedef PS_JOIN(REAL, 16) real16;
typedef real16 unaligned_real16 __attribute__((aligned(sizeof(real))));

/* Local memory of a chunk. */
typedef struct chunk {
    __local real
        *across; /* [bins of axis 0][CHUNK], times the weights; in one dimension just these */
    __local real *along;   /* [CHUNK][bins of the last axis] */
    __local real *centres; /* [axis][CHUNK]: where windows are made */
    __local real *weights; /* [CHUNK] */
    __local uint *cells;   /* [CHUNK]: the first in the grid */
    __local uint *columns; /* [CHUNK]: the first of its row */
} chunk;

/* Windows of a point: along rows of cells, and in two dimensions across them. */
typedef struct chunk_axes {
    window_axis across, along;
    uint dimension;
} chunk_axes;

static inline chunk make_chunk(__local real *windows, __local uint *cells, const window_axis across,
                               const window_axis along) {
    __local real *centres = windows + CHUNK * (across.bins + along.bins);
    return (chunk){windows,      windows + CHUNK * across.bins, centres, centres + 2 * CHUNK, cells,
                   cells + CHUNK};
}

/* ---- where points fall ---------------------------------------------------------------------- */

static inline realv load_few_weights(__global const real *weights, const uint count) {
    real few[LANES];
    for (uint i = 0; i < LANES; i++) {
        few[i] = i < count ? weights[i] : 0;
    }
    return *(realv *)few;
}

/* LANES places from the points that `from` begins with, `num` of them at most. pitch: of rows of
 * cells. */
static inline void place_lanes(const chunk to, const uint part, const uint pitch,
                               __global const ulong *from, const uint num, const realv weights,
                               const chunk_axes axes) {
    const uint dimension = axes.dimension;
    wordv fractions;
    const uintv columns = first_cells(load_some_coordinates(from, dimension, axes.along.axis, num),
                                      axes.along.n, axes.along.width, &fractions);
    uintv cells = columns;
    store_local(to.centres + CHUNK, part, centred_fractions(fractions));
    if (dimension > 1) {
        cells += first_cells(load_some_coordinates(from, dimension, axes.across.axis, num),
                             axes.across.n, axes.across.width, &fractions) *
                 (uintv)pitch;
        store_local(to.centres, part, centred_fractions(fractions));
        store_local(to.weights, part, weights);
    } else {
        store_local(to.across, part, weights);
    }
    *(__local unaligned_uintv *)(to.columns + part * LANES) = columns;
    *(__local unaligned_uintv *)(to.cells + part * LANES) = cells;
}

/* ---- windows -------------------------------------------------------------------------------- */

/* All 8 bins of four points, [4][8]: two chains, since each step waits for the one before. */
static inline void make_8_bins(const window_axis axis, __local const real *centres,
                               __local real *to) {
    const real16 u = (real16)((real8)centres[0], (real8)centres[1]);
    const real16 v = (real16)((real8)centres[2], (real8)centres[3]);
    __global const unaligned_real8 *from =
        (__global const unaligned_real8 *)axis.coefficients + axis.degree;
    real16 first = (real16)(*from, *from), second = first;
    for (uint i = 0; i < axis.degree; i++) {
        from--;
        const real16 coefficients = (real16)(*from, *from);
        first = fma(first, u, coefficients);
        second = fma(second, v, coefficients);
    }
    *(__local unaligned_real16 *)to = first;
    *(__local unaligned_real16 *)(to + 16) = second;
}

/* All 16 bins of four points: [4][16] */
static inline void make_16_bins(const window_axis axis, __local const real *centres,
                                __local real *to) {
    __global const unaligned_real16 *from =
        (__global const unaligned_real16 *)axis.coefficients + axis.degree;
    real16 of[4] = {*from, *from, *from, *from};
    for (uint i = 0; i < axis.degree; i++) {
        from--;
        const real16 coefficients = *from;
#pragma unroll
        for (uint j = 0; j < 4; j++) {
            of[j] = fma(of[j], (real16)centres[j], coefficients);
        }
    }
#pragma unroll
    for (uint j = 0; j < 4; j++) {
        *(__local unaligned_real16 *)(to + j * 16) = of[j];
    }
}

/* All bins of four points: [4][bins] */
static inline void make_row_windows(const window_axis axis, __local const real *centres,
                                    __local real *to) {
    if (axis.bins == 8) {
        make_8_bins(axis, centres, to);
    } else {
        make_16_bins(axis, centres, to);
    }
}

/* Makes the windows of the first `count` points at least. */
static inline void make_windows(const chunk to, const uint count, const chunk_axes axes) {
    const window_axis across = axes.across, along = axes.along;
    const uint parts = CHUNK / LANES;
    const uint jobs = axes.dimension == 1 ? 0 : (across.width + 3) / 4 * parts; /* two pairs */
    for (uint job = own_item(); job < jobs; job += num_items()) {
        const uint part = job % parts;
        make_two_pairs(across, job / parts * 2, load_local(to.centres, part),
                       load_local(to.weights, part), to.across + part * LANES, CHUNK);
    }
    for (uint i = 4 * own_item(); i < count; i += 4 * num_items()) {
        make_row_windows(along, to.centres + CHUNK + i, to.along + i * along.bins);
    }
}

/* ---- both ----------------------------------------------------------------------------------- */

/* `count` points, at most CHUNK; up to `made` of them, count or CHUNK, points without weight
 * follow. All work-items call it. */
static inline void fill_chunk(const chunk to, __global const ulong *points,
                              __global const real *weights, const uint count, const uint made,
                              const uint pitch, const chunk_axes axes) {
    for (uint part = own_item(); part < CHUNK / LANES; part += num_items()) {
        const uint begin =
            min(part * LANES, count - 1); /* of those behind the end, the last point */
        const uint num = count - begin;
        const uint weighty = part * LANES < count ? num : 0;
        const realv few = weighty >= LANES ? load_global(weights + begin, 0)
                                           : load_few_weights(weights + begin, weighty);
        place_lanes(to, part, pitch, points + (size_t)begin * axes.dimension, num, few, axes);
    }
    GROUP_BARRIER(CLK_LOCAL_MEM_FENCE);
    make_windows(to, made, axes);
    GROUP_BARRIER(CLK_LOCAL_MEM_FENCE);
}

/* ---- adding --------------------------------------------------------------------------------- */

/* A row of 8 or 16 cells, and one of 12 by the first of 16 values: in double precision rows are
 * what spreading waits for, and a third less of windows up to 12 cells wide is worth a branch. */
#define ADD_ROW_8(SPACE, at, weight, values)                                                       \
    *(SPACE unaligned_real8 *)(at) = fma((real8)(weight), values, *(SPACE unaligned_real8 *)(at));
#define ADD_ROW_16(SPACE, at, weight, values)                                                      \
    *(SPACE unaligned_real16 *)(at) =                                                              \
        fma((real16)(weight), values, *(SPACE unaligned_real16 *)(at));
#define ADD_ROW_12(SPACE, at, weight, values)                                                      \
    ADD_ROW_8(SPACE, at, weight, (values).lo)                                                      \
    *(SPACE unaligned_real4 *)((at) + 8) =                                                         \
        fma((real4)(weight), (values).hi.lo, *(SPACE unaligned_real4 *)((at) + 8));

/* A point into num_rows rows `pitch` apart, by one work-item: values along a row are one vector,
 * weighted row by row by across. Four rows in a step: addresses and the loop are half of the
 * instructions else. */
#define ADD_ROWS(NAME, SPACE, CELLS, BINS)                                                         \
    static inline void add_##NAME##_values_##CELLS(SPACE real *at, const size_t pitch,             \
                                                   __local const real *across,                     \
                                                   const real##BINS values, const uint num_rows) { \
        uint row = 0;                                                                              \
        for (; row + 4 <= num_rows; row += 4) {                                                    \
            _Pragma("unroll") for (uint i = 0; i < 4; i++){ADD_ROW_##CELLS(                        \
                SPACE, at + i * pitch, across[(row + i) * CHUNK], values)} at += 4 * pitch;        \
        }                                                                                          \
        for (; row < num_rows; row++) {                                                            \
            ADD_ROW_##CELLS(SPACE, at, across[row * CHUNK], values) at += pitch;                   \
        }                                                                                          \
    }

/* width: of the window along rows, whose values are [8] or [16]. */
#define ADD_ANY_ROWS(NAME, SPACE)                                                                  \
    ADD_ROWS(NAME, SPACE, 8, 8)                                                                    \
    ADD_ROWS(NAME, SPACE, 12, 16)                                                                  \
    ADD_ROWS(NAME, SPACE, 16, 16)                                                                  \
    static inline void add_##NAME##_rows(SPACE real *at, const size_t pitch,                       \
                                         __local const real *across, __local const real *along,    \
                                         const uint num_rows, const uint width) {                  \
        if (width <= 8) {                                                                          \
            add_##NAME##_values_8(at, pitch, across, *(__local const unaligned_real8 *)along,      \
                                  num_rows);                                                       \
        } else if (PRECISION == 64 && width <= 12) {                                               \
            add_##NAME##_values_12(at, pitch, across, *(__local const unaligned_real16 *)along,    \
                                   num_rows);                                                      \
        } else {                                                                                   \
            add_##NAME##_values_16(at, pitch, across, *(__local const unaligned_real16 *)along,    \
                                   num_rows);                                                      \
        }                                                                                          \
    }

ADD_ANY_ROWS(global, __global)
ADD_ANY_ROWS(local, __local)

#endif
