/* Optimal weights: golden values, slopes of their errors, duplicates, and conjugate gradients
 * beside Cholesky. */
#include "harness_quadrature.h"

#include "rules/optimal_weights.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static ps_optimal_weights find(const ps_representer *r, size_t num, const double *points,
                               bool sum_to_one, const ps_kernel_options *options, double *weights) {
    ps_optimal_weights found;
    assert_ok(
        ps_optimal_weights_find(r, num, points, NULL, sum_to_one, options, weights, &found, error));
    return found;
}

/* docs/mathematics/quadrature.md#reference-errors: optimal weights of spherical Fibonacci sets. */
static void optimal_golden_values(void **state) {
    static const double golden[4] = {3.299e-2, 1.953e-2, 1.158e-2, 6.870e-3};
    ps_representer r = test_representer("diffuse", 1.5, 1e-13);
    (void)state;
    for (int k = 0; k < 4; k++) {
        const size_t num = (size_t)64 << k;
        double *points = test_rule_points("fibonacci-hemisphere:morph=diffuse", num, 0);
        double *weights = calloc(num, sizeof *weights);
        const ps_optimal_weights found = find(&r, num, points, false, NULL, weights);
        assert_true(fabs(sqrt(found.squared) / golden[k] - 1) <= 3e-4);
        assert_true(fabs(found.squared - test_squared_error(&r, num, points, weights)) <= 1e-14);
        assert_true(num != 256 || fabs(found.weight_sum - 0.99973) <= 6e-6);
        const ps_optimal_weights one = find(&r, num, points, true, NULL, weights);
        assert_true(fabs(one.weight_sum - 1) <= 1e-14);
        assert_true(one.squared > found.squared);
        assert_true(fabs(one.squared - test_squared_error(&r, num, points, weights)) <= 1e-14);
        free(points);
        free(weights);
    }
    ps_representer_destroy(&r);
}

/* Fig. 4 of Marques et al.: slopes of log E over log N, N = 64 .. 512, as
 * docs/mathematics/quadrature.md#reference-errors has them; theirs are the same within 0.04. */
static double find_slope(const ps_representer *r, const char *sampler, bool is_optimal) {
    enum { SIZES = 4 };
    double slope = 0;
    for (int k = 0; k < SIZES; k++) {
        const size_t num = (size_t)64 << k;
        double *points = test_rule_points(sampler, num, 0);
        double *weights = calloc(num, sizeof *weights);
        const double square = is_optimal ? find(r, num, points, false, NULL, weights).squared
                                         : test_squared_error(r, num, points, NULL);
        slope += (k - 1.5) * log2(square) / 2 / 5; /* sum (k - 1.5)^2 = 5 */
        free(points);
        free(weights);
    }
    return slope;
}

static void slopes(void **state) {
    static const struct {
        const char *sampler;
        double equal[2], optimal[2]; /* diffuse, glossy */
    } sets[] = {
        {"fibonacci-hemisphere:", {-.766, -.763}, {-.755, -.744}},
        {"larcher-pillichshammer:scramble=none,lift=hemisphere,", {-.770, -.846}, {-.751, -.748}},
        {"sobol:scramble=none,lift=hemisphere,", {-.718, -.798}, {-.721, -.727}}};
    static const char *const lobes[2] = {"diffuse", "glossy:n=30"};
    static const char *const morphs[2] = {"morph=diffuse", "morph=glossy,n=30"};
    (void)state;
    for (int lobe = 0; lobe < 2; lobe++) {
        ps_representer r = test_representer(lobes[lobe], 1.5, 1e-13);
        for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++) {
            char text[96];
            snprintf(text, sizeof text, "%s%s", sets[i].sampler, morphs[lobe]);
            const double equal = find_slope(&r, text, false);
            const double optimal = find_slope(&r, text, true);
            print_message("%-70s %.4f, optimal %.4f\n", text, equal, optimal);
            assert_true(fabs(equal - sets[i].equal[lobe]) <= 5e-3);
            assert_true(fabs(optimal - sets[i].optimal[lobe]) <= 5e-3);
        }
        ps_representer_destroy(&r);
    }
}

/* Duplicates share their point's weight; the error is that of the set without them. */
static void duplicates(void **state) {
    enum { NUM = 40, ALL = NUM + 3 };
    static const size_t copies[3] = {7, 7, 30};
    ps_representer r = test_representer("glossy:n=5", 1.9, 1e-12);
    double *points = test_rule_points("white-hemisphere", ALL, 2);
    double weights[ALL];
    double fewer[NUM];
    (void)state;
    const ps_optimal_weights without = find(&r, NUM, points, false, NULL, fewer);
    for (int i = 0; i < 3; i++) {
        memcpy(points + 3 * (NUM + i), points + 3 * copies[i], 3 * sizeof *points);
    }
    const ps_optimal_weights with = find(&r, ALL, points, false, NULL, weights);
    assert_int_equal(with.facts.num_distinct, NUM);
    assert_true(fabs(with.squared - without.squared) <= 1e-15);
    for (size_t j = 0; j < NUM; j++) {
        const double parts = j == 7 ? 3 : j == 30 ? 2 : 1;
        assert_true(fabs(weights[j] * parts - fewer[j]) <= 1e-12);
    }
    assert_true(weights[NUM] == weights[7] && weights[NUM + 2] == weights[30]);
    free(points);
    ps_representer_destroy(&r);
}

