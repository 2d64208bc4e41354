/* Rotations of space: random ones, uniform over SO(3), which make a point set of the sphere
 * homogeneous as a random shift does on the torus.
 */
#ifndef PS_MATH_RANDOM_ROTATION_H
#define PS_MATH_RANDOM_ROTATION_H

#include "math/random/random.h"

#include <stddef.h>

/* v -> matrix v; orthogonal with determinant 1, each entry right to about 2^-53. */
typedef struct ps_rotation {
    double matrix[3][3];
} ps_rotation;

/* Uniform (Haar) over all rotations. Takes three uniform numbers. */
ps_rotation ps_rotation_random(ps_random *random);
/* The same numbers, by + - * / sqrt and fma alone: the same bits on every machine, entries right to
 * 2^-50. */
ps_rotation ps_rotation_random_portable(ps_random *random);

/* The rotation by the quaternion w + x i + y j + z k, of any length but 0. */
ps_rotation ps_rotation_of_quaternion(double w, double x, double y, double z);

/* Rotates vectors [num_vectors][3] in place. */
void ps_rotate(const ps_rotation *rotation, double *vectors, size_t num_vectors);

#endif
