/* Products with distances on the device against long double and against the host, sizes around
 * segments. */
#include "harness.h"
#include "harness_pairs.h"

#include "rules/kernel/kernel_product.h"
#include "rules/kernel/kernel_system.h"
#include "math/sobolev.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;
static uint64_t seed = 3;

static double *make_vector(size_t num, double *size) {
    double *x = calloc(num, sizeof *x);
    *size = 0;
    for (size_t j = 0; j < num; j++) {
        x[j] = test_uniform(&seed) - 0.4;
        *size += fabs(x[j]);
    }
    return x;
}

static void against_long_double(void **state) {
    static const size_t nums[] = {1, 2, 17, 300};
    static const double powers[] = {0.1, 0.5, 0.9};
    (void)state;
    for (size_t k = 0; k < sizeof nums / sizeof nums[0]; k++) {
        const size_t num = nums[k];
        double size = 0;
        double *points = test_sphere_white_set(num, &seed);
        double *x = make_vector(num, &size);
        double *out = calloc(num, sizeof *out);
        for (size_t p = 0; p < sizeof powers / sizeof powers[0]; p++) {
            ps_kernel_product *product = NULL;
            assert_ok(ps_kernel_product_create(&product, device, powers[p], num, points, error));
            assert_ok(ps_kernel_product_apply(product, x, out, NULL, error));
            ps_kernel_product_destroy(product);
            for (size_t i = 0; i < num; i++) {
                long double exact = 0;
                for (size_t j = 0; j < num; j++) {
                    long double square = 0;
                    for (size_t axis = 0; axis < 3; axis++) {
                        const long double d =
                            (long double)points[3 * i + axis] - points[3 * j + axis];
                        square += d * d;
                    }
                    exact += x[j] * powl(square, (long double)powers[p]);
                }
                assert_true(fabs(out[i] - (double)exact) <= 1e-15 * size);
            }
        }
        free(points);
        free(x);
        free(out);
    }
}

/* More than one segment; twice the same bits, in other work-groups, too. */
static void segments(void **state) {
    enum { NUM = 4096 + 33 };
    const double s = 1.7;
    ps_kernel_product *product = NULL;
    double size = 0;
    double *points = test_sphere_white_set(NUM, &seed);
    double *x = make_vector(NUM, &size);
    double *out = calloc(NUM, sizeof *out);
    double *again = calloc(NUM, sizeof *again);
    (void)state;
    assert_ok(ps_kernel_product_create(&product, device, s - 1, NUM, points, error));
    assert_ok(ps_kernel_product_apply(product, x, out, NULL, error));
    ps_device_set_group_size(device, 5);
    assert_ok(ps_kernel_product_apply(product, x, again, NULL, error));
    ps_device_set_group_size(device, 0);
    assert_memory_equal(out, again, NUM * sizeof *out);
    for (size_t i = 0; i < NUM; i += 41) {
        const double expected = ps_sobolev_distance_sum(s, points + 3 * i, NUM, points, x);
        assert_true(fabs(out[i] - expected) <= 2e-15 * size);
    }
    ps_kernel_product_destroy(product);
    free(points);
    free(x);
    free(out);
    free(again);
}

/* Rules of several sizes, more than one segment, alone and together. */
static void distances_of_rules(void **state) {
    enum { NUM = 5, MOST = 4096 + 33 };
    static const size_t nums[NUM] = {1, 300, 17, MOST, 64};
    ps_kernel_product *product = NULL;
    ps_rule rules[NUM];
    double sums[NUM], alone = 0, expected = 0, size = 0;
    (void)state;
    for (size_t r = 0; r < NUM; r++) {
        rules[r] =
            (ps_rule){nums[r], test_sphere_white_set(nums[r], &seed), make_vector(nums[r], &size)};
    }
    assert_ok(ps_kernel_distances_create(&product, device, 0.5, MOST, NUM, error));
    assert_int_equal(ps_kernel_distances_most_points(product), MOST);
    assert_ok(ps_kernel_distances_sum(product, rules, NUM, sums, error));
    for (size_t r = 0; r < NUM; r++) {
        const ps_weight_sums weights = ps_rule_weight_sums(&rules[r]);
        assert_ok(ps_kernel_distances_sum(product, &rules[r], 1, &alone, error));
        assert_memory_equal(&alone, &sums[r], sizeof alone);
        assert_ok(ps_rule_distance(&rules[r], 1.5, NULL, &expected, error));
        assert_true(fabs(sums[r] - expected) <= 1e-15 * weights.size * weights.size);
        free((double *)rules[r].points);
        free((double *)rules[r].weights);
    }
    ps_kernel_product_destroy(product);
}

/* GPUs sum distances, and make products rather than factors; CPUs do neither. */
static void gpus_have_more(void **state) {
    ps_device *const gpu = test_open_gpu();
    (void)state;
    assert_true(ps_kernel_distances_pay(gpu, 32768) && !ps_kernel_distances_pay(gpu, 32769));
    assert_true(!ps_kernel_distances_pay(device, 1) || ps_device_get_limits(device)->is_gpu);
    assert_int_equal(ps_kernel_most_dense(gpu), PS_KERNEL_MOST_DENSE_ON_GPU);
    assert_int_equal(ps_kernel_most_dense(NULL), PS_KERNEL_MOST_DENSE);
    ps_device_close(gpu);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(against_long_double), cmocka_unit_test(segments),
        cmocka_unit_test(distances_of_rules), cmocka_unit_test(gpus_have_more)};
    device = test_open_device();
    if (!ps_kernel_product_is_possible(device)) {
        print_message("no double precision: skipped\n");
        ps_device_close(device);
        return TEST_SKIPPED;
    }
    const int failures = cmocka_run_group_tests_name("kernel_product", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
