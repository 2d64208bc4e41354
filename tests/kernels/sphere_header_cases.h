/* The headers of kernels/sphere, compiled as C in the precision that the including file defines:
 * directions, numbers with exponents, and the recurrence, against long double.
 */
#ifndef PRECISION
#error "define PRECISION first"
#endif

#include "harness_sphere.h"

#include "engines/host/host_direct.h"
#include "engines/sphere/sphere_layout.h"
#include "math/pi.h"

#include <float.h>
#include <stdlib.h>

typedef unsigned int uint;
#include "sphere/legendre.h"
#include "sphere/scaled.h"
#if PRECISION == 64
#include "sphere/direction.h"
static const double epsilon = DBL_EPSILON;
#else
static const double epsilon = FLT_EPSILON;
#endif

static uint64_t seed = 30;

/* x^n by squaring, with an exponent: relative error, the pair's n times and the last rounding. */
static void powers_keep_their_digits(void **state) {
    (void)state;
    static const uint exponents[] = {0, 1, 2, 3, 15, 16, 64, 1000, 4095, 32768};
    for (int i = 0; i < 2000; i++) {
        const double x = i % 2 == 0 ? test_uniform(&seed) : pow(2, -60 * test_uniform(&seed));
        const real high = (real)x;
        const uint n = exponents[i % 10];
        const long double exact_log = (long double)n * log2l((long double)(real)x);
        scaled base, power;
        scaled_make(&base, high, 0);
        scaled_power(&power, &base, n);
        assert_true(n == 0 || (power.high >= SCALED_LOW && power.high < SCALED_HIGH));
        const long double got =
            log2l((long double)power.high) + (long double)SCALE_BITS * (long double)power.scale;
        assert_true(fabsl(got - exact_log) <= 2 * epsilon + 1e-18L * fabsl(exact_log) * n);
    }
}

