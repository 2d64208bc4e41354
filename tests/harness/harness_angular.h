/* Fixtures of the tests of angular spectra. */
#ifndef TESTS_HARNESS_ANGULAR_H
#define TESTS_HARNESS_ANGULAR_H

#include "harness_public.h"

/* A question about degrees 1 .. TEST_MAX_DEGREE by the referee, which needs no device and has every
 * digit. */
enum { TEST_MAX_DEGREE = 12 };
#define TEST_ANGULAR "angular max-degree=12 engine=host_direct"

/* num random unit vectors that no sampler made; freed by the caller. */
double *test_make_vectors(size_t num, unsigned seed);
/* Without weights. */
pspec_pattern test_vectors(const double *vectors, size_t num);

void test_assert_near(double found, double expected, double allowed);

#endif
