/* The kernel of products with distances on its own: segments, every number of lanes, work-groups of
 * any size. */
#include "harness_kernels.h"
#include "harness_pairs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NUM = 37, STRIDE = 48, SEGMENT = 16, SEGMENTS = 3, PARTS = 2 };

static ps_device *device;
static uint64_t seed = 5;

typedef struct product_case {
    unsigned precision, lanes;
    bool is_root;
    size_t group;
} product_case;

static double power_of(const product_case *one) {
    return one->is_root ? 0.5 : 0.3;
}

static void check(const double *points, const double *x, const double *partials,
                  const product_case *one) {
    const double limit = one->precision == 32 ? 1e-6 : 2e-15;
    for (size_t i = 0; i < NUM; i++) {
        long double exact = 0;
        double sum = 0;
        double size = 0;
        for (size_t j = 0; j < NUM; j++) {
            long double square = 0;
            for (size_t axis = 0; axis < 3; axis++) {
                const long double d =
                    (long double)points[axis * STRIDE + i] - points[axis * STRIDE + j];
                square += d * d;
            }
            exact += x[j] * powl(square, (long double)power_of(one));
            size += fabs(x[j]);
        }
        for (size_t row = 0; row < SEGMENTS * PARTS; row++) {
            sum += partials[row * STRIDE + i];
        }
        if (!(fabs(sum - (double)exact) <= limit * size)) {
            fail_msg("precision %u lanes %u group %zu: row %zu is off by %g", one->precision,
                     one->lanes, one->group, i, (sum - (double)exact) / size);
        }
    }
}

/* Coordinates that either precision has exactly: differences are the kernel's own. */
static void fill(double *points, double *x) {
    double *white = test_sphere_white_set(NUM, &seed);
    for (size_t j = 0; j < STRIDE; j++) {
        for (size_t axis = 0; axis < 3; axis++) {
            points[axis * STRIDE + j] = j < NUM ? (double)(float)white[3 * j + axis] : 0.5;
        }
        x[j] = j < NUM ? (double)(float)(test_uniform(&seed) - 0.3) : 0;
    }
    for (size_t axis = 0; axis < 3; axis++) {
        points[axis * STRIDE + NUM - 1] = points[axis * STRIDE]; /* a distance of 0 */
    }
    free(white);
}

static void run(const product_case *one) {
    double points[3 * STRIDE];
    double x[STRIDE];
    const double power = power_of(one);
    fill(points, x);
    test_memory on_device = test_reals_create(device, one->precision, points, 3 * STRIDE);
    test_memory vector = test_reals_create(device, one->precision, x, STRIDE);
    test_memory exponent = test_reals_create(device, one->precision, &power, 1);
    test_memory partials =
        test_reals_create(device, one->precision, NULL, SEGMENTS * PARTS * STRIDE);
    ps_kernel *kernel = test_kernel(device, "rules/product.cl", "kernel_product",
                                    "-DPRECISION=%u -DLANES=%u -DROOT=%d", one->precision,
                                    one->lanes, one->is_root);
    TEST_LAUNCH(device, kernel, one->group, STRIDE / one->lanes, SEGMENTS, 1,
                PS_BUFFER(on_device.buffer), PS_BUFFER(vector.buffer), PS_BUFFER(exponent.buffer),
                PS_BUFFER(partials.buffer), PS_U64(STRIDE), PS_U64(SEGMENT));
    double *sums = test_reals_read(&partials, one->precision);
    check(points, x, sums, one);
    free(sums);
    test_memory_free(&partials);
    test_memory_free_unchanged(&on_device);
    test_memory_free_unchanged(&vector);
    test_memory_free_unchanged(&exponent);
}

static void products(void **state) {
    (void)state;
    for (unsigned precision = 32; precision <= 64; precision += 32) {
        for (unsigned lanes = 1; lanes <= 16 && test_has_precision(device, precision); lanes *= 2) {
            for (int is_root = 0; is_root < 2; is_root++) {
                const product_case one = {.precision = precision,
                                          .lanes = lanes,
                                          .is_root = is_root,
                                          .group = lanes < 16 ? 4 : 1};
                run(&one);
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(products)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernels_product", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
