/* Gaussian blue noise (Ahmed, Ren, Wonka 2022) on the torus of two or three dimensions: points at a
 * low of the sum of Gaussians of the distances of all pairs, sigma N^(-1/d) wide.
 *
 * All points go together along their forces, by a length below which the energy cannot rise where
 * they lie evenly. Where it does rise the step is taken back, and steps are half as long from then
 * on: the energy falls with every step (docs/samplers/forces.md#gaussian-blue-noise).
 */
#ifndef PS_SAMPLERS_FORCES_GAUSSIAN_H
#define PS_SAMPLERS_FORCES_GAUSSIAN_H

#include "base/watch.h"
#include "math/random/random.h"
#include "samplers/forces/gaussian_sums.h"

#include <stdbool.h>

/* Widths in units of N^(-1/d). Below the first, Gaussians of neighbours hardly meet; above the
 * second, what is left of the energy is lost in its rounding. */
#define PS_GAUSSIAN_LEAST_SIGMA 0.5
#define PS_GAUSSIAN_MOST_SIGMA 2.0
/* It ends with a step that moves no point by more than this, in units of N^(-1/d), or after so many
 * steps. */
#define PS_GAUSSIAN_STILL 1e-4
enum { PS_GAUSSIAN_MOST_STEPS = 10000 };

typedef struct ps_gaussian {
    ps_gaussian_sums sums;
    ps_gaussian_device on_device; /* whose sums they are, if any's */
    double *x, *force;            /* [num][dimension], where the energy is `energy` */
    double *next_x, *next_force;  /* of the step that is tried */
    double energy;                /* of all pairs, images of the same point among them */
    double length;                /* of a step, in units of its force */
    double unit;                  /* N^(-1/d) */
    double move;                  /* of the last step, the farthest of a point, in units */
    unsigned steps, halvings;
    const ps_watch *watch;
} ps_gaussian;

/* Refuses what cannot be made with a sentence. */
pspec_status ps_gaussian_check(size_t num, unsigned dimension, double sigma,
                               ps_error *error) PS_MUST_CHECK;

/* From points [num][dimension] as they are; device is borrowed, and NULL for the host, which has
 * the same bits. What it holds is freed by destroy, also after a failure. */
pspec_status ps_gaussian_begin(ps_gaussian *g, size_t num, unsigned dimension, double sigma,
                               const double *points, ps_device *device, const ps_watch *watch,
                               ps_error *error) PS_MUST_CHECK;
void ps_gaussian_destroy(ps_gaussian *g);
/* One step, after which the energy is not higher. */
pspec_status ps_gaussian_step(ps_gaussian *g, ps_error *error) PS_MUST_CHECK;
/* How far the energy is from N/2 ((2 pi sigma^2)^(d/2) - 1), below which no set comes. */
double ps_gaussian_excess(const ps_gaussian *g, double sigma);

/* Points [num][dimension] of a whole optimisation, from uniform random ones. */
pspec_status ps_gaussian_make(size_t num, unsigned dimension, double sigma, ps_random *random,
                              ps_device *device, const ps_watch *watch, double *points,
                              ps_error *error) PS_MUST_CHECK;

#endif
