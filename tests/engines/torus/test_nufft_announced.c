/* What torus_nufft announces to the planner is what it then takes: memory in buffers, launches. */
#include "harness.h"

#include "engines/engine.h"

#include <math.h>
#include <stdlib.h>

static ps_device *device;

/* Linked in the place of clCreateBuffer (tests/CMakeLists.txt). */
static double bytes_created;
cl_mem __real_clCreateBuffer(cl_context context, cl_mem_flags flags, size_t bytes, void *host,
                             cl_int *code);
cl_mem __wrap_clCreateBuffer(cl_context context, cl_mem_flags flags, size_t bytes, void *host,
                             cl_int *code);
cl_mem __wrap_clCreateBuffer(cl_context context, cl_mem_flags flags, size_t bytes, void *host,
                             cl_int *code) {
    bytes_created += (double)bytes;
    return __real_clCreateBuffer(context, flags, bytes, host, code);
}

typedef struct announced_case {
    unsigned dimension;
    int32_t max_frequency;
    size_t num_points, num_realizations;
    double tolerance;
    uint64_t planned_points; /* millions choose a grid */
} announced_case;

static const announced_case cases[] = {
    {1, 1, 1, 1, 1e-3, 0},           {1, 3000, 500, 3, 1e-6, 0},
    {1, 20000, 50000, 20, 1e-3, 0},  {2, 1, 10, 1, 1e-3, 0},
    {2, 40, 1000, 50, 1e-5, 0},      {2, 200, 300, 2, 1e-6, 0},
    {2, 9, 70000, 2, 1e-6, 5000000}, {2, 241, 3000, 3, 1e-6, 5000000},
    {2, 160, 20000, 20, 1e-6, 0},    {3, 2, 10, 1, 1e-3, 0},
    {3, 20, 100, 3, 1e-5, 0},        {3, 7, 9000, 2, 1e-5, 5000000},
};

static void run_case(const ps_problem *problem, ps_precision precision) {
    const size_t num_realizations = (size_t)problem->num_realizations;
    const unsigned dimension = problem->frequencies->dimension;
    pspec_pattern *patterns = calloc(num_realizations, sizeof *patterns);
    double *points = malloc(problem->num_points * dimension * sizeof *points);
    uint64_t random = 1;
    for (size_t i = 0; i < problem->num_points * dimension; i++) {
        points[i] = test_uniform(&random);
    }
    for (size_t r = 0; r < num_realizations; r++) {
        patterns[r] = (pspec_pattern){
            .num_points = problem->num_points, .dimension = dimension, .points = points};
    }
    free(test_run_problem(&ps_torus_nufft, problem, precision, device, patterns, num_realizations,
                          num_realizations));
    free(points);
    free(patterns);
}

/* Of three copies of points and weights that are announced two are on the device, and a page for
 * small tables of each axis. */
static void check_case(const announced_case *what, ps_precision precision) {
    const double page = 4096;
    ps_frequencies set = {0};
    assert_ok(ps_frequencies_lattice(&set, what->dimension, what->max_frequency, false, error));
    assert_ok(ps_frequencies_enumerate(&set, error));
    const ps_problem problem = {.frequencies = &set,
                                .num_points = what->num_points,
                                .num_realizations = what->num_realizations,
                                .tolerance = what->tolerance,
                                .planned_points = what->planned_points};
    const ps_work work =
        ps_torus_nufft.survey(&problem, ps_device_get_limits(device), precision).work;
    const double announced =
        work.fixed_bytes + work.bytes_per_realization * (double)what->num_realizations;
    const uint64_t launches_before = test_count_launches(device, "");
    bytes_created = 0;
    run_case(&problem, precision);
    assert_true(bytes_created <= announced);
    assert_true(announced <= bytes_created * 3 / 2 + what->dimension * page);
    assert_true((double)(test_count_launches(device, "") - launches_before) == work.launches);
    ps_frequencies_free(&set);
}

static void as_announced(void **state) {
    (void)state;
    const int last = ps_device_get_limits(device)->has_fp64 ? PS_DOUBLE : PS_SINGLE;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (int precision = PS_SINGLE; precision <= last; precision++) {
            check_case(&cases[i], (ps_precision)precision);
        }
    }
}

/* By the layouts of GPUs, whose sort is several launches. Few points: PoCL is slow with them. */
static void as_announced_on_gpus(void **state) {
    const size_t most_points = 10000;
    (void)state;
    ps_device_set_dedicated_local_memory(device, true);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        if (cases[i].num_points * cases[i].num_realizations <= most_points) {
            check_case(&cases[i], PS_SINGLE);
        }
    }
    ps_device_set_dedicated_local_memory(device, false);
}

static double created_for(const ps_problem *problem, uint64_t num_realizations) {
    ps_problem planned = *problem;
    void *engine = NULL;
    planned.num_realizations = num_realizations;
    bytes_created = 0;
    assert_ok(ps_engine_create(&ps_torus_nufft, &engine, &planned, PS_SINGLE, 1, device, error));
    ps_engine_destroy(&ps_torus_nufft, engine);
    return bytes_created;
}

/* Memory of a batch is that of its realizations, however many were planned: tiles, rows, whole
 * realizations, strips, which one alone is not done in. */
static void batches_of_one(void **state) {
    (void)state;
    static const announced_case smaller[] = {{2, 200, 300, 100, 1e-3, 0},
                                             {3, 20, 100, 100, 1e-3, 0},
                                             {2, 40, 20000, 100, 1e-3, 0},
                                             {2, 160, 20000, 100, 1e-6, 0}};
    for (size_t i = 0; i < sizeof smaller / sizeof smaller[0]; i++) {
        ps_frequencies set = {0};
        assert_ok(ps_frequencies_lattice(&set, smaller[i].dimension, smaller[i].max_frequency,
                                         false, error));
        const ps_problem problem = {.frequencies = &set,
                                    .num_points = smaller[i].num_points,
                                    .tolerance = smaller[i].tolerance};
        const double two = created_for(&problem, 2);
        const double many = created_for(&problem, smaller[i].num_realizations);
        assert_true(many == two);
        ps_frequencies_free(&set);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_announced),
        cmocka_unit_test(as_announced_on_gpus),
        cmocka_unit_test(batches_of_one),
    };
    ps_error error = {0};
    if (ps_device_open(&device, getenv("POINTSPEC_DEVICE"), true, &error) != PSPEC_OK) {
        print_message("skipped: %s\n", error.message);
        return TEST_SKIPPED;
    }
    const int failures = cmocka_run_group_tests_name("nufft_announced", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
