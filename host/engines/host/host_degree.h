/* The referee on the sphere: spherical-harmonic coefficients of one degree in long double. */
#ifndef PS_ENGINES_HOST_HOST_DEGREE_H
#define PS_ENGINES_HOST_HOST_DEGREE_H

#include "engines/engine.h"

/* Room and constants for one degree; any number of patterns. */
typedef struct ps_host_degree {
    int32_t degree;
    long double *up, *down; /* [degree + 1] of the recurrence over orders */
    long double *values;    /* [degree + 1] Lambda_lm of a point */
    long double (*sums)[2]; /* [degree + 1] c_lm, m >= 0: real and imaginary parts */
} ps_host_degree;

pspec_status ps_host_degree_create(ps_host_degree *out, int32_t degree,
                                   ps_error *error) PS_MUST_CHECK;
void ps_host_degree_free(ps_host_degree *self);

/* sums[m] = c_lm = sum w Y_lm(u) of one pattern
 * (docs/mathematics/sphere.md#coefficients-and-power). */
void ps_host_degree_sum(ps_host_degree *self, const pspec_pattern *pattern);

/* Q(l) = (4 pi / (2l + 1)) sum_m |c_lm|^2 of what was summed last. */
long double ps_host_degree_power(const ps_host_degree *self);

#endif
