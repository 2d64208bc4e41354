/* 1 where n.x is below an offset, x in the cell [0,1)^2, else 0: jumps at the edges of the cell,
 * too. */
#ifndef PS_INTEGRANDS_HALF_PLANE_H
#define PS_INTEGRANDS_HALF_PLANE_H

#include "shared/real.h"

enum { HALF_PLANE_NORMAL = 0, HALF_PLANE_OFFSET = 2 }; /* places among the numbers */

static inline realv half_plane_value(const realv *x, const unsigned dimension,
                                     const real *numbers) {
    const realv height = x[0] * numbers[HALF_PLANE_NORMAL] + x[1] * numbers[HALF_PLANE_NORMAL + 1];
    (void)dimension;
    return height < numbers[HALF_PLANE_OFFSET] ? (realv)1 : (realv)0;
}

#endif
