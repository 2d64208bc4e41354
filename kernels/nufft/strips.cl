/* Realizations in two dimensions, one by each work-group, on a grid that is never whole: strips of
 * some columns, one after the other, take the points whose windows begin there, are transformed
 * along axis 0 while they are in the cache of a core, and leave tiles of frequencies, which are
 * transformed along axis 1. Columns behind a strip, which windows reach into, begin the next one;
 * those behind the last strip are the first ones, so its points are added twice: before all others
 * for what they leave there, and in their turn. For CPUs: work-groups have one work-item.
 * Launch: (1, groups).
 *
 *   numbers    of nufft/strips.h; their names are used here
 *   places, sorted, heights, starts  of nufft/sort.cl, sorted by cells of axis 1
 *   across_window, along_window  of nufft/window.h
 *   first_*, second_*  of transforms, nufft/transform/finish.h: along axis 0, which is across rows, and axis 1
 *   first_gains, second_gains  [K + 1]: 1 / squared transform of the window
 *   means      [realization]: taken off every cell: frequency 0
 *   scales     [realization]
 *   power      [realization][stride], there [tile][2K + 1][LANES]
 *   strips     [group][strip_reals]: rows of `pitch`, as many as cells and a window more
 *   tiles      [group][tile][column][re, im][LANES]
 *   windows, cells  local, of a chunk: nufft/chunk.h
 */
#define ALONE 1
#define FFT_IN_GLOBAL
#include "nufft/chunk.h"
#include "nufft/transform/halves.h"
#include "nufft/strips.h"

typedef struct strip_place {
    __global real *cells;
    uint pitch, rows, columns; /* columns: of the strip, whole vectors; pitch has those behind it */
} strip_place;

static inline void clear_strip(const strip_place strip, const real mean) {
    for (size_t i = 0; i < strip.rows * (size_t)strip.pitch / LANES; i++) {
        store_global(strip.cells, i, (realv)-mean);
    }
}

/* What stands behind the strip begins the next one. */
static inline void go_on(const strip_place strip, const real mean) {
    const uint kept = (strip.pitch - strip.columns) / LANES, all = strip.pitch / LANES;
    for (uint row = 0; row < strip.rows; row++) {
        __global real *at = strip.cells + row * strip.pitch;
        for (uint i = 0; i < kept; i++) {
            store_global(at, i, load_global(at + strip.columns, i));
        }
        for (uint i = kept; i < all; i++) {
            store_global(at, i, (realv)-mean);
        }
    }
}

/* Places begin .. end, whose windows begin in the strip from `column` on. */
static inline void add_places(const strip_place strip, const chunk to, __global const ulong *sorted,
                              __global const real *heights, const size_t begin, const size_t end,
                              const uint column, const chunk_axes axes) {
    for (size_t place = begin; place < end; place += CHUNK) {
        const uint count = (uint)min((size_t)CHUNK, end - place);
        fill_chunk(to, sorted + place * 2, heights + place, count, CHUNK, strip.pitch, axes);
        for (uint i = 0; i < CHUNK; i++) {
            add_global_rows(strip.cells + to.cells[i] - column, strip.pitch, to.across + i,
                            to.along + i * axes.along.bins, axes.across.width, axes.along.width);
        }
    }
}

/* Rows behind the last are the first ones again. */
static inline void fold_strip(const strip_place strip, const real mean, const uint width,
                              const uint n) {
    for (uint row = 0; row < width; row++) {
        __global real *at = strip.cells + row * strip.pitch;
        for (uint i = 0; i < strip.columns / LANES; i++) {
            store_global(at, i,
                         load_global(at, i) + load_global(at + n * strip.pitch, i) + (realv)mean);
        }
    }
}

/* Gains of the frequencies of a tile, nothing beyond K. Frequencies are twice what they should be,
 * nufft/transform/halves.h. */
static inline realv gains_of_tile(__global const real *gains, const uint k, const uint K) {
    real of[LANES];
    for (uint i = 0; i < LANES; i++) {
        of[i] = k + i <= K ? (real)0.25 * gains[min(k + i, K)] : (real)0;
    }
    return LOADV(0, of);
}

