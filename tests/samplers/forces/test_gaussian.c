/* Gaussian blue noise: energy and forces beside plain sums over images, an energy that only falls,
 * its bound, the same bits for ever. */
#include "set_distances.h"
#include "stop_at_the_third.h"
#include "test_samplers.h"

#include <string.h>

#include "device/lender.h"
#include "files/digest.h"
#include "samplers/forces/gaussian.h"
#include "samplers/forces/loan.h"

enum { MOST = 128, IMAGES = 9, SPACE_IMAGES = 5 };

/* ---- energy and forces ---- */

static void fill(size_t num, uint64_t realization, double *x) {
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, realization);
    ps_random_fill_uniform(&random, x, num);
}

typedef struct plain_sums {
    long double energy, force[3];
} plain_sums;

/* Of point i, without itself. */
static plain_sums sum_plainly(size_t num, unsigned d, double sigma, const double *x, size_t i) {
    const long double width = sigma * powl(num, -1.0L / d);
    const int images = d == 2 ? IMAGES : SPACE_IMAGES;
    const int deep = d == 2 ? 0 : images;
    plain_sums sums = {0, {0, 0, 0}};
    for (size_t j = 0; j < num; j++) {
        for (int a = -images; a <= images; a++) {
            for (int b = -images; b <= images; b++) {
                for (int c = -deep; c <= deep; c++) {
                    const long double shift[3] = {a, b, c};
                    long double away[3] = {0, 0, 0};
                    long double square = 0;
                    for (unsigned k = 0; k < d; k++) {
                        away[k] = (long double)x[i * d + k] - x[j * d + k] + shift[k];
                        square += away[k] * away[k];
                    }
                    const long double term = expl(-square / (2 * width * width));
                    sums.energy += i == j && square == 0 ? 0 : term;
                    for (unsigned k = 0; k < d; k++) {
                        sums.force[k] += away[k] * term;
                    }
                }
            }
        }
    }
    return sums;
}

static void compare(size_t num, unsigned d, double sigma) {
    double x[3 * MOST], force[3 * MOST];
    double energy = 0;
    long double expected = 0;
    ps_gaussian_sums sums;
    ps_error error = {0};
    fill(num * d, num, x);
    assert_int_equal(ps_gaussian_sums_create(&sums, num, d, sigma, &error), PSPEC_OK);
    assert_int_equal(ps_gaussian_sums_find(&sums, x, NULL, &energy, force, &error), PSPEC_OK);
    const double scale = 100 * ps_gaussian_unit(num, d);
    for (size_t i = 0; i < num; i++) {
        const plain_sums plain = sum_plainly(num, d, sigma, x, i);
        expected += plain.energy / 2;
        for (unsigned k = 0; k < d; k++) {
            if (!(fabs(force[i * d + k] - (double)plain.force[k]) <= 1e-14 * scale)) {
                fail_msg("N = %zu, d = %u, sigma = %g: force %.17g, not %.17Lg", num, d, sigma,
                         force[i * d + k], plain.force[k]);
            }
        }
    }
    if (!(fabs(energy - (double)expected) <= 1e-13 * (double)(expected + 1))) {
        fail_msg("N = %zu, d = %u, sigma = %g: energy %.17g, not %.17Lg", num, d, sigma, energy,
                 expected);
    }
    ps_gaussian_sums_destroy(&sums);
}

/* Few points see many images of themselves, many only a part of all. */
static void energy_and_forces_are_those_of_all_images(void **state) {
    (void)state;
    static const size_t nums[] = {1, 2, 7, 33, MOST};
    for (unsigned n = 0; n < sizeof nums / sizeof nums[0]; n++) {
        compare(nums[n], 2, 1);
    }
    compare(33, 2, 0.5);
    compare(MOST, 2, 0.5);
    compare(40, 2, 0.8);
    compare(8, 3, 0.5);
    compare(40, 3, 0.5);
}

/* Poisson's formula with the powers of a lattice, which are exact: N at frequencies that are
 * multiples of N^(1/d), else 0. */
