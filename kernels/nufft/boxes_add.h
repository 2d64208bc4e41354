/* From the windows of a chunk of points into a box, and from a box to the grid. Device only; the
 * rest of it is in nufft/boxes.cl, which includes this. */
#ifndef PS_NUFFT_BOXES_ADD_H
#define PS_NUFFT_BOXES_ADD_H

#include "nufft/boxes.h"
#include "nufft/chunk.h"
#include "shared/ahead.h"

/* Rows of the grid that are fetched ahead; 2 and 8 take as long. */
#define AHEAD_ROWS 4

typedef PS_JOIN(REAL, 2) real2;
typedef real2 unaligned_real2 __attribute__((aligned(sizeof(real))));

#ifndef DIMENSION
#define DIMENSION 3
#endif

/* The first axis that there is. */
#define FIRST (BOX_AXES - DIMENSION)

/* Sums of chunks are added up in pairs of numbers. */
#ifndef PAIRS
#define PAIRS 0
#endif

/* Local memory of a chunk: windows of axes 0 and 1 [bins][CHUNK], the first times the weights, and
 * of axis 2 [CHUNK][bins]. In two dimensions the first are the weights. */
typedef struct box_chunk {
    __local real *window[BOX_AXES];
    __local real *centres; /* [axis][CHUNK]: where windows are made */
    __local real *weights; /* [CHUNK] */
    __local uint *cells;   /* [CHUNK]: the first in the box */
} box_chunk;

/* Where a box begins, and how many cells it has. */
typedef struct box_place {
    uint begin[BOX_AXES], size[BOX_AXES];
} box_place;

/* ---- adding --------------------------------------------------------------------------------- */

/* A point by one work-item: for each cell of axis 0 rows of axis 1, as those of nufft/chunk.h. */
#define ADD_POINT(CELLS, BINS)                                                                     \
    static inline void add_point_##CELLS(__local real *at, const box_chunk from, const uint i,     \
                                         const boxes_numbers numbers) {                            \
        const uint across = numbers.axes[1].window.width, plane = numbers.rows * numbers.pitch;    \
        const real##BINS along =                                                                   \
            *(__local const unaligned_real##BINS *)(from.window[2] + i * BINS);                    \
        for (uint bin = 0; bin < numbers.axes[0].window.width; bin++) {                            \
            const real##BINS values = along * (real##BINS)from.window[0][bin * CHUNK + i];         \
            add_local_values_##CELLS(at + bin * plane, numbers.pitch, from.window[1] + i, values,  \
                                     across);                                                      \
        }                                                                                          \
    }

ADD_POINT(8, 8)
ADD_POINT(12, 16)
ADD_POINT(16, 16)

static inline void add_points_alone(__local real *box, const box_chunk from, const uint count,
                                    const boxes_numbers numbers) {
    const uint width = numbers.axes[2].window.width;
    for (uint i = 0; i < count; i++) {
        if (width <= 8) {
            add_point_8(box + from.cells[i], from, i, numbers);
        } else if (PRECISION == 64 && width <= 12) {
            add_point_12(box + from.cells[i], from, i, numbers);
        } else {
            add_point_16(box + from.cells[i], from, i, numbers);
        }
    }
}

/* The same by all work-items: each has the rows of axis 1 that are its number modulo their number.
 * */
static inline void add_points_together(__local real *box, const box_chunk from, const uint count,
                                       const boxes_numbers numbers) {
    const uint size = get_local_size(0), pitch = numbers.pitch;
    const uint bins = numbers.axes[2].window.bins;
    for (uint i = 0; i < count; i++) {
        const uint first = from.cells[i] / pitch;
        __local const real *along = from.window[2] + i * bins;
        for (uint bin = 0; bin < numbers.axes[0].window.width; bin++) {
            const uint row = first + bin * numbers.rows;
            const real weight = from.window[0][bin * CHUNK + i];
            for (uint own = (get_local_id(0) + size - row % size) % size;
                 own < numbers.axes[1].window.width; own += size) {
                __local real *at = box + from.cells[i] + (bin * numbers.rows + own) * pitch;
                const real across = from.window[1][own * CHUNK + i];
                for (uint j = 0; j < bins; j++) {
                    at[j] = fma(across, along[j] * weight, at[j]);
                }
            }
        }
    }
}

