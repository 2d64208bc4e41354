/* Trials on a device: integrands/values.cl and its buffers; and on the host, in doubles: what there
 * is without a device, and the referee of the other. */
#ifndef PS_TRIALS_WAYS_H
#define PS_TRIALS_WAYS_H

#include "trials/trials.h"

typedef struct ps_device_trials ps_device_trials;

/* Of an integrand that has a kernel in this precision. */
pspec_status ps_device_trials_create(ps_device_trials **out, const ps_integrand *integrand,
                                     const ps_trials_options *options, ps_device *device,
                                     ps_error *error) PS_MUST_CHECK;
/* Of buffers and of what stages them. */
double ps_device_trials_bytes(const ps_integrand *integrand, const ps_trials_options *options,
                              const ps_device *device);
void ps_device_trials_destroy(ps_device_trials *trials); /* NULL is allowed */

/* sums[num_patterns][num_trials] of w F, of options.batch patterns at most; moves as in
 * trials/trials.h. */
pspec_status ps_device_trials_sums(ps_device_trials *trials, const ps_batch *batch,
                                   const double *moves, double *sums,
                                   ps_error *error) PS_MUST_CHECK;

/* sums[num_patterns][num_trials] of w F, by several threads where values cannot fail; moves as in
 * trials/trials.h. */
void ps_host_trials_sums(const ps_integrand *integrand, const pspec_pattern *patterns,
                         size_t num_patterns, size_t num_trials, const double *moves, double *sums);

#endif