static inline void write_tile(__global const real *row, const transform_axis axis,
                              const realv gains, __global real *power) {
    for (uint i = 0; i < 2 * axis.K + 1; i++) {
        const complexv z = kept_frequency(row, axis, i);
        const real gain = axis.gains[i >= axis.K ? i - axis.K : axis.K - i];
        store_global(power, i, fma(z.re, z.re, z.im * z.im) * (gains * (realv)gain));
    }
}

__kernel void nufft_strips(
    const strips_numbers numbers, __global const ulong *restrict places,
    __global const ulong *restrict sorted, __global const real *restrict heights,
    __global const uint *restrict starts, __global const real *restrict across_window,
    __global const real *restrict along_window, __global const uint *restrict first_radices,
    __global const real *restrict first_twiddles, __global const uint *restrict first_position,
    __global const real *restrict first_gains, __global const uint *restrict second_radices,
    __global const real *restrict second_twiddles, __global const uint *restrict second_position,
    __global const real *restrict second_gains, __global const real *restrict means,
    __global const real *restrict scales, __global real *restrict power,
    __global real *restrict strips, __global real *restrict tiles, __local real *windows,
    __local uint *cells) {
    const uint n = numbers.along.n, K = numbers.K, num_tiles = numbers.num_tiles;
    const uint columns = numbers.columns, num_strips = n / columns;
    const size_t group = get_global_id(1), tile_reals = (size_t)n * 2 * LANES;
    const window_axis across = make_chunk_window(across_window, numbers.across, 0);
    const window_axis along = make_chunk_window(along_window, numbers.along, 1);
    const transform_axis first = {first_radices, first_twiddles, first_position, 0, across.n, K};
    const transform_axis second = {
        second_radices, second_twiddles, second_position, second_gains, n, K};
    const strip_place strip = {strips + group * numbers.strip_reals, numbers.pitch,
                               across.n + across.width, columns};
    __global real *own_tiles = tiles + group * num_tiles * tile_reals;
    const chunk_axes axes = {across, along, 2};
    const chunk chunk = make_chunk(windows, cells, across, along);
    const uint parts = columns / (2 * LANES); /* of a strip, transformed side by side */
    for (size_t r = group; r < numbers.num_realizations; r += get_global_size(1)) {
        __global const uint *start = starts + r * ((size_t)n + 2);
        const real mean = means[r], scale = scales[numbers.first_row + r];
        __global real *to = power + (numbers.first_row + r) * numbers.stride;
        /* The last strip for what it leaves, parts of all strips, tiles: one loop, since a second
         * copy of all transforms takes the compiler seconds. */
        const uint all_parts = num_strips * parts;
        for (uint step = 0; step < 1 + all_parts + num_tiles; step++) {
            const bool is_part = step <= all_parts;
            const uint part = step == 0 ? 0 : (step - 1) % parts, tile = step - 1 - all_parts;
            const uint which = step == 0 ? num_strips - 1 : (step - 1) / parts;
            __global real *at =
                is_part ? strip.cells + part * 2 * LANES : own_tiles + tile * tile_reals;
            if (step == 0) {
                clear_strip(strip, mean);
            } else if (is_part && part == 0) {
                go_on(strip, mean);
            }
            if (is_part && part == 0) {
                add_places(strip, chunk, sorted, heights, places[r] + start[which * columns],
                           places[r] + start[(which + 1) * columns], which * columns, axes);
                fold_strip(strip, mean, across.width, across.n);
            }
            if (step == 0) {
                continue;
            }
            const transform_axis axis = is_part ? first : second;
            fft_transform(at, is_part ? strip.pitch : 2 * LANES, axis.n, axis.radices,
                          axis.twiddles);
            for (uint t = 0; is_part && t < num_tiles; t++) {
                turn_halves(at, strip.pitch, first, t * LANES,
                            own_tiles + t * tile_reals +
                                (which * columns + part * 2 * LANES) * (size_t)(2 * LANES));
            }
            if (!is_part) {
                write_tile(at, second, gains_of_tile(first_gains, tile * LANES, K) * (realv)scale,
                           to + tile * (2 * (size_t)K + 1) * LANES);
            }
        }
    }
}
