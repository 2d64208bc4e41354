/* Point sets on the sphere, and coefficients against the referee. */
#ifndef TESTS_HARNESS_SPHERE_H
#define TESTS_HARNESS_SPHERE_H

#include "harness.h"

/* The unit vector of colatitude theta from the pole of sign `pole` and azimuth phi; exact near the
 * poles. */
void test_sphere_point(double *u, double theta, double phi, double pole);
/* A white point. */
void test_sphere_white(double *u, uint64_t *state);
/* num white points; freed by the caller. */
double *test_sphere_white_set(size_t num, uint64_t *state);
/* Degrees 1 .. max_degree, or the even ones, enumerated; freed by ps_frequencies_free. */
ps_frequencies test_degrees(int32_t max_degree, bool only_even);

/* Index of c_lm among the coefficients to max_degree. */
size_t test_coefficient(int32_t max_degree, int32_t l, int32_t m);
/* c_lm of an engine to a tolerance of 1e-5 or 1e-12, by precision, (L + 1)(L + 2) numbers; freed by
 * the caller. */
double *test_coefficients(const ps_engine *engine, ps_precision precision, ps_device *device,
                          const ps_frequencies *frequencies, const pspec_pattern *pattern);
/* sum over m = -l .. l of |dc_lm|^2 against host_degree. */
double test_degree_error(const double *coefficients, int32_t max_degree, int32_t l,
                         const pspec_pattern *pattern);

/* x, y, z (and w) of a set of sphere.json or hemisphere_m18.json. */
test_set test_read_sphere_set(const cJSON *json);

#endif
