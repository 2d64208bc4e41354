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
#include "integrands/map.h"
#include "integrands/pixels.h"
#include "integrands/sphere_series.h"
#include "integrands/torus_map.h"
#include "integrands/torus_series.h"
#include "integrands/wave.h"
#include "integrands/zonal.h"

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

/* ---- tables of what is from files ------------------------------------------------------------ */

static void pixels(void **state) {
    enum { ROWS = 5, COLUMNS = 7 };
    const real numbers[NUMBERS] = {ROWS, COLUMNS};
    real image[ROWS * COLUMNS];
    (void)state;
    for (int i = 0; i < ROWS * COLUMNS; i++) {
        image[i] = (real)i;
    }
    for (int j = 0; j < POINTS; j++) {
        real x[2];
        random_point(x, 2);
        x[0] = j == 0 ? 1 - (real)(epsilon / 2) : x[0]; /* its product rounds to 5 */
        const int row = (int)((long double)x[0] * ROWS);
        const int column = (int)((long double)x[1] * COLUMNS);
        const real found = pixels_value(x, 2, numbers, image);
        const bool is_edge = fabsl(x[0] * ROWS - rintl(x[0] * ROWS)) < 8 * epsilon ||
                             fabsl(x[1] * COLUMNS - rintl(x[1] * COLUMNS)) < 8 * epsilon;
        assert_true(found == image[row * COLUMNS + column] || (is_edge && j > 0));
    }
}

static void zonal(void **state) {
    enum { NODES = 4 };
    const real numbers[NUMBERS] = {NODES};
    const real table[2 * NODES] = {(real)-0.5, 0, (real)0.25, 1, 1, 3, 2, (real)0.5};
    const real x[][3] = {{0, 0, (real)-0.5}, {0, 0, (real)-0.75}, {0, 0, (real)-0.25},
                         {0, 0, 0},          {0, 0, (real)0.125}, {0, 0, (real)0.625},
                         {0, 0, 1},          {0, 0, (real)1.0625}};
    const real expected[] = {1, 0, 2, 3, (real)2.5, (real)1.25, (real)0.5, 0};
    (void)state;
    for (size_t j = 0; j < sizeof expected / sizeof expected[0]; j++) {
        assert_true(zonal_value(x[j], 3, numbers, table) == expected[j]);
    }
}

/* Through the centres of pixels, their edges, the poles and the seam, against the definition. */
static void map(void **state) {
    enum { HEIGHT = 3, WIDTH = 4 };
    const real numbers[NUMBERS] = {WIDTH, HEIGHT};
    real rows[(HEIGHT + 2) * WIDTH];
    (void)state;
    for (int i = 0; i < (HEIGHT + 2) * WIDTH; i++) {
        const int row = i / WIDTH;
        rows[i] = row == 0 || row == HEIGHT + 1 ? (real)row : (real)(i * 5 % 7);
    }
    for (int i = 0; i <= 24; i++) {
        for (int j = -24; j <= 24; j++) {
            const long double theta = pi * i / 24;
            const long double phi = 2 * pi * j / 24;
            const real x[3] = {(real)(sinl(theta) * cosl(phi)), (real)(sinl(theta) * sinl(phi)),
                               (real)cosl(theta)};
            const long double down = HEIGHT * (long double)i / 24 + 0.5L;
            const int row = (int)down;
            const long double share = row == 0        ? 2 * down - 1
                                      : row == HEIGHT ? 2 * (down - HEIGHT)
                                                      : down - row;
            const long double along = WIDTH * (long double)(j + 48) / 24 - 0.5L;
            const int column = (int)along;
            long double expected = 0;
            for (int down_one = 0; down_one < 2; down_one++) {
                for (int right = 0; right < 2; right++) {
                    const long double u = right == 0 ? 1 - (along - column) : along - column;
                    const long double v = down_one == 0 ? 1 - share : share;
                    expected +=
                        u * v *
                        (long double)rows[(row + down_one) * WIDTH + (column + right) % WIDTH];
                }
            }
            assert_true(fabsl((long double)map_value(x, 3, numbers, rows) - expected) <
                        100 * epsilon);
        }
    }
}

/* Pixels of both kinds, at their centres, between them and across both edges. */
static void torus_map(void **state) {
    enum { ROWS = 3, SIDE = 5 };
    (void)state;
    for (unsigned bytes = 3; bytes <= 4; bytes++) {
        const real numbers[NUMBERS] = {SIDE, ROWS, (real)bytes};
        real table[4 * ROWS * SIDE] = {0};
        float pixels[ROWS * SIDE];
        for (int i = 0; i < ROWS * SIDE; i++) {
            uint32_t bits = 0;
            pixels[i] = ldexpf((float)(i * 5 % 7), 3 * i - 20);
            memcpy(&bits, &pixels[i], sizeof bits);
            bits >>= bytes == 3 ? 7 : 0;
            for (unsigned b = 0; b < bytes; b++) {
                ((unsigned char *)table)[bytes * (unsigned)i + b] = (unsigned char)(bits >> 8 * b);
            }
        }
        for (int j = 0; j < 40 * 40; j++) {
            const real x[] = {(real)(j / 40) / 40, (real)(j % 40) / 40};
            const long double down = (long double)x[0] * ROWS + ROWS - 0.5L;
            const long double along = (long double)x[1] * SIDE + SIDE - 0.5L;
            const int row = (int)down;
            const int column = (int)along;
            long double expected = 0;
            for (int corner = 0; corner < 4; corner++) {
                const int place = (row + corner / 2) % ROWS * SIDE + (column + corner % 2) % SIDE;
                expected += fabsl(1 - corner / 2 - (down - row)) *
                            fabsl(1 - corner % 2 - (along - column)) * (long double)pixels[place];
            }
            assert_true(fabsl((long double)torus_map_value(x, 2, numbers, table) - expected) <=
                        20 * epsilon * 0x1p20L);
        }
    }
}

