/* The pixel of an image that a point is in. The table has the pixels, the last axis fastest; their
 * places are numbers of the precision: at most 2^24 of them in single precision. */
#ifndef PS_INTEGRANDS_PIXELS_H
#define PS_INTEGRANDS_PIXELS_H

#include "integrands/table.h"

enum { PIXELS_SIDES = 0 }; /* place among the numbers, of the pixels along each axis */
#define pixels_has_table 1

static inline realv pixels_value(const realv *x, const unsigned dimension, const real *numbers,
                                 TABLE *table) {
    realv place = 0;
    FOR_AXES(unsigned i = 0; i < dimension; i++) {
        const real side = numbers[PIXELS_SIDES + i];
        const realv at = TO_REALV(TO_SWORDV(x[i] * side));
        place = place * side + (at < side ? at : (realv)(side - 1)); /* it may be rounded up */
    }
    return table_look_up(table, place);
}

#endif
