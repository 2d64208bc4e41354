/* Spreading: points times their windows into a row of cells [cell][re, im][LANES]. Device only.
 *
 * Lanes are frequencies of axis 0: the value of a point is exp(-2 pi i k x_0), k the first frequency of
 * the tile, times the phases of the lanes, which all tiles share.
 *
 * A row has room for `n + width + GAP` cells: windows that begin near the end go on behind it, and
 * fold_row() adds that to the beginning. On CPUs one work-item goes from point to point. The work-items of a group
 * each own cells and go through the points that touch them; every cell adds the same numbers in the same
 * order either way, so results are equal to the bit.
 */
#ifndef PS_NUFFT_SPREAD_H
#define PS_NUFFT_SPREAD_H

#include "nufft/fft.h"
#include "nufft/phase.h"
#include "nufft/place.h"

/* The axis along a row. */
typedef struct row_axis {
    __global const uint *cells;
    __global const real *windows;
    uint n, width, pitch;
} row_axis;

/* What a point is multiplied by. */
typedef struct tile_values {
    __global const ulong *along;
    __global const real *phases;
    uint k;
} tile_values;

static inline complexv value_of_place(const tile_values tile, const size_t place, const real re,
                                      const real im) {
    return complex_multiply(load_global(tile.phases, place), re, im);
}

/* exp(-2 pi i k x) of LANES places. */
static inline void make_turns(const tile_values tile, const size_t place, real *re, real *im) {
    realv cosine, sine;
    turn_cosine_sine(phases_of_points(tile.k, LOADV(0, tile.along + place)), &cosine, &sine);
    STOREV(cosine, 0, re);
    STOREV(-sine, 0, im);
}

/* ---- one work-item ------------------------------------------------------------------------- */

static inline void add_one(__local real *row, const uint width, __global const real *window,
                           const complexv value) {
    for (uint i = 0; i < width; i++) {
        const realv height = (realv)window[GAP + i];
        STOREV(fma(height, value.re, LOADV(0, row)), 0, row);
        STOREV(fma(height, value.im, LOADV(1, row)), 1, row);
        row += 2 * LANES;
    }
}

/* Two neighbours, `apart` cells from each other, within num_cells: half the loads and stores. To the bit the
 * same as one after the other, since windows are zero outside. */
static inline void add_two(__local real *row, const uint num_cells, const uint apart,
                           __global const real *window, const complexv value,
                           __global const real *next_window, const complexv next_value) {
    for (uint i = 0; i < num_cells; i++) {
        const realv height = (realv)window[GAP + i];
        const realv next_height = (realv)next_window[GAP + i - apart];
        const realv re = fma(height, value.re, LOADV(0, row));
        const realv im = fma(height, value.im, LOADV(1, row));
        STOREV(fma(next_height, next_value.re, re), 0, row);
        STOREV(fma(next_height, next_value.im, im), 1, row);
        row += 2 * LANES;
    }
}

/* Places begin .. end, whole units, in the order of cells; neighbours up to gap <= GAP cells apart in one go. (Loops
 * of one length for all of them: others are mispredicted, which costs more than zeros.) */
static inline void scatter_in_order(__local real *row, const row_axis axis, const tile_values tile,
                                    const uint gap, const size_t begin, const size_t end) {
    for (size_t place = begin; place < end; place += LANES) {
        real re[LANES], im[LANES];
        make_turns(tile, place, re, im);
        for (uint i = 0; i + 1 < LANES; i += 2) {
            const size_t at = place + i;
            const complexv value = value_of_place(tile, at, re[i], im[i]);
            const complexv next = value_of_place(tile, at + 1, re[i + 1], im[i + 1]);
            const uint cell = axis.cells[at], apart = axis.cells[at + 1] - cell;
            __local real *first = row + cell * 2 * LANES;
            __global const real *window = axis.windows + at * axis.pitch;
            if (apart <= gap) {
                add_two(first, axis.width + gap, apart, window, value, window + axis.pitch, next);
            } else {
                add_one(first, axis.width, window, value);
                add_one(first + apart * 2 * LANES, axis.width, window + axis.pitch, next);
            }
        }
        if (LANES == 1) {
            add_one(row + axis.cells[place] * 2, axis.width, axis.windows + place * axis.pitch,
                    value_of_place(tile, place, re[0], im[0]));
        }
    }
}

