/* Small powers beside large ones through torus_nufft: what --floor promises. */
#include "harness_shapes.h"

#include "engines/host/host_direct.h"
#include "engines/engine.h"
#include "plan/choose.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static ps_device *device;
static const ps_precision precisions[] = {PS_SINGLE, PS_DOUBLE};

static size_t num_precisions(void) {
    return ps_device_get_limits(device)->has_fp64 ? 2 : 1;
}

/* Between the peaks of a lattice powers are 0; what is left there in units of white noise is below
 * the square of what the floor asks of S. */
static void floor_of_lattices(void **state) {
    (void)state;
    enum { SIDE = 32, POINTS = SIDE * SIDE, K = 31 };
    const double floor_power = 1e-6;
    const double tolerance = ps_plan_tolerance(1, floor_power);
    double *points = malloc(2 * POINTS * sizeof(double));
    ps_frequencies grid = test_make_grid(2, K);
    for (size_t j = 0; j < POINTS; j++) {
        points[2 * j] = fmod((double)(j / SIDE) / SIDE + 0.0123, 1);
        points[2 * j + 1] = fmod((double)(j % SIDE) / SIDE + 0.4567, 1);
    }
    const pspec_pattern lattice = {2, POINTS, points, NULL};
    for (size_t p = 0; p < num_precisions(); p++) {
        double *found = test_run_engine_to(&ps_torus_nufft, precisions[p], tolerance, device, &grid,
                                           &lattice, 1, 1);
        double largest = 0;
        for (size_t i = 0; i < grid.num; i++) {
            largest = fmax(largest, found[i] / POINTS);
        }
        print_message("lattice, %s, --floor %.0e: powers up to %.1e\n",
                      ps_precision_name(precisions[p]), floor_power, largest);
        assert_true(largest <= floor_power / 10);
        free(found);
    }
    ps_frequencies_free(&grid);
    free(points);
}

static size_t read_points(const char *name, double *points, size_t most) {
    const char *folder = getenv("POINTSPEC_TEST_DATA");
    char path[1024];
    size_t num = 0;
    snprintf(path, sizeof path, "%s/pointsets/%s", folder != NULL ? folder : "../shared/data",
             name);
    FILE *file = fopen(path, "r");
    while (file != NULL && num < most && fscanf(file, "%lf", &points[num]) == 1) {
        num++;
    }
    if (file != NULL) {
        fclose(file);
    }
    return num;
}

/* Blue noise with powers near 1e-6 at small k: right to 10 %. */
static void floor_of_blue_noise(void **state) {
    (void)state;
    enum { POINTS = 4096, K = 64, NEAR = 4 };
    const double floor_power = 1e-6;
    double *points = malloc(2 * POINTS * sizeof(double));
    if (read_points("utk_BNOT_4096.txt", points, (size_t)2 * POINTS) != (size_t)2 * POINTS) {
        free(points);
        skip();
    }
    const pspec_pattern pattern = {2, POINTS, points, NULL};
    ps_frequencies grid = test_make_grid(2, K);
    const double tolerance = ps_plan_tolerance(1, floor_power);
    for (size_t p = 0; p < num_precisions(); p++) {
        double *found = test_run_engine_to(&ps_torus_nufft, precisions[p], tolerance, device, &grid,
                                           &pattern, 1, 1);
        double smallest = HUGE_VAL;
        double worst = 0;
        for (size_t i = 0; i < grid.num; i++) {
            const int32_t *k = grid.vectors + 2 * i;
            long double re = 0;
            long double im = 0;
            if (abs(k[0]) > NEAR || abs(k[1]) > NEAR) {
                continue;
            }
            ps_host_sum(&pattern, k, &re, &im);
            const double power = (double)(re * re + im * im) / POINTS;
            smallest = fmin(smallest, power);
            if (power >= floor_power) {
                worst = fmax(worst, fabs(found[i] / POINTS / power - 1));
            }
        }
        print_message("BNOT, %s, --floor %.0e: smallest power %.1e, off by up to %.1e of it\n",
                      ps_precision_name(precisions[p]), floor_power, smallest, worst);
        assert_true(worst <= 0.1);
        free(found);
    }
    ps_frequencies_free(&grid);
    free(points);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floor_of_lattices),
        cmocka_unit_test(floor_of_blue_noise),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("nufft_floor", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
