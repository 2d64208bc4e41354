/* Spreading: points times their windows into rows of cells [cell][re, im][LANES], one row for each tile of
 * a work-group. Device only.
 *
 * Lanes are frequencies of axis 0: the value of a point is exp(-2 pi i k x_0), k the first frequency of
 * the tile, times the phases of the lanes, which all tiles share.
 *
 * A row has room for n + width + GAP cells: windows that begin near the end go on behind it, and fold_row()
 * adds that to the beginning.
 *
 * Points come in chunks: windows and phases are made for a chunk, which then goes into every tile. On CPUs one
 * work-item goes from point to point; the work-items of a group each own cells and go through the points
 * of the chunk. Every cell adds the same numbers in the same order either way, so results are equal
 * to the bit.
 */
#ifndef PS_NUFFT_SPREAD_H
#define PS_NUFFT_SPREAD_H

#include "nufft/fft.h"
#include "nufft/phase.h"
#include "nufft/place.h"
#include "nufft/window.h"

/* Points of a chunk; PLACE_UNIT is a multiple of it, and LANES divides it. */
#define CHUNK 16

/* Local memory of a chunk. */
typedef struct chunk {
    __local real *windows; /* [CHUNK][pitch], times the weights */
    __local real *phases;  /* [CHUNK][re, im][LANES] */
    __local real *turns;   /* [re, im][CHUNK]: exp(-2 pi i k x_0) of a tile */
    __local ulong *along;  /* [CHUNK]: x_0 */
    __local uint *cells;   /* [CHUNK] */
} chunk;

#define CHUNK_REALS(pitch) (CHUNK * ((pitch) + 2 * LANES + 2))

static inline chunk make_chunk(__local real *reals, __local ulong *along, __local uint *cells,
                               const uint pitch) {
    return (chunk){reals, reals + CHUNK * pitch, reals + CHUNK * (pitch + 2 * LANES), along, cells};
}