static void the_excess_of_a_lattice_is_the_sum_of_its_powers(void **state) {
    (void)state;
    enum { SIDE = 8 };
    double x[2 * SIDE * SIDE];
    ps_gaussian g;
    ps_error error = {0};
    for (int i = 0; i < SIDE * SIDE; i++) {
        x[2 * i] = (double)(i % SIDE) / SIDE;
        x[2 * i + 1] = (double)(i / SIDE) / SIDE; /* NOLINT(bugprone-integer-division) */
    }
    const double sigma = 0.5;
    const double pi = acos(-1);
    double series = 0;
    for (int a = -4; a <= 4; a++) {
        for (int b = -4; b <= 4; b++) {
            series += a == 0 && b == 0
                          ? 0
                          : exp(-2 * pi * pi * sigma * sigma * (a * a + b * b)) * SIDE * SIDE;
        }
    }
    assert_int_equal(ps_gaussian_begin(&g, 64, 2, sigma, x, NULL, NULL, &error), PSPEC_OK);
    assert_true(fabs(ps_gaussian_excess(&g, sigma) - pi * sigma * sigma * series) < 1e-11);
    ps_gaussian_destroy(&g);
}

/* ---- steps ---- */

static void take_steps(size_t num, unsigned d, double sigma, unsigned steps) {
    double x[3 * MOST];
    ps_gaussian g;
    ps_error error = {0};
    fill(num * d, 3, x);
    assert_int_equal(ps_gaussian_begin(&g, num, d, sigma, x, NULL, NULL, &error), PSPEC_OK);
    for (unsigned k = 0; k < steps; k++) {
        const double before = g.energy;
        assert_int_equal(ps_gaussian_step(&g, &error), PSPEC_OK);
        if (!(g.energy < before || g.move < PS_GAUSSIAN_STILL)) {
            fail_msg("N = %zu, d = %u, sigma = %g: step %u from %.17g to %.17g", num, d, sigma, k,
                     before, g.energy);
        }
        assert_true(ps_gaussian_excess(&g, sigma) > -1e-11 * g.energy);
    }
    assert_int_equal(g.halvings, 0);
    ps_gaussian_destroy(&g);
}

static void the_energy_falls_with_every_step(void **state) {
    (void)state;
    take_steps(MOST, 2, 1, 300);
    take_steps(MOST, 2, 0.5, 100);
    take_steps(MOST, 2, 2, 100);
    take_steps(3, 2, 1, 100);
    take_steps(100, 3, 1, 10);
    take_steps(100, 3, 0.6, 50);
}

/* A length that is too long is halved until the energy falls. */
static void steps_that_are_too_long_are_taken_back(void **state) {
    (void)state;
    double x[2 * MOST];
    ps_gaussian g;
    ps_error error = {0};
    fill(2 * MOST, 5, x);
    assert_int_equal(ps_gaussian_begin(&g, MOST, 2, 1, x, NULL, NULL, &error), PSPEC_OK);
    g.length *= 16;
    double before = g.energy;
    for (unsigned k = 0; k < 50; k++) {
        assert_int_equal(ps_gaussian_step(&g, &error), PSPEC_OK);
        assert_true(g.energy < before);
        before = g.energy;
    }
    assert_in_range(g.halvings, 2, 6);
    ps_gaussian_destroy(&g);
}

static void points_that_coincide_stay_together(void **state) {
    (void)state;
    const double x[4] = {0.25, 0.5, 0.25, 0.5};
    ps_gaussian g;
    ps_error error = {0};
    assert_int_equal(ps_gaussian_begin(&g, 2, 2, 1, x, NULL, NULL, &error), PSPEC_OK);
    for (unsigned k = 0; k < 3; k++) {
        assert_int_equal(ps_gaussian_step(&g, &error), PSPEC_OK);
    }
    assert_true(g.move <= PS_GAUSSIAN_STILL);
    ps_gaussian_destroy(&g);
}

/* ---- sets ---- */

static void make(size_t num, unsigned d, double sigma, uint64_t realization, double *x) {
    ps_error error = {0};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, realization);
    if (ps_gaussian_make(num, d, sigma, &random, NULL, NULL, x, &error) != PSPEC_OK) {
        fail_msg("%s", error.message);
    }
    for (size_t i = 0; i < num * d; i++) {
        assert_true(x[i] >= 0 && x[i] < 1);
    }
}

/* Recorded: the bits of a set stay the same, with any compiler and on any machine. */
static void the_bits_of_sets_are_these(void **state) {
    (void)state;
    double x[3 * MOST];
    char digest[PS_DIGEST_BYTES];
    make(MOST, 2, 1, 0, x);
    ps_digest_bytes(x, 2 * MOST * sizeof *x, digest);
    assert_string_equal(digest, "f5d55a114b7d31fdb22ecc581e747b44");
    make(30, 3, 0.5, 0, x);
    ps_digest_bytes(x, 90 * sizeof *x, digest);
    assert_string_equal(digest, "7ece6e88a6270108b57c30b28dc5c5f9");
}

