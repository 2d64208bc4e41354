/* Coordinates on their way to the device: fixed point and the far-apart order. */
#include "harness.h"

#include "engines/torus_points.h"

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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fixed_point),
        cmocka_unit_test(steps),
    };
    return cmocka_run_group_tests_name("torus_points", tests, NULL, NULL);
}
