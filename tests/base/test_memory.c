/* Memory as it is announced: the buffers that a job has on the device, within 10 % of what plan
 * counted. */
#include "harness.h"

#include "jobs/estimator.h"
#include "plan/choose.h"

#include <stdlib.h>

typedef struct memory_case {
    unsigned dimension; /* 0: degrees of the sphere */
    int32_t k;
    uint64_t num_points, num_realizations;
    const char *engine;
} memory_case;

/* All buffers are there before the first point. num_weighted: weighted sums of the powers. */
static double measure(const memory_case *what, size_t num_weighted, double *announced) {
    const ps_plan_constraints constraints = {.engine = what->engine, .precision = -1};
    ps_frequencies grid = {0};
    ps_device *device = test_open_device();
    ps_estimator *estimator = NULL;
    ps_plan plan;
    assert_ok(what->dimension == 0
                  ? ps_frequencies_degrees(&grid, what->k, false, error)
                  : ps_frequencies_lattice(&grid, what->dimension, what->k, true, error));
    assert_ok(ps_frequencies_enumerate(&grid, error));
    const ps_problem problem = {.frequencies = &grid,
                                .num_points = what->num_points,
                                .num_realizations = what->num_realizations,
                                .tolerance = 1e-6,
                                .num_weighted = num_weighted};
    double *weights = calloc(num_weighted * grid.num + 1, sizeof *weights);
    assert_ok(ps_plan_make(&plan, &problem, ps_device_get_limits(device), &constraints, error));
    assert_non_null(plan.chosen);
    const ps_estimator_options options = {.problem = problem,
                                          .engine = plan.chosen->engine,
                                          .precision = plan.chosen->precision,
                                          .batch = plan.chosen->batch,
                                          .want_frequencies = true,
                                          .weights = weights,
                                          .num_weighted = num_weighted};
    assert_ok(ps_estimator_create(&estimator, &options, device, error));
    assert_int_equal(ps_estimator_batch(estimator), plan.chosen->batch);
    ps_estimator_destroy(estimator);
    *announced = plan.chosen->device_bytes;
    const double measured = (double)ps_device_most_buffer_bytes(device);
    print_message("d=%u N=%-9llu K=%-6d %s, %zu at a time: %.3g bytes announced, %.3g there\n",
                  what->dimension, (unsigned long long)what->num_points, (int)what->k,
                  plan.chosen->engine->name, plan.chosen->batch, *announced, measured);
    ps_device_close(device);
    ps_frequencies_free(&grid);
    free(weights);
    return measured;
}

static void check_announced(const memory_case *what, size_t num_weighted) {
    double announced = 0;
    const double measured = measure(what, num_weighted, &announced);
    assert_true(announced > 0.9 * measured && announced < 1.1 * measured);
}

static void buffers_are_announced(void **state) {
    (void)state;
    static const memory_case cases[] = {
        {2, 32, 256, 1, NULL},
        {2, 32, 256, 1000, NULL},
        {2, 128, 1024, 30, NULL},
        {2, 256, 4096, 4, NULL},
        {2, 512, 16384, 1, NULL},
        {3, 32, 4096, 3, NULL},
        {1, 32768, 65536, 30, NULL},
        {2, 1024, 10000000, 1, NULL},
        {3, 32, 20000000, 1, NULL},
        {2, 64, 1024, 1, "torus_direct"},
        {2, 32, 256, 1000, "torus_direct"},
        {0, 64, 256, 1000, "sphere_nufft"},
        {0, 64, 256, 1000, "sphere_grid"},
        {0, 256, 4096, 100, "sphere_grid"},
        {0, 20, 100, 1, "sphere_grid"},
        {0, 256, 4096, 1, "sphere_nufft"},
        {0, 512, 16384, 100, "sphere_nufft"},
        {0, 1000, 1000000, 4, "sphere_nufft"},
        {0, 512, 10000000, 1, "sphere_nufft"},
        {0, 1500, 4096, 10, "sphere_nufft"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        check_announced(&cases[i], 0);
    }
}

/* As many as there are rows, and more. */
static void weights_are_announced(void **state) {
    (void)state;
    static const memory_case cases[] = {
        {2, 256, 4096, 4, NULL},
        {3, 32, 4096, 3, NULL},
        {1, 32768, 65536, 30, NULL},
        {0, 256, 4096, 1, "sphere_nufft"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        check_announced(&cases[i], 40);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(buffers_are_announced),
        cmocka_unit_test(weights_are_announced),
    };
    return cmocka_run_group_tests_name("memory", tests, NULL, NULL);
}
