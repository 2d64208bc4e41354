/* Bridson's Poisson disk points of the torus: each new point lies between one and two radii from an
 * earlier one, which is given up after so many tries in a row that failed (R. Bridson, "Fast
 * Poisson disk sampling in arbitrary dimensions", 2007). Not maximal: holes are left.
 */
#ifndef PS_SAMPLERS_DARTS_BRIDSON_H
#define PS_SAMPLERS_DARTS_BRIDSON_H

#include "samplers/darts/blue_noise.h"

/* Are radius and tries possible? */
pspec_status ps_bridson_check(const ps_blue_noise *asked, ps_error *error) PS_MUST_CHECK;

/* d = 2, 3 or 4. Points [num_points][d] in the order of their acceptance. */
pspec_status ps_bridson_points(const ps_blue_noise *asked, ps_random *random, double *points,
                               size_t *num_points, ps_error *error) PS_MUST_CHECK;

#endif
