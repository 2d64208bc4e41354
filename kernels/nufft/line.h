/* Frequency 0 of axis 0, where every phase is 1: a realization as one row of real numbers, beside
 * the tiles of its other frequencies. A lane of a tile would be complex, and often the only one of
 * its tile. Device only.
 *
 * Points of a chunk go on LINE_ROWS rows in turn, which are added up in the end: neighbours in the
 * order of cells fall on the same cells, and on one row each would wait for what the one before
 * stored.
 */
#ifndef PS_NUFFT_LINE_H
#define PS_NUFFT_LINE_H

#include "nufft/row_windows.h"
#include "nufft/spread.h"

#ifndef LINE
#define LINE 0 /* no realization has one, and what follows does nothing */
#endif

#define LINE_ROWS 4

typedef struct line {
    __local real *rows;    /* [LINE_ROWS][pitch] */
    __local real *windows; /* [CHUNK][bins] */
    uint pitch;            /* all cells, and all bins behind the last */
    bool is_own;           /* of this work-group: that of the first tile */
} line;

#if LINE

/* reals: LINE_ROWS (n + bins) + CHUNK bins */
static inline line make_line(__local real *reals, const window_axis axis, const bool is_own) {
    const uint pitch = axis.n + axis.bins;
    return (line){reals, reals + LINE_ROWS * pitch, pitch, is_own};
}

/* No barrier depends on whether there is a line: PoCL compiles what follows such a one twice. */

static inline void clear_line(const line to) {
    const uint num = to.is_own ? LINE_ROWS * to.pitch : 0;
    for (uint i = get_local_id(0); i < num; i += get_local_size(0)) {
        to.rows[i] = 0;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

/* As work-items that share rows do it: each has cells of its own. */
static inline void gather_line(const line to, const chunk from, const window_axis axis) {
    const uint end = from.cells[CHUNK - 1] + axis.width;
    for (uint cell = from.cells[0] + get_local_id(0); cell < end; cell += get_local_size(0)) {
        for (uint i = 0; i < CHUNK; i++) {
            const uint bin = cell - from.cells[i];
            if (bin < axis.width) {
                __local real *at = to.rows + i % LINE_ROWS * to.pitch + cell;
                *at = fma(from.weights[i], to.windows[i * axis.bins + bin], *at);
            }
        }
    }
}

/* A work-item alone. */
static inline void scatter_to_line(const line to, const chunk from, const window_axis axis) {
    for (uint i = 0; i < CHUNK; i++) {
        add_local_rows(to.rows + i % LINE_ROWS * to.pitch + from.cells[i], 0, from.weights + i,
                       to.windows + i * axis.bins, 1, axis.width);
    }
}

/* A chunk that is finished (nufft/spread.h). */
static inline void add_to_line(const line to, const chunk from, const window_axis axis) {
    const uint num = to.is_own ? CHUNK : 0;
    for (uint i = 4 * get_local_id(0); i < num; i += 4 * get_local_size(0)) {
        make_row_windows(axis, from.centres + i, to.windows + i * axis.bins);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (to.is_own) {
        if (get_local_size(0) > 1) {
            gather_line(to, from, axis);
        } else {
            scatter_to_line(to, from, axis);
        }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

static inline real sum_of_rows(const line from, const uint cell) {
    __local const real *at = from.rows + cell;
    return (at[0] + at[from.pitch]) + (at[2 * from.pitch] + at[3 * from.pitch]);
}

/* cells: [n], whose mean is taken off: it is what frequency 0 of all axes leaves there. */
static inline void write_line(const line from, const window_axis axis, const real mean,
                              __global real *cells) {
    const uint num = from.is_own ? axis.n : 0;
    for (uint i = get_local_id(0); i < num; i += get_local_size(0)) {
        const real behind = i < axis.bins ? sum_of_rows(from, axis.n + i) : 0;
        cells[i] = sum_of_rows(from, i) + behind - mean;
    }
}

#else

static inline line make_line(__local real *reals, const window_axis axis, const bool is_own) {
    (void)axis;
    (void)is_own;
    return (line){reals, reals, 0, false};
}

static inline void clear_line(const line to) {
    (void)to;
}

static inline void add_to_line(const line to, const chunk from, const window_axis axis) {
    (void)to;
    (void)from;
    (void)axis;
}

static inline void write_line(const line from, const window_axis axis, const real mean,
                              __global real *cells) {
    (void)from;
    (void)axis;
    (void)mean;
    (void)cells;
}

#endif

#endif
