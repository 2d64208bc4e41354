/* sphere_direct by what must hold of any spectrum on the sphere
 * (docs/mathematics/sphere.md#coefficients-and-power): no recorded output. */
#include "harness_sphere.h"

#include "engines/engine.h"
#include "engines/sphere/sphere_layout.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;

static void need_double(void) {
    if (!ps_device_get_limits(device)->has_fp64) {
        skip();
    }
}

static double *run(ps_precision precision, const ps_frequencies *degrees,
                   const pspec_pattern *patterns, size_t num, size_t batch) {
    return test_run_engine(&ps_sphere_direct, precision, device, degrees, patterns, num, batch);
}

/* One point has P = 1 for every degree: the addition theorem. Every power of every sin theta is in
 * it. */
static void addition_theorem(ps_precision precision, const int32_t last, double begin,
                             double step) {
    static const double angles[] = {0,   1e-200, 1e-30, 1e-8, 1e-5, 1e-3, 0.01, 0.03,
                                    0.1, 0.2,    0.3,   0.5,  0.8,  1.1,  1.4,  1.5707963267948966};
    enum { ANGLES = sizeof angles / sizeof angles[0] };
    double points[2 * ANGLES][PS_SPHERE_DIMENSION];
    pspec_pattern patterns[2 * ANGLES];
    ps_frequencies degrees = test_degrees(last, false);
    for (size_t i = 0; i < 2 * (size_t)ANGLES; i++) {
        test_sphere_point(points[i], angles[i / 2], 0.7 * (double)i, i % 2 == 0 ? 1 : -1);
        patterns[i] = (pspec_pattern){PS_SPHERE_DIMENSION, 1, points[i], NULL};
    }
    double *q = run(precision, &degrees, patterns, 2 * (size_t)ANGLES, 8);
    double worst = 0;
    for (size_t i = 0; i < 2 * (size_t)ANGLES * degrees.num; i++) {
        const double allowed = 2 * hypot(begin, step * (double)(i % degrees.num + 1));
        if (!(fabs(q[i] - 1) <= allowed)) {
            fail_msg("%s, angle %g, degree %zu: %.17g", ps_precision_name(precision),
                     angles[i / degrees.num / 2], i % degrees.num + 1, q[i]);
        }
        worst = fmax(worst, fabs(q[i] - 1));
    }
    print_message("%s to degree %d: within %.2g of 1\n", ps_precision_name(precision), last, worst);
    free(q);
    ps_frequencies_free(&degrees);
}

static void one_point_single(void **state) {
    (void)state;
    addition_theorem(PS_SINGLE, 4096, 7e-7, 3.5e-8); /* the coherent errors of the engine */
}

static void one_point_double(void **state) {
    (void)state;
    need_double();
    addition_theorem(PS_DOUBLE, 4096, 5e-13, 0);
}

static void antipodal_pair(void **state) {
    (void)state;
    const double points[2][PS_SPHERE_DIMENSION] = {{0.36, 0.48, -0.8}, {-0.36, -0.48, 0.8}};
    const pspec_pattern pattern = {PS_SPHERE_DIMENSION, 2, points[0], NULL};
    ps_frequencies degrees = test_degrees(200, false);
    for (int precision = PS_SINGLE; precision <= PS_DOUBLE; precision++) {
        if (!ps_device_get_limits(device)->has_fp64 && precision == PS_DOUBLE) {
            continue;
        }
        const double allowed = precision == PS_SINGLE ? 1e-5 : 1e-12;
        double *q = run((ps_precision)precision, &degrees, &pattern, 1, 1);
        for (size_t i = 0; i < degrees.num; i++) {
            assert_true(fabs(q[i] - (degrees.vectors[i] % 2 == 0 ? 4 : 0)) <= 2 * allowed);
        }
        free(q);
    }
    ps_frequencies_free(&degrees);
}

/* A turn about an axis that is no axis of coordinates. */
static void rotate(double *u) {
    const double angle = 1.9;
    const double axis[3] = {2.0 / 3, -1.0 / 3, 2.0 / 3};
    const double dot = axis[0] * u[0] + axis[1] * u[1] + axis[2] * u[2];
    double out[3];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        out[i] = u[i] * cos(angle) + (axis[j] * u[k] - axis[k] * u[j]) * sin(angle) +
                 axis[i] * dot * (1 - cos(angle));
    }
    memcpy(u, out, sizeof out);
}

