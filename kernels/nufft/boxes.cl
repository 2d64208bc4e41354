/* Points of one large set in two or three dimensions spread on the whole fine grid, as real
 * numbers, a box of cells by each work-group, in local memory with the cells behind it that windows
 * touch. A launch has the boxes of one colour, which share no cell; others come before or after it,
 * so that every cell is added to in the same order. Launch: (work-items of one group, boxes of the
 * colour).
 *
 *   places, sorted, heights  of nufft/sort.cl, in parts
 *   starts    [part][box + 2]: places in the order of boxes
 *   numbers   boxes_numbers of nufft/boxes.h: in two dimensions axes 1 and 2 are those of the points
 *   windows_0, windows_1, windows_2  coefficients of nufft/window.h
 *   high, low [cell of axis 0][cell of axis 1][cell of axis 2]: numbers, with PAIRS pairs of them;
 *             without, low is not touched; in this launch some cells of the first axis
 *   box       local, [..][rows][pitch], where windows of axis 2 end within the pitch
 *   windows, cells  local, of a chunk
 */
#include "nufft/boxes.h"
#include "nufft/chunk.h"
#include "shared/ahead.h"
#include "shared/pair.h"

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

static inline box_chunk make_box_chunk(__local real *windows, __local uint *cells,
                                       const boxes_numbers numbers) {
    __local real *second = windows + CHUNK * numbers.axes[0].window.bins;
    __local real *third = second + CHUNK * numbers.axes[1].window.bins;
    __local real *centres = third + CHUNK * numbers.axes[2].window.bins;
    return (box_chunk){{windows, second, third}, centres, centres + BOX_AXES * CHUNK, cells};
}

/* ---- windows -------------------------------------------------------------------------------- */

/* LANES places from the points that `from` begins with, `num` of them at most. */
static inline void place_in_box(const box_chunk to, const uint part, __global const ulong *from,
                                const uint num, const realv weights, const box_place place,
                                const boxes_numbers numbers) {
    uintv cells = 0;
#pragma unroll
    for (uint axis = FIRST; axis < BOX_AXES; axis++) {
        const window_numbers window = numbers.axes[axis].window;
        const uint apart = axis == 0 ? 1 : axis == 1 ? numbers.rows : numbers.pitch;
        const ulongv x = load_some_coordinates(from, DIMENSION, axis - FIRST, num);
        wordv fractions;
        const uintv first = first_cells(x, window.n, window.width, &fractions);
        cells = cells * (uintv)apart + first - (uintv)place.begin[axis];
        store_local(to.centres + axis * CHUNK, part, centred_fractions(fractions));
    }
    store_local(FIRST == 0 ? to.weights : to.window[0], part, weights);
    *(__local unaligned_uintv *)(to.cells + part * LANES) = cells;
}

/* Windows of the first `count` points at least. */
static inline void make_box_windows(const box_chunk to, const uint count,
                                    const window_axis axes[BOX_AXES]) {
    const uint parts = (count + LANES - 1) / LANES;
    for (uint axis = FIRST; axis < BOX_AXES - 1; axis++) {
        const uint jobs = (axes[axis].width + 3) / 4 * parts; /* two pairs of bins */
        for (uint job = own_item(); job < jobs; job += num_items()) {
            const uint part = job % parts;
            const realv weight = axis == 0 ? load_local(to.weights, part) : (realv)1;
            make_two_pairs(axes[axis], job / parts * 2, load_local(to.centres + axis * CHUNK, part),
                           weight, to.window[axis] + part * LANES, CHUNK);
        }
    }
    for (uint i = 4 * own_item(); i < count; i += 4 * num_items()) {
        make_row_windows(axes[2], to.centres + 2 * CHUNK + i, to.window[2] + i * axes[2].bins);
    }
}

