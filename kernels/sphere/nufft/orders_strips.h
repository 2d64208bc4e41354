/* The grid strip by strip: so many angles from the pole and all longitudes, small enough for the
 * cache of a core. Points come sorted by strips, and what their windows leave behind the end of one
 * is carried to the next. Device only.
 *
 * A grid that is small enough is one strip, whose points come in any order.
 */
#ifndef PS_SPHERE_ORDERS_STRIPS_H
#define PS_SPHERE_ORDERS_STRIPS_H

#include "sphere/nufft/orders_grid.h"

/* Points of a realization by strips `first` .. end - 1: strip s has points starts[s] .. starts[s +
 * 1]. Counting sort, stable, by one work-item: they are few, and cost little beside their windows.
 */
typedef struct strip_points {
    __global ulong *turns; /* [..][2], room for whole vectors */
    __global real *weights;
    __global uint *strips, *starts; /* [..], [end + 1]; strips: scratch, room for whole vectors */
} strip_points;

static inline void find_strips(const strip_points to, __global const ulong *turns,
                               const size_t place, const uint num, const window_axis along,
                               const uint strip, const uint first, const uint end) {
    union {
        uintv together;
        uint each[LANES];
    } column;
    wordv fraction;
    column.together = first_cells(load_some_coordinates(turns + place * 2, 2, along.axis, num),
                                  along.n, along.width, &fraction);
    for (uint i = 0; i < num; i++) {
        const uint own = column.each[i] / strip;
        to.strips[place + i] = own < first || own >= end ? end : own;
        to.starts[to.strips[place + i]]++;
    }
}

static inline void sort_by_strips(const strip_points to, __global const ulong *turns,
                                  __global const real *weights, const size_t num_points,
                                  const window_axis along, const uint strip, const uint first,
                                  const uint end) {
    for (uint i = first; i <= end; i++) {
        to.starts[i] = 0;
    }
    for (size_t place = 0; place < num_points; place += LANES) {
        const uint num = (uint)min((size_t)LANES, num_points - place);
        find_strips(to, turns, place, num, along, strip, first, end);
    }
    uint before = 0;
    for (uint i = first; i <= end; i++) { /* to the beginning of each, ... */
        const uint num = to.starts[i];
        to.starts[i] = before;
        before += num;
    }
    for (size_t i = 0; i < num_points; i++) { /* ... then to its end, ... */
        if (to.strips[i] < end) {
            const size_t place = to.starts[to.strips[i]]++;
            to.turns[place * 2] = turns[i * 2];
            to.turns[place * 2 + 1] = turns[i * 2 + 1];
            to.weights[place] = weights[i];
        }
    }
    for (uint i = end; i > first; i--) { /* ... which is where the next begins */
        to.starts[i] = to.starts[i - 1];
    }
    to.starts[first] = 0;
}

/* The first columns of the next strip are those from `strip` on; the others are cleared. strip =
 * pitch: all are. */
static inline void carry_cells(const orders_grid grid, const uint strip) {
    const uint kept = grid.pitch - strip;
    for (uint row = 0; row < grid.rows; row++) {
        __global real *cells = grid.cells + row * (size_t)grid.pitch;
        uint i = 0;
        for (; i < kept; i += LANES) {
            store_global(cells + i, 0, load_global(cells + i + strip, 0));
        }
        for (; i < grid.pitch; i += LANES) {
            store_global(cells + i, 0, (realv)0);
        }
    }
}

#endif
