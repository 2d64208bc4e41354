/* A sampler whose number of points changes from realization to realization, through the jobs. The
 * one here is of this test: white points, three more for every number of the realization. */
#include "harness_estimator.h"

#include "jobs/quadrature/quadrature_job.h"
#include "jobs/spectrum/power_job.h"
#include "math/random/random.h"
#include "samplers/sampler.h"

#include <math.h>
#include <stdlib.h>

enum { N = 50, M = 5, STEP = 3, K = 4 };

static size_t number_of(uint64_t realization) {
    return N + STEP * (size_t)realization;
}

static bool always(const ps_sampler_request *request) {
    (void)request;
    return true;
}

static bool never(const ps_sampler_request *request) {
    (void)request;
    return false;
}

static size_t most_points(const ps_sampler_request *request) {
    return request->num_points + (size_t)STEP * M;
}

static pspec_status generate_some(const ps_sampler_request *request, uint64_t realization,
                                  double *points, size_t *num_points, ps_error *error) {
    (void)error;
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    *num_points = number_of(realization);
    ps_random_fill_uniform(&random, points, *num_points * request->dimension);
    return PSPEC_OK;
}

static const ps_sampler growing = {
    .name = "growing",
    .maximum_dimension = PS_MAX_DIMENSION,
    .nanoseconds = 1,
    .varies = always,
    .most_points = most_points,
    .is_deterministic = never,
    .generate_some = generate_some,
};

static ps_sampler_request make_growing(ps_sampler_domain lift) {
    return (ps_sampler_request){.sampler = &growing,
                                .lift = lift,
                                .num_points = N,
                                .dimension = lift == PS_SAMPLES_TORUS ? 2 : 3,
                                .seed = 4};
}

/* N |S(k)|^2 / N^2 of the realization, in plain arithmetic. */
static double power_of(const ps_sampler_request *request, uint64_t realization, const int32_t *k) {
    double points[2 * (N + STEP * M)];
    size_t num = 0;
    double re = 0;
    double im = 0;
    assert_int_equal(ps_sampler_generate(request, realization, points, &num, NULL, NULL), PSPEC_OK);
    assert_int_equal(num, number_of(realization));
    for (size_t j = 0; j < num; j++) {
        const double turn = points[2 * j] * k[0] + points[2 * j + 1] * k[1];
        re += cos(2 * acos(-1) * turn);
        im += sin(2 * acos(-1) * turn);
    }
    return (re * re + im * im) / (double)num;
}

static void each_realization_has_its_own_number(void **state) {
    (void)state;
    ps_error error = {0};
    const ps_sampler_request request = make_growing(PS_SAMPLES_TORUS);
    const ps_power_question question = {.sampler = &request,
                                        .num_realizations = M,
                                        .frequencies.max_frequency = K,
                                        .wants_full_array = true,
                                        .accuracy.tolerance = 1e-6,
                                        .limits.constraints = {.precision = -1},
                                        .limits.device = getenv("POINTSPEC_DEVICE")};
    ps_power_job *job = NULL;
    assert_int_equal(ps_power_job_create(&job, &question, &error), PSPEC_OK);
    assert_int_equal(job->problem.num_points, N + STEP * M);
    assert_int_equal(job->problem.planned_points, N);
    assert_int_equal(ps_power_job_run(job, &error), PSPEC_OK);
    const ps_spectrum *const spectrum = &job->spectrum;
    assert_int_equal(spectrum->smallest_points, N);
    assert_int_equal(spectrum->largest_points, number_of(M - 1));
    for (size_t i = 0; i < spectrum->frequencies.num; i++) {
        double sum = 0;
        for (uint64_t r = 0; r < M; r++) {
            sum += power_of(&request, r, spectrum->frequencies.vectors + 2 * i);
        }
        assert_true(fabs(spectrum->powers[i].mean - sum / M) < 1e-4 * (1 + sum / M));
    }
    ps_power_job_destroy(job);
}

/* Homogenized and lifted: all points of a realization are moved, not the first N. */
static void all_points_are_moved(void **state) {
    (void)state;
    ps_error error = {0};
    ps_sampler_request request = make_growing(PS_SAMPLES_SPHERE);
    request.homogenize = true;
    const size_t last = number_of(M - 1);
    double points[3 * (N + STEP * M)];
    size_t num = 0;
    assert_int_equal(ps_sampler_generate(&request, M - 1, points, &num, NULL, &error), PSPEC_OK);
    assert_int_equal(num, last);
    for (size_t j = 0; j < num; j++) {
        const double *const u = points + 3 * j;
        assert_true(fabs(u[0] * u[0] + u[1] * u[1] + u[2] * u[2] - 1) < 1e-14);
    }
    request.homogenize = false;
    double plain[3 * (N + STEP * M)];
    assert_int_equal(ps_sampler_generate(&request, M - 1, plain, &num, NULL, &error), PSPEC_OK);
    const double *const a = points + 3 * (last - 1);
    const double *const b = plain + 3 * (last - 1);
    assert_true(fabs(a[0] - b[0]) + fabs(a[1] - b[1]) + fabs(a[2] - b[2]) > 1e-3);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_realization_has_its_own_number),
        cmocka_unit_test(all_points_are_moved),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
