/* The hemisphere stretched over the sphere, for hemispherical harmonics. */
#ifndef PS_MATH_HEMISPHERE_H
#define PS_MATH_HEMISPHERE_H

#include <stdbool.h>

/* (x, y, z), z >= 0, of any length -> the unit vector of the same azimuth with height 2 z / |u| -
 * 1. Hemispherical harmonics are those of the sphere there, times sqrt(2): they are orthonormal on
 * the hemisphere (docs/mathematics/quadrature.md#hemispherical-harmonics). False below the
 * horizon. */
bool ps_hemisphere_stretch(const double *u, double *out);

#endif
