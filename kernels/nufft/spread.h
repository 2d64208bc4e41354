/* Spreading: points times their windows into rows of cells [cell][re, im][LANES], one row for each
 * tile of a work-group. Device only.
 *
 * Lanes are frequencies of axis 0: the value of a point is exp(-2 pi i k x_0), k the first
 * frequency of the tile, times the phases of the lanes, which all tiles share.
 *
 * A row has room for n + width + GAP cells: windows that begin near the end go on behind it, and
 * fold_row() adds that to the beginning.
 *
 * Points come in chunks: windows and phases are made for a chunk, which then goes into every tile.
 * On CPUs one work-item goes from point to point; the work-items of a group each own cells and go
 * through the points of the chunk. Every cell adds the same numbers in the same order either way,
 * so results are equal to the bit.
 */
#ifndef PS_NUFFT_SPREAD_H
#define PS_NUFFT_SPREAD_H

#include "nufft/transform/fft.h"
#include "nufft/phase.h"
#include "nufft/place.h"
#include "nufft/window.h"

/* Local memory of a chunk. */
typedef struct chunk {
    __local real *windows; /* [GAP zeros, width, zeros up to the pitch][CHUNK], times the weights */
    __local real *phases;  /* [CHUNK][re, im][LANES] */
    __local real *centres; /* [CHUNK]: where windows are made */
    __local real *weights; /* [CHUNK] */
    __local real *turns;   /* [tile][re, im][CHUNK]: exp(-2 pi i k x_0), k the first of a tile */
    __local ulong *along;  /* [CHUNK]: x_0 */
    __local uint *cells;   /* [CHUNK] */
} chunk;

/* All work-items call it. */
static inline chunk make_chunk(__local real *reals, __local ulong *along, __local uint *cells,
                               const window_axis axis) {
    __local real *phases = reals + CHUNK * axis.pitch;
    __local real *centres = phases + CHUNK * 2 * LANES;
    for (uint i = get_local_id(0); i < CHUNK * axis.pitch; i += get_local_size(0)) {
        reals[i] = 0;
    }
    return (chunk){reals, phases, centres, centres + CHUNK, centres + 2 * CHUNK, along, cells};
}

/* LANES places of a chunk: coordinates of axis 0 and of the axis that is spread, weights. */
static inline void fill_places(const chunk to, const uint part, const ulongv along, const ulongv x,
                               const realv weights, const window_axis axis) {
    wordv fractions;
    const uintv cells = first_cells((ulongv)axis.factor * x, axis.n, axis.width, &fractions);
    *(__local unaligned_uintv *)(to.cells + part * LANES) = cells;
    *(__local unaligned_ulongv *)(to.along + part * LANES) = along;
    store_local(to.centres, part, centred_fractions(fractions));
    store_local(to.weights, part, weights);
}

/* Windows and turns, LANES places at a time, and phases, once all places are filled. Tiles have the
 * first frequencies k, k + LANES, ... */
