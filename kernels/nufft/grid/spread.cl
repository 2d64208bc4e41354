/* Points of sets spread on the fine grid of their box, in local memory, with the cells behind
 * it that windows touch. Launch: (work-items of one group, boxes, sets). The group has COPIES
 * of the box. Runs of GRID_RUN points go to copies in turn; a copy adds its points in order,
 * for every cell belongs to one of SLOTS slots, by its place modulo SLOT_PLANES, SLOT_ROWS and
 * SLOT_COLUMNS, and a slot to one work-item. So nothing is atomic, nothing waits between
 * points, and results do not depend on how many work-items there are.
 *
 *   numbers   grid_spread_numbers of nufft/grid/grid.h
 *   places, sorted, heights  of nufft/sort.cl
 *   starts    [set][box + 2]: places in the order of boxes
 *   windows_0, windows_1, windows_2  coefficients of nufft/window.h
 *   high, low [set][box][SIDE_0][SIDE_1][SIDE_2]: numbers, with PAIRS pairs of them, to which it may be added; without, low is not touched
 *   copies    local, [COPIES][SIDE_0][SIDE_1][PITCH]
 *   values    local, [COPIES * GRID_RUN][WINDOW_REALS]: windows of a chunk of points
 *   cells     local, [COPIES * GRID_RUN]: where they begin
 */
#define LANES 1
#include "nufft/cells.h"
#include "nufft/grid/sides.h"
#include "nufft/window.h"
#include "shared/pair.h"

#ifndef COPIES
#define COPIES 1
#endif
/* Numbers from one row of a box to the next: so that the cells of all slots are in different
 * banks. */
#ifndef PITCH
#define PITCH 24
#endif
#define COPY_CELLS (SIDE_0 * SIDE_1 * PITCH)
#define CHUNK_POINTS (COPIES * GRID_RUN)

#define SLOT_PLANES (DIMENSION > 2 ? 4 : 1)
#define SLOT_ROWS (DIMENSION > 2 ? 4 : DIMENSION > 1 ? 8 : 1)
#define SLOT_COLUMNS (DIMENSION > 1 ? 8 : 16)
#define SLOTS (SLOT_PLANES * SLOT_ROWS * SLOT_COLUMNS)

/* Windows are made in two pairs of bins, which may go over the end of a narrow one; odd, for
 * banks. */
#define ROOM(width) ((width) < 4 ? 4 : (width))
#define FIRST (GRID_AXES - DIMENSION)
#define BEGIN_1 (DIMENSION > 2 ? ROOM(WIDTH_0) : 0)
#define BEGIN_2 (BEGIN_1 + (DIMENSION > 1 ? ROOM(WIDTH_1) : 0))
#define WINDOW_REALS ((BEGIN_2 + ROOM(WIDTH_2)) | 1)

/* Where a point's windows begin in its box: the cell, and what decides over slots. */
static inline uint pack_place(const uint x, const uint y, const uint z) {
    const uint cell = (x * SIDE_1 + y) * PITCH + z;
    const uint slot = (x % SLOT_PLANES * SLOT_ROWS + y % SLOT_ROWS) * SLOT_COLUMNS;
    return cell * SLOTS + slot + z % SLOT_COLUMNS;
}

/* The window of one axis, times the weight; returns where it begins in a box. */
static inline uint make_axis_window(__local real *to, const ulong x, const window_axis axis,
                                    const uint edge, const real weight) {
    word fraction;
    const uint cell = first_cells(x, axis.n, axis.width, &fraction);
    const real centre = centred_fractions(fraction);
    for (uint pair = 0; pair < (axis.width + 1) / 2; pair += 2) {
        make_two_pairs(axis, pair, centre, weight, to, 1);
    }
    return cell % edge;
}

static inline void make_windows(__local real *values, __local uint *cells,
                                __global const ulong *points, __global const real *weights,
                                const uint num, const window_axis axes[GRID_AXES]) {
    for (uint i = get_local_id(0); i < num; i += get_local_size(0)) {
        __local real *const to = values + i * WINDOW_REALS;
        __global const ulong *const x = points + (size_t)i * DIMENSION;
        const real weight = weights[i];
        uint begin[GRID_AXES] = {0, 0, 0};
#if DIMENSION > 2
        begin[0] = make_axis_window(to, x[0], axes[0], EDGE_0, weight);
#endif
#if DIMENSION > 1
        begin[1] = make_axis_window(to + BEGIN_1, x[1 - FIRST], axes[1], EDGE_1,
                                    DIMENSION == 2 ? weight : 1);
#endif
        begin[2] = make_axis_window(to + BEGIN_2, x[2 - FIRST], axes[2], EDGE_2,
                                    DIMENSION == 1 ? weight : 1);
        cells[i] = pack_place(begin[0], begin[1], begin[2]);
    }
}

/* The first cell of a window that begins at `begin` and belongs to slot `own` of `num`. */
static inline uint first_of(const uint own, const uint begin, const uint num) {
    return (own + num - begin % num) % num;
}

