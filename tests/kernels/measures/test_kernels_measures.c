/* Near pairs and discrepancies by their kernels, against plain loops over all pairs: few points,
 * one cell or many, clusters, points at one place, every number of dimensions. */
#include "harness_kernels.h"

#include "jobs/measure/discrepancy.h"
#include "jobs/measure/near.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Lengths are made in two ways here. */
#define ROUNDING 1e-12

static ps_device *device;
static uint64_t seed = 5;

/* Uniform, in a corner whose side is the spread, and the first two at one place. */
static double *make_points(size_t num, unsigned dimension, bool on_sphere, double spread) {
    double *const points = calloc(num * dimension, sizeof *points);
    assert_non_null(points);
    for (size_t j = 0; j < num; j++) {
        double square = 0;
        for (unsigned i = 0; i < dimension; i++) {
            const double x = spread * test_uniform(&seed);
            points[j * dimension + i] = on_sphere ? 2 * x - spread : x;
            square += points[j * dimension + i] * points[j * dimension + i];
        }
        for (unsigned i = 0; on_sphere && i < dimension; i++) {
            points[j * dimension + i] /= sqrt(square);
        }
    }
    if (num > 2) {
        memcpy(points + dimension, points, dimension * sizeof *points);
    }
    return points;
}

static double distance(const double *x, const double *y, unsigned dimension, bool on_sphere) {
    double square = 0;
    for (unsigned i = 0; i < dimension; i++) {
        const double apart = on_sphere ? x[i] - y[i] : x[i] - y[i] - rint(x[i] - y[i]);
        square += apart * apart;
    }
    return sqrt(square);
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* ---- nearest neighbours ---------------------------------------------------------------------- */

static void check_nearest(const ps_near *near, const double *points, size_t num, unsigned dimension,
                          bool on_sphere) {
    double *const expected = calloc(num, sizeof *expected);
    double *const found = calloc(num, sizeof *found);
    for (size_t i = 0; i < num; i++) {
        expected[i] = INFINITY;
        for (size_t j = 0; j < num; j++) {
            const double apart =
                distance(points + i * dimension, points + j * dimension, dimension, on_sphere);
            expected[i] = i == j ? expected[i] : fmin(expected[i], apart);
        }
    }
    memcpy(found, ps_near_distances(near), num * sizeof *found);
    qsort(expected, num, sizeof *expected, compare);
    qsort(found, num, sizeof *found, compare);
    for (size_t i = 0; i < num; i++) {
        assert_true(found[i] == expected[i] || fabs(found[i] - expected[i]) < 1e-15);
    }
    free(expected);
    free(found);
}

/* ---- pair correlation ------------------------------------------------------------------------ */

static double unit_of_length(size_t num, unsigned dimension, bool on_sphere) {
    return on_sphere ? sqrt(PS_FOUR_PI / (double)num) : pow((double)num, -1.0 / dimension);
}

/* Volumes of balls of radius 1. */
static const double balls[] = {1, 2, PS_PI, 4 * PS_PI / 3, PS_PI *PS_PI / 2};

static void check_correlation(const ps_near *near, const double *points, size_t num,
                              unsigned dimension, bool on_sphere) {
    const double width =
        ps_near_reach(dimension, on_sphere) * unit_of_length(num, dimension, on_sphere) / NEAR_BINS;
    double counts[NEAR_BINS] = {0};
    for (size_t i = 0; i < num; i++) {
        for (size_t j = 0; j < num; j++) {
            const double bin =
                distance(points + i * dimension, points + j * dimension, dimension, on_sphere) /
                width;
            counts[i != j && bin < NEAR_BINS ? (size_t)bin : 0] += i != j && bin < NEAR_BINS;
        }
    }
    for (size_t b = 0; b < NEAR_BINS; b++) {
        const double low = (double)b * width;
        const double high = (double)(b + 1) * width;
        const double share = on_sphere
                                 ? (high * high - low * low) / 4
                                 : balls[dimension] * (pow(high, dimension) - pow(low, dimension));
        const double expected = counts[b] / ((double)num * ((double)num - 1) * share);
        const double found = ps_near_correlation(near, b);
        const double end = on_sphere ? 2 : 0.5;
        if (num < 2 || high > end * (1 + ROUNDING)) {
            assert_true(isnan(found));
        } else if (high < end * (1 - ROUNDING)) {
            assert_true(fabs(found - expected) <= 1e-9 * expected);
        }
    }
}

/* ---- windows --------------------------------------------------------------------------------- */

static double shared_volume(double r, double radius, unsigned dimension) {
    const double x = r / (2 * radius);
    return x >= 1           ? 0
           : dimension == 1 ? 2 * radius - r
           : dimension == 2
               ? 2 * radius * radius * acos(x) - r / 2 * sqrt(4 * radius * radius - r * r)
               : PS_PI / 12 * (4 * radius + r) * (2 * radius - r) * (2 * radius - r);
}

static void check_windows(const ps_near *near, const double *points, size_t num,
                          unsigned dimension) {
    const double reach = ps_near_reach(dimension, false) * unit_of_length(num, dimension, false);
    for (size_t w = 0; w < NEAR_WINDOWS; w++) {
        const double radius = reach * (double)(w + 1) / (2 * NEAR_WINDOWS);
        const double mean = (double)num * balls[dimension] * pow(radius, dimension);
        long double square = 0;
        for (size_t i = 0; i < num; i++) {
            for (size_t j = 0; j < num; j++) {
                square += shared_volume(
                    distance(points + i * dimension, points + j * dimension, dimension, false),
                    radius, dimension);
            }
        }
        const double found = ps_near_number_variance(near, w, false);
        const double expected = (double)(square - (long double)mean * mean);
        if (radius > 0.25 * (1 + ROUNDING)) {
            assert_true(isnan(found));
        } else if (radius < 0.25 * (1 - ROUNDING)) {
            const double over_mean = ps_near_number_variance(near, w, true);
            assert_true(fabs(found - expected) < 1e-9 * fmax(mean, 1));
            assert_true(fabs(over_mean * mean - found) < 1e-9 * fmax(mean, 1));
        }
    }
}

/* ---- near pairs ------------------------------------------------------------------------------ */

static void check_near(ps_near *near, size_t num, unsigned dimension, bool on_sphere,
                       double spread) {
    double *const points = make_points(num, dimension, on_sphere, spread);
    assert_ok(ps_near_look(near, points, num, error));
    check_nearest(near, points, num, dimension, on_sphere);
    check_correlation(near, points, num, dimension, on_sphere);
    if (!on_sphere && dimension <= PS_NEAR_MOST_WINDOW_DIMENSION) {
        check_windows(near, points, num, dimension);
    }
    free(points);
}

/* In four dimensions and on the sphere several cells about a point are not all cells with no fewer
 * points than this. */
static size_t most_points(unsigned d) {
    static const size_t num[] = {0, 333, 333, 333, 1500, 600};
    return ps_device_is_simulator(ps_device_get_limits(device)) ? 3 : num[d];
}

/* Larger and smaller sets, one after the other. */
static void near_pairs_are_those_of_all(void **state) {
    static const size_t sizes[] = {150, 1, 2, 7, 333, 65};
    (void)state;
    for (unsigned d = 1; d <= 5; d++) {
        const bool on_sphere = d == 5;
        const unsigned dimension = on_sphere ? 3 : d;
        ps_near *near = NULL;
        assert_ok(ps_near_create(&near, dimension, on_sphere,
                                 !on_sphere && d <= PS_NEAR_MOST_WINDOW_DIMENSION, device, error));
        for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
            check_near(near, sizes[i], dimension, on_sphere, 1);
        }
        check_near(near, 90, dimension, on_sphere, 0.01);
        check_near(near, most_points(d), dimension, on_sphere, 1);
        ps_near_destroy(near);
    }
}

