/* Laws of pair sums by the engines that sum over pairs: closed forms, rotations, batches,
 * designs; with the layouts of CPUs and of GPUs. */
#include "harness_pairs.h"

#include "engines/pairs/pairs_bins.h"
#include "engines/host/host_direct.h"
#include "engines/engine.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;
static uint64_t seed = 3;

typedef struct way {
    const ps_engine *engine;
    ps_precision precision;
    double tolerance, limit; /* asked; of what comes */
} way;

static const way ways[] = {{&ps_pairs_direct, PS_SINGLE, 1e-6, 2e-6},
                           {&ps_pairs_histogram, PS_SINGLE, 1e-5, 1e-5},
                           {&ps_pairs_direct, PS_DOUBLE, 1e-12, 5e-15},
                           {&ps_pairs_histogram, PS_DOUBLE, 1e-10, 1e-10}};

/* The next way that the device has; NULL behind the last. */
static const way *next_way(size_t *i) {
    while (*i < sizeof ways / sizeof ways[0]) {
        const way *one = &ways[(*i)++];
        if (one->precision == PS_SINGLE || ps_device_get_limits(device)->has_fp64) {
            return one;
        }
    }
    return NULL;
}

static double *run(const way *by, int32_t last, const pspec_pattern *patterns, size_t num,
                   size_t batch) {
    return test_run_pairs(by->engine, by->precision, by->tolerance, device, last, patterns, num,
                          batch);
}

/* One point 1; two antipodal ones 4 and 0; a point given twice is one of twice the weight; weights
 * of either sign. */
static void closed_forms(void **state) {
    (void)state;
    enum { LAST = 37 };
    static const double points[] = {0.36, 0.48, 0.8, -0.36, -0.48, -0.8, 0.36, 0.48, 0.8};
    static const double signs[] = {1, -1};
    static const double twice[] = {1, 1};
    const pspec_pattern patterns[] = {{3, 1, points, NULL},
                                      {3, 2, points, NULL},
                                      {3, 2, points, signs},
                                      {3, 2, points + 3, twice},
                                      {3, 3, points, NULL}};
    const double even[] = {1, 4, 0, 4, 9};
    const double odd[] = {1, 0, 4, 0, 1};
    const double sizes[] = {1, 4, 4, 4, 9};
    size_t i = 0;
    for (const way *by = next_way(&i); by != NULL; by = next_way(&i)) {
        double *q = run(by, LAST, patterns, 5, 2);
        for (size_t r = 0; r < 5; r++) {
            for (int l = 1; l <= LAST; l++) {
                const double expected = l % 2 == 0 ? even[r] : odd[r];
                assert_true(fabs(q[r * LAST + (size_t)l - 1] - expected) <= by->limit * sizes[r]);
            }
        }
        free(q);
    }
}

/* A pair 3e-10 apart, near a pole and not: as one point. */
static void close_pairs(void **state) {
    (void)state;
    enum { LAST = 1000 };
    double points[6];
    const pspec_pattern pattern = {3, 2, points, NULL};
    for (int pole = 0; pole < 2; pole++) {
        const double theta = pole ? 1e-8 : 1.1;
        test_sphere_point(points, theta, 2, 1);
        test_sphere_point(points + 3, theta + 3e-10, 2, 1);
        size_t i = 0;
        for (const way *by = next_way(&i); by != NULL; by = next_way(&i)) {
            /* 1 - P_l = l^2 theta^2 / 4; what P_l near 1 gathers of rounding: see
             * ps_pairs_error_law */
            const double drift = by->precision == PS_SINGLE ? 3e-8 * LAST : 6e-17 * LAST;
            double *q = run(by, LAST, &pattern, 1, 1);
            for (int l = 1; l <= LAST; l++) {
                assert_true(fabs(q[l - 1] - 4) <= 4 * (by->limit + drift + 1e-13));
            }
            free(q);
        }
    }
}

static void turn(double *points, size_t num) {
    const double c = cos(0.7), s = sin(0.7);
    for (size_t j = 0; j < num; j++) {
        double *u = points + 3 * j;
        for (int axis = 0; axis < 2; axis++) { /* about z, then about x */
            const double x = u[axis], y = u[axis + 1];
            u[axis] = c * x - s * y;
            u[axis + 1] = s * x + c * y;
        }
    }
}

static void rotations(void **state) {
    (void)state;
    enum { NUM = 101, LAST = 90 };
    double *points = test_sphere_white_set(2 * NUM, &seed);
    const pspec_pattern patterns[] = {{3, NUM, points, NULL}, {3, NUM, points + 3 * NUM, NULL}};
    memcpy(points + 3 * NUM, points, 3 * NUM * sizeof(double));
    turn(points + 3 * NUM, NUM);
    size_t i = 0;
    for (const way *by = next_way(&i); by != NULL; by = next_way(&i)) {
        double *q = run(by, LAST, patterns, 2, 2);
        for (size_t l = 0; l < LAST; l++) {
            assert_true(fabs(q[l] - q[LAST + l]) <= 2 * by->limit * NUM * NUM);
        }
        free(q);
    }
    free(points);
}

