/* The error formula of sphere_direct holds, and is no more than a few times too large: point sets
 * of every kind against the referee, c_lm by c_lm. */
#include "harness_sphere.h"
#include "harness_sphere_shapes.h"

#include "engines/engine.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;

/* Within 0.02 of the north or south pole. */
static void near_poles(double *u, uint64_t *state) {
    const double theta = 0.02 * sqrt(test_uniform(state));
    test_sphere_point(u, theta, PS_TWO_PI * test_uniform(state),
                      test_uniform(state) < 0.5 ? -1 : 1);
}

static void near_equator(double *u, uint64_t *state) {
    const double quarter = PS_TWO_PI / 4;
    test_sphere_point(u, quarter + 1e-3 * test_uniform(state), PS_TWO_PI * test_uniform(state), 1);
}

static void one_place(double *u, uint64_t *state) {
    (void)state;
    test_sphere_point(u, 1.234, 3.456, 1);
}

static const test_point_shape shapes[] = {
    {"white", test_sphere_white, NULL},   {"near poles", near_poles, NULL},
    {"near equator", near_equator, NULL}, {"clustered", test_sphere_clustered, NULL},
    {"one place", one_place, NULL},       {"wild weights", test_sphere_white, test_wild_weight},
};

typedef struct job {
    const test_point_shape *shape;
    size_t num_points;
    int32_t max_degree;
} job;

/* sqrt(4 pi mean |dc_lm|^2 / V) over some degrees: small ones, middle ones and the last. */
static double measure(const ps_frequencies *degrees, const double *c, const pspec_pattern *pattern,
                      double squares) {
    const double four_pi = 2 * PS_TWO_PI;
    const int32_t last = degrees->max_frequency;
    const int32_t some[] = {last / 8, last / 4, last / 2, 3 * last / 4, last - 1, last};
    double sum = 0;
    double num = 0;
    for (size_t i = 0; i < sizeof some / sizeof some[0]; i++) {
        sum += test_degree_error(c, last, some[i], pattern);
        num += 2 * some[i] + 1;
    }
    return sqrt(four_pi * sum / num / squares);
}

static double mean_power(const ps_frequencies *degrees, const double *c, double squares) {
    const double four_pi = 2 * PS_TWO_PI;
    const int32_t last = degrees->max_frequency;
    double sum = 0;
    for (int32_t m = 0; m <= last; m++) {
        for (int32_t l = m > 0 ? m : 1; l <= last; l++) {
            const double *one = c + 2 * test_coefficient(last, l, m);
            sum += (m > 0 ? 2 : 1) * (one[0] * one[0] + one[1] * one[1]);
        }
    }
    return four_pi * sum / ((double)last * (last + 2.0)) / squares;
}

static void check(const job *one, ps_precision precision) {
    const size_t num = one->num_points;
    double squares = 0;
    pspec_pattern pattern = test_draw_sphere_pattern(one->shape, num, 5, &squares);
    ps_frequencies degrees = test_degrees(one->max_degree, false);
    double *c = test_coefficients(&ps_sphere_direct, precision, device, &degrees, &pattern);
    const ps_problem problem = {.frequencies = &degrees, .num_points = num, .tolerance = 1};
    const double power = mean_power(&degrees, c, squares);
    const double error = measure(&degrees, c, &pattern, squares);
    const double formula = test_engine_error(&ps_sphere_direct, &problem, precision, device, power);
    print_message("%-13s N %6zu L %5d %-7s power %9.3g error %9.3g formula %9.3g slack %5.2f\n",
                  one->shape->name, num, one->max_degree, ps_precision_name(precision), power,
                  error, formula, formula / error);
    assert_true(error <= formula);
    free(c);
    test_free_sphere_pattern(&pattern);
    ps_frequencies_free(&degrees);
}

static void sweep(ps_precision precision) {
    static const int32_t all[] = {4, 16, 64, 256, 1024};
    if (precision == PS_DOUBLE && !ps_device_get_limits(device)->has_fp64) {
        skip();
    }
    for (size_t s = 0; s < sizeof shapes / sizeof shapes[0]; s++) {
        for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
            const size_t num = all[i] < 1000 ? 1000 : 100;
            check(&(job){&shapes[s], num, all[i]}, precision);
        }
    }
    check(&(job){&shapes[0], 20, 4096}, precision);
    check(&(job){&shapes[0], 80000, 16}, precision);
    check(&(job){&shapes[0], 20000, 128}, precision);
    check(&(job){&shapes[4], 20000, 16}, precision);
}

static void single(void **state) {
    (void)state;
    sweep(PS_SINGLE);
}

static void double_precision(void **state) {
    (void)state;
    sweep(PS_DOUBLE);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(single),
                                       cmocka_unit_test(double_precision)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("sphere_error", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