/* A point far from a cluster has its nearest neighbour beyond the cells about it. */
static void far_neighbours_are_found(void **state) {
    enum { NUM = 300 };
    ps_near *near = NULL;
    double points[2 * NUM];
    (void)state;
    for (size_t i = 0; i < 2 * NUM; i++) {
        points[i] = 0.05 * test_uniform(&seed);
    }
    points[2 * NUM - 2] = points[2 * NUM - 1] = 0.5;
    assert_ok(ps_near_create(&near, 2, false, false, device, error));
    assert_ok(ps_near_look(near, points, NUM, error));
    check_nearest(near, points, NUM, 2, false);
    ps_near_destroy(near);
}

/* ---- discrepancies --------------------------------------------------------------------------- */

static ps_discrepancies sum_plainly(const double *points, size_t num, unsigned dimension) {
    const long double cube = powl(3, -(long double)dimension);
    const long double n = (long double)num;
    long double star = cube, periodic = -cube;
    for (size_t i = 0; i < num; i++) {
        long double box = 2 / n;
        for (unsigned a = 0; a < dimension; a++) {
            const long double x = points[i * dimension + a];
            box *= (1 - x * x) / 2;
        }
        star -= box;
        for (size_t j = 0; j < num; j++) {
            long double both = 1, wrapped = 1;
            for (unsigned a = 0; a < dimension; a++) {
                const long double x = points[i * dimension + a], y = points[j * dimension + a];
                both *= 1 - fmaxl(x, y);
                wrapped *= 0.5L - fabsl(x - y) * (1 - fabsl(x - y));
            }
            star += both / (n * n);
            periodic += wrapped / (n * n);
        }
    }
    return (ps_discrepancies){(double)sqrtl(star), (double)sqrtl(periodic)};
}

static void discrepancies_are_sums(void **state) {
    static const size_t sizes[] = {100, 1, 2, 3, 17, 131};
    (void)state;
    for (unsigned d = 1; d <= PS_MAX_DIMENSION; d++) {
        ps_discrepancy *discrepancy = NULL;
        assert_ok(ps_discrepancy_create(&discrepancy, d, device, error));
        for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
            double *const points = make_points(sizes[i], d, false, 1);
            const ps_discrepancies expected = sum_plainly(points, sizes[i], d);
            ps_discrepancies found;
            assert_ok(ps_discrepancy_find(discrepancy, points, sizes[i], &found, error));
            assert_true(fabs(found.star - expected.star) < 1e-12 * expected.star);
            assert_true(fabs(found.periodic - expected.periodic) < 1e-12 * expected.periodic);
            free(points);
        }
        ps_discrepancy_destroy(discrepancy);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(near_pairs_are_those_of_all),
        cmocka_unit_test(far_neighbours_are_found),
        cmocka_unit_test(discrepancies_are_sums),
    };
    device = test_open_device();
    if (!ps_device_get_limits(device)->has_fp64) {
        print_message("skipped: measures need doubles\n");
        return TEST_SKIPPED;
    }
    const int failures = cmocka_run_group_tests_name("kernels_measures", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
