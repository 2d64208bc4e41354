#include "harness_sphere.h"

#include "engines/host/host_direct.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

void test_sphere_point(double *u, double theta, double phi, double pole) {
    u[0] = sin(theta) * cos(phi);
    u[1] = sin(theta) * sin(phi);
    u[2] = pole * cos(theta);
}

void test_sphere_white(double *u, uint64_t *state) {
    const double z = 2 * test_uniform(state) - 1;
    const double rho = sqrt((1 - z) * (1 + z));
    const double phi = PS_TWO_PI * test_uniform(state);
    u[0] = rho * cos(phi);
    u[1] = rho * sin(phi);
    u[2] = z;
}

double *test_sphere_white_set(size_t num, uint64_t *state) {
    double *points = calloc(num * PS_SPHERE_DIMENSION, sizeof(double));
    assert_non_null(points);
    for (size_t j = 0; j < num; j++) {
        test_sphere_white(points + j * PS_SPHERE_DIMENSION, state);
    }
    return points;
}

ps_frequencies test_degrees(int32_t max_degree, bool only_even) {
    ps_frequencies degrees = {0};
    assert_ok(ps_frequencies_degrees(&degrees, max_degree, only_even, error));
    assert_ok(ps_frequencies_enumerate(&degrees, error));
    return degrees;
}

size_t test_coefficient(int32_t max_degree, int32_t l, int32_t m) {
    return (size_t)m * (2 * (size_t)max_degree + 1 - (size_t)m) / 2 + (size_t)l;
}

double *test_coefficients(const ps_engine *engine, ps_precision precision, ps_device *device,
                          const ps_frequencies *frequencies, const pspec_pattern *pattern) {
    const size_t max_degree = (size_t)frequencies->max_frequency;
    const ps_problem problem = {.frequencies = frequencies,
                                .num_points = pattern->num_points,
                                .num_realizations = 1,
                                .tolerance = precision == PS_SINGLE ? 1e-5 : 1e-12};
    double *out = calloc((max_degree + 1) * (max_degree + 2), sizeof(double));
    void *state = NULL;
    assert_non_null(out);
    assert_ok(ps_engine_create(engine, &state, &problem, precision, 1, device, error));
    assert_ok(engine->coefficients(state, &(ps_batch){.num_patterns = 1, .patterns = pattern}, NULL,
                                   out, error));
    ps_engine_destroy(engine, state);
    return out;
}

double test_degree_error(const double *coefficients, int32_t max_degree, int32_t l,
                         const pspec_pattern *pattern) {
    ps_host_degree exact;
    double sum = 0;
    assert_ok(ps_host_degree_create(&exact, l, error));
    ps_host_degree_sum(&exact, pattern);
    for (int32_t m = 0; m <= l; m++) {
        const double *c = coefficients + 2 * test_coefficient(max_degree, l, m);
        const double re = (double)(c[0] - exact.sums[m][0]);
        const double im = (double)(c[1] - exact.sums[m][1]);
        sum += (m > 0 ? 2 : 1) * (re * re + im * im);
    }
    ps_host_degree_free(&exact);
    return sum;
}

test_set test_read_sphere_set(const cJSON *json) {
    test_set set = {.name = cJSON_GetObjectItem(json, "name")->valuestring,
                    .dimension = PS_SPHERE_DIMENSION,
                    .num_points = (size_t)test_field(json, "N"),
                    .json = json};
    const cJSON *points = cJSON_GetObjectItem(json, "xyz");
    const cJSON *weights = cJSON_GetObjectItem(json, "w");
    set.points = calloc(set.num_points * PS_SPHERE_DIMENSION, sizeof(double));
    set.weights = cJSON_IsArray(weights) ? calloc(set.num_points, sizeof(double)) : NULL;
    for (size_t j = 0; j < set.num_points; j++) {
        const cJSON *point = cJSON_GetArrayItem(points, (int)j);
        for (int axis = 0; axis < PS_SPHERE_DIMENSION; axis++) {
            set.points[j * PS_SPHERE_DIMENSION + (size_t)axis] =
                test_number(cJSON_GetArrayItem(point, axis));
        }
        if (set.weights != NULL) {
            set.weights[j] = test_number(cJSON_GetArrayItem(weights, (int)j));
        }
        set.weight_size_sum += set.weights != NULL ? fabs(set.weights[j]) : 1;
    }
    set.weight_sum = test_field(json, "sum_w");
    set.weight_square_sum = test_field(json, "sum_w2");
    return set;
}
