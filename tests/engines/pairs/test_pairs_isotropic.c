/* Sums of isotropic kernels over pairs, from one histogram: against sums over pairs in long double,
 * the direct chord sums of the device, and the series of the Sobolev kernel. */
#include "harness_pairs.h"

#include "rules/kernel/kernel_chords.h"
#include "engines/pairs/pairs_isotropic.h"
#include "math/pi.h"
#include "math/sobolev.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;
static uint64_t seed = 20;

static long double exact_chords(const pspec_pattern *set, double power) {
    long double sum = 0;
    for (size_t i = 0; i < set->num_points; i++) {
        for (size_t j = 0; j < i; j++) {
            long double square = 0;
            for (size_t axis = 0; axis < 3; axis++) {
                const long double step =
                    (long double)set->points[3 * i + axis] - set->points[3 * j + axis];
                square += step * step;
            }
            const long double both =
                set->weights != NULL ? (long double)set->weights[i] * set->weights[j] : 1;
            sum += 2 * both * powl(square, (long double)power);
        }
    }
    return sum;
}

enum { NUM = 700, NUM_POWERS = 4 };
static const ps_isotropic_kernel chords[NUM_POWERS] = {
    {.power = 0.1}, {.power = 0.5}, {.power = 0.9}, {.power = 1}};

static double limit_of(double tolerance) {
    return tolerance > 1e-6 || ps_device_get_limits(device)->has_fp64 ? tolerance : 1e-5;
}

static void compare(const pspec_pattern *set) {
    static const double tolerances[] = {1e-4, 1e-8, 1e-12};
    const double size = test_weight_sizes(set);
    for (size_t i = 0; i < sizeof tolerances / sizeof tolerances[0]; i++) {
        const double tolerance = limit_of(tolerances[i]);
        double sums[NUM_POWERS], bounds[NUM_POWERS];
        assert_ok(ps_pairs_isotropic_sums(device, set, 0, chords, NUM_POWERS, tolerance, sums,
                                          bounds, NULL, error));
        for (size_t k = 0; k < NUM_POWERS; k++) {
            const double off = fabs((double)(sums[k] - exact_chords(set, chords[k].power)));
            print_message("tolerance %.0e, power %.1f: off by %.1e, bound %.1e\n", tolerance,
                          chords[k].power, off / size / size, bounds[k]);
            assert_true(bounds[k] <= tolerance);
            assert_true(off <= bounds[k] * size * size);
        }
    }
}

static void white_points(void **state) {
    (void)state;
    double *points = test_sphere_white_set(NUM, &seed);
    const pspec_pattern set = {3, NUM, points, NULL};
    compare(&set);
    free(points);
}

/* Weights of either sign; duplicates, near points and opposite ones. */
static void hard_points(void **state) {
    (void)state;
    double *points = test_sphere_white_set(NUM, &seed);
    double weights[NUM];
    for (size_t j = 0; j < NUM; j++) {
        weights[j] = test_uniform(&seed) - 0.4;
    }
    for (size_t j = 1; j < 100; j++) { /* all within 1e-3 of the first, some upon it */
        for (size_t axis = 0; axis < 3; axis++) {
            points[3 * j + axis] =
                points[axis] + (j % 10 == 0 ? 0 : 1e-3 * (test_uniform(&seed) - 0.5));
        }
    }
    for (size_t i = 0; i < 3; i++) {
        points[300 + i] = -points[303 + i];
    }
    for (size_t j = 0; j < NUM; j++) {
        double *const u = points + 3 * j;
        const long double length =
            sqrtl((long double)u[0] * u[0] + (long double)u[1] * u[1] + (long double)u[2] * u[2]);
        for (size_t axis = 0; axis < 3; axis++) {
            u[axis] = (double)(u[axis] / length);
        }
    }
    const pspec_pattern set = {3, NUM, points, weights};
    compare(&set);
    free(points);
}

/* The direct chord sums of the device are the same to the tolerance. */
static void direct_sums(void **state) {
    (void)state;
    const double tolerance = limit_of(1e-10);
    const ps_precision precision = tolerance < 1e-6 ? PS_DOUBLE : PS_SINGLE;
    double *points = test_sphere_white_set(NUM, &seed);
    const pspec_pattern set = {3, NUM, points, NULL};
    const ps_batch batch = {.num_patterns = 1, .patterns = &set};
    double sums[NUM_POWERS], bounds[NUM_POWERS], direct = 0;
    assert_ok(ps_pairs_isotropic_sums(device, &set, 0, chords, NUM_POWERS, tolerance, sums, bounds,
                                      NULL, error));
    for (size_t k = 0; k < NUM_POWERS - 1; k++) {
        assert_ok(ps_kernel_chord_sums(device, precision, chords[k].power, &batch, &direct, error));
        assert_true(fabs(sums[k] - direct) <= tolerance * NUM * NUM);
    }
    free(points);
}

/* Kernels by their coefficients: single degrees, and c - |u - v|^(2s - 2) as its own series; all
 * from one histogram. */
