/* The quadrature job: the same bits in any batches, the same answer by any route, the tolerance
 * kept. */
#include "harness.h"

#include "jobs/quadrature/quadrature_job.h"
#include "math/pi.h"
#include "samplers/sampler.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LAST = 12 };

typedef struct asked {
    ps_brdf *brdf;
    ps_sampler_request request;
    ps_quadrature_question question;
} asked;

/* *job must not be moved. */
static void ask(asked *job, const char *sampler, size_t num_points, uint64_t num_realizations,
                const char *engine) {
    *job = (asked){.request = {.num_points = num_points, .seed = 7}};
    assert_ok(ps_brdf_parse(&job->brdf, "diffuse", error));
    assert_ok(ps_sampler_parse(&job->request, sampler, error));
    assert_ok(ps_sampler_resolve(&job->request, error));
    job->question =
        (ps_quadrature_question){.brdf = job->brdf,
                                 .smoothness = 1.5,
                                 .sampler = &job->request,
                                 .num_realizations = num_realizations,
                                 .max_degree = LAST,
                                 .accuracy.tolerance = 1e-10,
                                 .limits.constraints = {.engine = engine, .precision = -1}};
}

static ps_quadrature_job *run(const ps_quadrature_question *question) {
    ps_quadrature_job *job = NULL;
    assert_ok(ps_quadrature_job_create(&job, question, error));
    assert_ok(ps_quadrature_job_run(job, error));
    assert_int_equal(job->setup.max_degree, LAST);
    return job;
}

static void same_bits(const ps_quadrature_result *a, const ps_quadrature_result *b) {
    assert_int_equal(a->num_realizations, b->num_realizations);
    assert_memory_equal(a->degrees, b->degrees, (LAST + 1) * sizeof *a->degrees);
    assert_memory_equal(&a->squared, &b->squared, sizeof a->squared);
    assert_memory_equal(&a->zonal, &b->zonal, sizeof a->zonal);
    assert_memory_equal(&a->anisotropic, &b->anisotropic, sizeof a->anisotropic);
    assert_memory_equal(&a->tail, &b->tail, sizeof a->tail);
}

static void batches(void **state) {
    static const char *const engines[] = {"host_direct", "sphere_direct", "sphere_nufft",
                                          "sphere_grid", "pairs_direct",  "pairs_histogram"};
    static const size_t sizes[] = {1, 3, 7};
    (void)state;
    for (size_t i = 0; i < sizeof engines / sizeof engines[0]; i++) {
        asked job;
        ask(&job, "white-hemisphere:morph=diffuse", 24, 10, engines[i]);
        ps_quadrature_job *const whole = run(&job.question);
        assert_true(strstr(ps_text_string(&whole->description), engines[i]) != NULL);
        for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++) {
            job.question.batch = sizes[k];
            ps_quadrature_job *const parts = run(&job.question);
            same_bits(&whole->result, &parts->result);
            ps_quadrature_job_destroy(parts);
        }
        ps_quadrature_job_destroy(whole);
        ps_brdf_destroy(job.brdf);
    }
}

/* Sums over pairs against coefficients: |dC_l^2| <= (2l + 1) / (4 pi) tol (sum |w|)^2, and so do
 * d_l^2 and e_l^2 follow. */
static void near(const ps_quadrature_job *one, const ps_quadrature_job *other, double tolerance) {
    const ps_quadrature_result *const a = &one->result;
    const ps_quadrature_result *const b = &other->result;
    double e = 0;
    for (size_t l = 0; l <= LAST; l++) {
        const double factor = (2 * (double)l + 1) / PS_FOUR_PI;
        assert_true(fabs(a->degrees[l].c2.mean - b->degrees[l].c2.mean) <= factor * tolerance);
        assert_true(fabs(a->degrees[l].d2.mean - b->degrees[l].d2.mean) <= factor * tolerance);
        e += fabs(a->degrees[l].e2.mean - b->degrees[l].e2.mean);
    }
    assert_true(e <= tolerance * one->setup.representer.constant);
    assert_true(fabs(a->squared.mean - b->squared.mean) <= a->numerical_bound + b->numerical_bound);
}