/* White sets have a mean of N. */
static void white_mean(void **state) {
    (void)state;
    enum { NUM = 30, SETS = 400, LAST = 20 };
    const double deviations = 5;
    double *points = test_sphere_white_set(NUM * SETS, &seed);
    pspec_pattern *patterns = calloc(SETS, sizeof *patterns);
    for (size_t r = 0; r < SETS; r++) {
        patterns[r] = (pspec_pattern){3, NUM, points + 3 * NUM * r, NULL};
    }
    double *q = run(&ways[0], LAST, patterns, SETS, 64);
    for (size_t l = 1; l <= LAST; l++) {
        double sum = 0;
        for (size_t r = 0; r < SETS; r++) {
            sum += q[r * LAST + l - 1] / NUM;
        }
        const double sigma = sqrt(2.0 * (NUM - 1) / (NUM * (2.0 * (double)l + 1)) / SETS);
        assert_true(fabs(sum / SETS - 1) <= deviations * sigma);
    }
    free(q);
    free(patterns);
    free(points);
}

/* The bound of the bins holds for polynomials in between, at the ends of bins, and is no more than
 * 20 times what happens. */
static void bound_of_bins(void **state) {
    (void)state;
    enum { LAST = 60, SAMPLES = 2000 };
    const double wanted = 1e-6;
    const size_t num_bins = ps_pairs_bins_choose(LAST, wanted);
    const double bound = ps_pairs_bins_bound(LAST, num_bins);
    assert_true(bound <= wanted * (1 + 1e-9));
    assert_true(ps_pairs_bins_bound(LAST, num_bins - 1) > wanted);
    double matrix[PS_PAIRS_MOMENTS * PS_PAIRS_MOMENTS];
    double *nodes = calloc(4 * num_bins * PS_PAIRS_MOMENTS, sizeof(double));
    ps_pairs_bins_matrix(matrix);
    ps_pairs_bins_nodes(num_bins, nodes);
    double worst = 0;
    for (int i = 0; i < SAMPLES; i++) {
        const double place = (double)num_bins * i / SAMPLES;
        const size_t bin = (size_t)place;
        const double x = 2 * (place - (double)bin) - 1;
        const double chord = place * sqrt(2) / (double)num_bins;
        double sum = 0;
        for (size_t j = 0; j < PS_PAIRS_MOMENTS; j++) {
            double weight = 0;
            for (size_t k = 0; k < PS_PAIRS_MOMENTS; k++) {
                weight += matrix[j * PS_PAIRS_MOMENTS + k] * cos((double)k * acos(x));
            }
            const double t = nodes[bin * PS_PAIRS_MOMENTS + j];
            double p = 1, d = 0;
            for (int l = 1; l <= LAST; l++) {
                d = ((l - 1) * d - (2 * l - 1) * t * p) / l;
                p += d;
            }
            sum += weight * p;
        }
        double p = 1, d = 0;
        for (int l = 1; l <= LAST; l++) {
            d = ((l - 1) * d - (2 * l - 1) * chord * chord / 2 * p) / l;
            p += d;
        }
        worst = fmax(worst, fabs(sum - p));
    }
    print_message("bins: error %.3g, bound %.3g\n", worst, bound);
    assert_true(worst <= bound && worst > bound / 20);
    free(nodes);
}

/* Womersley's design t = 19 with 201 points: no power to degree 19, and 4/3 - mean distance is E^2
 * of s = 3/2, .8191 N^-3/2 (docs/mathematics/samplers.md#lattices-of-the-sphere). */
static void designs(void **state) {
    (void)state;
    enum { NUM = 201, DEGREE = 19 };
    const char *folder = getenv("POINTSPEC_TEST_DATA");
    char path[512];
    snprintf(path, sizeof path, "%s/spherical/womersley_sf_t019_N00201.txt",
             folder != NULL ? folder : "../shared/data");
    FILE *file = fopen(path, "r");
    if (file == NULL || !ps_device_get_limits(device)->has_fp64) {
        print_message("no %s, or no double precision: skipped\n", path);
        if (file != NULL) {
            fclose(file);
        }
        skip();
    }
    double points[3 * NUM];
    for (size_t i = 0; i < 3 * NUM; i++) {
        assert_int_equal(fscanf(file, "%lf", &points[i]), 1);
    }
    fclose(file);
    const pspec_pattern pattern = {3, NUM, points, NULL};
    for (size_t i = 2; i < 4; i++) {
        double *q = run(&ways[i], DEGREE + 1, &pattern, 1, 1);
        for (size_t l = 1; l <= DEGREE; l++) {
            assert_true(fabs(q[l - 1]) <= 1e-10 * NUM * NUM);
        }
        assert_true(q[DEGREE] > 0.05 * NUM);
        free(q);
    }
    long double sum = 0;
    assert_ok(ps_host_chords(&pattern, 0.5, &sum, error));
    const double constant = (4.0 / 3 - (double)sum / (NUM * NUM)) * NUM * sqrt(NUM);
    print_message("design: E^2 N^1.5 = %.5f\n", constant);
    assert_true(fabs(constant - 0.8191) <= 1e-4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_forms),  cmocka_unit_test(close_pairs),
        cmocka_unit_test(rotations),     cmocka_unit_test(white_mean),
        cmocka_unit_test(bound_of_bins), cmocka_unit_test(designs)};
    device = test_open_device();
    int failures = cmocka_run_group_tests_name("pairs", tests, NULL, NULL);
    ((ps_device_limits *)ps_device_get_limits(device))->has_dedicated_local_memory = true;
    failures += cmocka_run_group_tests_name("pairs as on GPUs", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