/* ---- what cannot be made ---- */

static void what_cannot_be_made_is_refused(void **state) {
    (void)state;
    double x[2] = {0, 0};
    ps_error error = {0};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    assert_refused("gaussian-blue-noise", 64, 1, "dimension 1");
    assert_refused("gaussian-blue-noise", 64, 4, "dimension 4");
    assert_refused("gaussian-blue-noise", ((size_t)1 << 26) + 1, 2, "67108864");
    assert_refused("gaussian-blue-noise:sigma=0.4", 64, 2, "sigma");
    assert_refused("gbn:sigma=2.1", 64, 2, "sigma");
    assert_refused("gbn:sigma=wide", 64, 2, "sigma");
    assert_int_equal(ps_gaussian_make(1, 2, NAN, &random, NULL, NULL, x, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(ps_gaussian_make(1, 5, 1, &random, NULL, NULL, x, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, "5 coordinates"));
}

static void a_device_without_double_precision_is_refused(void **state) {
    (void)state;
    ps_device_limits limits = {.name = "small GPU"};
    ps_error error = {0};
    assert_int_equal(ps_forces_need_doubles(&limits, "gaussian-blue-noise", &error),
                     PSPEC_ERROR_DEVICE);
    assert_non_null(strstr(error.message, "small GPU"));
    assert_non_null(strstr(error.message, "--device cpu"));
    limits.has_fp64 = true;
    assert_int_equal(ps_forces_need_doubles(&limits, "gaussian-blue-noise", &error), PSPEC_OK);
}

/* Sets that are much work want one that was chosen; few points want none. Nobody chose "". */
static void a_device_that_is_not_there_is_told(void **state) {
    (void)state;
    double x[2 * 1024];
    ps_lender *none = NULL;
    ps_error error = {0};
    ps_sampler_request request = make_request("gbn", 20, 2);
    assert_int_equal(ps_lender_create(&none, "no such device", &error), PSPEC_OK);
    request.lender = none;
    assert_int_equal(ps_sampler_generate(&request, 0, x, NULL, NULL, &error), PSPEC_OK);
    assert_int_equal(ps_sampler_check_device(&request, "no such device", &error), PSPEC_OK);
    request.num_points = 1024;
    assert_int_equal(ps_sampler_generate(&request, 0, x, NULL, NULL, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, "no such device"));
    assert_int_equal(ps_sampler_check_device(&request, "no such device", &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(ps_sampler_check_device(&request, NULL, &error), PSPEC_OK);
    assert_int_equal(ps_sampler_check_device(&request, "", &error), PSPEC_OK);
    ps_lender_destroy(none);
}

static void the_row_has_the_parameter(void **state) {
    (void)state;
    double expected[2 * 20];
    const ps_sampler_request request = make_request("gbn:sigma=1.5", 20, 2);
    double *const points = generate_points(&request, 7);
    make(20, 2, 1.5, 7, expected);
    assert_memory_equal(points, expected, sizeof expected);
    free(points);
}

static void whoever_watches_may_stop_it(void **state) {
    (void)state;
    double x[2 * MOST];
    unsigned calls = 0;
    const ps_watch watch = {stop_at_the_third, &calls};
    ps_error error = {0};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    assert_int_equal(ps_gaussian_make(MOST, 2, 1, &random, NULL, &watch, x, &error),
                     PSPEC_ERROR_CANCELLED);
    assert_int_equal(calls, 3);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energy_and_forces_are_those_of_all_images),
        cmocka_unit_test(the_excess_of_a_lattice_is_the_sum_of_its_powers),
        cmocka_unit_test(the_energy_falls_with_every_step),
        cmocka_unit_test(steps_that_are_too_long_are_taken_back),
        cmocka_unit_test(points_that_coincide_stay_together),
        cmocka_unit_test(the_bits_of_sets_are_these),
        cmocka_unit_test(what_cannot_be_made_is_refused),
        cmocka_unit_test(a_device_without_double_precision_is_refused),
        cmocka_unit_test(a_device_that_is_not_there_is_told),
        cmocka_unit_test(the_row_has_the_parameter),
        cmocka_unit_test(whoever_watches_may_stop_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
