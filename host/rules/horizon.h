/* The horizon of a normal that is not the axis of the lobe, as where a glossy surface is looked at
 * from aside: the lobe is about the mirror direction z, and light from below the horizon does not
 * reach it (docs/mathematics/quadrature.md#horizon). The part of the lobe that is cut away,
 *
 *     phat(u.z) where u.n < 0,
 *
 * as directions with weights: a rule for it, which takes the place of points below the horizon.
 */
#ifndef PS_RULES_HORIZON_H
#define PS_RULES_HORIZON_H

#include "integrands/lobes/brdf.h"

/* Between normal and axis, in degrees: beyond, the mirror direction itself is below. */
#define PS_MOST_VIEW 90

typedef struct ps_horizon {
    double normal[3];         /* n = (sin, 0, cos) of the angle between normal and axis */
    size_t num;               /* 0: nothing is cut away */
    double *points, *weights; /* [num][3], [num] */
    double share;             /* sum of the weights: how much of the lobe is below */
} ps_horizon;

/* degrees: 0 .. PS_MOST_VIEW. Integrals of polynomials up to max_degree are right to rounding;
 * lobes from tables are refused. *out is freed by ps_horizon_free, also after an error. */
pspec_status ps_horizon_make(ps_horizon *out, const ps_brdf *brdf, double degrees,
                             size_t max_degree, ps_error *error) PS_MUST_CHECK;
void ps_horizon_free(ps_horizon *horizon);

/* Is a direction on the side of the normal? */
bool ps_horizon_is_above(const ps_horizon *horizon, const double *u);

#endif
