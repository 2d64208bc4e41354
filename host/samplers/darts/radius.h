/* Least distances of points on the torus: from numbers of points and back. */
#ifndef PS_SAMPLERS_DARTS_RADIUS_H
#define PS_SAMPLERS_DARTS_RADIUS_H

#include "base/status.h"

#include <stddef.h>

/* A radius may be above 0 and up to sqrt(d)/2, the farthest that two points of [0,1)^d are apart,
 * wrapped. */
pspec_status ps_torus_radius_check(unsigned dimension, double radius,
                                   ps_error *error) PS_MUST_CHECK;

/* More points than this are never at the radius from each other: the densest packing of balls.
 * SIZE_MAX for radii that no grid has. */
size_t ps_torus_radius_most_points(unsigned dimension, double radius);

/* The radius at which saturated dart throwing makes num_points in the mean, d = 2 or 3; at most
 * sqrt(d)/2. From 16 points on the mean is right within 0.2 %, from 8 on within 2 %; 3 make 4. */
double ps_poisson_disk_radius(unsigned dimension, size_t num_points);
/* The mean number of points at the radius. */
double ps_poisson_disk_expected(unsigned dimension, double radius);

/* Bridson's tries: with a single one chains of points end before they fill anything. */
enum { PS_LEAST_TRIES = 2, PS_MOST_TRIES = 1000 };
pspec_status ps_bridson_tries_check(unsigned tries, ps_error *error) PS_MUST_CHECK;
/* The same two for Bridson's points, d = 2 to 4, within 1 % for the tries that were measured. */
double ps_bridson_radius(unsigned dimension, unsigned tries, size_t num_points);
double ps_bridson_expected(unsigned dimension, double radius, unsigned tries);

#endif
