/* Estimates of integrals of a user's own functions, by their kernels against the host. */
#include "file_kinds.h"
#include "harness.h"

#include "math/pi.h"
#include "test_folder.h"
#include "trials/trials.h"

#include <math.h>
#include <stdio.h>

static ps_device *device;
static uint64_t seed = 13;

enum { POINTS = 1200, TRIALS = 3, DEGREE = 40, SIDE = 16 };

static const ps_integrand_place torus = {PS_SAMPLES_TORUS, 2};
static const ps_integrand_place space = {PS_SAMPLES_TORUS, 3};
static const ps_integrand_place sphere = {PS_SAMPLES_SPHERE, 3};
static const ps_integrand_place hemisphere = {PS_SAMPLES_HEMISPHERE, 3};

/* ---- files ----------------------------------------------------------------------------------- */

static double number(void) {
    return test_uniform(&seed) - 0.5;
}

/* Runs longer than those of the table, short ones, and single frequencies. */
static void write_torus(FILE *stream, double factor) {
    fprintf(stream, "0 0 %.17g 0\n", factor * number());
    for (int k = 1; k <= 150; k++) {
        const double re = factor * number(), im = factor * number();
        fprintf(stream, "0 %d %.17g %.17g\n0 %d %.17g %.17g\n", k, re, im, -k, re, -im);
    }
    for (int k = 1; k <= 9; k++) {
        const double re = factor * number(), im = factor * number();
        fprintf(stream, "%d %d %.17g %.17g\n%d %d %.17g %.17g\n", k, k * k - 40, re, im, -k,
                40 - k * k, re, -im);
    }
}

static void write_space(FILE *stream, double factor) {
    for (int k = 1; k <= 5; k++) {
        const double re = factor * number(), im = factor * number();
        fprintf(stream, "%d 0 %d %.17g %.17g\n%d 0 %d %.17g %.17g\n", k, 2 * k, re, im, -k, -2 * k,
                re, -im);
    }
}

/* Even degrees, so that the hemisphere has it, too. */
static void write_sphere(FILE *stream, double factor) {
    for (int l = 0; l <= DEGREE; l += 2) {
        for (int m = 0; m <= l; m++) {
            fprintf(stream, "%d %d %.17g %.17g\n", l, m, factor * number(),
                    m > 0 ? factor * number() : 0);
        }
    }
}

/* Whole numbers, whose sums are exact in either precision. */
static void write_image(const char *name) {
    double image[SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; i++) {
        image[i] = i * 37 % 101 - 50;
    }
    assert_true(test_write_array(name, "<f8", "False", "(16, 16)", image, sizeof image));
}

/* Jumps at both ends. */
static void write_lobe(FILE *stream, double factor) {
    fprintf(stream, "-0.5 %.17g\n0 %.17g\n0.5 %.17g\n0.51 0\n1 %.17g\n", factor, 2 * factor,
            factor / 4, 3 * factor);
}

/* Of 4 x 4 pixels, from the lowest row up. */
static void write_map(FILE *stream, double factor) {
    fputs("Pf 4 4 -1\n", stream);
    for (int i = 0; i < 16; i++) {
        const float light = (float)(i * 7 % 11 * factor);
        fwrite(&light, sizeof light, 1, stream);
    }
}

static void write_with(void (*write)(FILE *, double), const char *name, double factor) {
    FILE *const stream = fopen(name, "wb");
    assert_non_null(stream);
    write(stream, factor);
    assert_int_equal(fclose(stream), 0);
}

static int make_files(void **state) {
    if (test_folder_create(state) != 0 || chdir(((test_folder *)*state)->path) != 0) {
        return -1;
    }
    write_with(write_torus, "torus.txt", 1);
    write_with(write_torus, "large.txt", 1e60);
    write_with(write_space, "space.txt", 1);
    write_with(write_sphere, "sphere.txt", 1);
    write_with(write_lobe, "lobe.txt", 1);
    write_with(write_map, "map.pfm", 1);
    write_image("image.npy");
    return 0;
}

static int remove_files(void **state) {
    return test_folder_remove(state) == 0 ? chdir("/") : -1;
}

/* ---- estimates ------------------------------------------------------------------------------- */

typedef struct estimates {
    bool is_on_device;
    double of_trial[TRIALS];
} estimates;

/* grid 0: any coordinates; else multiples of 1/grid. */
static double coordinate(double grid) {
    const double x = test_uniform(&seed);
    return grid > 0 ? floor(x * grid) / grid : x;
}

static void fill(double *points, double *moves, ps_integrand_place place, double grid) {
    const double c = 0.6, s = 0.8; /* about z, about x, and both */
    const double turns[TRIALS][9] = {{c, -s, 0, s, c, 0, 0, 0, 1},
                                     {1, 0, 0, 0, c, -s, 0, s, c},
                                     {c, -s * c, s * s, s, c * c, -c * s, 0, s, c}};
    for (size_t j = 0; j < POINTS; j++) {
        double *const x = points + j * place.dimension;
        for (unsigned i = 0; i < place.dimension; i++) {
            x[i] = coordinate(grid);
        }
        if (place.where != PS_SAMPLES_TORUS) {
            const double z = j == 0 ? 1 : 2 * x[0] - 1;
            const double sine = sqrt(1 - z * z);
            const double azimuth = PS_TWO_PI * x[1];
            x[0] = sine * cos(azimuth);
            x[1] = sine * sin(azimuth);
            x[2] = z;
        }
    }
    for (size_t i = 0; i < TRIALS * (size_t)9; i++) {
        moves[i] = place.where == PS_SAMPLES_TORUS ? coordinate(grid) : turns[i / 9][i % 9];
    }
}

