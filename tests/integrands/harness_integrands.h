/* What the tests of integrands of the sphere share. */
#ifndef TESTS_HARNESS_INTEGRANDS_H
#define TESTS_HARNESS_INTEGRANDS_H

#include "harness.h"
#include "test_folder.h"

#include "integrands/integrand.h"

#define TEST_SPHERE ((ps_integrand_place){PS_SAMPLES_SPHERE, 3})
#define TEST_HEMISPHERE ((ps_integrand_place){PS_SAMPLES_HEMISPHERE, 3})

/* An integrand that must be one; freed by ps_integrand_destroy. */
ps_integrand *test_integrand(const char *text, ps_integrand_place place);

/* Fails with the integrand's text where a value is not within the tolerance of the exact one. */
void test_near(const char *text, const char *what, double value, double exact, double tolerance);

/* Setup and teardown: a folder with the tables lobe.txt, which jumps at z = -1/2 and goes below the
 * horizon, and above.txt, which does not. */
int test_enter_lobes(void **state);
int test_leave_lobes(void **state);

#endif
