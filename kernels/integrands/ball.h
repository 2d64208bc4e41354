/* 1 inside of a ball of the torus of radius 1/2 at most, else 0. A point has one image in it at
 * most, the nearest. */
#ifndef PS_INTEGRANDS_BALL_H
#define PS_INTEGRANDS_BALL_H

#include "integrands/fold.h"

enum { BALL_CENTRE = 0, BALL_RADIUS = 6 }; /* places among the numbers */
#define ball_folds 1                       /* takes points of any cell */

static inline realv ball_value(const realv *x, const unsigned dimension, const real *numbers) {
    realv norm2 = 0;
    FOR_AXES(unsigned i = 0; i < dimension; i++) {
        const realv difference = fold_difference(x[i], numbers[BALL_CENTRE + i]);
        norm2 += difference * difference;
    }
    const real radius = numbers[BALL_RADIUS];
    return norm2 < radius * radius ? (realv)1 : (realv)0;
}

#endif
