/* The powers of an integrand that is weighted points: pixels. */
#ifndef PS_JOBS_VARIANCE_POINT_POWERS_H
#define PS_JOBS_VARIANCE_POINT_POWERS_H

#include "base/watch.h"
#include "device/device.h"
#include "frequencies/frequencies.h"
#include "integrands/integrand.h"

/* Where the engine runs. */
typedef struct ps_point_way {
    ps_device *device;     /* NULL: an engine of the host */
    uint64_t memory_limit; /* bytes that somebody typed; 0: none */
    const ps_watch *watch; /* told about every second; may be NULL */
} ps_point_way;

/* |f_k|^2 of frequencies that are enumerated, by the cheapest engine that has sums to 1e-9 of those
 * of white noise. */
pspec_status ps_point_powers(const ps_integrand *integrand, const ps_frequencies *frequencies,
                             const ps_point_way *way, double *powers,
                             ps_error *error) PS_MUST_CHECK;

/* The seconds of that; 0 where no engine does it, which the run will say. */
pspec_status ps_point_powers_seconds(double *seconds, const ps_integrand *integrand,
                                     const ps_frequencies *frequencies, const ps_point_way *way,
                                     ps_error *error) PS_MUST_CHECK;

#endif
