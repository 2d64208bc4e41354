/* Engines of the sphere read the powers of all realizations that share work in one go: a read of
 * its own for every realization took ten times as long as the sums of few points and degrees. And
 * they wait for none before the device has more to do. */
#include "harness.h"

#include "engines/engine.h"

#include <math.h>
#include <stdlib.h>

static ps_device *device;

/* Linked in the place of clEnqueueReadBuffer (tests/CMakeLists.txt). */
static size_t num_reads, num_blocking;
cl_int __real_clEnqueueReadBuffer(cl_command_queue queue, cl_mem buffer, cl_bool is_blocking,
                                  size_t offset, size_t bytes, void *to, cl_uint num_events,
                                  const cl_event *events, cl_event *event);
cl_int __wrap_clEnqueueReadBuffer(cl_command_queue queue, cl_mem buffer, cl_bool is_blocking,
                                  size_t offset, size_t bytes, void *to, cl_uint num_events,
                                  const cl_event *events, cl_event *event);
cl_int __wrap_clEnqueueReadBuffer(cl_command_queue queue, cl_mem buffer, cl_bool is_blocking,
                                  size_t offset, size_t bytes, void *to, cl_uint num_events,
                                  const cl_event *events, cl_event *event) {
    num_reads++;
    num_blocking += is_blocking == CL_TRUE ? 1 : 0;
    return __real_clEnqueueReadBuffer(queue, buffer, is_blocking, offset, bytes, to, num_events,
                                      events, event);
}

/* More than sphere_nufft and sphere_grid do at once. */
enum { REALIZATIONS = 70, POINTS = 3, DEGREE = 5 };

static void make_points(double *points) {
    uint64_t random = 11;
    for (size_t j = 0; j < (size_t)REALIZATIONS * POINTS; j++) {
        const double z = 2 * test_uniform(&random) - 1;
        const double angle = 6 * test_uniform(&random);
        points[3 * j] = sqrt(1 - z * z) * cos(angle);
        points[3 * j + 1] = sqrt(1 - z * z) * sin(angle);
        points[3 * j + 2] = z;
    }
}

/* Few reads of 70 realizations, and the bits of 70 batches. */
static void check_reads(const ps_engine *engine) {
    ps_frequencies degrees = {0};
    double points[3 * REALIZATIONS * POINTS];
    pspec_pattern patterns[REALIZATIONS];
    make_points(points);
    for (size_t r = 0; r < REALIZATIONS; r++) {
        patterns[r] = (pspec_pattern){3, POINTS, points + 3 * POINTS * r, NULL};
    }
    assert_ok(ps_frequencies_degrees(&degrees, DEGREE, false, error));
    assert_ok(ps_frequencies_enumerate(&degrees, error));
    num_reads = num_blocking = 0;
    double *together =
        test_run_engine(engine, PS_SINGLE, device, &degrees, patterns, REALIZATIONS, REALIZATIONS);
    assert_in_range(num_reads, 1, 3);
    assert_int_equal(num_blocking, 0);
    double *alone = test_run_engine(engine, PS_SINGLE, device, &degrees, patterns, REALIZATIONS, 1);
    assert_memory_equal(together, alone, REALIZATIONS * degrees.num * sizeof(double));
    free(together);
    free(alone);
    ps_frequencies_free(&degrees);
}

static void few_reads_of_a_batch(void **state) {
    (void)state;
    for (size_t e = 0; ps_engines[e] != NULL; e++) {
        if (ps_engines[e]->needs_device && (ps_engines[e]->domains & PS_ON_SPHERE) != 0) {
            check_reads(ps_engines[e]);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(few_reads_of_a_batch)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("sphere_reads", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
