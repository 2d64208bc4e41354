/* Capacity-constrained tessellation of the sphere: angles as distances, and as background the
 * spherical Fibonacci points, rotated at random, whose power is near 0 at low degrees. Of random
 * ones the power of sites ends at 1/M (docs/samplers/optimized.md#ccvt).
 */
#ifndef PS_SAMPLERS_CCVT_SPHERE_CCVT_H
#define PS_SAMPLERS_CCVT_SPHERE_CCVT_H

#include "samplers/ccvt/ccvt.h"

enum { PS_SPHERE_CCVT_LEAST_POINTS = 2 };

extern const ps_ccvt_space ps_sphere_ccvt_space;

#endif