static estimates estimate(const ps_integrand *integrand, ps_device *where, ps_precision precision,
                          const double *points, const double *moves) {
    const ps_trials_options options = {precision, 1, POINTS, TRIALS, false};
    const pspec_pattern pattern = {integrand->place.dimension, POINTS, points, NULL};
    ps_trials *trials = NULL;
    estimates found;
    assert_ok(ps_trials_create(&trials, integrand, &options, where, error));
    found.is_on_device = ps_trials_is_on_device(trials);
    assert_ok(ps_trials_run(trials, &(ps_batch){.num_patterns = 1, .patterns = &pattern}, moves,
                            found.of_trial, error));
    ps_trials_destroy(trials);
    return found;
}

/* The device is off by at most so much; needs_doubles: single precision is the host's. */
static void check(const char *text, ps_integrand_place place, double grid, double single,
                  double exact, bool needs_doubles) {
    double points[POINTS * 3];
    double moves[TRIALS * 9];
    ps_integrand *integrand = NULL;
    fill(points, moves, place, grid);
    assert_ok(ps_integrand_parse(&integrand, text, place, error));
    const estimates expected = estimate(integrand, NULL, PS_DOUBLE, points, moves);
    const bool has_doubles = ps_device_get_limits(device)->has_fp64;
    for (ps_precision p = PS_SINGLE; p <= (has_doubles ? PS_DOUBLE : PS_SINGLE); p++) {
        const estimates found = estimate(integrand, device, p, points, moves);
        assert_false(expected.is_on_device);
        assert_true(found.is_on_device == !(p == PS_SINGLE && needs_doubles));
        for (size_t t = 0; t < TRIALS; t++) {
            const double off = fabs(found.of_trial[t] - expected.of_trial[t]);
            if (!(off <= (found.is_on_device ? (p == PS_SINGLE ? single : exact) : 0))) {
                fail_msg("%s, precision %d: %.17g, on the host %.17g", text, (int)p,
                         found.of_trial[t], expected.of_trial[t]);
            }
        }
    }
    ps_integrand_destroy(integrand);
}

/* 160 pairs of coefficients below 1/2, frequencies up to 150: phases of single precision are off by
 * 150 2 pi 2^-24 at most, those of doubles by as many 2^-53. */
static void series_of_the_torus(void **state) {
    const double single = 160 * 150 * PS_TWO_PI * 0x1p-24;
    (void)state;
    check("coefficients:file=torus.txt", torus, 0, single, single * 0x1p-29, false);
    check("coefficients:file=space.txt", space, 0, single, single * 0x1p-29, false);
    check("coefficients:file=large.txt", torus, 0, 0, single * 0x1p-29 * 1e60, true);
}

/* 441 coefficients below 1/2, harmonics below 3, and a volume of 4 pi. */
static void series_of_the_sphere(void **state) {
    const double exact = 441 * 3 * PS_FOUR_PI * 0x1p-52;
    (void)state;
    check("coefficients:file=sphere.txt", sphere, 0, 0, exact, true);
    check("coefficients:file=sphere.txt", hemisphere, 0, 0, exact, true);
}

/* Densities below 1 whose slope is below 10, and heights of points of either precision. A jump of
 * some density may be on the wrong side for one point. */
static void tables(void **state) {
    const double slope = 10 * PS_FOUR_PI;
    (void)state;
    check("zonal:file=lobe.txt", sphere, 0, slope * 0x1p-22 + PS_FOUR_PI / POINTS, slope * 0x1p-50,
          false);
}

/* At points of a grid nothing is rounded but the mean over them. */
static void images(void **state) {
    const double mean = 0x1p-52 * 50;
    (void)state;
    check("pixels:file=image.npy", torus, 1024, mean, mean, false);
    check("pixels:file=image.npy", torus, SIDE, mean, mean, false);
}

/* Light up to 10 over a volume of 4 pi: from pixel to pixel it changes by 10, and angles of 4 of
 * them are off by some roundings. */
static void maps(void **state) {
    const double slope = 10 * 4 * PS_FOUR_PI;
    (void)state;
    check("map:file=map.pfm", sphere, 0, slope * 0x1p-21, slope * 0x1p-50, false);
    check("map:file=map.pfm", hemisphere, 0, slope * 0x1p-21, slope * 0x1p-50, false);
    check("map:file=map.pfm", torus, 0, slope * 0x1p-21, slope * 0x1p-50, false);
}

/* Whoever adds a kind that reads files adds it above. */
static void all_kinds_are_above(void **state) {
    static const char *const above[] = {"coefficients", "pixels", "zonal", "map"};
    size_t num = 0;
    (void)state;
    for (size_t i = 0; ps_integrand_kinds[i] != NULL; i++) {
        if (is_of_file(ps_integrand_kinds[i])) {
            assert_true(num < sizeof above / sizeof above[0]);
            assert_string_equal(ps_integrand_kinds[i]->name, above[num++]);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(series_of_the_torus),
                                       cmocka_unit_test(series_of_the_sphere),
                                       cmocka_unit_test(tables),
                                       cmocka_unit_test(images),
                                       cmocka_unit_test(maps),
                                       cmocka_unit_test(all_kinds_are_above)};
    device = test_open_device();
    const int failures =
        cmocka_run_group_tests_name("trial_files", tests, make_files, remove_files);
    ps_device_close(device);
    return failures;
}