static void near_duplicates(void **state) {
    const double far[6] = {0, 0, 1, sin(1e-3), 0, cos(1e-3)};
    const double near[6] = {0, 0, 1, 1e-9, 0, 1};
    ps_representer r = test_representer("diffuse", 1.9, 1e-12);
    double weights[2];
    ps_optimal_weights found = find(&r, 2, far, false, NULL, weights);
    ps_error error = {0};
    (void)state;
    assert_true(!found.facts.is_ill_conditioned && found.facts.condition > 1e5);
    assert_int_equal(
        ps_optimal_weights_find(&r, 2, near, NULL, false, NULL, weights, &found, &error),
        PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "points 2 and 1 are 1e-09 from each other"));
    ps_representer_destroy(&r);
}

static void one_point(void **state) {
    const double up[3] = {0, 0, 1};
    double weight = 0;
    ps_representer r = test_representer("diffuse", 1.5, 1e-13);
    (void)state;
    const ps_optimal_weights found = find(&r, 1, up, false, NULL, &weight);
    const double kappa = r.constant - exp2(1.5) / 3.75; /* D at the pole */
    assert_true(fabs(weight - kappa / r.constant) <= 1e-13);
    assert_true(fabs(found.squared - (r.kappa_0 - kappa * kappa / r.constant)) <= 1e-13);
    find(&r, 1, up, true, NULL, &weight);
    assert_true(fabs(weight - 1) <= 1e-15);
    ps_representer_destroy(&r);
}

/* No memory for a matrix: the same weights by conjugate gradients, on the device or not, with
 * duplicates and with the sum imposed. */
static void compare_ways(const ps_representer *r, size_t num, double *points, ps_device *device,
                         bool sum_to_one) {
    const ps_kernel_options options = {.memory_limit = 1, .device = device};
    double *dense = calloc(num, sizeof *dense);
    double *weights = calloc(num, sizeof *weights);
    const ps_optimal_weights a = find(r, num, points, sum_to_one, NULL, dense);
    const ps_optimal_weights b = find(r, num, points, sum_to_one, &options, weights);
    double worst = 0;
    assert_true(a.facts.is_dense && !b.facts.is_dense);
    assert_int_equal(a.facts.num_distinct, b.facts.num_distinct);
    assert_true(num < 500 || b.facts.bytes < a.facts.bytes / 2);
    assert_true(b.facts.num_steps > 0 && b.facts.num_steps <= 40);
    assert_true(b.facts.residual <= 2e-12);
    assert_true(b.facts.condition <= a.facts.condition * (1 + 1e-12)); /* a bound from below */
    assert_true(b.facts.condition >= a.facts.condition / 1e4);
    assert_true(fabs(a.squared - b.squared) <= 1e-14);
    assert_true(fabs(a.weight_sum - b.weight_sum) <= 1e-12);
    for (size_t j = 0; j < num; j++) {
        worst = fmax(worst, fabs(weights[j] - dense[j]));
    }
    print_message("N = %zu, s = %g: %zu steps, weights differ by %.2g / N\n", num, r->smoothness,
                  b.facts.num_steps, worst * (double)num);
    assert_true(worst <= 1e-7 / (double)num);
    free(dense);
    free(weights);
}

static void gradients(void **state) {
    static const size_t nums[] = {1, 2, 40, 500, 1500};
    static const double smoothnesses[] = {1.1, 1.5, 1.9};
    ps_device *device = NULL;
    (void)state;
    if (ps_device_open(&device, NULL, false, NULL) != PSPEC_OK) {
        print_message("no device: on the host only\n");
    }
    for (size_t k = 0; k < sizeof smoothnesses / sizeof smoothnesses[0]; k++) {
        ps_representer r = test_representer("diffuse", smoothnesses[k], 1e-12);
        for (size_t i = 0; i < sizeof nums / sizeof nums[0]; i++) {
            double *points = test_rule_points(k == 1 ? "white-hemisphere:morph=diffuse"
                                                     : "fibonacci-hemisphere:morph=diffuse",
                                              nums[i], 0);
            if (nums[i] > 10) {
                memcpy(points + 3 * 8, points, 3 * sizeof *points);
            }
            compare_ways(&r, nums[i], points, i % 2 == 0 ? NULL : device, i % 3 == 0);
            free(points);
        }
        ps_representer_destroy(&r);
    }
    ps_device_close(device);
}

