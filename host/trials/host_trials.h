/* Trials on the host, in doubles: what there is without a device, and the referee of the other. */
#ifndef PS_TRIALS_HOST_TRIALS_H
#define PS_TRIALS_HOST_TRIALS_H

#include "integrands/integrand.h"
#include "pointspec/pointspec.h"

/* sums[num_patterns][num_trials] of w F, by several threads where values cannot fail; moves as in
 * trials/trials.h. */
void ps_host_trials_sums(const ps_integrand *integrand, const pspec_pattern *patterns,
                         size_t num_patterns, size_t num_trials, const double *moves, double *sums);

#endif
