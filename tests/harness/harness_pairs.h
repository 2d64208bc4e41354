/* Pair sums in long double, the referee of the engines that sum over pairs, and what runs these. */
#ifndef TESTS_HARNESS_PAIRS_H
#define TESTS_HARNESS_PAIRS_H

#include "harness_sphere.h"

/* ps_host_pairs for l = 0 .. max_degree; freed by the caller. */
long double *test_pair_sums(const pspec_pattern *pattern, int32_t max_degree);
double test_weight_sizes(const pspec_pattern *pattern);

/* Q(l) of any engine for l = 1 .. max_degree, pair sums being asked for to a tolerance:
 * [pattern][degree], freed by the caller. */
double *test_run_pairs(const ps_engine *engine, ps_precision precision, double tolerance,
                       ps_device *device, int32_t max_degree, const pspec_pattern *patterns,
                       size_t num_patterns, size_t batch);
/* The engine's largest error of these, in (sum |w|)^2. */
double test_pairs_error(const ps_engine *engine, ps_precision precision, double tolerance,
                        ps_device *device, int32_t max_degree, const pspec_pattern *pattern);

/* Skips the test where the device has not that precision. */
void test_need_precision(const ps_device *device, ps_precision precision);

#endif
