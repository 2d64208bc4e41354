#include "harness_angular.h"

#include <math.h>
#include <stdlib.h>

/* The referee: no device, and every digit. */
pspec_angular_request test_angular_request(void) {
    pspec_angular_request request = PSPEC_ANGULAR_REQUEST_INIT;
    request.num_points = TEST_NUM_POINTS;
    request.max_degree = TEST_MAX_DEGREE;
    request.engine = "host_direct";
    return request;
}

pspec_status test_try_angular(pspec_context *context, const pspec_angular_request *request,
                              const pspec_pattern *patterns, size_t num, pspec_spectrum **out) {
    pspec_plan *plan = NULL;
    *out = NULL;
    pspec_status status = pspec_plan_create_angular(&plan, context, request);
    if (status == PSPEC_OK) {
        status = pspec_plan_run(plan, patterns, num);
    }
    if (status == PSPEC_OK) {
        status = pspec_spectrum_create(out, plan);
    }
    pspec_plan_destroy(plan);
    return status;
}

pspec_spectrum *test_estimate_angular(pspec_context *context, const pspec_angular_request *request,
                                      const pspec_pattern *patterns, size_t num) {
    pspec_spectrum *spectrum = NULL;
    if (test_try_angular(context, request, patterns, num, &spectrum) != PSPEC_OK) {
        fail_msg("%s", pspec_context_message(context));
    }
    return spectrum;
}

/* num random unit vectors that no sampler made: cubes' points outside the ball are drawn again. */
double *test_make_vectors(size_t num, unsigned seed) {
    double *vectors = calloc(num, 3 * sizeof(double));
    uint64_t word = seed;
    for (size_t j = 0; j < num;) {
        double *u = vectors + 3 * j;
        double square = 0;
        for (int axis = 0; axis < 3; axis++) {
            word = word * 6364136223846793005U + 1442695040888963407U;
            u[axis] = 2 * ldexp((double)(word >> 11), -53) - 1;
            square += u[axis] * u[axis];
        }
        if (square > 0.01 && square < 1) {
            for (int axis = 0; axis < 3; axis++) {
                u[axis] /= sqrt(square);
            }
            j++;
        }
    }
    return vectors;
}

pspec_pattern test_vectors(const double *vectors, size_t num) {
    return (pspec_pattern){3, num, vectors, NULL};
}

void test_assert_near(double found, double expected, double allowed) {
    if (!(fabs(found - expected) <= allowed)) {
        fail_msg("%.17g instead of %.17g +- %.2g", found, expected, allowed);
    }
}
