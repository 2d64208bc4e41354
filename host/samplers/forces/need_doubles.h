/* What samplers of forces have in common: doubles on the device, points that stay on the torus. */
#ifndef PS_SAMPLERS_FORCES_NEED_DOUBLES_H
#define PS_SAMPLERS_FORCES_NEED_DOUBLES_H

#include "device/device.h"

#include <math.h>

/* A device without double precision is refused, with a sentence that names the sampler. */
pspec_status ps_forces_need_doubles(const ps_device_limits *limits, const char *sampler,
                                    ps_error *error) PS_MUST_CHECK;

/* A coordinate after a move, in [0,1). */
static inline double ps_forces_wrap(double x) {
    const double wrapped = x - floor(x);
    return wrapped < 1 ? wrapped : 0;
}

#endif
