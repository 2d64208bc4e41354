/* Sets of points of every kind that tolerances are tried with. */
#ifndef TESTS_HARNESS_SHAPES_H
#define TESTS_HARNESS_SHAPES_H

#include "harness.h"

typedef struct test_shape {
    const char *name;
    double (*coordinate)(size_t point, size_t num_points, unsigned axis, uint64_t *state);
    double (*weight)(size_t point, uint64_t *state); /* NULL: unit weights */
} test_shape;

enum { TEST_WHITE, TEST_SIGNED_WEIGHTS = 8, TEST_WILD_WEIGHTS, TEST_SHAPES };
extern const test_shape test_shapes[TEST_SHAPES];

pspec_pattern test_make_pattern(const test_shape *shape, unsigned dimension, size_t num_points,
                                uint64_t seed);
void test_free_pattern(pspec_pattern *pattern);
double test_sum_of_squares(const pspec_pattern *pattern);

/* All k with |k_i| <= max_frequency, enumerated. */
ps_frequencies test_make_grid(unsigned dimension, int32_t max_frequency);

#endif
