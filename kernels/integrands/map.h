/* Light from every direction: linear between the centres of the pixels of an equirectangular image,
 * as host/images/sphere_map.h says. The table has the rows, with one of each pole before and behind
 * them; places in it are numbers of the precision: at most 2^24 of them in single precision. */
#ifndef PS_INTEGRANDS_MAP_H
#define PS_INTEGRANDS_MAP_H

#include "integrands/table.h"

enum { MAP_WIDTH = 0, MAP_HEIGHT = 1 }; /* places among the numbers */
#define map_has_table 1

static inline realv map_value(const realv *x, const unsigned dimension, const real *numbers,
                              TABLE *table) {
    const real width = numbers[MAP_WIDTH], height = numbers[MAP_HEIGHT];
    const real per_turn = (real)0.15915494309189533577; /* 1/(2 pi) */
    const realv polar = atan2(sqrt(x[0] * x[0] + x[1] * x[1]), x[2]);
    const realv down = polar * (2 * per_turn * height) + (real)0.5; /* rows 1 to height */
    const realv row = TO_REALV(TO_SWORDV(down));
    realv share = down - row;
    share = row < (realv)1 ? 2 * share - 1 : share; /* poles are half a row away */
    share = row >= (realv)height ? 2 * share : share;
    share = fmin(fmax(share, (realv)0), (realv)1);
    realv along = atan2(x[1], x[0]) * (per_turn * width) - (real)0.5;
    along += along < (realv)0 ? (realv)width : (realv)0;
    along -= along >= (realv)width ? (realv)width : (realv)0;
    const realv column = TO_REALV(TO_SWORDV(along));
    const realv across = along - column;
    const realv next = column + 1 < (realv)width ? column + 1 : (realv)0;
    const realv place = row * width;
    (void)dimension;
    const realv above = table_look_up(table, place + column) * (1 - across) +
                        table_look_up(table, place + next) * across;
    const realv below = table_look_up(table, place + width + column) * (1 - across) +
                        table_look_up(table, place + width + next) * across;
    return above * (1 - share) + below * share;
}

#endif
