/* An image on the torus: linear between the centres of its pixels, x[0] down and x[1] to the right,
 * as host/images/torus_map.h says. The table has the bytes of the pixels. Places in it are whole
 * numbers of the device, so that images of any size are looked up in single precision, too, where
 * a coordinate is off by 6e-8 of a side. */
#ifndef PS_INTEGRANDS_TORUS_MAP_H
#define PS_INTEGRANDS_TORUS_MAP_H

#include "images/pixel.h"
#include "integrands/table.h"

/* places among the numbers */
enum { TORUS_MAP_WIDTH = 0, TORUS_MAP_HEIGHT = 1, TORUS_MAP_BYTES = 2 };
#define torus_map_has_table 1

/* Pixels of rows and columns, each lane its own. */
static inline realv torus_map_look_up(const realv rows, const realv columns, const real *numbers,
                                      TABLE *table) {
    PIXELS *const pixels = (PIXELS *)table;
    const size_t width = (size_t)numbers[TORUS_MAP_WIDTH];
    const unsigned bytes = (unsigned)numbers[TORUS_MAP_BYTES];
#ifdef __OPENCL_C_VERSION__
    real row[LANES], column[LANES];
    STOREV(rows, 0, row);
    STOREV(columns, 0, column);
    FOR_AXES(uint i = 0; i < LANES; i++) {
        row[i] = pixel_at(pixels, (size_t)row[i] * width + (size_t)column[i], bytes);
    }
    return LOADV(0, row);
#else
    return pixel_at(pixels, (size_t)rows * width + (size_t)columns, bytes);
#endif
}

/* How far x is beyond a centre along an axis of `side` pixels, which is number *cell there; *next
 * is the one behind it. */
static inline realv torus_map_share(const realv x, const real side, realv *cell, realv *next) {
    realv at = x * side - (real)0.5;
    at += at < (realv)0 ? (realv)side : (realv)0;
    at -= at >= (realv)side ? (realv)side : (realv)0;
    *cell = TO_REALV(TO_SWORDV(at));
    *next = *cell + 1 < (realv)side ? *cell + 1 : (realv)0;
    return at - *cell;
}

static inline realv torus_map_value(const realv *x, const unsigned dimension, const real *numbers,
                                    TABLE *table) {
    realv row = 0, below = 0, column = 0, right = 0;
    const realv down = torus_map_share(x[0], numbers[TORUS_MAP_HEIGHT], &row, &below);
    const realv across = torus_map_share(x[1], numbers[TORUS_MAP_WIDTH], &column, &right);
    (void)dimension;
    const realv first = torus_map_look_up(row, column, numbers, table) * (1 - across) +
                        torus_map_look_up(row, right, numbers, table) * across;
    const realv second = torus_map_look_up(below, column, numbers, table) * (1 - across) +
                         torus_map_look_up(below, right, numbers, table) * across;
    return first * (1 - down) + second * down;
}

#endif