static void zonal_kernels(void **state) {
    (void)state;
    enum { LAST = 80 };
    const double s = 1.9;
    const double tolerance = limit_of(1e-9);
    double *points = test_sphere_white_set(NUM, &seed);
    double weights[NUM], a[LAST + 2], series[LAST + 1], one[LAST + 1] = {0}, sums[3], bounds[3];
    for (size_t j = 0; j < NUM; j++) {
        weights[j] = test_uniform(&seed) / NUM;
    }
    ps_sobolev_eigenvalues(s, LAST + 1, a);
    for (size_t l = 0; l <= LAST; l++) {
        series[l] = a[l] * (2 * (double)l + 1) / PS_FOUR_PI;
    }
    one[LAST] = -3;
    const pspec_pattern set = {3, NUM, points, weights};
    const ps_isotropic_kernel kernels[3] = {
        {LAST + 1, one, 0}, {LAST + 1, series, 0}, {.power = s - 1}};
    assert_ok(
        ps_pairs_isotropic_sums(device, &set, 0, kernels, 3, tolerance, sums, bounds, NULL, error));
    const double size = test_weight_sizes(&set);
    long double *exact = test_pair_sums(&set, LAST);
    assert_true(fabs((double)(sums[0] + 3 * exact[LAST])) <= bounds[0] * size * size);
    long double sum = 0;
    for (size_t l = 0; l <= LAST; l++) {
        sum += series[l] * exact[l];
    }
    assert_true(fabs((double)(sums[1] - sum)) <= bounds[1] * size * size);
    assert_true(bounds[0] <= tolerance && bounds[1] <= tolerance && bounds[2] <= tolerance);
    /* the whole series has no more beyond LAST than tau W^2 */
    const double rest = ps_sobolev_constant(s) * size * size - sums[2] - sums[1];
    const double tau = ps_sobolev_tail(s, LAST, a[LAST + 1]);
    assert_true(fabs(rest) <= tau * size * size + (bounds[1] + bounds[2]) * size * size);
    /* weights as mantissas: powers of two change nothing */
    double scaled[3];
    assert_ok(ps_pairs_isotropic_sums(device, &set, -9, kernels, 3, tolerance, scaled, bounds, NULL,
                                      error));
    for (size_t k = 0; k < 3; k++) {
        assert_true(scaled[k] == ldexp(sums[k], 18));
    }
    free(exact);
    free(points);
}

/* Says stop when a phase is so far. */
typedef struct stopper {
    const char *phase;
    uint64_t least;
    uint64_t num_told;
} stopper;

static int tell(const ps_watch_report *report, void *payload) {
    stopper *const self = payload;
    const bool is_meant = strcmp(report->phase, self->phase) == 0;
    self->num_told += is_meant ? 1 : 0;
    return is_meant && report->done >= self->least;
}

/* Between slabs of pairs, whose launches are waited for, and among pairs that are so near that the
 * host adds them up: all of a clump are. */
static void stops(void **state) {
    enum { MANY = 8192 };
    (void)state;
    double *points = test_sphere_white_set(MANY, &seed);
    const pspec_pattern set = {3, MANY, points, NULL};
    const double tolerance = limit_of(1e-8);
    double sum = 0, bound = 0;
    ps_error failure = {0};
    stopper slabs = {"slabs of pairs of points", 1, 0},
            near = {"points with their neighbours", 1, 0};
    const ps_watch of_slabs = {tell, &slabs}, of_near = {tell, &near};
    assert_int_equal(ps_pairs_isotropic_sums(device, &set, 0, chords, 1, tolerance, &sum, &bound,
                                             &of_slabs, &failure),
                     PSPEC_ERROR_CANCELLED);
    assert_int_equal(slabs.num_told, 2);
    assert_string_equal(failure.message, "interrupted after 1 slabs of pairs of points");
    for (size_t j = 0; j < MANY; j++) {
        points[3 * j] *= 1e-3;
        points[3 * j + 1] *= 1e-3;
        points[3 * j + 2] =
            sqrt(1 - points[3 * j] * points[3 * j] - points[3 * j + 1] * points[3 * j + 1]);
    }
    assert_int_equal(ps_pairs_isotropic_sums(device, &set, 0, chords, 1, tolerance, &sum, &bound,
                                             &of_near, &failure),
                     PSPEC_ERROR_CANCELLED);
    assert_int_equal(near.num_told, 1);
    assert_non_null(strstr(failure.message, "points with their neighbours"));
    free(points);
}

static void nonsense(void **state) {
    (void)state;
    const double point[] = {0, 0, 1}, bad[] = {1, NAN};
    const pspec_pattern set = {3, 1, point, NULL};
    const ps_isotropic_kernel kernels[] = {
        {.power = 0}, {.power = 1.5}, {.power = NAN}, {2, bad, 0}};
    double sum = 7, bound = 7;
    ps_error failure = {0};
    for (size_t k = 0; k < 4; k++) {
        assert_int_equal(ps_pairs_isotropic_sums(device, &set, 0, &kernels[k], 1, 1e-4, &sum,
                                                 &bound, NULL, &failure),
                         PSPEC_ERROR_INVALID_ARGUMENT);
    }
    assert_int_equal(
        ps_pairs_isotropic_sums(device, &set, 0, chords, 1, 1e-20, &sum, &bound, NULL, &failure),
        PSPEC_ERROR_TOLERANCE);
    /* one point: nothing but the diagonal */
    assert_ok(ps_pairs_isotropic_sums(device, &set, 0, chords, 1, 1e-4, &sum, &bound, NULL, error));
    assert_true(sum == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(white_points), cmocka_unit_test(hard_points),
        cmocka_unit_test(direct_sums),  cmocka_unit_test(zonal_kernels),
        cmocka_unit_test(stops),        cmocka_unit_test(nonsense)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("pairs_isotropic", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
