/* Fixtures of the estimator's tests. */
#ifndef TESTS_HARNESS_ESTIMATOR_H
#define TESTS_HARNESS_ESTIMATOR_H

#include "harness.h"

#include "jobs/estimator.h"

/* num white patterns of first, first + step, ... points. */
typedef struct test_sample {
    size_t num;
    pspec_pattern *patterns;
} test_sample;

test_sample test_make_sample(size_t num, unsigned dimension, size_t first, size_t step,
                             bool weighted);
void test_free_sample(test_sample *what);

ps_frequencies test_make_lattice(unsigned dimension, int32_t k, bool ball);

ps_estimator_options test_make_options(const ps_frequencies *set, const ps_engine *engine,
                                       ps_precision precision, size_t num_points, size_t batch);

/* Spectrum of the sample, given to the estimator `at_a_time` realizations at once. */
ps_spectrum test_estimate(const ps_estimator_options *options, const test_sample *what,
                          size_t at_a_time, ps_device *device);

bool test_is_same_bits(const ps_spectrum *a, const ps_spectrum *b);

#endif