static inline void finish_chunk(const chunk to, const window_axis axis, const uint k,
                                const uint num_tiles) {
    const uint parts = CHUNK / LANES;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint i = 2 * get_local_id(0); i < CHUNK; i += 2 * get_local_size(0)) {
        complexv lanes, next_lanes;
        lanes_of_two(to.along[i], to.along[i + 1], &lanes, &next_lanes);
        store_complex(to.phases, i, lanes);
        store_complex(to.phases, i + 1, next_lanes);
    }
    for (uint job = get_local_id(0); job < (axis.width + 3) / 4 * parts; job += get_local_size(0)) {
        const uint part = job % parts;
        make_two_pairs(axis, job / parts * 2, load_local(to.centres, part),
                       load_local(to.weights, part), to.windows + GAP * CHUNK + part * LANES,
                       CHUNK);
    }
    for (uint job = get_local_id(0); job < num_tiles * parts; job += get_local_size(0)) {
        const uint part = job % parts, tile = job / parts;
        const ulongv along = *(__local const unaligned_ulongv *)(to.along + part * LANES);
        realv cosine, sine;
        turn_cosine_sine(phases_of_points(k + tile * LANES, along), &cosine, &sine);
        store_local(to.turns + tile * 2 * CHUNK, part, cosine);
        store_local(to.turns + tile * 2 * CHUNK + CHUNK, part, -sine);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

/* exp(-2 pi i k x_0) of place i for the lanes, from its phases; turns of the tile. */
static inline complexv turned(const complexv phases, __local const real *turns, const uint i) {
    return complex_multiply(phases, turns[i], turns[CHUNK + i]);
}

/* ---- one work-item ------------------------------------------------------------------------- */

/* Rows of tiles: reals of a row, number of rows. */
typedef struct tile_rows {
    __local real *rows;
    uint row_reals, num;
} tile_rows;

static inline void add_one(const tile_rows to, const chunk from, const uint i, const uint width) {
    const complexv phases = load_complex(from.phases, i);
    for (uint tile = 0; tile < to.num; tile++) {
        const complexv value = turned(phases, from.turns + tile * 2 * CHUNK, i);
        __local const real *window = from.windows + GAP * CHUNK + i;
        __local real *row = to.rows + tile * to.row_reals + from.cells[i] * 2 * LANES;
        for (uint bin = 0; bin < width; bin++) {
            const realv height = (realv)window[0];
            store_local(row, 0, fma(height, value.re, load_local(row, 0)));
            store_local(row, 1, fma(height, value.im, load_local(row, 1)));
            row += 2 * LANES;
            window += CHUNK;
        }
    }
}

/* Neighbours i and i + 1 in one go, half the loads and stores, when they are `apart` <= GAP cells
 * from each other. To the bit the same as one after the other, since windows are zero outside. */
static inline void add_two(const tile_rows to, const chunk from, const uint i, const uint width,
                           const uint apart) {
    const complexv phases = load_complex(from.phases, i);
    const complexv next_phases = load_complex(from.phases, i + 1);
    for (uint tile = 0; tile < to.num; tile++) {
        __local const real *turns = from.turns + tile * 2 * CHUNK;
        const complexv value = turned(phases, turns, i), next = turned(next_phases, turns, i + 1);
        __local const real *window = from.windows + GAP * CHUNK + i;
        __local const real *next_window = window + 1 - apart * CHUNK;
        __local real *row = to.rows + tile * to.row_reals + from.cells[i] * 2 * LANES;
        for (uint bin = 0; bin < width + apart; bin++) {
            const realv height = (realv)window[0], next_height = (realv)next_window[0];
            const realv re = fma(height, value.re, load_local(row, 0));
            const realv im = fma(height, value.im, load_local(row, 1));
            store_local(row, 0, fma(next_height, next.re, re));
            store_local(row, 1, fma(next_height, next.im, im));
            row += 2 * LANES;
            window += CHUNK;
            next_window += CHUNK;
        }
    }
}

/* Four neighbours, all within GAP cells. */
static inline void add_four(const tile_rows to, const chunk from, const uint i, const uint width) {
    const uint cell = from.cells[i];
    const complexv phases_a = load_complex(from.phases, i);
    const complexv phases_b = load_complex(from.phases, i + 1);
    const complexv phases_c = load_complex(from.phases, i + 2);
    const complexv phases_d = load_complex(from.phases, i + 3);
    const uint to_b = 1 - (from.cells[i + 1] - cell) * CHUNK;
    const uint to_c = 2 - (from.cells[i + 2] - cell) * CHUNK;
    const uint to_d = 3 - (from.cells[i + 3] - cell) * CHUNK;
    const uint num_cells = width + from.cells[i + 3] - cell;
    for (uint tile = 0; tile < to.num; tile++) {
        __local const real *turns = from.turns + tile * 2 * CHUNK;
        const complexv a = turned(phases_a, turns, i), b = turned(phases_b, turns, i + 1);
        const complexv c = turned(phases_c, turns, i + 2), d = turned(phases_d, turns, i + 3);
        __local const real *in_a = from.windows + GAP * CHUNK + i;
        __local const real *in_b = in_a + (int)to_b;
        __local const real *in_c = in_a + (int)to_c;
        __local const real *in_d = in_a + (int)to_d;
        __local real *row = to.rows + tile * to.row_reals + cell * 2 * LANES;
        for (uint bin = 0; bin < num_cells * CHUNK; bin += CHUNK) {
            const realv at_a = (realv)in_a[bin], at_b = (realv)in_b[bin];
            const realv at_c = (realv)in_c[bin], at_d = (realv)in_d[bin];
            realv re = fma(at_a, a.re, load_local(row, 0));
            realv im = fma(at_a, a.im, load_local(row, 1));
            re = fma(at_b, b.re, re);
            im = fma(at_b, b.im, im);
            re = fma(at_c, c.re, re);
            im = fma(at_c, c.im, im);
            store_local(row, 0, fma(at_d, d.re, re));
            store_local(row, 1, fma(at_d, d.im, im));
            row += 2 * LANES;
        }
    }
}

/* A chunk in the order of cells. The lengths of loops depend on the points; the same points in all
 * tiles one after the other make them predictable. */
static inline void scatter_in_order(const tile_rows to, const chunk from, const uint width) {
    for (uint i = 0; i < CHUNK; i += 4) {
        if (from.cells[i + 3] - from.cells[i] <= GAP) {
            add_four(to, from, i, width);
            continue;
        }
        for (uint j = i; j < i + 4; j += 2) {
            const uint apart = from.cells[j + 1] - from.cells[j];
            if (apart <= GAP) {
                add_two(to, from, j, width, apart);
            } else {
                add_one(to, from, j, width);
                add_one(to, from, j + 1, width);
            }
        }
    }
}

/* ---- work-items that share a row ----------------------------------------------------------- */

/* Cells first .. end of a row. */
static inline void gather(__local real *row, const chunk from, __local const real *turns,
                          const uint width, const uint first, const uint end) {
    for (uint cell = first + get_local_id(0); cell < end; cell += get_local_size(0)) {
        complexv sum = load_complex(row, cell);
        for (uint i = 0; i < CHUNK; i++) {
            const uint bin = cell - from.cells[i];
            if (bin < width) {
                const complexv value = turned(load_complex(from.phases, i), turns, i);
                const realv height = (realv)from.windows[(GAP + bin) * CHUNK + i];
                sum.re = fma(height, value.re, sum.re);
                sum.im = fma(height, value.im, sum.im);
            }
        }
        store_complex(row, cell, sum);
    }
}

/* ---- rows ---------------------------------------------------------------------------------- */

static inline uint row_cells(const window_axis axis) {
    return axis.n + axis.width + GAP;
}

/* num_cells cells: of one row, or of several. */
static inline void clear_rows(__local real *rows, const uint num_cells) {
    for (uint i = get_local_id(0); i < num_cells; i += get_local_size(0)) {
        store_complex(rows, i, (complexv){(realv)0, (realv)0});
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

/* A chunk whose places are filled, in the order of cells, into the rows of num_tiles tiles, whose
 * first frequencies are k, k + LANES, ... */
static inline void add_chunk(__local real *rows, const chunk from, const window_axis axis,
                             const uint k, const uint num_tiles) {
    const tile_rows to = {rows, row_cells(axis) * 2 * LANES, num_tiles};
    finish_chunk(from, axis, k, num_tiles);
    if (get_local_size(0) > 1) {
        for (uint tile = 0; tile < num_tiles; tile++) {
            gather(rows + tile * to.row_reals, from, from.turns + tile * 2 * CHUNK, axis.width,
                   from.cells[0], from.cells[CHUNK - 1] + axis.width);
        }
    } else {
        scatter_in_order(to, from, axis.width);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

/* The cells behind the end are the first ones again. */
static inline void fold_row(__local real *row, const window_axis axis) {
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint i = get_local_id(0); i < axis.width; i += get_local_size(0)) {
        store_complex(row, i, complex_add(load_complex(row, i), load_complex(row, axis.n + i)));
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

#endif
