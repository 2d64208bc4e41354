#include "harness_angular.h"

#include <math.h>
#include <stdlib.h>

/* num random unit vectors that no sampler made: cubes' points outside the ball are drawn again. */
double *test_make_vectors(size_t num, unsigned seed) {
    double *vectors = calloc(num, 3 * sizeof(double));
    uint64_t word = seed;
    for (size_t j = 0; j < num;) {
        double *u = vectors + 3 * j;
        double square = 0;
        for (int axis = 0; axis < 3; axis++) {
            word = word * 6364136223846793005U + 1442695040888963407U;
            u[axis] = 2 * ldexp((double)(word >> 11), -53) - 1;
            square += u[axis] * u[axis];
        }
        if (square > 0.01 && square < 1) {
            for (int axis = 0; axis < 3; axis++) {
                u[axis] /= sqrt(square);
            }
            j++;
        }
    }
    return vectors;
}

pspec_pattern test_vectors(const double *vectors, size_t num) {
    return (pspec_pattern){3, num, vectors, NULL};
}

void test_assert_near(double found, double expected, double allowed) {
    if (!(fabs(found - expected) <= allowed)) {
        fail_msg("%.17g instead of %.17g +- %.2g", found, expected, allowed);
    }
}
