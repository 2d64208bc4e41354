/* Discrepancies in the square mean, exactly, by sums over all pairs of points (Warnock 1972;
 * Lev 1995, Hinrichs and Oettershagen 2014), as docs/user/measure.md has them:
 *
 *     star^2     = 3^-d - (2/N) sum_i prod (1 - x^2)/2 + (1/N^2) sum_ij prod (1 - max(x, y))
 *     periodic^2 = -3^-d + (1/N^2) sum_ij prod (1/2 - |x - y| (1 - |x - y|))
 */
#ifndef PS_JOBS_MEASURE_DISCREPANCY_H
#define PS_JOBS_MEASURE_DISCREPANCY_H

#include "device/device.h"

typedef struct ps_discrepancy ps_discrepancy;

typedef struct ps_discrepancies {
    double star, periodic;
} ps_discrepancies;

/* The device must have doubles. Borrows it. */
pspec_status ps_discrepancy_create(ps_discrepancy **out, unsigned dimension, ps_device *device,
                                   ps_error *error) PS_MUST_CHECK;
void ps_discrepancy_destroy(ps_discrepancy *discrepancy); /* NULL is allowed */

/* Of points [num][dimension] of [0,1)^d: O(N^2). */
pspec_status ps_discrepancy_find(ps_discrepancy *discrepancy, const double *points, size_t num,
                                 ps_discrepancies *out, ps_error *error) PS_MUST_CHECK;

#endif
