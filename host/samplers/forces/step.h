/* Step blue noise (Heck, Schloemer, Deussen 2013) on the torus of the plane: points whose
 * distances are distributed as those of a spectrum that is 0 up to a frequency and 1 above, the
 * largest such frequency that there can be, sqrt(N / pi).
 *
 * Pairs push each other apart, or pull, where there are too many or too few of their distance;
 * steps grow shorter while nothing improves (docs/samplers/forces.md#step). All pairs are the work
 * of a device.
 */
#ifndef PS_SAMPLERS_FORCES_STEP_H
#define PS_SAMPLERS_FORCES_STEP_H

#include "base/watch.h"
#include "device/device.h"
#include "math/random/random.h"
#include "samplers/forces/step_curves.h"

#include <stddef.h>

/* Below the first, smoothing hides all of the distribution; above the second, all pairs take
 * hours. */
enum { PS_STEP_LEAST_POINTS = 64, PS_STEP_MOST_POINTS = 1 << 16 };
/* Rounds after which it ends with the best so far: never before its own end. */
enum { PS_STEP_MOST_ROUNDS = 10000 };

typedef struct ps_step_options {
    unsigned most_rounds;
    ps_step_smoothing smoothing; /* PS_STEP_SMOOTHING */
} ps_step_options;

typedef struct ps_step_outcome {
    unsigned rounds;    /* that points were moved */
    double first, last; /* distance of the distribution from that of a step spectrum */
} ps_step_outcome;

/* What ps_step_make takes of memory, that of the device included. */
double ps_step_bytes(size_t num);

/* Points [num][2], from uniform random ones, by the device, which has double precision. outcome may
 * be NULL. */
pspec_status ps_step_make(size_t num, ps_step_options options, ps_random *random, ps_device *device,
                          const ps_watch *watch, double *points, ps_step_outcome *outcome,
                          ps_error *error) PS_MUST_CHECK;

#endif