/* Places begin .. end in any order, each times heights[place pitch]. */
static inline void scatter_scaled(__local real *row, const row_axis axis, const tile_values tile,
                                  __global const real *heights, const uint height_pitch,
                                  const size_t begin, const size_t end) {
    for (size_t place = begin; place < end; place += LANES) {
        real re[LANES], im[LANES];
        make_turns(tile, place, re, im);
        for (uint i = 0; i < LANES && place + i < end; i++) {
            const size_t at = place + i;
            const real height = heights[at * height_pitch];
            add_one(row + axis.cells[at] * 2 * LANES, axis.width, axis.windows + at * axis.pitch,
                    value_of_place(tile, at, re[i] * height, im[i] * height));
        }
    }
}

/* ---- work-items that share a row ----------------------------------------------------------- */

/* What places begin .. end leave in a cell, added to sum. */
static inline complexv gather(complexv sum, const row_axis axis, const tile_values tile,
                              __global const real *heights, const uint height_pitch,
                              const uint cell, const size_t begin, const size_t end) {
    for (size_t at = begin; at < end; at++) {
        const uint bin = cell - axis.cells[at];
        if (bin < axis.width) {
            realv cosine, sine;
            turn_cosine_sine(phases_of_points(tile.k, (ulongv)tile.along[at]), &cosine, &sine);
            const real scale = heights != 0 ? heights[at * height_pitch] : 1;
            const complexv value = complex_multiply_lanes(
                load_global(tile.phases, at), cosine * (realv)scale, -sine * (realv)scale);
            const realv height = (realv)axis.windows[at * axis.pitch + GAP + bin];
            sum.re = fma(height, value.re, sum.re);
            sum.im = fma(height, value.im, sum.im);
        }
    }
    return sum;
}

/* ---- rows ---------------------------------------------------------------------------------- */

static inline void clear_row(__local real *row, const row_axis axis) {
    for (uint i = get_local_id(0); i < axis.n + axis.width + GAP; i += get_local_size(0)) {
        store_complex(row, i, (complexv){(realv)0, (realv)0});
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

/* Row `index` of the sums of nufft/add.cl. */
static inline void load_sums(__local real *row, const row_axis axis, __global const real *sums,
                             __global const real *low, const size_t index) {
    const size_t count = axis.n + axis.width + GAP;
    for (uint i = get_local_id(0); i < count; i += get_local_size(0)) {
        store_complex(
            row, i,
            complex_add(load_global(sums, index * count + i), load_global(low, index * count + i)));
    }
}

/* All points of a part: places first .. end, whole units, in the order of cells; cell m has the points
 * first + start[m] .. first + start[m + 1]. */
static inline void add_sorted(__local real *row, const row_axis axis, const tile_values tile,
                              const uint gap, const size_t first, const size_t end,
                              __global const uint *start) {
    if (get_local_size(0) == 1) {
        scatter_in_order(row, axis, tile, gap, first, end);
    } else {
        for (uint m = get_local_id(0); m < axis.n + axis.width; m += get_local_size(0)) {
            const uint begin = start[m + 1 < axis.width ? 0 : min(m + 1 - axis.width, axis.n)];
            store_complex(row, m,
                          gather(load_complex(row, m), axis, tile, 0, 0, m, first + begin,
                                 first + start[min(m + 1, axis.n)]));
        }
    }
}

/* Places begin .. end in any order, each times heights[place height_pitch]. */
static inline void add_scaled(__local real *row, const row_axis axis, const tile_values tile,
                              __global const real *heights, const uint height_pitch,
                              const size_t begin, const size_t end) {
    if (get_local_size(0) == 1) {
        scatter_scaled(row, axis, tile, heights, height_pitch, begin, end);
    } else {
        for (uint m = get_local_id(0); m < axis.n + axis.width; m += get_local_size(0)) {
            store_complex(
                row, m,
                gather(load_complex(row, m), axis, tile, heights, height_pitch, m, begin, end));
        }
    }
}

/* Places sorted by the rows where their windows begin, and their windows across rows. */
typedef struct sorted_rows {
    __global const uint *start, *cells;
    __global const real *windows;
    uint n, width, pitch;
} sorted_rows;

/* All points whose windows touch row m, places counted from `first` on. */
static inline void add_touching(__local real *row, const row_axis axis, const tile_values tile,
                                const sorted_rows rows, const uint m, const size_t first) {
    for (uint i = 0; i < rows.width; i++) {
        const uint begun = m >= i ? m - i : rows.n + m - i;
        add_scaled(row, axis, tile, rows.windows + GAP + i, rows.pitch, first + rows.start[begun],
                   first + rows.start[begun + 1]);
    }
}

/* The cells behind the end are the first ones again. */
static inline void fold_row(__local real *row, const row_axis axis) {
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint i = get_local_id(0); i < axis.width; i += get_local_size(0)) {
        store_complex(row, i, complex_add(load_complex(row, i), load_complex(row, axis.n + i)));
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

#endif
