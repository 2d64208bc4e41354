/* Sums of Gaussians of all pairs of points of the torus, and their forces, by cells
 * (kernels/samplers/gaussian.h). */
#ifndef PS_SAMPLERS_FORCES_GAUSSIAN_SUMS_H
#define PS_SAMPLERS_FORCES_GAUSSIAN_SUMS_H

#include "base/watch.h"
#include "device/device.h"

#include <stddef.h>
#include <stdint.h>

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

/* s->sums of s->points, which are sorted. */
pspec_status ps_gaussian_device_sum(ps_gaussian_device *d, const ps_gaussian_sums *s,
                                    const ps_watch *watch, ps_error *error) PS_MUST_CHECK;

#endif
