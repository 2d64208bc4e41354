/* Estimates of integrals over the sphere and the hemisphere: rotations, by hand. */
#include "file_kinds.h"
#include "harness.h"

#include "math/pi.h"
#include "trials/trials.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static ps_device *device;
static uint64_t seed = 12;

/* The number of a wave, of unit vectors: cos(2 pi (k.u + phase)), with the kernel of waves. */
static void wave_values(const ps_integrand *self, const double *points, size_t num, double *out) {
    for (size_t i = 0; i < num; i++) {
        double turns = self->numbers[6];
        for (unsigned axis = 0; axis < 3; axis++) {
            turns += points[3 * i + axis] * self->numbers[axis];
        }
        out[i] = cos(PS_TWO_PI * turns);
    }
}

static const ps_integrand_kind wave_on_sphere = {
    .name = "some-thing", .kernel = "wave", .values = wave_values};
static const ps_integrand_kind without_kernel = {.name = "wave", .values = wave_values};

/* A quarter turn about each axis, and one of no simple angle. */
static const double rotations[][9] = {{1, 0, 0, 0, 0, -1, 0, 1, 0},
                                      {0, 0, 1, 0, 1, 0, -1, 0, 0},
                                      {0, -1, 0, 1, 0, 0, 0, 0, 1},
                                      {0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6}};
enum { NUM_ROTATIONS = 4, SPHERE_POINTS = 50 };

static void by_hand(const ps_integrand *integrand, const double *points, double volume,
                    double *estimates) {
    for (size_t t = 0; t < NUM_ROTATIONS; t++) {
        double sum = 0;
        for (size_t j = 0; j < SPHERE_POINTS; j++) {
            double u[3] = {0, 0, 0};
            double value = 0;
            for (size_t i = 0; i < 9; i++) {
                u[i / 3] += rotations[t][i] * points[3 * j + i % 3];
            }
            const bool is_low = integrand->place.where == PS_SAMPLES_HEMISPHERE && u[2] < 0;
            for (size_t i = 0; i < 3; i++) {
                u[i] = is_low ? -u[i] : u[i];
            }
            wave_values(integrand, u, 1, &value);
            sum += value;
        }
        estimates[t] = volume * sum / SPHERE_POINTS;
    }
}

static void make_unit_vectors(double *points) {
    for (size_t j = 0; j < SPHERE_POINTS; j++) {
        const double z = 2 * test_uniform(&seed) - 1;
        const double azimuth = PS_TWO_PI * test_uniform(&seed);
        points[3 * j] = sqrt(1 - z * z) * cos(azimuth);
        points[3 * j + 1] = sqrt(1 - z * z) * sin(azimuth);
        points[3 * j + 2] = z;
    }
}

static void check_rotations(const ps_integrand *integrand, double volume, ps_precision precision,
                            ps_device *where, bool is_on_device) {
    const ps_trials_options options = {precision, 1, SPHERE_POINTS, NUM_ROTATIONS, false};
    double points[3 * SPHERE_POINTS];
    double expected[NUM_ROTATIONS];
    double found[NUM_ROTATIONS];
    const pspec_pattern pattern = {3, SPHERE_POINTS, points, NULL};
    ps_trials *trials = NULL;
    make_unit_vectors(points);
    by_hand(integrand, points, volume, expected);
    assert_ok(ps_trials_create(&trials, integrand, &options, where, error));
    assert_true(ps_trials_is_on_device(trials) == is_on_device);
    assert_ok(ps_trials_run(trials, &(ps_batch){.num_patterns = 1, .patterns = &pattern},
                            rotations[0], found, error));
    for (size_t t = 0; t < NUM_ROTATIONS; t++) {
        assert_true(fabs(found[t] - expected[t]) <
                    (is_on_device && precision == PS_SINGLE ? 1e-5 : 1e-13));
    }
    ps_trials_destroy(trials);
}

static void rotations_and_halves(void **state) {
    ps_integrand integrand = {.kind = &wave_on_sphere,
                              .place = {PS_SAMPLES_SPHERE, 3},
                              .numbers = {0.3, -0.2, 0.7, 0, 0, 0, 0.1}};
    (void)state;
    for (int half = 0; half <= 1; half++) {
        const double volume = half ? PS_TWO_PI : PS_FOUR_PI;
        integrand.place.where = half ? PS_SAMPLES_HEMISPHERE : PS_SAMPLES_SPHERE;
        integrand.kind = &wave_on_sphere;
        assert_int_equal(ps_trials_move_numbers(&integrand), 9);
        check_rotations(&integrand, volume, PS_DOUBLE, NULL, false);
        check_rotations(&integrand, volume, PS_SINGLE, device, true);
        check_rotations(&integrand, volume, PS_DOUBLE, device,
                        ps_device_get_limits(device)->has_fp64);
        integrand.kind = &without_kernel;
        check_rotations(&integrand, volume, PS_SINGLE, device, false);
    }
}

/* Estimates of the device and of the host, in doubles. */
static void check_values(const char *text) {
    const ps_integrand_place place = {PS_SAMPLES_SPHERE, 3};
    const ps_trials_options options = {PS_DOUBLE, 1, SPHERE_POINTS, NUM_ROTATIONS, false};
    double points[3 * SPHERE_POINTS];
    const pspec_pattern pattern = {3, SPHERE_POINTS, points, NULL};
    double found[2][NUM_ROTATIONS];
    ps_integrand *integrand = NULL;
    make_unit_vectors(points);
    assert_ok(ps_integrand_parse(&integrand, text, place, error));
    for (size_t i = 0; i < 2; i++) {
        ps_trials *trials = NULL;
        assert_ok(ps_trials_create(&trials, integrand, &options, i == 0 ? NULL : device, error));
        assert_true(ps_trials_is_on_device(trials) == (i == 1));
        assert_ok(ps_trials_run(trials, &(ps_batch){.num_patterns = 1, .patterns = &pattern},
                                rotations[0], found[i], error));
        ps_trials_destroy(trials);
    }
    for (size_t t = 0; t < NUM_ROTATIONS; t++) {
        assert_true(fabs(found[1][t] - found[0][t]) <= 1e-13 * fmax(1, fabs(found[0][t])));
    }
    ps_integrand_destroy(integrand);
}

static void kernels_of_rows_have_their_values(void **state) {
    const size_t least = 8;
    size_t num = 0;
    (void)state;
    for (size_t i = 0; ps_integrand_kinds[i] != NULL; i++) {
        const ps_integrand_kind *const kind = ps_integrand_kinds[i];
        if (!is_of_file(kind) && (kind->domains & PS_INTEGRAND_ON(PS_SAMPLES_SPHERE)) != 0 &&
            ps_device_get_limits(device)->has_fp64) {
            char text[64];
            const bool needs_exponent =
                strcmp(kind->name, "glossy") == 0 || strcmp(kind->name, "phong") == 0;
            snprintf(text, sizeof text, "%s%s", kind->name, needs_exponent ? ":n=30" : "");
            check_values(text);
            num++;
        }
    }
    assert_true(num >= least || !ps_device_get_limits(device)->has_fp64);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(rotations_and_halves),
                                       cmocka_unit_test(kernels_of_rows_have_their_values)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("trial_rotations", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
