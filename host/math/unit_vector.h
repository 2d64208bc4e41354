/* Vectors of three numbers that are directions. */
#ifndef PS_MATH_UNIT_VECTOR_H
#define PS_MATH_UNIT_VECTOR_H

#include <math.h>
#include <stdbool.h>

static inline double ps_square_length(const double *vector) {
    return vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2];
}

/* Is the length 1, within 1e-6? Vectors this near are unit vectors that somebody printed with few
 * digits. */
static inline bool ps_is_unit_vector(const double *vector) {
    const double tolerance = 2e-6; /* of the square of the length */
    return fabs(ps_square_length(vector) - 1) <= tolerance;
}

#endif
