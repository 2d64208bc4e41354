/* The headers of integrands that host and device share, compiled as C with PRECISION 32 or 64
 * (test_integrand_headers_*.c), against plain formulas in long double.
 */
#ifndef PRECISION
#error "define PRECISION first"
#endif

#include "harness.h"

#include <float.h>
#include <tgmath.h> /* exp, cos, rint and fabs of floats are those of floats, as on the device */
#undef fma          /* shared/real.h has its own */

#include "integrands/ball.h"
#include "integrands/box.h"
#include "integrands/constant.h"
#include "integrands/gaussian.h"
#include "integrands/half_plane.h"
#include "integrands/wave.h"

enum { MOST_DIMENSION = 6, POINTS = 300, NUMBERS = 16 };
static uint64_t seed = 21;
static const long double pi = 3.141592653589793238462643383279502884L;

#if PRECISION == 64
static const long double epsilon = DBL_EPSILON;
#else
static const long double epsilon = FLT_EPSILON;
#endif

static void random_point(real *x, unsigned dimension) {
    for (unsigned i = 0; i < dimension; i++) {
        x[i] = (real)test_uniform(&seed);
    }
}

/* Difference to the nearest of the images that there are. */
static long double nearest(real x, real centre) {
    long double least = 2;
    for (int n = -2; n <= 2; n++) {
        const long double difference = (long double)x + n - (long double)centre;
        least = fabsl(difference) < fabsl(least) ? difference : least;
    }
    return least;
}

/* Where a jump is nearer than rounding, either side will do. */
static void assert_side(long double distance, real value) {
    assert_true(value == 0 || value == 1);
    if (fabsl(distance) > 8 * epsilon) {
        assert_true(value == (distance < 0 ? 1 : 0));
    }
}

static void ball(void **state) {
    (void)state;
    for (unsigned dimension = 1; dimension <= MOST_DIMENSION; dimension++) {
        real numbers[NUMBERS] = {(real)0.9, (real)0.1, (real)0.5, 0, 1, (real)0.3, (real)0.41};
        for (int j = 0; j < POINTS; j++) {
            real x[MOST_DIMENSION];
            long double norm2 = 0;
            random_point(x, dimension);
            for (unsigned i = 0; i < dimension; i++) {
                x[i] = j % 2 == 0 ? x[i] : numbers[i] + (x[i] - (real)0.5) * (real)0.6;
                norm2 += nearest(x[i], numbers[i]) * nearest(x[i], numbers[i]);
            }
            assert_side(norm2 - (long double)numbers[BALL_RADIUS] * numbers[BALL_RADIUS],
                        ball_value(x, dimension, numbers));
        }
    }
}

static void box(void **state) {
    (void)state;
    for (unsigned dimension = 1; dimension <= MOST_DIMENSION; dimension++) {
        real numbers[NUMBERS] = {(real)0.9, (real)0.1, (real)0.5, 0,         1,         (real)0.3,
                                 (real)0.7, (real)0.9, (real)0.5, (real)0.8, (real)0.8, 1};
        for (int j = 0; j < POINTS; j++) {
            real x[MOST_DIMENSION];
            long double farthest = -1; /* beyond its side, of all axes */
            random_point(x, dimension);
            for (unsigned i = 0; i < dimension; i++) {
                farthest = fmaxl(farthest, fabsl(nearest(x[i], numbers[i])) -
                                               (long double)numbers[BOX_SIDES + i] / 2);
            }
            assert_side(farthest, box_value(x, dimension, numbers));
        }
    }
}

static void half_plane(void **state) {
    const real numbers[NUMBERS] = {(real)0.6, (real)-0.8, (real)-0.1};
    (void)state;
    for (int j = 0; j < POINTS; j++) {
        real x[2];
        random_point(x, 2);
        assert_side((long double)numbers[0] * x[0] + (long double)numbers[1] * x[1] - numbers[2],
                    half_plane_value(x, 2, numbers));
    }
}

static void constant(void **state) {
    const real numbers[NUMBERS] = {(real)-2.5};
    const real x[MOST_DIMENSION] = {0};
    (void)state;
    for (unsigned dimension = 1; dimension <= MOST_DIMENSION; dimension++) {
        assert_true(constant_value(x, dimension, numbers) == (real)-2.5);
    }
}

