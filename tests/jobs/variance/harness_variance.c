#include "harness_variance.h"

#include <stdlib.h>

void test_variance_add(test_variance *out, const char *integrand) {
    assert_true(out->question.num_integrands < TEST_MOST_INTEGRANDS);
    out->texts[out->question.num_integrands++] = integrand;
}

void test_variance_ask(test_variance *out, const char *sampler, size_t num_points,
                       uint64_t num_realizations, const char *integrand, ps_device *device) {
    *out = (test_variance){.sampler = {.num_points = num_points, .seed = 1}};
    assert_ok(ps_sampler_parse(&out->sampler, sampler, error));
    assert_ok(ps_sampler_resolve(&out->sampler, error));
    out->question = (ps_variance_question){
        .spectrum = {.sampler = &out->sampler,
                     .num_realizations = num_realizations,
                     .on_sphere = ps_sampler_is_on_sphere(&out->sampler),
                     .on_hemisphere = ps_sampler_is_on_hemisphere(&out->sampler),
                     .wants_full_array = true,
                     .normalization = PSPEC_NORMALIZATION_INTEGRAL,
                     .accuracy.tolerance = 1e-6,
                     .limits.constraints = {.engine = device == NULL ? "host_direct" : NULL,
                                            .precision = -1},
                     .open_device = device},
        .texts = out->texts,
        .made = &out->made,
        .num_shifts = 1,
        .is_moved = true};
    test_variance_add(out, integrand);
}

const ps_variance_row *test_variance_run(test_variance *asked) {
    test_variance_free(asked);
    assert_ok(ps_variance_question_check(&asked->question, error));
    assert_ok(ps_variance_job_create(&asked->job, &asked->question, error));
    assert_ok(ps_variance_job_run(asked->job, error));
    return asked->job->rows;
}

const ps_spectrum *test_variance_spectrum(const test_variance *asked) {
    return &asked->job->spectrum->spectrum;
}

const ps_integrand *test_variance_integrand(const test_variance *asked, size_t index) {
    return asked->job->integrands[index];
}

void test_variance_free(test_variance *asked) {
    ps_variance_job_destroy(asked->job);
    ps_made_integrands_free(&asked->made);
    asked->job = NULL;
}

double *test_variance_points(const test_variance *asked, uint64_t realization, size_t *num_points) {
    const ps_sampler_request *const sampler = &asked->sampler;
    double *const points =
        calloc(ps_sampler_most_points(sampler) * sampler->dimension, sizeof *points);
    assert_non_null(points);
    assert_ok(ps_sampler_generate(sampler, realization, points, num_points, NULL, error));
    return points;
}
