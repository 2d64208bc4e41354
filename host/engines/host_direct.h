/* host_direct: the referee. Direct sums in long double on the host, phases exact, no device. */
#ifndef PS_ENGINES_HOST_DIRECT_H
#define PS_ENGINES_HOST_DIRECT_H

#include "engines/engine.h"

extern const ps_engine ps_host_direct;

/* S(k) = sum w exp(-2 pi i k.x) of one pattern and one frequency. */
void ps_host_sum(const pspec_pattern *pattern, const int32_t *k, long double *re, long double *im);

#endif
