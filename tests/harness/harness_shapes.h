/* Sets of points of every kind that tolerances are tried with: those of `pointspec stress`. */
#ifndef TESTS_HARNESS_SHAPES_H
#define TESTS_HARNESS_SHAPES_H

#include "harness.h"

#include "verify/stress_shapes.h"

typedef ps_stress_shape test_shape;

/* The first ones of the table. */
enum { TEST_WHITE, TEST_SIGNED_WEIGHTS = 8, TEST_WILD_WEIGHTS, TEST_SHAPES };
#define test_shapes ps_torus_shapes

pspec_pattern test_make_pattern(const test_shape *shape, unsigned dimension, size_t num_points,
                                uint64_t seed);
void test_free_pattern(pspec_pattern *pattern);
double test_sum_of_squares(const pspec_pattern *pattern);

/* All k with |k_i| <= max_frequency, enumerated. */
ps_frequencies test_make_grid(unsigned dimension, int32_t max_frequency);

#endif
