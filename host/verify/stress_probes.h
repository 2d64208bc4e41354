/* Cases of the stability suite that are no engine's: sums and averages on the device, and special
 * functions, kernels and weights on the host. */
#ifndef PS_VERIFY_STRESS_PROBES_H
#define PS_VERIFY_STRESS_PROBES_H

#include "verify/stress.h"

/* On the device. */
extern const ps_stress_probe ps_probe_averages;

/* On the host. */
extern const ps_stress_probe ps_probe_diagonal, ps_probe_eigenvalues, ps_probe_sharp_lobe,
    ps_probe_wide_lobe, ps_probe_optimal_weights;

#endif
