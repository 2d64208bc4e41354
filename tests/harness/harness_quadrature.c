#include "harness_quadrature.h"

#include "samplers/sampler.h"

#include <stdlib.h>

ps_representer test_representer(const char *brdf_text, double smoothness, double tolerance) {
    ps_representer representer = {0};
    ps_brdf *brdf = NULL;
    assert_ok(ps_brdf_parse(&brdf, brdf_text, error));
    assert_ok(ps_representer_create(&representer, brdf, smoothness, tolerance, 0, error));
    ps_brdf_destroy(brdf);
    return representer;
}

double *test_rule_points(const char *text, size_t num, uint64_t realization) {
    ps_sampler_request request = {.num_points = num, .seed = 11};
    double *points = calloc(3 * num, sizeof *points);
    assert_ok(ps_sampler_parse(&request, text, error));
    assert_ok(ps_sampler_resolve(&request, error));
    assert_ok(ps_sampler_generate(&request, realization, points, NULL, NULL, error));
    return points;
}

double test_squared_error(const ps_representer *r, size_t num, const double *points,
                          const double *weights) {
    const ps_rule rule = {num, points, weights};
    ps_kernel_error e;
    assert_ok(ps_kernel_error_of(r, &rule, NULL, NULL, NULL, &e, error));
    return e.squared;
}
