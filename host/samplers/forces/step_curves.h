/* Curves over distances for step blue noise: the radial distribution that a step spectrum has, the
 * one of points, and forces from one to the other. Bin b of num covers b <= 2 num r < b + 1. */
#ifndef PS_SAMPLERS_FORCES_STEP_CURVES_H
#define PS_SAMPLERS_FORCES_STEP_CURVES_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

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

#endif