/* A set alone goes through its coefficients, unless an engine for pairs is named. */
static void two_routes(void **state) {
    static const char *const samplers[] = {"fibonacci-hemisphere:morph=diffuse",
                                           "white-hemisphere:morph=none"};
    (void)state;
    for (size_t i = 0; i < 2; i++) {
        asked job;
        ask(&job, samplers[i], 64, 1, "host_direct");
        ps_quadrature_job *const coefficients = run(&job.question);
        job.question.limits.constraints.engine = "pairs_direct";
        ps_quadrature_job *const pairs = run(&job.question);
        assert_true(strstr(ps_text_string(&pairs->description), "pairs_direct") != NULL);
        near(coefficients, pairs, 1e-14);
        ps_quadrature_job_destroy(coefficients);
        ps_quadrature_job_destroy(pairs);
        ps_brdf_destroy(job.brdf);
    }
}

/* Points in a heap, which no lobe predicts: the plan is made again with the powers that were
 * measured, and what comes out is within the tolerance. */
static void replanned(void **state) {
    static const double tolerances[] = {5e-7, 7e-7, 1e-6,
                                        2e-6}; /* near what single precision has */
    int num_replanned = 0;
    (void)state;
    for (size_t i = 0; i < sizeof tolerances / sizeof tolerances[0]; i++) {
        asked job;
        ask(&job, "white-hemisphere:morph=glossy,n=5000", 64, 4, "sphere_nufft");
        job.question.accuracy.tolerance = tolerances[i];
        ps_quadrature_job *const result = run(&job.question);
        job.question.limits.constraints.engine = "host_direct";
        ps_quadrature_job *const exact = run(&job.question);
        near(exact, result, tolerances[i]);
        assert_int_equal(exact->runner.num_replans, 0);
        num_replanned += result->runner.num_replans > 0 ? 1 : 0;
        ps_quadrature_job_destroy(exact);
        ps_quadrature_job_destroy(result);
        ps_brdf_destroy(job.brdf);
    }
    assert_true(num_replanned > 0);
}

/* ---- standard error -------------------------------------------------------------------------- */

/* E^2 and two degrees from sums of three realizations; the second degree is small. */
static void looks(void **state) {
    static const double values[3][3] = {{1, 2, 3}, {4, 5, 6}, {0, 1e-9, 2e-9}};
    ps_sums sums[3] = {{0}};
    (void)state;
    for (int i = 0; i < 3; i++) {
        for (int r = 0; r < 3; r++) {
            ps_sums_add(&sums[i], values[i][r]);
        }
    }
    const ps_quadrature_sums all = {2, sums + 1, 1, sums};
    const double root = sqrt(3.0);
    ps_sequential_look look = ps_quadrature_look(&all, 1e-8, 3);
    assert_int_equal(look.bin,
                     PS_LOOK_AT_E2); /* 1, 2, 3: standard error 1 / sqrt 3 of a mean of 2 */
    assert_true(fabs(look.relative_error - 1 / root / 2) < 1e-15);
    assert_true(fabs(look.corrected - look.relative_error * (1 + 0.75 * sqrt((2 + 4.0) / 3))) <
                1e-15);
    look = ps_quadrature_look(&all, 3,
                              3); /* degree 0 alone is above that: one real number, kurtosis 12 */
    assert_int_equal(look.bin, 0);
    assert_true(fabs(look.relative_error - 1 / root / 5) < 1e-15);
    assert_true(fabs(look.corrected - look.relative_error * (1 + 0.75 * sqrt(14.0 / 3))) < 1e-15);
    look = ps_quadrature_look(&all, 1e-10, 3); /* and now the small one counts */
    assert_int_equal(look.bin, 1);
    look = ps_quadrature_look(&all, 10, 3);
    assert_true(look.bin == PS_LOOK_AT_NOTHING && look.corrected == 0);
}

/* Ends at a look, whatever the batch, with the bits of a job of so many realizations; and what it
 * says is true. */
