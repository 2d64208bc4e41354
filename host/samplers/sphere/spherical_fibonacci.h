/* Spherical Fibonacci points, which sphere and hemisphere share: azimuth j/Phi of a turn. */
#ifndef PS_SAMPLERS_SPHERE_SPHERICAL_FIBONACCI_H
#define PS_SAMPLERS_SPHERE_SPHERICAL_FIBONACCI_H

#include "samplers/sampler.h"

/* Point j, with z = 1 - (2j + 1)/num_heights: num_heights is their number for the sphere and twice
 * that for the hemisphere. */
void ps_fibonacci_point(size_t j, uint64_t num_heights, double *point);
/* Points j = first .. end - 1 of the array. */
void ps_fibonacci_points(size_t first, size_t end, uint64_t num_heights, double *points);
/* All points of a request. PSPEC_ERROR_CANCELLED where the watch asks to stop. */
pspec_status ps_fibonacci_generate(const ps_sampler_request *request, uint64_t num_heights,
                                   double *points, ps_error *error) PS_MUST_CHECK;

#endif
