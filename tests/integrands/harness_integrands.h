/* What the tests of integrands of the sphere share. */
#ifndef TESTS_HARNESS_INTEGRANDS_H
#define TESTS_HARNESS_INTEGRANDS_H

#include "harness.h"
#include "test_folder.h"

#include "integrands/integrand.h"

#define TEST_SPHERE ((ps_integrand_place){PS_SAMPLES_SPHERE, 3})
#define TEST_HEMISPHERE ((ps_integrand_place){PS_SAMPLES_HEMISPHERE, 3})
#define TEST_PLANE ((ps_integrand_place){PS_SAMPLES_TORUS, 2})

/* An integrand that must be one; freed by ps_integrand_destroy. */
ps_integrand *test_integrand(const char *text, ps_integrand_place place);

/* Fails with the integrand's text where a value is not within the tolerance of the exact one. */
void test_near(const char *text, const char *what, double value, double exact, double tolerance);

/* An image of light, as a PFM file of one channel; filled with numbers at random. */
enum { TEST_LIGHT_PIXELS = 512 * 400 };
typedef struct test_light {
    size_t width, height;
    float light[TEST_LIGHT_PIXELS]; /* the top row first */
} test_light;
void test_light_fill(test_light *out, size_t width, size_t height);
void test_light_write(const char *path, const test_light *image);

/* Setup and teardown: a folder with the tables lobe.txt, which jumps at z = -1/2 and goes below the
 * horizon, and above.txt, which does not. */
int test_enter_lobes(void **state);
int test_leave_lobes(void **state);

#endif
