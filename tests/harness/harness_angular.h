/* Fixtures of the tests of angular spectra through the public library. */
#ifndef TESTS_HARNESS_ANGULAR_H
#define TESTS_HARNESS_ANGULAR_H

#include "harness_public.h"

enum { TEST_MAX_DEGREE = 12 };

/* Degrees 1 .. TEST_MAX_DEGREE by the referee, which needs no device and has every digit. */
pspec_angular_request test_angular_request(void);
/* A plan, its patterns and its spectrum; NULL in *out after an error. */
pspec_status test_try_angular(pspec_context *context, const pspec_angular_request *request,
                              const pspec_pattern *patterns, size_t num, pspec_spectrum **out);
/* The same where nothing may fail. */
pspec_spectrum *test_estimate_angular(pspec_context *context, const pspec_angular_request *request,
                                      const pspec_pattern *patterns, size_t num);
/* num random unit vectors that no sampler made; freed by the caller. */
double *test_make_vectors(size_t num, unsigned seed);
/* Without weights. */
pspec_pattern test_vectors(const double *vectors, size_t num);

void test_assert_near(double found, double expected, double allowed);

#endif