/* ---- the grid ------------------------------------------------------------------------------- */

/* pair_add of shared/pair.h for one number. */
static inline void add_number(__global real *high, __global real *low, const real x) {
#if PAIRS
    const real before = *high, sum = before + x, x_part = sum - before;
    *low += (before - (sum - x_part)) + (x - x_part);
    *high = sum;
#else
    (void)low;
    *high += x;
#endif
}

#if PAIRS
#define ADD_VECTOR(TYPE)                                                                           \
    {                                                                                              \
        const TYPE x = *(__local const unaligned_##TYPE *)(from + i);                              \
        const TYPE before = *(__global const unaligned_##TYPE *)(high + i);                        \
        const TYPE sum = before + x, x_part = sum - before;                                        \
        *(__global unaligned_##TYPE *)(high + i) = sum;                                            \
        *(__global unaligned_##TYPE *)(low + i) += (before - (sum - x_part)) + (x - x_part);       \
    }
#else
#define ADD_VECTOR(TYPE)                                                                           \
    *(__global unaligned_##TYPE *)(high + i) += *(__local const unaligned_##TYPE *)(from + i);
#endif

/* Vectors as long as they fit, and then numbers one by one: what follows may be another
 * work-group's. */
static inline void add_numbers(__global real *high, __global real *low, __local const real *from,
                               const uint num) {
    uint i = 0;
    for (; i + 16 <= num; i += 16) {
        ADD_VECTOR(real16)
    }
    if (i + 8 <= num) {
        ADD_VECTOR(real8)
        i += 8;
    }
    for (; i + 2 <= num; i += 2) {
        ADD_VECTOR(real2)
    }
    if (i < num) {
        add_number(high + i, low + i, from[i]);
    }
}

/* A row of a box: cells behind the end of the grid's row are its first ones again. */
static inline void add_row(__global real *high, __global real *low, __local real *row,
                           const uint begin, const uint num, const uint n) {
    const uint kept = min(num, n);
    if (num_items() > 1) {
        for (uint i = own_item(); i < kept; i += num_items()) {
            const uint at = (begin + i) % n;
            add_number(high + at, low + at, i + n < num ? row[i] + row[i + n] : row[i]);
        }
        return;
    }
    for (uint i = n; i < num; i++) {
        row[i - n] += row[i];
    }
    const uint before = min(kept, n - begin);
    add_numbers(high + begin, low + begin, row, before);
    add_numbers(high, low, row + before, kept - before);
}

/* Where a cell of axis 0 and one of axis 1 have their row in this launch; false: nowhere. */
static inline bool find_row(size_t *row, const uint cell, const uint next,
                            const boxes_numbers numbers) {
    const uint at = (FIRST == 0 ? cell : next) - numbers.first_row;
    *row = FIRST == 0 ? (size_t)at * numbers.axes[1].window.n + next : at;
    return at < numbers.num_rows;
}

static inline void add_box(__global real *high, __global real *low, __local real *box,
                           const box_place place, const boxes_numbers numbers) {
    const window_numbers first = numbers.axes[0].window, second = numbers.axes[1].window;
    const window_numbers last = numbers.axes[2].window;
    for (uint i = 0; i < place.size[0] + first.width - 1; i++) {
        for (uint j = 0; j < place.size[1] + second.width - 1; j++) {
            size_t row;
            if (!find_row(&row, (place.begin[0] + i) % first.n, (place.begin[1] + j) % second.n,
                          numbers)) {
                continue;
            }
            row *= last.n;
            for (uint k = 0; k < numbers.pitch; k += 64 / sizeof(real)) {
                will_write(high + row + AHEAD_ROWS * last.n + place.begin[2] + k);
            }
            add_row(high + row, low + row, box + (i * numbers.rows + j) * numbers.pitch,
                    place.begin[2], place.size[2] + last.width - 1, last.n);
        }
    }
}

#endif
