/* Maximal Poisson disk points of the sphere: as samplers/darts/poisson_disk.h on the torus, by
 * squares of the faces of HEALPix, which have equal areas.
 */
#ifndef PS_SAMPLERS_DARTS_SPHERE_DISK_H
#define PS_SAMPLERS_DARTS_SPHERE_DISK_H

#include "samplers/darts/blue_noise.h"

/* In radians. Up to here two points always find room, and between here and pi their straight
 * distance says less and less of their angle. */
#define PS_SPHERE_MOST_RADIUS 3.0

/* Is the radius possible? */
pspec_status ps_sphere_disk_check(const ps_blue_noise *asked, ps_error *error) PS_MUST_CHECK;

/* Unit vectors [num_points][3] in the order of their acceptance, no two of them at an angle below
 * the radius, up to the rounding of their numbers. */
pspec_status ps_sphere_disk_points(const ps_blue_noise *asked, ps_random *random, double *points,
                                   size_t *num_points, ps_error *error) PS_MUST_CHECK;

/* More points than this are never at the radius from each other: their caps of half the radius
 * would have more area than the sphere. */
size_t ps_sphere_disk_most_points(double radius);

/* The radius at which num_points are made in the mean, from 2 on, and the mean number at a radius.
 * From 4 points on the mean is right within 2 %, from 16 on within 0.2 %; 3 make 2.9. */
double ps_sphere_disk_radius(size_t num_points);
double ps_sphere_disk_expected(double radius);

#endif
