/* A pass of the transform of the grid: lines along one axis, or one of the two halves of it
 * where lines are long. Launch: (ITEMS, groups of LINES lines, sets). Numbers of line (outer,
 * inner) of a set stand at (outer N + i) numbers.inner + inner.
 *
 *   FROM   0: numbers are [set][from_stride] complex; 1: cells, from the tiles of nufft/grid/spread.cl
 *   TO     0: frequencies that are kept, divided by their window; 1: their powers; 2: all numbers, times
 *          the roots that are between the two halves of an axis
 *   IS_HALF  frequencies 0 .. K are kept, else -K .. K
 *
 *   numbers  grid_lines_numbers of nufft/grid/grid.h
 *   from, high, low  what is read, by FROM
 *   means    [set]: taken off every cell: frequency 0
 *   roots    [N][cosine, sine] of nufft/grid/stockham.h
 *   turns    the same of the whole axis, of n
 *   gains    [K + 1]: 1 / transform of the window
 *   scales   [realization]
 *   to       [set][to_stride]: [outer][frequency][inner] complex
 *   power    [realization][to_stride]: [frequency][inner]
 *   lines    local, [LINES][LINE_REALS]
 */
#define LANES 1
#include "nufft/grid/sides.h"
#include "nufft/grid/stockham.h"
#include "shared/pair.h"

#ifndef FROM
#define FROM 0
#endif
#ifndef TO
#define TO 0
#endif
#ifndef IS_HALF
#define IS_HALF 1
#endif
/* Cells of the last two axes, to find a cell by its number. */
#ifndef CELLS_1
#define CELLS_1 16
#endif
#ifndef CELLS_2
#define CELLS_2 16
#endif

typedef struct line_data {
    const grid_lines_numbers *numbers;
    __global const real *from, *high, *low, *turns, *gains;
    __global real *to;
    real mean, scale;
} line_data;

#if FROM
/* The box `back` boxes in front, around the axis. */
static inline uint box_before(const uint box, const uint back, const uint boxes) {
    return box >= back ? box - back : box + boxes - back;
}

/* A cell: its own box, then those in front whose windows reach it, in order. */
static inline real load_cell(const line_data *all, const uint cell) {
    const grid_lines_numbers *const numbers = all->numbers;
    const uint z = cell % CELLS_2, y = cell / CELLS_2 % CELLS_1, x = cell / CELLS_2 / CELLS_1;
    const uint boxes_1 = numbers->boxes[1], boxes_2 = numbers->boxes[2];
    real high = -all->mean, low = 0;
    for (uint i = 0; x % EDGE_0 + i * EDGE_0 < SIDE_0; i++) {
        const uint box_x = box_before(x / EDGE_0, i, numbers->boxes[0]);
        for (uint j = 0; y % EDGE_1 + j * EDGE_1 < SIDE_1; j++) {
            const uint box_xy = box_x * boxes_1 + box_before(y / EDGE_1, j, boxes_1);
            const uint row = (x % EDGE_0 + i * EDGE_0) * SIDE_1 + y % EDGE_1 + j * EDGE_1;
            for (uint k = 0; z % EDGE_2 + k * EDGE_2 < SIDE_2; k++) {
                const size_t box = box_xy * (size_t)boxes_2 + box_before(z / EDGE_2, k, boxes_2);
                const size_t at = box * TILE_CELLS + row * SIDE_2 + z % EDGE_2 + k * EDGE_2;
                pair_add(&high, &low, all->high[at]);
                low += PAIRS ? all->low[at] : 0;
            }
        }
    }
    return high + low;
}
#endif

static inline complexv load_number(const line_data *all, const size_t line, const uint i) {
    const ulong inner = all->numbers->inner;
    const size_t at = (line / inner * N + i) * inner + line % inner;
#if FROM
    return (complexv){load_cell(all, (uint)at), 0};
#else
    return (complexv){all->from[2 * at], all->from[2 * at + 1]};
#endif
}

static inline void store_number(const line_data *all, const size_t line, const uint q,
                                const complexv z) {
    const grid_lines_numbers *numbers = all->numbers;
    const ulong outer = line / numbers->inner, inner = line % numbers->inner;
#if TO == 2
    const uint turn = (uint)(inner / numbers->neighbours) * q;
    const complexv turned =
        complex_multiply(z, all->turns[2 * (size_t)turn], all->turns[2 * (size_t)turn + 1]);
    const size_t at = (outer * N + q) * numbers->inner + inner;
    all->to[2 * at] = turned.re;
    all->to[2 * at + 1] = turned.im;
#else
    const uint n = numbers->n, K = numbers->K;
    const uint k = (uint)(outer % numbers->apart) + numbers->apart * q;
    const bool is_below = k >= (IS_HALF ? n : n - K);
    if (k > K && !is_below) {
        return;
    }
    const uint kept = IS_HALF ? k : is_below ? k - (n - K) : K + k;
    const size_t width = IS_HALF ? K + 1 : 2 * K + 1;
    const size_t at = (outer / numbers->apart * width + kept) * numbers->inner + inner;
    const real gain = all->gains[is_below ? n - k : k];
    const real re = z.re * gain, im = z.im * gain;
#if TO == 1
    all->to[at] = fma(re, re, im * im) * all->scale;
#else
    all->to[2 * at] = re;
    all->to[2 * at + 1] = im;
#endif
#endif
}

#include "nufft/grid/line_pass.h"

__kernel void
nufft_grid_lines(const grid_lines_numbers numbers, __global const real *restrict from,
                 __global const real *restrict high, __global const real *restrict low,
                 __global const real *restrict means, __global const real *restrict roots,
                 __global const real *restrict turns, __global const real *restrict gains,
                 __global const real *restrict scales, __global real *restrict to,
                 __global real *restrict power, __local real *lines) {
    const size_t set = get_global_id(2), row = numbers.first_row + set;
    const size_t tiles = set * numbers.boxes[0] * numbers.boxes[1] * numbers.boxes[2] * TILE_CELLS;
    const line_data all = {&numbers,
                           from + 2 * set * numbers.from_stride,
                           high + tiles,
                           PAIRS ? low + tiles : low,
                           turns,
                           gains,
                           TO == 1 ? power + row * numbers.to_stride
                                   : to + 2 * set * numbers.to_stride,
                           FROM ? means[set] : 0,
                           TO == 1 ? scales[row] : 0};
    pass_lines(&all, get_global_id(1) * LINES, numbers.lines, roots, lines);
}