__constant word lane_numbers[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

/* One place of a chunk; its weight as given. */
static inline void fill_place(const chunk to, const uint i, __global const ulong *x,
                              const real weight, const window_axis axis) {
    ulong fraction;
    realv cosine, sine;
    to.cells[i] = first_cell(axis.factor * x[axis.axis], axis.n, axis.width, &fraction);
    make_window(axis, centred(fraction), weight, to.windows + i * axis.pitch);
    to.along[i] = x[0];
    turn_cosine_sine(phases_of_lanes(LOADV(0, lane_numbers), x[0]), &cosine, &sine);
    store_local(to.phases, 2 * i, cosine);
    store_local(to.phases, 2 * i + 1, -sine);
}

static inline void fill_turns(const chunk to, const uint k) {
    for (uint i = get_local_id(0) * LANES; i < CHUNK; i += get_local_size(0) * LANES) {
        realv cosine, sine;
        turn_cosine_sine(phases_of_points(k, LOADV(0, to.along + i)), &cosine, &sine);
        store_local(to.turns + i, 0, cosine);
        store_local(to.turns + CHUNK + i, 0, -sine);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

static inline complexv value_of(const chunk from, const uint i) {
    return complex_multiply(load_complex(from.phases, i), from.turns[i], from.turns[CHUNK + i]);
}

/* ---- one work-item ------------------------------------------------------------------------- */

static inline void add_one(__local real *row, const uint width, const chunk from, const uint i,
                           const uint pitch) {
    const complexv value = value_of(from, i);
    __local const real *window = from.windows + i * pitch + GAP;
    row += from.cells[i] * 2 * LANES;
    for (uint bin = 0; bin < width; bin++) {
        const realv height = (realv)window[bin];
        store_local(row, 0, fma(height, value.re, load_local(row, 0)));
        store_local(row, 1, fma(height, value.im, load_local(row, 1)));
        row += 2 * LANES;
    }
}

/* Neighbours i and i + 1, `apart` cells from each other, within num_cells: half the loads and stores. To the bit
 * the same as one after the other, since windows are zero outside. */
static inline void add_two(__local real *row, const uint num_cells, const uint apart,
                           const chunk from, const uint i, const uint pitch) {
    const complexv value = value_of(from, i), next = value_of(from, i + 1);
    __local const real *window = from.windows + i * pitch + GAP;
    __local const real *next_window = window + pitch - apart;
    row += from.cells[i] * 2 * LANES;
    for (uint bin = 0; bin < num_cells; bin++) {
        const realv height = (realv)window[bin], next_height = (realv)next_window[bin];
        const realv re = fma(height, value.re, load_local(row, 0));
        const realv im = fma(height, value.im, load_local(row, 1));
        store_local(row, 0, fma(next_height, next.re, re));
        store_local(row, 1, fma(next_height, next.im, im));
        row += 2 * LANES;
    }
}

/* Four neighbours, within num_cells. */
static inline void add_four(__local real *row, const uint num_cells, const chunk from, const uint i,
                            const uint pitch) {
    const uint cell = from.cells[i];
    const complexv a = value_of(from, i), b = value_of(from, i + 1);
    const complexv c = value_of(from, i + 2), d = value_of(from, i + 3);
    __local const real *in_a = from.windows + i * pitch + GAP;
    __local const real *in_b = in_a + pitch - (from.cells[i + 1] - cell);
    __local const real *in_c = in_a + 2 * pitch - (from.cells[i + 2] - cell);
    __local const real *in_d = in_a + 3 * pitch - (from.cells[i + 3] - cell);
    row += cell * 2 * LANES;
    for (uint bin = 0; bin < num_cells; bin++) {
        const realv at_a = (realv)in_a[bin], at_b = (realv)in_b[bin];
        const realv at_c = (realv)in_c[bin], at_d = (realv)in_d[bin];
        realv re = fma(at_a, a.re, load_local(row, 0)), im = fma(at_a, a.im, load_local(row, 1));
        re = fma(at_b, b.re, re);
        im = fma(at_b, b.im, im);
        re = fma(at_c, c.re, re);
        im = fma(at_c, c.im, im);
        store_local(row, 0, fma(at_d, d.re, re));
        store_local(row, 1, fma(at_d, d.im, im));
        row += 2 * LANES;
    }
}

/* A chunk in the order of cells. Neighbours up to gap <= GAP cells apart go in one go. (Loops of one length for
 * all of them: others are mispredicted, which costs more than zeros.) */
static inline void scatter_in_order(__local real *row, const chunk from, const uint width,
                                    const uint pitch, const uint gap) {
    for (uint i = 0; i < CHUNK; i += 4) {
        const uint apart = from.cells[i + 1] - from.cells[i];
        const uint next_apart = from.cells[i + 3] - from.cells[i + 2];
        if (from.cells[i + 3] - from.cells[i] <= gap) {
            add_four(row, width + gap, from, i, pitch);
        } else if (apart <= gap && next_apart <= gap) {
            add_two(row, width + gap, apart, from, i, pitch);
            add_two(row, width + gap, next_apart, from, i + 2, pitch);
        } else {
            for (uint j = i; j < i + 4; j++) {
                add_one(row, width, from, j, pitch);
            }
        }
    }
}

/* ---- work-items that share a row ----------------------------------------------------------- */

/* Cells first .. end of a row. */
static inline void gather(__local real *row, const chunk from, const uint width, const uint pitch,
                          const uint first, const uint end) {
    for (uint cell = first + get_local_id(0); cell < end; cell += get_local_size(0)) {
        complexv sum = load_complex(row, cell);
        for (uint i = 0; i < CHUNK; i++) {
            const uint bin = cell - from.cells[i];
            if (bin < width) {
                const complexv value = value_of(from, i);
                const realv height = (realv)from.windows[i * pitch + GAP + bin];
                sum.re = fma(height, value.re, sum.re);
                sum.im = fma(height, value.im, sum.im);
            }
        }
        store_complex(row, cell, sum);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
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

/* A filled chunk of `count` places into the rows of num_tiles tiles, whose first frequencies are k, k + LANES, ... */
static inline void add_chunk(__local real *rows, const chunk from, const window_axis axis,
                             const uint k, const uint num_tiles, const uint count,
                             const bool is_sorted, const uint gap) {
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint tile = 0; tile < num_tiles; tile++) {
        __local real *row = rows + tile * row_cells(axis) * 2 * LANES;
        fill_turns(from, k + tile * LANES);
        if (get_local_size(0) > 1) {
            gather(row, from, axis.width, axis.pitch, is_sorted ? from.cells[0] : 0,
                   (is_sorted ? from.cells[CHUNK - 1] : axis.n) + axis.width);
        } else if (is_sorted) {
            scatter_in_order(row, from, axis.width, axis.pitch, gap);
        } else {
            for (uint i = 0; i < count; i++) {
                add_one(row, axis.width, from, i, axis.pitch);
            }
        }
    }
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
