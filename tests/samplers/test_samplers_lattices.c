/* Lattices of rank 1, Kronecker sequences, and the beginnings of progressive sets. */
#include "test_samplers.h"

#include <math.h>
#include <string.h>

static const double TURN = 6.283185307179586;

/* N |S|^2 / N^2 by plain sums. */
static double power_at(const double *points, size_t num, int k, int l) {
    double real = 0, imaginary = 0;
    for (size_t j = 0; j < num; j++) {
        const double turns = k * points[2 * j] + l * points[2 * j + 1];
        real += cos(TURN * turns);
        imaginary += sin(TURN * turns);
    }
    return (real * real + imaginary * imaginary) / (double)num;
}

/* P(k) = N where k.z is a multiple of N, the dual lattice, else 0. */
static void check_dual(const char *text, int num, int z) {
    enum { MOST = 20 };
    const ps_sampler_request request = make_request(text, (size_t)num, 2);
    double *const points = generate_points(&request, 0);
    for (int k = -MOST; k <= MOST; k++) {
        for (int l = -MOST; l <= MOST; l++) {
            const double expected = (k + l * z) % num == 0 ? num : 0;
            assert_true(fabs(power_at(points, (size_t)num, k, l) - expected) < 1e-9 * num);
        }
    }
    free(points);
}

static void the_spectrum_is_the_dual_lattice(void **state) {
    (void)state;
    check_dual("fibonacci-lattice", 34, 21);
    check_dual("rank1", 34, 21);
    check_dual("rank1:generator=1x7", 50, 7);
    check_dual("rank1:generator=1x107", 50, 7);
    check_dual("rank1", 100, 61); /* 62 has a divisor in common */
}

/* The best of all generators of the plane: the least vector of the dual lattice. */
static void fibonacci_lattices_are_good(void **state) {
    const ps_sampler_request request = make_request("fibonacci-lattice", 233, 2);
    double *const points = generate_points(&request, 0);
    double least = INFINITY;
    (void)state;
    for (size_t j = 1; j < 233; j++) {
        const double x = points[2 * j] - rint(points[2 * j]);
        const double y = points[2 * j + 1] - rint(points[2 * j + 1]);
        least = fmin(least, x * x + y * y);
    }
    assert_true(least * 233 > 0.99); /* F_13 = 8^2 + 13^2: a square lattice */
    free(points);
}

static void lattices_say_what_they_need(void **state) {
    (void)state;
    assert_refused("fibonacci-lattice", 100, 2, "use 89 or 144, or rank1");
    assert_refused("rank1", 100, 3, "in 3 dimensions generator=AxBx.. must be given");
    assert_refused("rank1:generator=1x2x3", 100, 2, "is not 2 positive whole numbers");
    assert_refused("rank1:generator=0x2", 100, 2, "is not 2 positive whole numbers");
    assert_refused("kronecker:alpha=0.5", 100, 2, "is not 2 numbers between 0 and 1");
    assert_refused("r2:alpha=0.5x1", 100, 2, "is not 2 numbers between 0 and 1");
    assert_refused("r2:alpha=0.5x 0.25", 100, 2, "is not 2 numbers between 0 and 1");
    assert_refused("r2:alpha=0.5x0.25x0.125", 100, 2, "is not 2 numbers between 0 and 1");
    assert_refused("r2:alpha=0.5x0.2500000000000000000000000000000000001", 100, 2,
                   "is not 2 numbers between 0 and 1");
    ps_sampler_request open = {.seed = 1};
    ps_error error = {0};
    assert_int_equal(ps_sampler_parse(&open, "fibonacci-lattice", &error), PSPEC_OK);
    assert_int_equal(ps_sampler_resolve(&open, &error), PSPEC_OK);
    assert_int_equal(open.num_points, 987);
}

/* M. Roberts's page has 1/g and 1/g^2 of R2 as 0.7548776662466927 and 0.5698402909980532. */
static void r2_is_as_published(void **state) {
    const ps_sampler_request request = make_request("r2", 1000, 2);
    double *const points = generate_points(&request, 0);
    (void)state;
    assert_true(points[0] == 0.5 && points[1] == 0.5);
    for (size_t j = 0; j < 1000; j++) {
        const double x = 0.5 + (double)j * 0.7548776662466927;
        const double y = 0.5 + (double)j * 0.5698402909980532;
        assert_true(fabs(points[2 * j] - (x - floor(x))) < 1e-12);
        assert_true(fabs(points[2 * j + 1] - (y - floor(y))) < 1e-12);
    }
    free(points);
}

/* g^(d+1) = g + 1. */
static void golden_steps_are_powers_of_the_root(void **state) {
    (void)state;
    for (unsigned d = 1; d <= PS_MAX_DIMENSION; d++) {
        const ps_sampler_request request = make_request("kronecker", 2, d);
        double *const points = generate_points(&request, 0);
        double steps[PS_MAX_DIMENSION];
        for (unsigned i = 0; i < d; i++) {
            const double step = points[d + i] - 0.5;
            steps[i] = step > 0 ? step : step + 1;
        }
        const double g = 1 / steps[0];
        assert_true(fabs(pow(g, d + 1.0) - g - 1) < 1e-12);
        for (unsigned i = 0; i < d; i++) {
            assert_true(fabs(steps[i] - pow(g, -(double)(i + 1))) < 1e-14);
        }
        free(points);
    }
}

/* Few points are the beginning of many, and the sets those of Sobol's with the same scrambling. */
static void beginnings_stay(void **state) {
    static const char *const progressive[] = {"pmj02", "pmj02:scramble=hash", "sobol:scramble=hash",
                                              "r2"};
    (void)state;
    for (size_t i = 0; i < sizeof progressive / sizeof progressive[0]; i++) {
        const ps_sampler_request few = make_request(progressive[i], 64, 2);
        const ps_sampler_request many = make_request(progressive[i], 256, 2);
        double *const a = generate_points(&few, 5);
        double *const b = generate_points(&many, 5);
        assert_memory_equal(a, b, 128 * sizeof *a);
        free(a);
        free(b);
    }
    const ps_sampler_request pmj02 = make_request("pmj02", 100, 2);
    const ps_sampler_request sobol = make_request("sobol:scramble=owen", 100, 2);
    double *const a = generate_points(&pmj02, 5);
    double *const b = generate_points(&sobol, 5);
    assert_memory_equal(a, b, 200 * sizeof *a);
    free(a);
    free(b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_spectrum_is_the_dual_lattice),
        cmocka_unit_test(fibonacci_lattices_are_good),
        cmocka_unit_test(lattices_say_what_they_need),
        cmocka_unit_test(r2_is_as_published),
        cmocka_unit_test(golden_steps_are_powers_of_the_root),
        cmocka_unit_test(beginnings_stay),
    };
    return cmocka_run_group_tests_name("samplers_lattices", tests, NULL, NULL);
}