/* Runs of one, of three and of the most that there are. Every step of a run is off by some epsilon,
 * and the first phase of k by |k| epsilon of a turn. */
static void torus_series(void **state) {
    enum { RUNS = 3 };
    const int starts[RUNS][2] = {{0, 1}, {1, -1}, {2, -30}};
    const int counts[RUNS] = {1, 3, TORUS_SERIES_RUN};
    const real numbers[NUMBERS] = {(real)0.75};
    real table[3 * (RUNS + 1) + 2 * (4 + TORUS_SERIES_RUN)] = {0};
    size_t at = 0;
    (void)state;
    for (int r = 0; r < RUNS; r++) {
        table[at++] = (real)starts[r][0];
        table[at++] = (real)starts[r][1];
        table[at++] = (real)counts[r];
        for (int i = 0; i < 2 * counts[r]; i++) {
            table[at++] = (real)test_uniform(&seed) - (real)0.5;
        }
    }
    for (int j = 0; j < POINTS; j++) {
        real x[2];
        long double sum = 0;
        const real *own = table;
        random_point(x, 2);
        for (int r = 0; r < RUNS; r++) {
            own += 3;
            for (int i = 0; i < counts[r]; i++, own += 2) {
                const long double turns =
                    starts[r][0] * (long double)x[0] + (starts[r][1] + i) * (long double)x[1];
                sum += own[0] * cosl(2 * pi * turns) - own[1] * sinl(2 * pi * turns);
            }
        }
        assert_true(fabsl(torus_series_value(x, 2, numbers, table) - (numbers[0] + 2 * sum)) <
                    2 * TORUS_SERIES_RUN * (TORUS_SERIES_RUN + 64) * epsilon);
    }
}

/* Degree 2: Y_00, Y_10, Y_20, Y_11, Y_21, Y_22 in closed form. */
static void sphere_series(void **state) {
    const real numbers[NUMBERS] = {2};
    const long double f[6][2] = {{1, 0}, {0.5L, 0}, {-0.25L, 0}, {0.3L, -0.2L}, {1, 2}, {-1, 0.7L}};
    const long double a[6] = {1, sqrtl(3), sqrtl(15) / 2, -sqrtl(1.5L), sqrtl(5), -sqrtl(1.25L)};
    const long double b[6] = {0, 0, 1 / sqrtl(3), 0, 0, 0};
    real table[6 * SPHERE_SERIES_NUMBERS];
    (void)state;
    for (size_t i = 0; i < 6; i++) {
        real *const own = table + SPHERE_SERIES_NUMBERS * i;
        own[0] = (real)a[i];
        own[1] = (real)b[i];
        own[2] = (real)f[i][0];
        own[3] = (real)f[i][1];
    }
    for (int j = 0; j < POINTS; j++) {
        const long double z = j < 2 ? 1 - 2 * j : 2 * test_uniform(&seed) - 1;
        const long double azimuth = 2 * pi * test_uniform(&seed), s = sqrtl(1 - z * z);
        const real x[3] = {(real)(s * cosl(azimuth)), (real)(s * sinl(azimuth)), (real)z};
        const long double q[6] = {sqrtl(1 / (4 * pi)),
                                  sqrtl(3 / (4 * pi)) * z,
                                  sqrtl(5 / (16 * pi)) * (3 * z * z - 1),
                                  -sqrtl(3 / (8 * pi)) * s,
                                  -sqrtl(15 / (8 * pi)) * s * z,
                                  sqrtl(15 / (32 * pi)) * s * s};
        const int orders[6] = {0, 0, 0, 1, 1, 2};
        long double sum = 0;
        for (size_t i = 0; i < 6; i++) {
            const long double turn = orders[i] * azimuth;
            sum += (orders[i] > 0 ? 2 : 1) * q[i] * (f[i][0] * cosl(turn) - f[i][1] * sinl(turn));
        }
        assert_true(fabsl(sphere_series_value(x, 3, numbers, table) - sum) < 64 * epsilon);
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
        cmocka_unit_test(pixels),
        cmocka_unit_test(torus_map),
        cmocka_unit_test(map),
        cmocka_unit_test(zonal),
        cmocka_unit_test(torus_series),
        cmocka_unit_test(sphere_series),
        cmocka_unit_test(nearest_whole_numbers),
    };
    return cmocka_run_group_tests_name("integrand_headers", tests, NULL, NULL);
}
