/* Sets of points on the sphere of every kind, those of `pointspec stress`, and coefficients in
 * extended precision. */
#ifndef TESTS_HARNESS_SPHERE_SHAPES_H
#define TESTS_HARNESS_SPHERE_SHAPES_H

#include "harness.h"

#include "verify/stress_shapes.h"

typedef ps_stress_shape test_sphere_shape;

/* The first ones of the table. */
enum { TEST_SPHERE_WHITE, TEST_SPHERE_SHAPES = 10 };
#define test_sphere_shapes ps_vector_shapes

/* Points and weights are freed by test_free_sphere_pattern. */
pspec_pattern test_make_sphere_pattern(const test_sphere_shape *shape, size_t num_points,
                                       uint64_t seed);
void test_free_sphere_pattern(pspec_pattern *pattern);

/* A kind of point drawn one by one, with its weight. */
typedef struct test_point_shape {
    const char *name;
    void (*point)(double *u, uint64_t *state);
    double (*weight)(uint64_t *state); /* NULL: unit weights */
} test_point_shape;

/* Freed by test_free_sphere_pattern; *squares becomes sum w^2. */
pspec_pattern test_draw_sphere_pattern(const test_point_shape *shape, size_t num_points,
                                       uint64_t seed, double *squares);
/* Within 1e-3 of a point of the southern half. */
void test_sphere_clustered(double *u, uint64_t *state);
/* Twelve decades, of either sign. */
double test_wild_weight(uint64_t *state);

/* c_lm, m >= 0, l = 0 .. max_degree in steps: pairs at index 2 (m (2L + 1 - m) / 2 + l); others are
 * 0. */
double *test_sphere_coefficients(const pspec_pattern *pattern, int32_t max_degree, int32_t step);

/* sqrt(4 pi mean |dc_lm|^2) / sqrt(sum w^2), mean over both signs of m; and the mean power of what
 * was expected, without degree 0, relative to white noise. */
double test_sphere_error(const double *found, const double *expected, int32_t max_degree,
                         int32_t step, const pspec_pattern *pattern, double *mean_power);

#endif
