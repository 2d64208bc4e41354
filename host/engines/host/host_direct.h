/* host_direct: the referee. Direct sums in long double on the host, phases exact, no device. */
#ifndef PS_ENGINES_HOST_HOST_DIRECT_H
#define PS_ENGINES_HOST_HOST_DIRECT_H

#include "engines/engine.h"

/* S(k) = sum w exp(-2 pi i k.x) of one pattern and one frequency. */
void ps_host_sum(const pspec_pattern *pattern, const int32_t *k, long double *re, long double *im);

/* |S|^2 of frequency i of the set, or Q(l) of its degree i, of one pattern with weights w
 * 2^-exponent. */
pspec_status ps_host_power(const pspec_pattern *pattern, const ps_frequencies *set, size_t i,
                           int exponent, long double *power, ps_error *error) PS_MUST_CHECK;

#endif
