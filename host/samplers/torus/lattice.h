/* Points j z / N mod 1 of a lattice of rank 1, in whole numbers until the last division. */
#ifndef PS_SAMPLERS_TORUS_LATTICE_H
#define PS_SAMPLERS_TORUS_LATTICE_H

#include "samplers/sampler.h"

/* N up to which j z_i / N is right to the last digit, and below 1. */
#define PS_LATTICE_MOST_POINTS ((uint64_t)1 << 40)

/* z[dimension] of the request. */
pspec_status ps_lattice_generate(const ps_sampler_request *request,
                                 const uint64_t z[PS_MAX_DIMENSION], double *points,
                                 ps_error *error) PS_MUST_CHECK;
/* The second component of (1, z): the whole number nearest to N / golden ratio that has no divisor
 * in common with N. Of a Fibonacci number it is the one before. */
uint64_t ps_lattice_golden(uint64_t num_points);

#endif