static void rotations_change_nothing(void **state) {
    (void)state;
    need_double();
    enum { NUM = 700 };
    uint64_t seed = 3;
    double *points = test_sphere_white_set((size_t)2 * NUM, &seed);
    memcpy(points + 3 * NUM, points, (size_t)3 * NUM * sizeof *points);
    for (size_t j = NUM; j < (size_t)2 * NUM; j++) {
        rotate(points + 3 * j);
    }
    const pspec_pattern patterns[] = {{3, NUM, points, NULL}, {3, NUM, points + 3 * NUM, NULL}};
    ps_frequencies degrees = test_degrees(300, false);
    double *q = run(PS_DOUBLE, &degrees, patterns, 2, 2);
    for (size_t i = 0; i < degrees.num; i++) {
        assert_true(fabs(q[i] - q[degrees.num + i]) <= 1e-11 * NUM);
    }
    free(q);
    free(points);
    ps_frequencies_free(&degrees);
}

/* Mean 1 and variance 2 (N - 1) / (N (2l + 1)) of P(l). */
static void white_noise(void **state) {
    (void)state;
    enum { NUM = 20, REALIZATIONS = 4000, LAST = 24 };
    uint64_t seed = 9;
    double *points = test_sphere_white_set((size_t)NUM * REALIZATIONS, &seed);
    pspec_pattern *patterns = calloc(REALIZATIONS, sizeof *patterns);
    for (size_t r = 0; r < REALIZATIONS; r++) {
        patterns[r] = (pspec_pattern){3, NUM, points + 3 * NUM * r, NULL};
    }
    ps_frequencies degrees = test_degrees(LAST, false);
    double *q = run(PS_SINGLE, &degrees, patterns, REALIZATIONS, 1000);
    for (size_t i = 0; i < LAST; i++) {
        double sum = 0;
        double squares = 0;
        for (size_t r = 0; r < REALIZATIONS; r++) {
            const double p = q[r * LAST + i] / NUM;
            sum += p;
            squares += p * p;
        }
        const double mean = sum / REALIZATIONS;
        const double variance = squares / REALIZATIONS - mean * mean;
        const double expected = 2.0 * (NUM - 1) / NUM / (2 * (double)(i + 1) + 1);
        assert_true(fabs(mean - 1) <= 4.5 * sqrt(expected / REALIZATIONS));
        assert_true(fabs(variance / expected - 1) <= 0.15); /* 4.5 deviations of its own */
    }
    free(q);
    free(points);
    free(patterns);
    ps_frequencies_free(&degrees);
}

/* Only even degrees: those of the whole sphere, bits aside. */
static void even_degrees(void **state) {
    (void)state;
    enum { NUM = 600, LAST = 100 };
    uint64_t seed = 4;
    double *points = test_sphere_white_set(NUM, &seed);
    const pspec_pattern pattern = {3, NUM, points, NULL};
    ps_frequencies all = test_degrees(LAST, false);
    ps_frequencies even = test_degrees(LAST, true);
    double *q = run(PS_SINGLE, &all, &pattern, 1, 1);
    double *some = run(PS_SINGLE, &even, &pattern, 1, 1);
    for (size_t i = 0; i < even.num; i++) {
        assert_true(fabs(some[i] - q[even.vectors[i] - 1]) <= 1e-5 * NUM);
    }
    double *c = test_coefficients(&ps_sphere_direct, PS_SINGLE, device, &even, &pattern);
    for (int32_t l = 1; l <= LAST; l += 2) {
        assert_true(c[2 * test_coefficient(LAST, l, 1)] == 0);
    }
    free(c);
    free(q);
    free(some);
    free(points);
    ps_frequencies_free(&all);
    ps_frequencies_free(&even);
}

/* Slabs as large as a set, and of whole chunks, with sets of several slabs and of less beside each
 * other. */
static void slabs_change_no_bit(void **state) {
    (void)state;
    enum { SETS = 3, LARGEST = 1700 };
    uint64_t seed = 21;
    double *points = test_sphere_white_set(LARGEST, &seed);
    const pspec_pattern patterns[SETS] = {
        {3, 600, points, NULL}, {3, LARGEST, points, NULL}, {3, 20, points, NULL}};
    ps_frequencies degrees = test_degrees(60, false);
    double *whole = run(PS_SINGLE, &degrees, patterns, SETS, SETS);
    for (uint64_t slab = 512; slab <= 1024; slab += 512) {
        const ps_problem problem = {
            .frequencies = &degrees, .num_points = slab, .num_realizations = SETS, .tolerance = 1};
        double *q =
            test_run_problem(&ps_sphere_direct, &problem, PS_SINGLE, device, patterns, SETS, SETS);
        assert_memory_equal(q, whole, SETS * degrees.num * sizeof *q);
        free(q);
    }
    free(whole);
    free(points);
    ps_frequencies_free(&degrees);
}

