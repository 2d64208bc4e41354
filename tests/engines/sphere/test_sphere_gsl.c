/* Coefficients of the engines of the sphere against the associated Legendre functions of GSL, which
 * somebody else wrote: degree by degree at fixed order, like the device engines, in double
 * precision.
 */
#include "harness_sphere.h"

#include "engines/host/host_direct.h"
#include "engines/engine.h"

#include <gsl/gsl_sf_legendre.h>
#include <math.h>
#include <stdlib.h>

enum { NUM_POINTS = 60, LAST = 80 };

static ps_device *device;

/* c[2 (m (2L + 1 - m) / 2 + l)] = sum of Y_lm, Condon-Shortley phase included. */
static double *sum_gsl(const double *points) {
    const double with_phase = -1;
    double *legendre = calloc(gsl_sf_legendre_array_n(LAST), sizeof(double));
    double *c = calloc((LAST + 1) * (LAST + 2), sizeof(double));
    for (size_t j = 0; j < NUM_POINTS; j++) {
        const double *u = points + 3 * j;
        const double phi = atan2(u[1], u[0]);
        assert_int_equal(
            gsl_sf_legendre_array_e(GSL_SF_LEGENDRE_SPHARM, LAST, u[2], with_phase, legendre), 0);
        for (int32_t m = 0; m <= LAST; m++) {
            for (int32_t l = m; l <= LAST; l++) {
                const double value = legendre[gsl_sf_legendre_array_index((size_t)l, (size_t)m)];
                double *to = c + 2 * test_coefficient(LAST, l, m);
                to[0] += value * cos(m * phi);
                to[1] += value * sin(m * phi);
            }
        }
    }
    free(legendre);
    return c;
}

/* allowed: of a coefficient, whose standard deviation for white points is sqrt(N / 4 pi) = 2.2. */
static void compare(const ps_engine *engine, ps_precision precision, double allowed) {
    uint64_t seed = 8;
    double *points = test_sphere_white_set(NUM_POINTS, &seed);
    const pspec_pattern pattern = {3, NUM_POINTS, points, NULL};
    ps_frequencies degrees = test_degrees(LAST, false);
    double *expected = sum_gsl(points);
    double *found = test_coefficients(engine, precision, device, &degrees, &pattern);
    for (size_t i = 0; i < (LAST + 1) * (LAST + 2); i++) {
        if (!(fabs(found[i] - expected[i]) <= allowed)) {
            fail_msg("%s, %s: coefficient %zu is %.17g, GSL has %.17g", engine->name,
                     ps_precision_name(precision), i / 2, found[i], expected[i]);
        }
    }
    free(found);
    free(expected);
    ps_frequencies_free(&degrees);
    free(points);
}

static void in_extended_precision(void **state) {
    (void)state;
    compare(&ps_host_direct, PS_EXTENDED, 2e-12);
}

static void in_double_precision(void **state) {
    (void)state;
    if (!ps_device_get_limits(device)->has_fp64) {
        skip();
    }
    compare(&ps_sphere_direct, PS_DOUBLE, 2e-12);
    compare(&ps_sphere_nufft, PS_DOUBLE, 2e-11);
    compare(&ps_sphere_grid, PS_DOUBLE, 2e-11);
}

static void in_single_precision(void **state) {
    (void)state;
    compare(&ps_sphere_direct, PS_SINGLE, 2e-5);
}

static int open_device(void **state) {
    (void)state;
    device = test_open_device();
    return 0;
}

static int close_device(void **state) {
    (void)state;
    ps_device_close(device);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(in_extended_precision),
        cmocka_unit_test(in_double_precision),
        cmocka_unit_test(in_single_precision),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