static inline void fill_box_chunk(const box_chunk to, __global const ulong *points,
                                  __global const real *weights, const uint count,
                                  const box_place place, const window_axis axes[BOX_AXES],
                                  const boxes_numbers numbers) {
    for (uint part = own_item(); part * LANES < count; part += num_items()) {
        const uint begin = part * LANES, num = count - begin;
        const realv few =
            num >= LANES ? load_global(weights + begin, 0) : load_few_weights(weights + begin, num);
        place_in_box(to, part, points + (size_t)begin * DIMENSION, num, few, place, numbers);
    }
    GROUP_BARRIER(CLK_LOCAL_MEM_FENCE);
    make_box_windows(to, count, axes);
    GROUP_BARRIER(CLK_LOCAL_MEM_FENCE);
}

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

/* ---- a box ---------------------------------------------------------------------------------- */

/* The own box, and its number among all. */
static inline uint find_box(box_place *place, const boxes_numbers numbers) {
    uint rest = (uint)get_global_id(1), number = 0, each = 1;
    place->begin[0] = 0;
    place->size[0] = 1;
    for (uint i = BOX_AXES; i-- > FIRST;) {
        const box_axis axis = numbers.axes[i];
        const uint num = axis.boxes / axis.colours;
        const uint box = rest % num * axis.colours + axis.colour;
        place->begin[i] = box_begin(box, axis.per_cell);
        place->size[i] = box_begin(box + 1, axis.per_cell) - place->begin[i];
        number += box * each;
        each *= axis.boxes;
        rest /= num;
    }
    return number;
}

/* Does a window that begins in the box touch the cells of the first axis that are there? */
static inline bool is_there(const box_place place, const boxes_numbers numbers) {
    const window_numbers window = numbers.axes[FIRST].window;
    for (uint i = 0; i < place.size[FIRST] + window.width - 1; i++) {
        if ((place.begin[FIRST] + i) % window.n - numbers.first_row < numbers.num_rows) {
            return true;
        }
    }
    return false;
}

__kernel void
nufft_boxes(const boxes_numbers numbers, __global const ulong *restrict places,
            __global const ulong *restrict sorted, __global const real *restrict heights,
            __global const uint *restrict starts, __global const real *restrict windows_0,
            __global const real *restrict windows_1, __global const real *restrict windows_2,
            __global real *restrict high, __global real *restrict low, __local real *box,
            __local real *windows, __local uint *cells) {
    const window_axis axes[BOX_AXES] = {make_chunk_window(windows_0, numbers.axes[0].window, 0),
                                        make_chunk_window(windows_1, numbers.axes[1].window, 0),
                                        make_chunk_window(windows_2, numbers.axes[2].window, 0)};
    const box_chunk chunk = make_box_chunk(windows, cells, numbers);
    const size_t num_boxes =
        (size_t)numbers.axes[0].boxes * numbers.axes[1].boxes * numbers.axes[2].boxes;
    box_place place;
    const uint own = find_box(&place, numbers);
    if (!is_there(place, numbers)) {
        return;
    }
    const uint num = (place.size[0] + axes[0].width - 1) * numbers.rows * numbers.pitch;
    for (uint i = own_item(); i < num; i += num_items()) {
        box[i] = 0;
    }
    GROUP_BARRIER(CLK_LOCAL_MEM_FENCE);
    for (uint part = 0; part < numbers.num_parts; part++) {
        __global const uint *start = starts + part * (num_boxes + 2) + own;
        const size_t end = places[part] + start[1];
        for (size_t at = places[part] + start[0]; at < end; at += CHUNK) {
            const uint count = (uint)min((size_t)CHUNK, end - at);
            fill_box_chunk(chunk, sorted + at * DIMENSION, heights + at, count, place, axes,
                           numbers);
            if (num_items() == 1) {
                add_points_alone(box, chunk, count, numbers);
            } else {
                add_points_together(box, chunk, count, numbers);
            }
            GROUP_BARRIER(CLK_LOCAL_MEM_FENCE);
        }
    }
    add_box(high, low, box, place, numbers);
}