/* A launch of any degree and number of points is of a chunk or of a few seconds at most. */
static void launches_are_short(void **state) {
    (void)state;
    const double most = 4e9; /* harmonics */
    for (int32_t l = 1; l <= 32768; l *= 8) {
        ps_frequencies degrees = {0};
        assert_ok(ps_frequencies_degrees(&degrees, l, false, error));
        const ps_problem problem = {.frequencies = &degrees, .num_points = 10000000000};
        const ps_sphere_layout layout =
            ps_sphere_layout_make(&problem, ps_device_get_limits(device), PS_SINGLE);
        assert_int_equal(layout.slab % PS_SPHERE_CHUNK, 0);
        assert_true(layout.slab == PS_SPHERE_CHUNK ||
                    (double)layout.slab * (double)layout.pass_orders * l <= most);
        ps_frequencies_free(&degrees);
    }
}

/* ---- spherical designs --------------------------------------------------------------------- */

typedef struct design {
    const char *file;
    size_t num;
    int32_t strength;
    double allowed; /* of P */
} design;

static const design designs[] = {
    {"womersley_sf_t009_N00050.txt", 50, 9, 1e-20},
    {"womersley_sf_t013_N00098.txt", 98, 13, 1e-20},
    {"womersley_sf_t031_N00513.txt", 513, 31, 1e-20},
    {"womersley_sf_t089_N04051.txt", 4051, 89, 1e-20},
    {"sloane_des3-24-7.txt", 24, 7, 1e-8},
    {"sloane_des3-240-21.txt", 240, 21, 1e-8},
};

/* Numbers from a text file, or NULL; false where the folder is not there. */
static double *read_points(const char *name, size_t num) {
    char path[512];
    const char *folder = getenv("POINTSPEC_TEST_DATA");
    snprintf(path, sizeof path, "%s/spherical/%s", folder != NULL ? folder : "../shared/data",
             name);
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        print_message("skipped: no %s\n", path);
        return NULL;
    }
    double *points = calloc(3 * num, sizeof *points);
    for (size_t i = 0; i < 3 * num; i++) {
        assert_int_equal(fscanf(file, "%lf", &points[i]), 1);
    }
    fclose(file);
    return points;
}

static void designs_have_no_power(void **state) {
    (void)state;
    need_double();
    for (size_t d = 0; d < sizeof designs / sizeof designs[0]; d++) {
        const design *one = &designs[d];
        double *points = read_points(one->file, one->num);
        if (points == NULL) {
            skip();
        }
        const pspec_pattern pattern = {3, one->num, points, NULL};
        ps_frequencies degrees = test_degrees(one->strength + 2, false);
        double *q = run(PS_DOUBLE, &degrees, &pattern, 1, 1);
        double largest = 0;
        for (size_t i = 0; i < (size_t)one->strength; i++) {
            largest = fmax(largest, q[i] / (double)one->num);
        }
        const double next = fmax(q[one->strength], q[one->strength + 1]) / (double)one->num;
        print_message("%-30s P <= %.2g to degree %d, then %.2g\n", one->file, largest,
                      one->strength, next);
        assert_true(largest <= one->allowed && next > 1e-3);
        free(q);
        free(points);
        ps_frequencies_free(&degrees);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_point_single),      cmocka_unit_test(one_point_double),
        cmocka_unit_test(antipodal_pair),        cmocka_unit_test(rotations_change_nothing),
        cmocka_unit_test(white_noise),           cmocka_unit_test(even_degrees),
        cmocka_unit_test(designs_have_no_power), cmocka_unit_test(slabs_change_no_bit),
        cmocka_unit_test(launches_are_short),
    };
    /* Work-groups of 64 items are slow on CPUs: one point of many degrees would take a minute. */
    const struct CMUnitTest quick_tests[] = {
        cmocka_unit_test(antipodal_pair), cmocka_unit_test(rotations_change_nothing),
        cmocka_unit_test(white_noise), cmocka_unit_test(even_degrees),
        cmocka_unit_test(slabs_change_no_bit)};
    device = test_open_device();
    int failures = cmocka_run_group_tests_name("sphere_direct", tests, NULL, NULL);
    ((ps_device_limits *)ps_device_get_limits(device))->has_dedicated_local_memory = true;
    failures += cmocka_run_group_tests_name("sphere_direct as on GPUs", quick_tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