static int stop_at_two(const ps_watch_report *report, void *payload) {
    (void)payload;
    return strcmp(report->phase, "iterations of conjugate gradients") == 0 && report->done >= 2;
}

/* Few steps, an interrupt, and more than double precision has are errors that say so. */
static void gradients_that_end(void **state) {
    enum { NUM = 700 };
    static const ps_watch stopping = {.tell = stop_at_two};
    static const struct {
        ps_kernel_options options;
        pspec_status status;
        const char *says;
    } cases[] = {
        {{.memory_limit = 1, .most_steps = 3}, PSPEC_ERROR_TOLERANCE, "in 3 steps, not the 1e-12"},
        {{.memory_limit = 1, .watch = &stopping}, PSPEC_ERROR_CANCELLED, "after 2 iterations"}};
    ps_representer r = test_representer("diffuse", 1.5, 1e-13);
    double *points = test_rule_points("fibonacci-hemisphere:morph=diffuse", NUM, 0);
    double *weights = calloc(NUM, sizeof *weights);
    ps_optimal_weights found;
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_error error = {0};
        assert_int_equal(ps_optimal_weights_find(&r, NUM, points, NULL, false, &cases[i].options,
                                                 weights, &found, &error),
                         cases[i].status);
        assert_non_null(strstr(error.message, cases[i].says));
    }
    /* what rounding does not allow is given as near as it goes */
    const ps_kernel_options exact = {.memory_limit = 1, .residual = 1e-30};
    found = find(&r, NUM, points, false, &exact, weights);
    assert_true(found.facts.residual > 1e-30 && found.facts.residual < 1e-13);
    free(points);
    free(weights);
    ps_representer_destroy(&r);
}

/* Points near each other: the condition says so either way, and what is singular is refused by
 * name. */
static void ill_conditioned(void **state) {
    enum { NUM = 300 };
    ps_representer r = test_representer("diffuse", 1.9, 1e-12);
    double *points = test_rule_points("fibonacci-hemisphere:morph=diffuse", NUM, 0);
    double weights[NUM];
    (void)state;
    for (int is_dense = 0; is_dense < 2; is_dense++) {
        const ps_kernel_options options = {.memory_limit = is_dense ? 0 : 1};
        points[3] = points[0] + 2e-6;
        points[4] = points[1];
        points[5] = points[2];
        const ps_optimal_weights found = find(&r, NUM, points, false, &options, weights);
        print_message("near duplicates: condition %.3g, %zu steps\n", found.facts.condition,
                      found.facts.num_steps);
        assert_true(found.facts.is_ill_conditioned && found.facts.condition > 4.5e11);
        assert_true(fabs(found.squared - test_squared_error(&r, NUM, points, weights)) <= 1e-10);
        ps_error error = {0};
        points[3] = points[0] + 1e-9;
        ps_optimal_weights none;
        assert_int_equal(
            ps_optimal_weights_find(&r, NUM, points, NULL, false, &options, weights, &none, &error),
            PSPEC_ERROR_INPUT);
        assert_non_null(strstr(error.message, " are 1e-09 from each other: for smoothness 1.9"));
        assert_true(strstr(error.message, "points 2 and 1 ") != NULL ||
                    strstr(error.message, "points 1 and 2 ") != NULL);
    }
    free(points);
    ps_representer_destroy(&r);
}

/* What the machine has chooses nothing; a limit that was asked for does. */
static void dense_on_every_machine(void **state) {
    const size_t most = PS_KERNEL_MOST_DENSE;
    (void)state;
    assert_int_equal(most, 20000);
    assert_true(ps_kernel_system_is_dense(most, 0, 0));
    assert_true(ps_kernel_system_is_dense(most, 0, ps_kernel_system_bytes(most, true)));
    assert_false(ps_kernel_system_is_dense(most, 0, ps_kernel_system_bytes(most, true) - 1));
    assert_false(ps_kernel_system_is_dense(most + 1, 0, 0));
    assert_false(ps_kernel_system_is_dense(most + 1, 0, UINT64_MAX));
    assert_true(ps_kernel_system_is_dense(100, 100, 0));
    assert_false(ps_kernel_system_is_dense(101, 100, 0));
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(optimal_golden_values),
                                       cmocka_unit_test(slopes),
                                       cmocka_unit_test(duplicates),
                                       cmocka_unit_test(near_duplicates),
                                       cmocka_unit_test(one_point),
                                       cmocka_unit_test(gradients),
                                       cmocka_unit_test(gradients_that_end),
                                       cmocka_unit_test(ill_conditioned),
                                       cmocka_unit_test(dense_on_every_machine)};
    return cmocka_run_group_tests_name("optimal_weights", tests, NULL, NULL);
}
