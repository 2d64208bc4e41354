/* Sets of points on the sphere of every kind, and coefficients in extended precision. */
#ifndef TESTS_HARNESS_SPHERE_SHAPES_H
#define TESTS_HARNESS_SPHERE_SHAPES_H

#include "harness.h"

typedef struct test_sphere_shape {
    const char *name;
    /* Angle from the pole and longitude; axis 0, 1. */
    void (*place)(size_t point, size_t num_points, uint64_t *state, double angles[2]);
    double (*weight)(size_t point, uint64_t *state); /* NULL: unit weights */
} test_sphere_shape;

enum { TEST_SPHERE_WHITE, TEST_SPHERE_SHAPES = 10 };
extern const test_sphere_shape test_sphere_shapes[TEST_SPHERE_SHAPES];

/* Points and weights are freed by test_free_sphere_pattern. */
pspec_pattern test_make_sphere_pattern(const test_sphere_shape *shape, size_t num_points,
                                       uint64_t seed);
void test_free_sphere_pattern(pspec_pattern *pattern);

/* c_lm, m >= 0, l = 0 .. max_degree in steps: pairs at index 2 (m (2L + 1 - m) / 2 + l); others are 0. */
double *test_sphere_coefficients(const pspec_pattern *pattern, int32_t max_degree, int32_t step);

/* sqrt(4 pi mean |dc_lm|^2) / sqrt(sum w^2), mean over both signs of m; and the mean power of what was expected,
 * without degree 0, relative to white noise. */
double test_sphere_error(const double *found, const double *expected, int32_t max_degree,
                         int32_t step, const pspec_pattern *pattern, double *mean_power);

#endif
