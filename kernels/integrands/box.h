/* 1 inside of a box with its sides along the axes, each 1 at most, else 0. */
#ifndef PS_INTEGRANDS_BOX_H
#define PS_INTEGRANDS_BOX_H

#include "integrands/fold.h"

enum { BOX_CENTRE = 0, BOX_SIDES = 6 }; /* places among the numbers */
#define box_folds 1                     /* takes points of any cell */

static inline realv box_value(const realv *x, const unsigned dimension, const real *numbers) {
    realv inside = 1;
    FOR_AXES(unsigned i = 0; i < dimension; i++) {
        const realv difference = fold_difference(x[i], numbers[BOX_CENTRE + i]);
        inside = fabs(difference) < (real)0.5 * numbers[BOX_SIDES + i] ? inside : (realv)0;
    }
    return inside;
}

#endif
