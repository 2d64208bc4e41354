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

/* Windows of a point: along rows of cells, across them, and in three dimensions those of axis 0, of
 * which one bin counts. In one dimension there is only the first. */
typedef struct chunk_axes {
    window_axis outer, across, along;
    uint dimension, outer_bin;
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
    realv values = weights;
    wordv fractions;
    const uintv columns = first_cells(load_some_coordinates(from, dimension, axes.along.axis, num),
                                      axes.along.n, axes.along.width, &fractions);
    uintv cells = columns;
    store_local(to.centres + CHUNK, part, centred_fractions(fractions));
    if (dimension == 3) {
        first_cells(load_some_coordinates(from, dimension, axes.outer.axis, num), axes.outer.n,
                    axes.outer.width, &fractions);
        values *= window_bin_of_points(axes.outer, centred_fractions(fractions), axes.outer_bin);
    }
    if (dimension > 1) {
        cells += first_cells(load_some_coordinates(from, dimension, axes.across.axis, num),
                             axes.across.n, axes.across.width, &fractions) *
                 (uintv)pitch;
        store_local(to.centres, part, centred_fractions(fractions));
        store_local(to.weights, part, values);
    } else {
        store_local(to.across, part, values);
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
        __local const real *centres = to.centres + CHUNK + i;
        if (along.bins == 8) {
            make_8_bins(along, centres, to.along + i * 8);
        } else {
            make_16_bins(along, centres, to.along + i * 16);
        }
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

/* A point into num_rows rows `pitch` apart, by one work-item: values along a row are one vector,
 * weighted row by row by across. Four rows in a step: addresses and the loop are half of the
 * instructions else. */
#define ADD_ROWS(NAME, SPACE, BINS)                                                                \
    static inline void add_##NAME##_rows_##BINS(SPACE real *at, const size_t pitch,                \
                                                __local const real *across,                        \
                                                __local const real *along, const uint num_rows) {  \
        const real##BINS values = *(__local const unaligned_real##BINS *)along;                    \
        uint row = 0;                                                                              \
        for (; row + 4 <= num_rows; row += 4) {                                                    \
            _Pragma("unroll") for (uint i = 0; i < 4; i++) {                                       \
                SPACE unaligned_real##BINS *to = (SPACE unaligned_real##BINS *)(at + i * pitch);   \
                *to = fma((real##BINS)across[(row + i) * CHUNK], values, *to);                     \
            }                                                                                      \
            at += 4 * pitch;                                                                       \
        }                                                                                          \
        for (; row < num_rows; row++) {                                                            \
            SPACE unaligned_real##BINS *to = (SPACE unaligned_real##BINS *)at;                     \
            *to = fma((real##BINS)across[row * CHUNK], values, *to);                               \
            at += pitch;                                                                           \
        }                                                                                          \
    }

#define ADD_ANY_ROWS(NAME, SPACE)                                                                  \
    ADD_ROWS(NAME, SPACE, 8)                                                                       \
    ADD_ROWS(NAME, SPACE, 16)                                                                      \
    static inline void add_##NAME##_rows(SPACE real *at, const uint pitch,                         \
                                         __local const real *across, __local const real *along,    \
                                         const uint num_rows, const uint bins) {                   \
        if (bins == 8) {                                                                           \
            add_##NAME##_rows_8(at, pitch, across, along, num_rows);                               \
        } else {                                                                                   \
            add_##NAME##_rows_16(at, pitch, across, along, num_rows);                              \
        }                                                                                          \
    }

ADD_ANY_ROWS(global, __global)
ADD_ANY_ROWS(local, __local)

#endif
