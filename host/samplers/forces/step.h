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
#include "base/status.h"

#include <stddef.h>
#include <stdbool.h>
#include <stdint.h>

/* Curves over distances for step blue noise: the radial distribution that a step spectrum has, the
 * one of points, and forces from one to the other. Bin b of num covers b <= 2 num r < b + 1. */

/* By a Gaussian, which ends where it is 3e-4 of its middle. */
typedef struct ps_step_smoothing {
    unsigned bins;     /* its standard deviation */
    bool is_of_target; /* the distribution that points are to have is smoothed, too */
} ps_step_smoothing;
/* That of step blue noise; the authors' program has 8 bins, too. Others are for looking at what it
 * does: bench/forces/bench_forces.c. */
#define PS_STEP_SMOOTHING ((ps_step_smoothing){8, false})

typedef struct ps_step_curves {
    size_t num_points, num_bins, smooth_end;
    double *target;  /* [num_bins] */
    double *found;   /* [num_bins], of the points */
    double *rough;   /* [num_bins], before it is smoothed */
    double *weights; /* [smooth_end + 1], of the bins on either side, by their distance */
} ps_step_curves;

/* Destroy also after a failure. */
pspec_status ps_step_curves_create(ps_step_curves *c, size_t num_points, size_t num_bins,
                                   ps_step_smoothing smoothing, ps_error *error) PS_MUST_CHECK;
void ps_step_curves_destroy(ps_step_curves *c);

/* J1(t) / t for t = 2 pi turns, to 1e-15 (1 + turns). */
double ps_step_bessel(double turns);

/* Smoothed distribution of pairs that were counted into found; the distance of the two curves, the
 * root of the integral over r of the squared difference. */
double ps_step_curves_measure(ps_step_curves *c, const uint64_t *counts);
/* table [num_bins + 1]: what the difference of two points is multiplied by; the last is 0. */
void ps_step_curves_force(const ps_step_curves *c, double *table);

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

/* Points [num][2], from uniform random ones, by the device, which has double precision. outcome may
 * be NULL. */
pspec_status ps_step_make(size_t num, ps_step_options options, ps_random *random, ps_device *device,
                          const ps_watch *watch, double *points, ps_step_outcome *outcome,
                          ps_error *error) PS_MUST_CHECK;

#endif
