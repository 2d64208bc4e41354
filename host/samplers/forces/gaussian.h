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
#include "device/device.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Sums of Gaussians of all pairs of points of the torus, and their forces, by cells
 * (kernels/samplers/gaussian.h). */

/* Points of a set: their numbers, and those of cells, are 32 bits wide. */
enum { PS_GAUSSIAN_MOST_POINTS = 1 << 26 };

typedef struct ps_gaussian_device {
    ps_device *device; /* borrowed */
    ps_kernel *kernel;
    ps_buffer points, begins, sums;
} ps_gaussian_device;

typedef struct ps_gaussian_sums {
    size_t num;
    unsigned dimension;
    double reach, exponent; /* as gaussian_grid has them */
    uint32_t cells;         /* along an axis */
    size_t stride, num_cells;
    uint32_t *begins;           /* [num_cells + 1], points of cells */
    uint32_t *place;            /* [num], where a point stands among all by cells */
    double *points;             /* [dimension][stride], by cells */
    double *sums;               /* [1 + dimension][stride], of points by cells */
    ps_gaussian_device *device; /* that makes them, borrowed; NULL: the host */
} ps_gaussian_sums;

/* N^(-1/d), the same bits on any machine. */
double ps_gaussian_unit(size_t num, unsigned dimension);

/* What ps_gaussian_sums_create allocates. */
double ps_gaussian_sums_bytes(size_t num, unsigned dimension);

/* sigma in units of N^(-1/d). Destroy also after a failure. */
pspec_status ps_gaussian_sums_create(ps_gaussian_sums *s, size_t num, unsigned dimension,
                                     double sigma, ps_error *error) PS_MUST_CHECK;
void ps_gaussian_sums_destroy(ps_gaussian_sums *s);

/* The energy of points x [num][dimension] in [0,1), images of the same point among pairs, and
 * force[i] = sum_j (x_i - x_j) exp(..). */
pspec_status ps_gaussian_sums_find(ps_gaussian_sums *s, const double *x, const ps_watch *watch,
                                   double *energy, double *force, ps_error *error) PS_MUST_CHECK;

/* The same bits by a device, for sets of that shape; one without double precision is refused.
 * Destroy also after a failure. */
pspec_status ps_gaussian_device_create(ps_gaussian_device *d, ps_device *device,
                                       const ps_gaussian_sums *shape,
                                       ps_error *error) PS_MUST_CHECK;
void ps_gaussian_device_destroy(ps_gaussian_device *d);

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
