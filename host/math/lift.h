/* Points of the sphere from heights and azimuths, without loss of digits near the poles.
 */
#ifndef PS_MATH_LIFT_H
#define PS_MATH_LIFT_H

#include "math/turns.h"

#include <stdbool.h>
#include <stddef.h>

/* Numbers per point on sphere and hemisphere: x, y, z of a unit vector. */
enum { PS_VECTOR_DIMENSION = 3 };

/* Where points of the plane are taken to. */
typedef enum ps_lift { PS_NO_LIFT = 0, PS_LIFT_TO_SPHERE, PS_LIFT_TO_HEMISPHERE } ps_lift;

/* A height z in [-1,1] and its distance to the nearer pole, t = 1 - |z|, each with all its digits:
 * t cannot be had from a rounded z, nor the sine of the polar angle, sqrt(t (2 - t)). */
typedef struct ps_height {
    double z, t;
} ps_height;

/* z = numerator/denominator, best of whole numbers (below 2^53): nothing is lost before the
 * division. */
ps_height ps_height_of_ratio(double numerator, double denominator);
/* Height x of the hemisphere, 2x - 1 of the sphere: equal areas in equal intervals of x in
 * [0,1]. */
ps_height ps_height_of_area(bool on_hemisphere, double x);

/* The unit vector (x, y, z), with the same bits on every machine. No coordinate is -0. */
void ps_sphere_point(ps_height height, ps_turns azimuth, double point[PS_VECTOR_DIMENSION]);

/* Lambert's cylindrical equal-area map: points (x, y) of the plane, [..][2] at the beginning of the
 * array, become unit vectors [..][3] with height by ps_height_of_area(x) and azimuth y turns.
 * Points first .. end - 1 of them: those after them must be vectors already, or not wanted. */
void ps_sphere_lift(bool on_hemisphere, size_t first, size_t end, double *points);

/* Turns every point z < 0 into its antipode: the hemisphere as the projective plane. */
void ps_sphere_fold(size_t num_points, double *points);

#endif