static void nothing_stays_nothing(void **state) {
    (void)state;
    static const struct {
        real base;
        uint exponent;
        real expected;
    } cases[] = {{0, 100, 0}, {0, 0, 1}, {1, 32768, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        scaled base, power;
        scaled_make(&base, cases[i].base, 0);
        scaled_power(&power, &base, cases[i].exponent);
        assert_true(power.high == cases[i].expected);
    }
}

/* Steps and powers agree. */
static void steps_follow_powers(void **state) {
    (void)state;
    for (int i = 0; i < 200; i++) {
        const real x = (real)pow(10, -15 * test_uniform(&seed));
        scaled step;
        scaled_make(&step, 1, 0);
        for (uint n = 1; n <= 16; n++) {
            scaled base, power;
            scaled_step(&step, x, 0);
            scaled_make(&base, x, 0);
            scaled_power(&power, &base, n);
            const double ratio = ldexp((double)step.high / (double)power.high,
                                       SCALE_BITS * (int)(step.scale - power.scale));
            assert_true(fabs(ratio - 1) <= n * epsilon);
        }
    }
}

/* Lambda_lm of an order from its table, from sin^m(theta) = 1 on where that is small: against the
 * referee. */
static void check_order(int32_t m, int32_t last, double theta) {
    const size_t num = ps_sphere_blocks(last, m);
    double *table = calloc(num, PS_SPHERE_BLOCK_REALS * sizeof *table);
    real *block = calloc(num, PS_SPHERE_BLOCK_REALS * sizeof *block);
    long double constant = sqrtl(1 / PS_FOUR_PI_L);
    for (int32_t i = 1; i <= m; i++) {
        constant = ps_sphere_next_constant(constant, i);
    }
    ps_sphere_fill_order(table, last, m, constant);
    for (size_t i = 0; i < num * PS_SPHERE_BLOCK_REALS; i++) {
        block[i] = (real)table[i];
    }
    const double half = sin(theta / 2);
    const real t = (real)(2 * half * half);
    real p = (real)pow(sin(theta), m);
    real e = 0;
    double u[PS_SPHERE_DIMENSION];
    test_sphere_point(u, theta, 0, 1);
    const pspec_pattern pattern = {PS_SPHERE_DIMENSION, 1, u, NULL};
    for (int32_t l = m; l <= last; l++) {
        const real *at = block + (size_t)(l - m) / DEGREES * BLOCK_REALS;
        const int i = (l - m) % DEGREES;
        ps_host_degree exact;
        assert_ok(ps_host_degree_create(&exact, l, error));
        ps_host_degree_sum(&exact, &pattern);
        const double off = (double)(p * at[BLOCK_RATIO + i] - exact.sums[m][0]);
        ps_host_degree_free(&exact);
        assert_true(fabs(off) <= 2 * epsilon * sqrt(2 * l + 1) * (8 + l));
        legendre_step(&p, &e, t, at, i + 1);
        if (i == DEGREES - 1) {
            legendre_enter(&p, &e, at);
        }
    }
    free(table);
    free(block);
}

static void orders_match_the_referee(void **state) {
    (void)state;
    static const double angles[] = {1e-6, 0.01, 0.3, 1, 1.5707};
    for (size_t i = 0; i < sizeof angles / sizeof angles[0]; i++) {
        check_order(0, 60, angles[i]);
        check_order(1, 60, angles[i]);
        check_order(7, 70, angles[i]);
        check_order(20, 61, angles[i]);
    }
}

#if PRECISION == 64
static void directions_keep_their_digits(void **state) {
    (void)state;
    long double worst = 0;
    for (int i = 0; i < 200000; i++) {
        double u[PS_SPHERE_DIMENSION];
        const double theta =
            i % 2 == 0 ? 1.5 * test_uniform(&seed) : pow(10, -25 * test_uniform(&seed));
        test_sphere_point(u, theta, 6.28 * test_uniform(&seed), i % 3 == 0 ? -1 : 1);
        const direction to = direction_of(u[0], u[1], u[2], DIRECTION_SMALLEST(64));
        const long double flat = hypotl(u[0], u[1]);
        const long double length = hypotl(flat, u[2]);
        const long double rho = flat / length;
        const long double t = flat * flat / (length * (length + fabsl((long double)u[2])));
        assert_true(fabsl(to.t / t - 1) <= 5e-16L);
        assert_true(fabsl(to.rho / rho - 1) <= 4e-16L);
        assert_true(fabsl(to.cosine - u[0] / flat) <= 3e-16L &&
                    fabsl(to.sine - u[1] / flat) <= 3e-16L);
        const long double turn = atan2l(u[1], u[0]) / PS_TWO_PI_L;
        const long double off = ldexpl((long double)(int64_t)to.turn, -64) - turn;
        worst = fmaxl(worst, fabsl(off - rintl(off)));
    }
    print_message("azimuth: %.2Lg turns\n", worst);
    assert_true(worst <= 8e-17L); /* 5.5e-17 is a unit of half a turn */
}

static void poles_have_no_azimuth(void **state) {
    (void)state;
    const direction north = direction_of(0, 0, 1, DIRECTION_SMALLEST(64));
    const direction south = direction_of(1e-200, -1e-300, -1, DIRECTION_SMALLEST(64));
    assert_true(north.t == 0 && north.rho == 0 && north.cosine == 1 && north.sine == 0);
    assert_true(south.t == 0 && south.rho == 0 && south.cosine == 1 && south.turn == 0);
}
#endif

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers_keep_their_digits),
        cmocka_unit_test(nothing_stays_nothing),
        cmocka_unit_test(steps_follow_powers),
        cmocka_unit_test(orders_match_the_referee),
#if PRECISION == 64
        cmocka_unit_test(directions_keep_their_digits),
        cmocka_unit_test(poles_have_no_azimuth),
#endif
    };
    return cmocka_run_group_tests_name("sphere_headers", tests, NULL, NULL);
}
