/* Maximal Poisson disk points of the torus: uniform random points in turn, each refused that is
 * nearer than the radius to an earlier one, until no place is left. The distribution is that of
 * plain dart throwing to saturation (M. S. Ebeida et al., "A simple algorithm for maximal
 * Poisson-disk sampling in high dimensions", 2012).
 */
#ifndef PS_SAMPLERS_DARTS_POISSON_DISK_H
#define PS_SAMPLERS_DARTS_POISSON_DISK_H

#include "samplers/darts/blue_noise.h"

/* Is the radius possible? */
pspec_status ps_poisson_disk_check(const ps_blue_noise *asked, ps_error *error) PS_MUST_CHECK;

/* d = 2 or 3. Points [num_points][d] in the order of their acceptance. */
pspec_status ps_poisson_disk_points(const ps_blue_noise *asked, ps_random *random, double *points,
                                    size_t *num_points, ps_error *error) PS_MUST_CHECK;

#endif
