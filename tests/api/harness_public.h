/* Fixtures of the public library's tests. */
#ifndef TESTS_HARNESS_PUBLIC_H
#define TESTS_HARNESS_PUBLIC_H

#include "harness_estimator.h"

enum { TEST_NUM_POINTS = 30 };

/* A small grid, by the engine that needs no device. */
pspec_power_request test_host_request(void);

/* With the device of the tests. */
pspec_context *test_public_context(void);

/* The spectrum of patterns, by a plan of its own. */
pspec_spectrum *test_public_spectrum(pspec_context *context, const pspec_power_request *request,
                                     const pspec_pattern *patterns, size_t num);

/* To the bit; powers of single frequencies only when asked for. */
bool test_is_same_spectrum(const pspec_spectrum *a, const pspec_spectrum *b, bool with_powers);

/* Installs an error handler of GSL's that counts. At the end of a program, as a test: it is still
 * there, after everything that the library did, and nobody called it. */
void test_watch_gsl(void);
void test_gsl_is_left_alone(void **state);

#endif