/* A slot's cells of one point. */
#if DIMENSION == 1
static inline void add_point(__local real *restrict copy, __local const real *restrict values,
                             const uint place, const uint slot) {
    for (uint z = first_of(slot, place % SLOTS, SLOTS); z < WIDTH_2; z += SLOTS) {
        copy[place / SLOTS + z] += values[z];
    }
}
#else
static inline void add_point(__local real *restrict copy, __local const real *restrict values,
                             const uint place, const uint slot) {
    const uint begin = place % SLOTS;
    const uint column = first_of(slot % SLOT_COLUMNS, begin, SLOT_COLUMNS);
    const uint row = first_of(slot / SLOT_COLUMNS % SLOT_ROWS, begin / SLOT_COLUMNS, SLOT_ROWS);
    const uint plane =
        first_of(slot / SLOT_COLUMNS / SLOT_ROWS, begin / SLOT_COLUMNS / SLOT_ROWS, SLOT_PLANES);
    __local real *const cells = copy + place / SLOTS;
#pragma unroll
    for (uint z = column; z < WIDTH_2; z += SLOT_COLUMNS) {
        const real along = values[BEGIN_2 + z];
#pragma unroll
        for (uint x = plane; x < WIDTH_0; x += SLOT_PLANES) {
            const real before = DIMENSION > 2 ? along * values[x] : along;
#pragma unroll
            for (uint y = row; y < WIDTH_1; y += SLOT_ROWS) {
                __local real *const to = cells + (x * SIDE_1 + y) * PITCH + z;
                *to = fma(values[BEGIN_1 + y], before, *to);
            }
        }
    }
}
#endif

/* A work-item has a slot of a copy, or several. */
static inline void add_chunk(__local real *copies, __local const real *values,
                             __local const uint *cells, const uint num) {
    for (uint job = get_local_id(0); job < COPIES * SLOTS; job += get_local_size(0)) {
        const uint copy = job / SLOTS, slot = job % SLOTS;
        const uint end = min((copy + 1) * GRID_RUN, num);
        for (uint i = copy * GRID_RUN; i < end; i++) {
            add_point(copies + copy * COPY_CELLS, values + i * WINDOW_REALS, cells[i], slot);
        }
    }
}

/* Copies in order into the tile, to what is there where has_sums is set. They begin anew. */
static inline void put_away(__local real *copies, __global real *high, __global real *low,
                            const bool has_sums) {
    for (uint i = get_local_id(0); i < TILE_CELLS; i += get_local_size(0)) {
        const uint at = i / SIDE_2 * PITCH + i % SIDE_2;
        real sum = 0;
#pragma unroll
        for (uint copy = 0; copy < COPIES; copy++) {
            sum += copies[copy * COPY_CELLS + at];
            copies[copy * COPY_CELLS + at] = 0;
        }
#if PAIRS
        real own_high = has_sums ? high[i] : 0, own_low = has_sums ? low[i] : 0;
        pair_add(&own_high, &own_low, sum);
        high[i] = own_high;
        low[i] = own_low;
#else
        (void)low;
        (void)has_sums;
        high[i] = sum;
#endif
    }
}

__kernel void
nufft_grid_spread(const grid_spread_numbers numbers, __global const ulong *restrict places,
                  __global const ulong *restrict sorted, __global const real *restrict heights,
                  __global const uint *restrict starts, __global const real *restrict windows_0,
                  __global const real *restrict windows_1, __global const real *restrict windows_2,
                  __global real *restrict high, __global real *restrict low, __local real *copies,
                  __local real *values, __local uint *cells) {
    const window_axis axes[GRID_AXES] = {make_chunk_window(windows_0, numbers.windows[0], 0),
                                         make_chunk_window(windows_1, numbers.windows[1], 0),
                                         make_chunk_window(windows_2, numbers.windows[2], 0)};
    const size_t box = get_global_id(1), set = get_global_id(2), num_boxes = get_global_size(1);
    __global const uint *const start = starts + set * (num_boxes + 2) + box;
    const size_t begin = places[set] + start[0], end = places[set] + start[1];
    __global real *const to = high + (set * num_boxes + box) * TILE_CELLS;
    __global real *const to_low = PAIRS ? low + (set * num_boxes + box) * TILE_CELLS : low;
    for (uint i = get_local_id(0); i < COPIES * COPY_CELLS; i += get_local_size(0)) {
        copies[i] = 0;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    size_t at = begin;
    do { /* once at least: PoCL 3.1 loses what is stored behind a loop with barriers */
        const uint num = (uint)min((size_t)CHUNK_POINTS, end - at);
        make_windows(values, cells, sorted + at * DIMENSION, heights + at, num, axes);
        barrier(CLK_LOCAL_MEM_FENCE);
        add_chunk(copies, values, cells, num);
        barrier(CLK_LOCAL_MEM_FENCE);
        at += num;
#if PAIRS
        if (at == end || (at - begin) % numbers.flush == 0) {
            put_away(copies, to, to_low, numbers.has_sums || at - begin > numbers.flush);
        }
        barrier(CLK_LOCAL_MEM_FENCE);
#else
        if (at == end) {
            put_away(copies, to, to_low, 0);
        }
#endif
    } while (at < end);
}
