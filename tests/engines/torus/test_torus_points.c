/* Coordinates on their way to the device: fixed point and the far-apart order. */
#include "harness.h"

#include "engines/torus/torus_points.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

static uint64_t expected_fixed_point(double x) {
    return (uint64_t)rintl((long double)x * 18446744073709551616.0L);
}

static void fixed_point(void **state) {
    (void)state;
    static const double special[] = {
        0,        0x1p-1,        0x1p-11,     0x1p-12,     0x1p-52,
        0x1p-53,  0x1p-60,       0x1p-64,     0x1p-65,     0x1.8p-65,
        0x1p-66,  0x1p-70,       0x1p-1074,   1 - 0x1p-53, 0.5 - 0x1p-54,
        0x1.8p-2, 0.5 + 0x1p-53, 1 - 0x1p-52, 0.1,         1.0 / 3};
    for (size_t i = 0; i < sizeof special / sizeof special[0]; i++) {
        assert_int_equal(ps_fixed_point(special[i]), expected_fixed_point(special[i]));
    }
    uint64_t random = 5;
    for (int i = 0; i < 1000000; i++) {
        const double x = ldexp(test_uniform(&random), -(i % 70));
        if (ps_fixed_point(x) != expected_fixed_point(x)) {
            fail_msg("%a: %llx instead of %llx", x, (unsigned long long)ps_fixed_point(x),
                     (unsigned long long)expected_fixed_point(x));
        }
    }
}

/* Every point once, and the points of a run far apart. */
static void steps(void **state) {
    (void)state;
    for (uint64_t n = 1; n < 3000; n++) {
        const uint64_t step = ps_torus_point_step(n);
        uint64_t a = n;
        uint64_t b = step;
        while (b != 0) {
            const uint64_t rest = a % b;
            a = b;
            b = rest;
        }
        assert_true(a == 1 || n == 1);
        assert_true(n < 100 || (step > n / 2 && step < 2 * n / 3));
    }
    assert_true(ps_torus_point_step((uint64_t)1 << 40) % 2 == 1);
}

/* ---- upload ------------------------------------------------------------------------------ */

static ps_device *device;

/* A few batches after another: coordinates of every point in the buffer of its upload, which keeps
 * them while the next one is filled. */
static void check_uploads(size_t num_points, bool far_apart) {
    enum { BATCHES = 5, DIMENSION = 3 };
    double *x = calloc(BATCHES * num_points * DIMENSION, sizeof *x);
    uint64_t *there = calloc(num_points * DIMENSION, sizeof *there);
    const size_t bytes = num_points * DIMENSION * sizeof *there;
    ps_torus_points points = {0};
    ps_buffer before = {0};
    uint64_t random = 11;
    assert_ok(ps_torus_points_create(&points, DIMENSION, 1, num_points, PS_SINGLE, far_apart,
                                     device, error));
    for (size_t i = 0; i < BATCHES * num_points * DIMENSION; i++) {
        x[i] = test_uniform(&random);
    }
    for (size_t b = 0; b < BATCHES; b++) {
        const double *own = x + b * num_points * DIMENSION;
        const uint64_t step = far_apart ? ps_torus_point_step(num_points) : 1;
        const pspec_pattern pattern = {DIMENSION, num_points, own, NULL};
        const ps_batch batch = {.num_patterns = 1, .patterns = &pattern};
        size_t num = 0;
        assert_ok(ps_torus_points_upload(&points, device, &batch, 0, &num, error));
        assert_int_equal(num, num_points);
        assert_true(b == 0 || points.points.memory != before.memory);
        before = points.points;
        assert_ok(ps_buffer_read(device, &points.points, 0, there, bytes, error));
        for (size_t i = 0; i < num_points * DIMENSION; i++) {
            const size_t from = i / DIMENSION * step % num_points * DIMENSION + i % DIMENSION;
            assert_int_equal(there[i], ps_fixed_point(own[from]));
        }
    }
    ps_torus_points_free(&points);
    free(there);
    free(x);
}

static void uploads(void **state) {
    (void)state;
    for (int is_unified = 0; is_unified < 2; is_unified++) {
        ps_device_set_unified_memory(device, is_unified != 0);
        check_uploads(1, false);
        check_uploads(1000, false);
        check_uploads(1000, true);
    }
    ps_device_set_unified_memory(device, true);
}

/* Each of these alone among good ones, at both ends and in the middle; and what is just inside. */
static void outside(void **state) {
    (void)state;
    enum { NUM = 37 };
    static const double bad[] = {1,         -0x1p-1074, -0.5,     0x1p60,     -0x1p60,
                                 -1,        2,          -DBL_MAX, DBL_MAX,    INFINITY,
                                 -INFINITY, NAN,        -NAN,     1 + 0x1p-52};
    static const double good[] = {0, -0.0, 0x1p-1074, 0x1p-1022, 1 - 0x1p-53};
    double x[NUM] = {0};
    const pspec_pattern pattern = {1, NUM, x, NULL};
    const ps_batch batch = {.num_patterns = 1, .patterns = &pattern};
    ps_torus_points points = {0};
    size_t num = 0;
    assert_ok(ps_torus_points_create(&points, 1, 1, NUM, PS_SINGLE, false, device, error));
    for (size_t at = 0; at < NUM; at += NUM / 2) {
        for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
            x[at] = bad[i];
            assert_int_equal(ps_torus_points_upload(&points, device, &batch, 0, &num, NULL),
                             PSPEC_ERROR_INPUT);
        }
        for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
            x[at] = good[i];
            assert_ok(ps_torus_points_upload(&points, device, &batch, 0, &num, error));
        }
    }
    ps_torus_points_free(&points);
}

static int open_device(void **state) {
    (void)state;
    return ps_device_open(&device, NULL, false, NULL) == PSPEC_OK ? 0 : -1;
}

static int close_device(void **state) {
    (void)state;
    ps_device_close(device);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fixed_point),
        cmocka_unit_test(steps),
        cmocka_unit_test(uploads),
        cmocka_unit_test(outside),
    };
    return cmocka_run_group_tests_name("torus_points", tests, open_device, close_device);
}
