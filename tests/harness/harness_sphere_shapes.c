#include "harness_sphere_shapes.h"

#include "harness_sphere.h"

#include "engines/host/host_direct.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

pspec_pattern test_make_sphere_pattern(const test_sphere_shape *shape, size_t num_points,
                                       uint64_t seed) {
    pspec_pattern pattern;
    assert_ok(ps_stress_shape_make(shape, PS_SPHERE_DIMENSION, num_points, seed, &pattern, error));
    return pattern;
}

void test_free_sphere_pattern(pspec_pattern *pattern) {
    ps_stress_pattern_free(pattern);
}

/* ---- coefficients ------------------------------------------------------------------------ */

double *test_sphere_coefficients(const pspec_pattern *pattern, int32_t max_degree, int32_t step) {
    const size_t L = (size_t)max_degree;
    double *out = calloc((L + 1) * (L + 2), sizeof(double));
    for (int32_t l = 0; l <= max_degree; l += step) {
        ps_host_degree degree;
        assert_ok(ps_host_degree_create(&degree, l, error));
        ps_host_degree_sum(&degree, pattern);
        for (size_t m = 0; m <= (size_t)l; m++) {
            double *to = out + 2 * (m * (2 * L + 1 - m) / 2 + (size_t)l);
            to[0] = (double)degree.sums[m][0];
            to[1] = (double)degree.sums[m][1];
        }
        ps_host_degree_free(&degree);
    }
    return out;
}

static double sum_of_squares(const pspec_pattern *pattern) {
    double sum = 0;
    for (size_t j = 0; j < pattern->num_points; j++) {
        sum += pattern->weights != NULL ? pattern->weights[j] * pattern->weights[j] : 1;
    }
    return sum;
}

double test_sphere_error(const double *found, const double *expected, int32_t max_degree,
                         int32_t step, const pspec_pattern *pattern, double *mean_power) {
    const size_t L = (size_t)max_degree;
    double sum = 0;
    double power = 0;
    double num = 0;
    for (size_t l = (size_t)step; l <= L; l += (size_t)step) {
        for (size_t m = 0; m <= l; m++) {
            const size_t at = 2 * (m * (2 * L + 1 - m) / 2 + l);
            const double re = found[at] - expected[at];
            const double im = found[at + 1] - expected[at + 1];
            const double signs = m == 0 ? 1 : 2;
            sum += signs * (re * re + im * im);
            power += signs * (expected[at] * expected[at] + expected[at + 1] * expected[at + 1]);
            num += signs;
        }
    }
    const double unit = PS_FOUR_PI / num / sum_of_squares(pattern);
    *mean_power = power * unit;
    return sqrt(sum * unit);
}

/* ---- points drawn one by one ------------------------------------------------------------- */

pspec_pattern test_draw_sphere_pattern(const test_point_shape *shape, size_t num_points,
                                       uint64_t seed, double *squares) {
    double *points = calloc(num_points * PS_SPHERE_DIMENSION, sizeof(double));
    double *weights = shape->weight != NULL ? calloc(num_points, sizeof(double)) : NULL;
    *squares = 0;
    for (size_t j = 0; j < num_points; j++) {
        shape->point(points + j * PS_SPHERE_DIMENSION, &seed);
        const double weight = weights != NULL ? (weights[j] = shape->weight(&seed)) : 1;
        *squares += weight * weight;
    }
    return (pspec_pattern){PS_SPHERE_DIMENSION, num_points, points, weights};
}

void test_sphere_clustered(double *u, uint64_t *state) {
    test_sphere_point(u, 1 + 1e-3 * test_uniform(state), 2 + 1e-3 * test_uniform(state), -1);
}

double test_wild_weight(uint64_t *state) {
    const double decades = 12;
    return pow(10, decades * (test_uniform(state) - 0.5)) * (test_uniform(state) < 0.3 ? -1 : 1);
}
