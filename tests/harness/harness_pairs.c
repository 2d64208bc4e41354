#include "harness_pairs.h"

#include "engines/error_units.h"
#include "engines/host/host_direct.h"

#include <math.h>
#include <stdlib.h>

long double *test_pair_sums(const pspec_pattern *pattern, int32_t max_degree) {
    long double *sums = calloc((size_t)max_degree + 1, sizeof *sums);
    assert_non_null(sums);
    assert_ok(ps_host_pairs(pattern, 0, max_degree, sums, error));
    return sums;
}

double test_weight_sizes(const pspec_pattern *pattern) {
    double sum = 0;
    for (size_t j = 0; j < pattern->num_points; j++) {
        sum += pattern->weights != NULL ? fabs(pattern->weights[j]) : 1;
    }
    return sum;
}

static double share_of(const pspec_pattern *pattern) {
    const double sizes = test_weight_sizes(pattern);
    double squares = 0;
    for (size_t j = 0; j < pattern->num_points; j++) {
        squares += pattern->weights != NULL ? pattern->weights[j] * pattern->weights[j] : 1;
    }
    return squares / (sizes * sizes);
}

static ps_problem make_problem(const ps_frequencies *degrees, const pspec_pattern *patterns,
                               size_t num_patterns, double tolerance) {
    ps_problem problem = {.frequencies = degrees,
                          .num_realizations = num_patterns,
                          .has_weights = true,
                          .measure = PS_OF_PAIR_SUMS,
                          .tolerance = tolerance};
    for (size_t r = 0; r < num_patterns; r++) {
        const uint64_t num = patterns[r].num_points;
        problem.num_points = num > problem.num_points ? num : problem.num_points;
        problem.weight_share = fmax(problem.weight_share, share_of(&patterns[r]));
    }
    return problem;
}

double *test_run_pairs(const ps_engine *engine, ps_precision precision, double tolerance,
                       ps_device *device, int32_t max_degree, const pspec_pattern *patterns,
                       size_t num_patterns, size_t batch) {
    ps_frequencies degrees = test_degrees(max_degree, false);
    const ps_problem asked = make_problem(&degrees, patterns, num_patterns, tolerance);
    const ps_problem own = ps_engine_problem(engine, &asked);
    double *q = test_run_problem(engine, &own, precision, device, patterns, num_patterns, batch);
    ps_frequencies_free(&degrees);
    return q;
}

double test_pairs_error(const ps_engine *engine, ps_precision precision, double tolerance,
                        ps_device *device, int32_t max_degree, const pspec_pattern *pattern) {
    double *q = test_run_pairs(engine, precision, tolerance, device, max_degree, pattern, 1, 1);
    long double *exact = test_pair_sums(pattern, max_degree);
    const double sizes = test_weight_sizes(pattern);
    double worst = 0;
    for (int32_t l = 1; l <= max_degree; l++) {
        const double off = fabs((double)(q[l - 1] - exact[l])) / (sizes * sizes);
        worst = off > worst || isnan(off) ? off : worst;
    }
    free(q);
    free(exact);
    return worst;
}

void test_need_precision(const ps_device *device, ps_precision precision) {
    if (precision == PS_DOUBLE && !ps_device_get_limits(device)->has_fp64) {
        skip();
    }
}
