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
#include "nufft/boxes_add.h"

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
