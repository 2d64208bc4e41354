/* Whole jobs whose points a GPU makes itself, beside the same jobs with points of the host: equal
 * bits, whichever engine takes them. */
#include "harness_estimator.h"

#include "jobs/self_check.h"
#include "jobs/spectrum/power_job.h"

static ps_device *device;

typedef struct job_case {
    const char *sampler, *engine;
    size_t num_points;
    unsigned dimension;    /* 3: where the sampler is on the sphere, unit vectors */
    int32_t max_frequency; /* or degree */
    uint64_t num_realizations;
    double tolerance;
} job_case;

static const job_case cases[] = {
    {"white", "torus_direct", 37, 2, 4, 300, 1e-5},
    {"jittered", "torus_nufft", 108, 2, 12, 9, 1e-5},
    {"sobol:scramble=owen", "torus_direct", 33, 3, 3, 3, 1e-12},
    {"white", "torus_nufft", PS_SELF_CHECK_POINTS + 1001, 2, 8, 1, 1e-3}, /* comes in parts */
    {"white-sphere", "sphere_nufft", 61, 3, 9, 300, 1e-5},
    {"white-hemisphere", "sphere_nufft", 64, 3, 8, 9, 1e-5},
    {"zphi", "sphere_nufft", 48, 3, 12, 9, 1e-9},
    {"zphi", "sphere_nufft", 3072, 3, 12, 2, 1e-9},
    {"jittered:lift=hemisphere", "sphere_nufft", 36, 3, 12, 5, 1e-5},
    {"white-hemisphere:morph=diffuse", "sphere_nufft", PS_SELF_CHECK_POINTS + 9, 3, 9, 2, 1e-5},
    {"fibonacci-hemisphere:morph=diffuse", "sphere_nufft", 61, 3, 9, 1, 1e-5},
    {"white:lift=sphere", "sphere_nufft", PS_SELF_CHECK_POINTS + 1001, 3, 70, 1, 1e-3},
    {"zphi", "sphere_nufft", 200000, 3, 40, 1, 1e-5},
};

static uint64_t count_launches(void) { /* of kernels that make points */
    return test_count_launches(device, "sampler_");
}

/* The picture of the first set wants its points on the host. */
static ps_power_job *run(const job_case *one, bool with_picture) {
    ps_power_job *job = NULL;
    ps_sampler_request request = {
        .num_points = one->num_points, .dimension = one->dimension, .seed = UINT64_C(7) << 33};
    assert_ok(ps_sampler_parse(&request, one->sampler, error));
    assert_ok(ps_sampler_resolve(&request, error));
    const bool on_sphere = ps_sampler_is_on_sphere(&request);
    const ps_power_question question = {
        .sampler = &request,
        .on_sphere = on_sphere,
        .on_hemisphere = ps_sampler_is_on_hemisphere(&request),
        .max_degree = on_sphere ? one->max_frequency : 0,
        .num_realizations = one->num_realizations,
        .frequencies = {.max_frequency = one->max_frequency},
        .accuracy = {.tolerance = one->tolerance},
        .limits = {.constraints = {.engine = one->engine, .precision = -1}},
        .keeps_first = with_picture,
        .open_device = device,
    };
    assert_ok(ps_power_job_create(&job, &question, error));
    assert_ok(ps_power_job_run(job, error));
    return job;
}

static void the_points_of_a_job_have_the_same_bits_either_way(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const uint64_t before = count_launches();
        ps_power_job *const made = run(&cases[i], false);
        const uint64_t after = count_launches();
        ps_power_job *const given = run(&cases[i], true);
        assert_true(after > before && count_launches() == after);
        assert_true(test_is_same_bits(&made->spectrum, &given->spectrum));
        assert_string_equal(ps_text_string(&made->description),
                            ps_text_string(&given->description));
        assert_true(made->runner.accuracy.was_checked);
        assert_true(made->runner.accuracy.self_check == given->runner.accuracy.self_check);
        ps_power_job_destroy(made);
        ps_power_job_destroy(given);
    }
}

/* Engines cut batches. */
static void parts_of_a_batch_have_its_realizations(void **state) {
    (void)state;
    const pspec_pattern patterns[4] = {{0}};
    const ps_batch batch = {.num_patterns = 4, .patterns = patterns, .realization = 10};
    const ps_batch middle = ps_batch_part(&batch, 1, 2);
    const ps_batch last = ps_batch_part(&batch, 3, 2);
    assert_true(middle.patterns == patterns + 1 && middle.num_patterns == 2);
    assert_true(last.patterns == patterns + 3 && last.num_patterns == 1);
    assert_int_equal(middle.realization, 11);
    assert_int_equal(last.realization, 13);
}

/* A CPU has the host's points. */
static void cpus_make_no_points(void **state) {
    (void)state;
    const uint64_t before = count_launches();
    ps_device_set_dedicated_local_memory(device, false);
    ps_power_job_destroy(run(&cases[0], false));
    ps_device_set_dedicated_local_memory(device, true);
    assert_true(count_launches() == before || ps_device_get_limits(device)->is_gpu);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_points_of_a_job_have_the_same_bits_either_way),
        cmocka_unit_test(parts_of_a_batch_have_its_realizations),
        cmocka_unit_test(cpus_make_no_points),
    };
    device = test_open_gpu();
    const int failures = cmocka_run_group_tests_name("device_sets", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
