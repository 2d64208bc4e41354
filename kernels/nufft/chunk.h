/* Points in chunks, on their way to a grid of real numbers: where they fall, and their windows on
 * each axis. Device only.
 */
#ifndef PS_NUFFT_CHUNK_H
#define PS_NUFFT_CHUNK_H

#include "nufft/cells.h"
#include "nufft/row_windows.h"
#include "shared/group.h"

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

#endif