static void stops(void **state) {
    static const size_t sizes[] = {0, 5, 100};
    static const ps_weights_kind weights[] = {PS_WEIGHTS_EQUAL, PS_WEIGHTS_OPTIMAL};
    const double wanted = 0.2;
    (void)state;
    for (size_t i = 0; i < sizeof weights / sizeof weights[0]; i++) {
        asked job;
        ask(&job, "white-hemisphere:morph=diffuse", 16, 5000, "pairs_direct");
        job.question.weights.kind = weights[i];
        job.question.accuracy.standard_error = wanted;
        ps_quadrature_job *const whole = run(&job.question);
        const uint64_t num = whole->result.num_realizations;
        assert_true(num > PS_LEAST_REALIZATIONS && num < 1000);
        assert_int_equal(ps_sequential_next_look(num - 1), num);
        assert_true(whole->result.has_look && whole->result.look.corrected <= wanted);
        assert_true(whole->result.squared.standard_error <= wanted * whole->result.squared.mean);
        const double least = job.question.accuracy.tolerance * whole->setup.representer.constant *
                             whole->result.weight_size * whole->result.weight_size;
        for (size_t l = 0; l <= LAST; l++) {
            const ps_mean e2 = whole->result.degrees[l].e2;
            assert_true(e2.mean <= least || e2.standard_error <= wanted * e2.mean);
        }
        for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++) {
            job.question.batch = sizes[k];
            ps_quadrature_job *const parts = run(&job.question);
            same_bits(&whole->result, &parts->result);
            ps_quadrature_job_destroy(parts);
        }
        job.question.accuracy.standard_error = 0;
        job.question.num_realizations = num;
        ps_quadrature_job *const exactly = run(&job.question);
        same_bits(&whole->result, &exactly->result);
        assert_false(exactly->result.has_look);
        ps_quadrature_job_destroy(exactly);
        ps_quadrature_job_destroy(whole);
        ps_brdf_destroy(job.brdf);
    }
}

/* A deterministic rule is done once; without skips all there are, which is said. */
static void one_is_enough(void **state) {
    asked job;
    (void)state;
    ask(&job, "fibonacci-hemisphere:morph=diffuse", 24, 20, NULL);
    job.question.accuracy.standard_error = 0.01;
    ps_quadrature_job *const once = run(&job.question);
    assert_true(once->result.num_realizations == 1 && !once->result.has_look);
    job.question.accuracy.no_skip = true;
    ps_quadrature_job *const every = run(&job.question);
    assert_true(every->result.num_realizations == 20 && every->result.has_look &&
                every->result.look.corrected < 1e-12);
    assert_true(fabs(once->result.squared.mean - every->result.squared.mean) <= 1e-15);
    ps_quadrature_job_destroy(once);
    ps_quadrature_job_destroy(every);
    ps_brdf_destroy(job.brdf);
}

/* In batches, whose last one is short. */
static void gpus_sum_distances(void **state) {
    asked job;
    ps_device *const gpu = test_open_gpu();
    (void)state;
    ask(&job, "white-hemisphere:morph=diffuse", 65, 10, "sphere_direct");
    ps_quadrature_job *const by_host = run(&job.question);
    job.question.open_device = gpu;
    ps_quadrature_job *const whole = run(&job.question);
    assert_true(whole->rules.distances != NULL && by_host->rules.distances == NULL);
    job.question.batch = 4;
    ps_quadrature_job *const parts = run(&job.question);
    same_bits(&whole->result, &parts->result);
    assert_true(fabs(whole->result.squared.mean - by_host->result.squared.mean) <=
                whole->result.numerical_bound + by_host->result.numerical_bound);
    ps_quadrature_job_destroy(by_host);
    ps_quadrature_job_destroy(whole);
    ps_quadrature_job_destroy(parts);
    ps_brdf_destroy(job.brdf);
    ps_device_close(gpu);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gpus_sum_distances),
        cmocka_unit_test(batches),
        cmocka_unit_test(two_routes),
        cmocka_unit_test(replanned),
        cmocka_unit_test(looks),
        cmocka_unit_test(stops),
        cmocka_unit_test(one_is_enough),
    };
    ps_device_close(test_open_device()); /* skips where there is none */
    return cmocka_run_group_tests(tests, NULL, NULL);
}
