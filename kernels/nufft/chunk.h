/* Points in chunks, on their way to a grid of real numbers: where they fall, and their windows on each axis.
 * Device only.
 */
#ifndef PS_NUFFT_CHUNK_H
#define PS_NUFFT_CHUNK_H

#include "nufft/cells.h"
#include "nufft/window.h"

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

/* Coordinates of the first axis and of the last: the same in one dimension. */
static inline void place_lanes(const chunk to, const uint part, const uint pitch, const ulongv x,
                               const ulongv y, const realv weights, const window_axis across,
                               const window_axis along, const bool is_line) {
    wordv fractions;
    const uintv columns = first_cells(y, along.n, along.width, &fractions);
    uintv cells = columns;
    store_local(to.centres + CHUNK, part, centred_fractions(fractions));
    if (is_line) {
        store_local(to.across, part, weights);
    } else {
        cells += first_cells(x, across.n, across.width, &fractions) * (uintv)pitch;
        store_local(to.centres, part, centred_fractions(fractions));
        store_local(to.weights, part, weights);
    }
    *(__local unaligned_uintv *)(to.columns + part * LANES) = columns;
    *(__local unaligned_uintv *)(to.cells + part * LANES) = cells;
}

/* ---- windows -------------------------------------------------------------------------------- */

/* All 8 bins of two points: [2][8] */
static inline void make_8_bins(const window_axis axis, const real a, const real b,
                               __local real *to) {
    const real16 u = (real16)((real8)a, (real8)b);
    __global const unaligned_real8 *from =
        (__global const unaligned_real8 *)axis.coefficients + axis.degree;
    real16 value = (real16)(*from, *from);
    for (uint i = 0; i < axis.degree; i++) {
        from--;
        value = fma(value, u, (real16)(*from, *from));
    }
    *(__local unaligned_real16 *)to = value;
}

/* All 16 bins of two points: [2][16] */
static inline void make_16_bins(const window_axis axis, const real a, const real b,
                                __local real *to) {
    const real16 u = (real16)a, v = (real16)b;
    __global const unaligned_real16 *from =
        (__global const unaligned_real16 *)axis.coefficients + axis.degree;
    real16 of_a = *from, of_b = of_a;
    for (uint i = 0; i < axis.degree; i++) {
        from--;
        const real16 coefficients = *from;
        of_a = fma(of_a, u, coefficients);
        of_b = fma(of_b, v, coefficients);
    }
    *(__local unaligned_real16 *)to = of_a;
    *(__local unaligned_real16 *)(to + 16) = of_b;
}

static inline void make_windows(const chunk to, const window_axis across, const window_axis along,
                                const bool is_line) {
    const uint parts = CHUNK / LANES;
    const uint jobs = is_line ? 0 : (across.width + 3) / 4 * parts;
    for (uint job = get_local_id(0); job < jobs; job += get_local_size(0)) {
        const uint part = job % parts, bin = job / parts * 4;
        make_four_bins(across, bin, load_local(to.centres, part), load_local(to.weights, part),
                       to.across + bin * CHUNK + part * LANES, CHUNK);
    }
    for (uint i = 2 * get_local_id(0); i < CHUNK; i += 2 * get_local_size(0)) {
        __local const real *centres = to.centres + CHUNK + i;
        if (along.bins == 8) {
            make_8_bins(along, centres[0], centres[1], to.along + i * 8);
        } else {
            make_16_bins(along, centres[0], centres[1], to.along + i * 16);
        }
    }
}

/* ---- both ----------------------------------------------------------------------------------- */

/* `count` points, at most CHUNK; the rest has no weight. All work-items call it. */
static inline void fill_chunk(const chunk to, __global const ulong *points,
                              __global const real *weights, const uint count, const uint pitch,
                              const window_axis across, const window_axis along,
                              const bool is_line) {
    for (uint part = get_local_id(0); part < CHUNK / LANES; part += get_local_size(0)) {
        const uint begin =
            min(part * LANES, count - 1); /* of those behind the end, the last point */
        const uint own = count - begin;
        const uint weighty = part * LANES < count ? own : 0;
        const uint dimension = is_line ? 1 : 2;
        __global const ulong *from = points + (size_t)begin * dimension;
        const ulongv x = load_some_coordinates(from, dimension, 0, own);
        const ulongv y = load_some_coordinates(from, dimension, dimension - 1, own);
        const realv few = weighty >= LANES ? load_global(weights + begin, 0)
                                           : load_few_weights(weights + begin, weighty);
        place_lanes(to, part, pitch, x, y, few, across, along, is_line);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    make_windows(to, across, along, is_line);
    barrier(CLK_LOCAL_MEM_FENCE);
}

#endif
