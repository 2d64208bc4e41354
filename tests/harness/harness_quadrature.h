/* Representers, rules and their errors for several tests. */
#ifndef TESTS_HARNESS_QUADRATURE_H
#define TESTS_HARNESS_QUADRATURE_H

#include "harness.h"

#include "rules/worst_case_error.h"

/* Of a BRDF, freed by ps_representer_destroy. */
ps_representer test_representer(const char *brdf_text, double smoothness, double tolerance);

/* [num][3] of a sampler, seed 11; freed by the caller. */
double *test_rule_points(const char *text, size_t num, uint64_t realization);

/* E^2 by the kernel form; weights NULL: 1/N. */
double test_squared_error(const ps_representer *r, size_t num, const double *points,
                          const double *weights);

#endif
