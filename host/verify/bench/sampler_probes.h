/* How long samplers take against what their rows say. */
#ifndef PS_VERIFY_BENCH_SAMPLER_PROBES_H
#define PS_VERIFY_BENCH_SAMPLER_PROBES_H

#include "samplers/sampler.h"

/* Makes a realization of as many points as take some milliseconds by the row, PS_PROBE_POINTS at
 * most; room is [PS_PROBE_POINTS][3]. *predicted is the row's, in seconds. */
pspec_status ps_probe_sampler(const ps_sampler *sampler, double *room, double *predicted,
                              ps_error *error) PS_MUST_CHECK;

#endif
