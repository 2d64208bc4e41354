/* Spherical Fibonacci points, which sphere and hemisphere share: azimuth j/Phi of a turn. */
#ifndef PS_SAMPLERS_SPHERE_SPHERICAL_FIBONACCI_H
#define PS_SAMPLERS_SPHERE_SPHERICAL_FIBONACCI_H

#include <stddef.h>
#include <stdint.h>

/* 2^64 frac(j/Phi), Phi = (1 + sqrt 5)/2, rounded down or to the next whole number, for any j. */
uint64_t ps_fibonacci_fraction(uint64_t j);

/* Points j = 0 .. num_points - 1 with z = 1 - (2j + 1)/num_heights: num_heights is num_points for
 * the sphere and twice that for the hemisphere. */
void ps_fibonacci_points(size_t num_points, uint64_t num_heights, double *points);

#endif
