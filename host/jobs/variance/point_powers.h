/* The powers of an integrand that is weighted points: pixels. */
#ifndef PS_JOBS_VARIANCE_POINT_POWERS_H
#define PS_JOBS_VARIANCE_POINT_POWERS_H

#include "device/device.h"
#include "frequencies/frequencies.h"
#include "integrands/integrand.h"

/* |f_k|^2 of frequencies that are enumerated, by the cheapest engine that has sums to 1e-9 of those
 * of white noise. device NULL: an engine of the host. */
pspec_status ps_point_powers(const ps_integrand *integrand, const ps_frequencies *frequencies,
                             ps_device *device, double *powers, ps_error *error) PS_MUST_CHECK;

#endif
