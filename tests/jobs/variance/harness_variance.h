/* Fixtures of the tests of variances. */
#ifndef TESTS_JOBS_VARIANCE_HARNESS_VARIANCE_H
#define TESTS_JOBS_VARIANCE_HARNESS_VARIANCE_H

#include "harness.h"

#include "jobs/variance/variance_job.h"

enum { TEST_MOST_INTEGRANDS = 4 };

/* A question and its job; must not be moved once it was asked. */
typedef struct test_variance {
    ps_sampler_request sampler;
    const char *texts[TEST_MOST_INTEGRANDS];
    ps_variance_question question;
    ps_made_integrands made;
    ps_variance_job *job; /* NULL: not run */
} test_variance;

/* Of one integrand, moved once; what else is asked may be changed until it is run. With a device
 * that is borrowed, or NULL: on the host alone, by host_direct. */
void test_variance_ask(test_variance *out, const char *sampler, size_t num_points,
                       uint64_t num_realizations, const char *integrand, ps_device *device);
void test_variance_add(test_variance *out, const char *integrand);
/* Plans and runs; the rows are borrowed. What was run before is forgotten. */
const ps_variance_row *test_variance_run(test_variance *asked);
const ps_spectrum *test_variance_spectrum(const test_variance *asked);
const ps_integrand *test_variance_integrand(const test_variance *asked, size_t index);
void test_variance_free(test_variance *asked);

/* Points of a realization [*num_points][dimension], freed by the caller. */
double *test_variance_points(const test_variance *asked, uint64_t realization, size_t *num_points);

#endif
