/* Farthest-point optimisation (Schloemer, Heck, Deussen 2011) on the torus of the plane: each point
 * in turn, in an order drawn once, goes to the place that is farthest from all others, until the
 * least distance of two points is large enough (docs/samplers/optimized.md#fpo).
 */
#ifndef PS_SAMPLERS_OPTIMIZED_FPO_H
#define PS_SAMPLERS_OPTIMIZED_FPO_H

#include "base/watch.h"
#include "math/random/random.h"

#include <stddef.h>

/* Least distances that may be asked for, in units of hexagonal packing's. Above the second, passes
 * grow into thousands. */
#define PS_FPO_LEAST_DISTANCE 0.5
#define PS_FPO_MOST_DISTANCE 0.93
/* Passes after which it ends with what there is. */
enum { PS_FPO_MOST_PASSES = 10000 };

typedef struct ps_fpo_outcome {
    unsigned passes;     /* over all points */
    size_t moves;        /* of points to another place, in all passes */
    double distance;     /* the least of two points, in units of hexagonal packing's */
    double mean_nearest; /* the mean distance to the nearest point, in the same units */
} ps_fpo_outcome;

/* Refuses a number of points and a distance outside the limits with a sentence. */
pspec_status ps_fpo_check(size_t num, double distance, ps_error *error) PS_MUST_CHECK;

/* Points [num][2], from uniform random ones, to that least distance: below it only where no point
 * has a better place any more, which few points come to. */
pspec_status ps_fpo_make(size_t num, double distance, ps_random *random, const ps_watch *watch,
                         double *points, ps_error *error) PS_MUST_CHECK;

/* The same from points [num][2] as they are, in an order drawn from random; they come back in
 * another. outcome may be NULL. PSPEC_ERROR_INPUT where two points coincide. */
pspec_status ps_fpo_optimise(size_t num, double distance, ps_random *random, const ps_watch *watch,
                             double *points, ps_fpo_outcome *outcome,
                             ps_error *error) PS_MUST_CHECK;

#endif