/* k.x is below `size`, rounded to size epsilon in every step. */
static void wave(void **state) {
    const real numbers[NUMBERS] = {3, -2, 1, 4, 0, -5, (real)0.15};
    const long double size = 16;
    (void)state;
    for (unsigned dimension = 1; dimension <= MOST_DIMENSION; dimension++) {
        for (int j = 0; j < POINTS; j++) {
            real x[MOST_DIMENSION];
            long double turns = numbers[WAVE_PHASE];
            random_point(x, dimension);
            for (unsigned i = 0; i < dimension; i++) {
                turns += (long double)numbers[i] * x[i];
            }
            assert_true(fabsl(wave_value(x, dimension, numbers) - cosl(2 * pi * turns)) <
                        2 * pi * size * dimension * epsilon);
        }
    }
}

/* All images that are larger than nothing. */
static long double wide_gaussian(real x, real centre, long double sigma) {
    long double sum = 0;
    for (int n = -30; n <= 30; n++) {
        const long double difference = (long double)x - (long double)centre + n;
        sum += expl(-difference * difference / (2 * sigma * sigma));
    }
    return sum;
}

/* The exponent is rounded to a few epsilon of itself, and x exp(-x) < 1/2: heights are right to
 * some epsilon of the highest, which is sum(0) on every axis. */
static void check_gaussian(unsigned dimension, long double sigma, int images) {
    real numbers[NUMBERS] = {(real)0.9, (real)0.1, (real)0.5, 0, 1, (real)0.3};
    numbers[GAUSSIAN_RATE] = (real)(1 / (2 * sigma * sigma));
    numbers[GAUSSIAN_IMAGES] = (real)images;
    numbers[GAUSSIAN_RATIO] = (real)expl(-2 * (long double)numbers[GAUSSIAN_RATE]);
    const long double own = sqrtl(1 / (2 * (long double)numbers[GAUSSIAN_RATE]));
    const long double top = powl(wide_gaussian(0, 0, own), dimension);
    for (int j = 0; j < POINTS; j++) {
        real x[MOST_DIMENSION];
        long double product = 1;
        random_point(x, dimension);
        for (unsigned i = 0; i < dimension; i++) {
            x[i] = j == 0 ? numbers[i] : x[i];
            product *= wide_gaussian(x[i], numbers[i], own);
        }
        assert_true(fabsl(gaussian_value(x, dimension, numbers) - product) <
                    10 * dimension * top * epsilon / fminl(1, own));
    }
}

static void gaussian(void **state) {
    (void)state;
    for (unsigned dimension = 1; dimension <= MOST_DIMENSION; dimension++) {
        check_gaussian(dimension, 0.05L, 0);
        check_gaussian(dimension, 0.0625L, 1);
        check_gaussian(dimension, 0.3L, 3);
        check_gaussian(dimension, 1, 9);
    }
}

/* Cut: the nearest image alone. */
static void gaussian_that_is_cut(void **state) {
    real numbers[NUMBERS] = {(real)0.9, (real)0.1, [GAUSSIAN_RATE] = 2};
    (void)state;
    for (int j = 0; j < POINTS; j++) {
        real x[2];
        random_point(x, 2);
        const long double a = nearest(x[0], numbers[0]);
        const long double b = nearest(x[1], numbers[1]);
        assert_true(fabsl(gaussian_value(x, 2, numbers) - expl(-2 * (a * a + b * b))) <
                    10 * epsilon);
    }
}

static void nearest_whole_numbers(void **state) {
    const real halves[] = {0, (real)0.5, (real)-0.5, (real)1.5, (real)-1, (real)0.499, 4000001};
    (void)state;
    for (size_t i = 0; i < sizeof halves / sizeof halves[0]; i++) {
        assert_true(nearest_whole(halves[i]) == rint(halves[i]));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ball),
        cmocka_unit_test(box),
        cmocka_unit_test(half_plane),
        cmocka_unit_test(constant),
        cmocka_unit_test(wave),
        cmocka_unit_test(gaussian),
        cmocka_unit_test(gaussian_that_is_cut),

        cmocka_unit_test(nearest_whole_numbers),
    };
    return cmocka_run_group_tests_name("integrand_headers", tests, NULL, NULL);
}
