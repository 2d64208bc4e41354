#include "harness_sphere_shapes.h"

#include "engines/host_degree.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.141592653589793;

/* ---- places ------------------------------------------------------------------------------ */

static void white(size_t point, size_t num_points, uint64_t *state, double angles[2]) {
    (void)point;
    (void)num_points;
    angles[0] = 2 * asin(sqrt(test_uniform(state)));
    angles[1] = 2 * pi * test_uniform(state);
}

static void spiral(size_t point, size_t num_points, uint64_t *state, double angles[2]) {
    const double golden_angle = 2.399963229728653;
    (void)state;
    angles[0] = acos(1 - (2 * (double)point + 1) / (double)num_points);
    angles[1] = fmod(golden_angle * (double)point, 2 * pi);
}

static void near_pole(size_t point, size_t num_points, uint64_t *state, double angles[2]) {
    white(point, num_points, state, angles);
    angles[0] = 1e-2 * test_uniform(state);
}

static void at_poles(size_t point, size_t num_points, uint64_t *state, double angles[2]) {
    (void)num_points;
    angles[0] = point % 2 == 0 ? 0 : pi;
    angles[1] = 2 * pi * test_uniform(state);
}

static void one_place(size_t point, size_t num_points, uint64_t *state, double angles[2]) {
    (void)point;
    (void)num_points;
    (void)state;
    angles[0] = 1.1;
    angles[1] = 2.3;
}

static void cluster(size_t point, size_t num_points, uint64_t *state, double angles[2]) {
    (void)point;
    (void)num_points;
    angles[0] = 1.9 + 3e-3 * test_uniform(state);
    angles[1] = 6.28 + 3e-3 * test_uniform(state);
}

/* Rows of points on circles, as many on each: regular along both angles. */
static void rows(size_t point, size_t num_points, uint64_t *state, double angles[2]) {
    const size_t side = (size_t)ceil(sqrt((double)num_points));
    (void)state;
    angles[0] = pi * ((double)(point / side) + 0.5) / (double)side;
    angles[1] = 2 * pi * (double)(point % side) / (double)side;
}

static void meridian(size_t point, size_t num_points, uint64_t *state, double angles[2]) {
    (void)state;
    angles[0] = pi * ((double)point + 0.5) / (double)num_points;
    angles[1] = 0;
}

static double signed_weight(size_t point, uint64_t *state) {
    (void)point;
    return 2 * test_uniform(state) - 1;
}

/* Over 12 decades. */
static double wild_weight(size_t point, uint64_t *state) {
    (void)point;
    return pow(10, 12 * test_uniform(state) - 6);
}

const test_sphere_shape test_sphere_shapes[TEST_SPHERE_SHAPES] = {
    {"white", white, NULL},
    {"spiral", spiral, NULL},
    {"near the pole", near_pole, NULL},
    {"poles", at_poles, NULL},
    {"one place", one_place, NULL},
    {"cluster", cluster, NULL},
    {"rows", rows, NULL},
    {"meridian", meridian, NULL},
    {"signed weights", white, signed_weight},
    {"wild weights", white, wild_weight},
};

pspec_pattern test_make_sphere_pattern(const test_sphere_shape *shape, size_t num_points,
                                       uint64_t seed) {
    uint64_t state = seed;
    double *points = calloc(num_points, PS_SPHERE_DIMENSION * sizeof(double));
    double *weights = shape->weight != NULL ? calloc(num_points, sizeof(double)) : NULL;
    for (size_t j = 0; j < num_points; j++) {
        double angles[2];
        shape->place(j, num_points, &state, angles);
        const double rho = angles[0] == pi ? 0 : sin(angles[0]);
        points[3 * j] = rho * cos(angles[1]);
        points[3 * j + 1] = rho * sin(angles[1]);
        points[3 * j + 2] = cos(angles[0]);
        if (weights != NULL) {
            weights[j] = shape->weight(j, &state);
        }
    }
    return (pspec_pattern){.num_points = num_points, .points = points, .weights = weights};
}

void test_free_sphere_pattern(pspec_pattern *pattern) {
    free((void *)(uintptr_t)pattern->points);
    free((void *)(uintptr_t)pattern->weights);
    *pattern = (pspec_pattern){0};
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
    const double unit = 4 * pi / num / sum_of_squares(pattern);
    *mean_power = power * unit;
    return sqrt(sum * unit);
}
