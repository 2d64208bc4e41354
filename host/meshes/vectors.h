/* Vectors of three doubles. */
#ifndef PS_MESHES_VECTORS_H
#define PS_MESHES_VECTORS_H

#include <math.h>

static inline void ps_vector_subtract(double out[3], const double a[3], const double b[3]) {
    for (unsigned i = 0; i < 3; i++) {
        out[i] = a[i] - b[i];
    }
}

static inline double ps_vector_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double ps_vector_length(const double a[3]) {
    return sqrt(ps_vector_dot(a, a));
}

static inline void ps_vector_cross(double out[3], const double a[3], const double b[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void ps_vector_scale(double a[3], double factor) {
    for (unsigned i = 0; i < 3; i++) {
        a[i] *= factor;
    }
}

#endif
