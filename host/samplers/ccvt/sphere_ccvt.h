/* Capacity-constrained tessellation of the sphere: angles as distances, and as background the
 * spherical Fibonacci points, rotated at random, whose power is near 0 at low degrees. Of random
 * ones the power of sites ends at 1/M (docs/samplers/optimized.md#ccvt).
 */
#ifndef PS_SAMPLERS_CCVT_SPHERE_CCVT_H
#define PS_SAMPLERS_CCVT_SPHERE_CCVT_H

#include "math/random/random.h"
#include "samplers/ccvt/ccvt.h"

enum { PS_SPHERE_CCVT_LEAST_POINTS = 2 };

extern const ps_ccvt_space ps_sphere_ccvt_space;

/* Sites at random and the background, before anything is optimised. ps_ccvt_destroy also after an
 * error. */
pspec_status ps_sphere_ccvt_create(ps_ccvt *ccvt, size_t num, size_t capacity, ps_random *random,
                                   const ps_watch *watch, ps_error *error) PS_MUST_CHECK;

/* Unit vectors [num][3]. outcome may be NULL. */
pspec_status ps_sphere_ccvt_make(size_t num, size_t capacity, ps_random *random,
                                 const ps_watch *watch, double *points, ps_ccvt_outcome *outcome,
                                 ps_error *error) PS_MUST_CHECK;

#endif
