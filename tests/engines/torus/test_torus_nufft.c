/* The engine torus_nufft: what its powers must obey, and work-groups that take different ways.
 * Tolerances are swept in test_tolerance_sweep.c, small powers are in test_nufft_floor.c.
 */
#include "harness_shapes.h"

#include "engines/host/host_direct.h"
#include "engines/torus/nufft/layout.h"
#include "engines/engine.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>
#include <stdlib.h>

static ps_device *device;
static const ps_precision precisions[] = {PS_SINGLE, PS_DOUBLE};

static size_t num_precisions(void) {
    return ps_device_get_limits(device)->has_fp64 ? 2 : 1;
}

/* Largest K by dimension: small problems. */
static const int32_t reach[4] = {0, 50, 9, 4};

static double tolerance_of(ps_precision precision) {
    return precision == PS_SINGLE ? 1e-5 : 1e-11;
}

/* ---- bits -------------------------------------------------------------------------------- */

enum { MOST_SETS = 19 };

typedef struct sample {
    ps_frequencies grid;
    size_t num;
    pspec_pattern patterns[MOST_SETS];
} sample;

/* K by dimension. Realization r has 1 + (step r) % most points. */
static sample make_sample(unsigned dimension, const int32_t *largest, size_t num, size_t step,
                          size_t most) {
    sample self = {.grid = test_make_grid(dimension, largest[dimension]), .num = num};
    for (size_t r = 0; r < num; r++) {
        const test_shape *shape = &test_shapes[r % 3 == 1 ? TEST_SIGNED_WEIGHTS : TEST_WHITE];
        self.patterns[r] = test_make_pattern(shape, dimension, 1 + r * step % most, 100 + r);
    }
    return self;
}

static void free_sample(sample *self) {
    for (size_t r = 0; r < self->num; r++) {
        test_free_pattern(&self->patterns[r]);
    }
    ps_frequencies_free(&self->grid);
}

static double *run_sample(const sample *self, ps_precision precision, size_t batch) {
    return test_run_engine_to(&ps_torus_nufft, precision, tolerance_of(precision), device,
                              &self->grid, self->patterns, self->num, batch);
}

static void check_same(const sample *self, double *found, const double *expected) {
    assert_memory_equal(found, expected, self->num * self->grid.num * sizeof(double));
    free(found);
}

/* One work-item goes from point to point, the items of a group from cell to cell: few and many
 * points in a cell take different ways. (Not groups of fewer items than lanes: PoCL 3.1 gets them
 * wrong, docs/engines/torus_nufft.md.) */
static void work_groups(void **state) {
    (void)state;
    static const size_t most[] = {20, 150, 1500};
    static const size_t sizes[2][3] = {{32, 64}, {8}};
    for (unsigned dimension = 1; dimension <= 3; dimension++) {
        for (size_t i = 0; i < sizeof most / sizeof most[0]; i++) {
            sample some = make_sample(dimension, reach, 3, most[i] - 2, most[i]);
            for (size_t p = 0; p < num_precisions(); p++) {
                double *expected = run_sample(&some, precisions[p], some.num);
                for (size_t s = 0; s < 3 && sizes[p][s] > 0; s++) {
                    ps_device_set_group_size(device, sizes[p][s]);
                    check_same(&some, run_sample(&some, precisions[p], some.num), expected);
                    ps_device_set_group_size(device, 0);
                }
                free(expected);
            }
            free_sample(&some);
        }
    }
}

/* ---- lines ------------------------------------------------------------------------------- */

/* More than there are lanes. */
enum { LINE_SETS = MOST_SETS, LINE_POINTS = 60 };

/* Multiples of the lanes of any device, by dimension: frequency 0 of axis 0 has a line. */
static const int32_t line_reach[4] = {0, 0, 48, 16};

static void assert_has_line(const ps_frequencies *grid, ps_precision precision) {
    const ps_problem problem = {.frequencies = grid,
                                .num_points = LINE_POINTS,
                                .num_realizations = LINE_SETS,
                                .tolerance = tolerance_of(precision)};
    const ps_device_limits *limits = ps_device_get_limits(device);
    const ps_nufft_layout layout = ps_nufft_layout_make(&problem, limits, precision);
    assert_ptr_equal(layout.choice.variant, &ps_nufft_tiles);
    assert_true(layout.choice.has_line);
}

/* One frequency may be off by several times the root mean square that tolerances are about. */
static const double single_frequency = 8;

static void check_powers(const sample *self, ps_precision precision, const double *found,
                         const double *expected) {
    const ps_frequencies *grid = &self->grid;
    for (size_t i = 0; i < self->num * grid->num; i++) {
        const double sum = test_sum_of_squares(&self->patterns[i / grid->num]);
        const double allowed = single_frequency * tolerance_of(precision) * sqrt(sum);
        const double size = sqrt(expected[i]);
        if (!(fabs(sqrt(found[i]) - size) <= allowed * fmax(1, size / 8))) {
            const int32_t *k = grid->vectors + i % grid->num * grid->dimension;
            fail_msg("d=%u %s: set %zu at (%d, %d, ..) has |S| %g, not %g", grid->dimension,
                     ps_precision_name(precision), i / grid->num, (int)k[0], (int)k[1],
                     sqrt(found[i]), size);
        }
    }
}

/* Of the first sets: groups of many items take PoCL long. */
static void check_groups(sample *some) {
    const size_t all = some->num;
    some->num = 2;
    for (size_t p = 0; p < num_precisions(); p++) {
        double *expected = run_sample(some, precisions[p], some->num);
        ps_device_set_group_size(device, precisions[p] == PS_SINGLE ? 32 : 8);
        check_same(some, run_sample(some, precisions[p], some->num), expected);
        ps_device_set_group_size(device, 0);
        free(expected);
    }
    some->num = all;
}

/* All frequencies are right, sets with signed weights among them, and the same to the bit in
 * batches that end within a vector, and where the items of a group share cells. */
static void lines(void **state) {
    (void)state;
    static const size_t batches[] = {1, 5, LINE_SETS - 1};
    for (unsigned dimension = 2; dimension <= 3; dimension++) {
        sample some = make_sample(dimension, line_reach, LINE_SETS, 13, LINE_POINTS);
        double *expected = test_run_engine(&ps_host_direct, PS_EXTENDED, NULL, &some.grid,
                                           some.patterns, some.num, some.num);
        for (size_t p = 0; p < num_precisions(); p++) {
            assert_has_line(&some.grid, precisions[p]);
            double *found = run_sample(&some, precisions[p], some.num);
            check_powers(&some, precisions[p], found, expected);
            for (size_t b = 0; b < sizeof batches / sizeof batches[0]; b++) {
                check_same(&some, run_sample(&some, precisions[p], batches[b]), found);
            }
            free(found);
        }
        check_groups(&some);
        free(expected);
        free_sample(&some);
    }
}

/* ---- what powers obey -------------------------------------------------------------------- */

/* White noise has mean power 1; the variance of one power is (N - 1) / N
 * (docs/mathematics/torus.md#white-noise). */
static void white_noise(void **state) {
    (void)state;
    enum { MANY = 64, POINTS = 64 };
    ps_frequencies grid = test_make_grid(2, 16);
    pspec_pattern patterns[MANY];
    double sum = 0;
    for (size_t r = 0; r < MANY; r++) {
        patterns[r] = test_make_pattern(&test_shapes[TEST_WHITE], 2, POINTS, 1000 + r);
    }
    double *found =
        test_run_engine_to(&ps_torus_nufft, PS_SINGLE, 1e-4, device, &grid, patterns, MANY, MANY);
    for (size_t i = 0; i < MANY * grid.num; i++) {
        sum += found[i] / POINTS / (double)(MANY * grid.num);
    }
    const double deviation = 1 / sqrt((double)(MANY * grid.num));
    assert_true(fabs(sum - 1) < 4 * deviation);
    for (size_t r = 0; r < MANY; r++) {
        test_free_pattern(&patterns[r]);
    }
    free(found);
    ps_frequencies_free(&grid);
}

/* |S| of every frequency as expected, up to the tolerance. */
static void check_sizes(const ps_frequencies *grid, const pspec_pattern *pattern,
                        ps_precision precision, const double *expected) {
    const double tolerance = tolerance_of(precision);
    const double allowed = single_frequency * tolerance * sqrt(test_sum_of_squares(pattern));
    double *found =
        test_run_engine_to(&ps_torus_nufft, precision, tolerance, device, grid, pattern, 1, 1);
    for (size_t i = 0; i < grid->num; i++) {
        const double size = sqrt(expected[i]);
        assert_true(fabs(sqrt(found[i]) - size) <= allowed * fmax(1, size / 8));
    }
    free(found);
}

/* Wherever it is. */
static void one_point(void **state) {
    (void)state;
    for (unsigned dimension = 1; dimension <= 3; dimension++) {
        ps_frequencies grid = test_make_grid(dimension, reach[dimension]);
        double *ones = malloc(grid.num * sizeof(double));
        for (size_t i = 0; i < grid.num; i++) {
            ones[i] = 1;
        }
        for (size_t p = 0; p < num_precisions(); p++) {
            for (size_t s = 0; s < TEST_SIGNED_WEIGHTS; s++) {
                pspec_pattern one = test_make_pattern(&test_shapes[s], dimension, 1, 5);
                check_sizes(&grid, &one, precisions[p], ones);
                test_free_pattern(&one);
            }
        }
        free(ones);
        ps_frequencies_free(&grid);
    }
}

static void shifts(void **state) {
    (void)state;
    enum { POINTS = 77 };
    static const double by[] = {0.25, 0.6180339887498949, 0.9999999};
    for (unsigned dimension = 1; dimension <= 3; dimension++) {
        ps_frequencies grid = test_make_grid(dimension, reach[dimension]);
        pspec_pattern pattern = test_make_pattern(&test_shapes[TEST_WHITE], dimension, POINTS, 3);
        double *points = (double *)pattern.points;
        double *before = test_run_engine(&ps_host_direct, PS_EXTENDED, NULL, &grid, &pattern, 1, 1);
        for (size_t i = 0; i < POINTS * dimension; i++) {
            points[i] = fmod(points[i] + by[i % dimension], 1);
        }
        for (size_t p = 0; p < num_precisions(); p++) {
            check_sizes(&grid, &pattern, precisions[p], before);
        }
        free(before);
        test_free_pattern(&pattern);
        ps_frequencies_free(&grid);
    }
}

/* N^2 at the Bragg peaks of the square lattice, nothing between them. */
static void peaks(void **state) {
    (void)state;
    enum { SIDE = 6, POINTS = SIDE * SIDE, K = 20 };
    ps_frequencies grid = test_make_grid(2, K);
    double points[2 * POINTS];
    double *expected = calloc(grid.num, sizeof(double));
    for (size_t j = 0; j < POINTS; j++) {
        points[2 * j] = fmod((double)(j / SIDE) / SIDE + 0.0123, 1);
        points[2 * j + 1] = fmod((double)(j % SIDE) / SIDE + 0.4567, 1);
    }
    for (size_t i = 0; i < grid.num; i++) {
        const int32_t *k = grid.vectors + 2 * i;
        expected[i] = k[0] % SIDE == 0 && k[1] % SIDE == 0 ? (double)POINTS * POINTS : 0;
    }
    const pspec_pattern lattice = {2, POINTS, points, NULL};
    for (size_t p = 0; p < num_precisions(); p++) {
        check_sizes(&grid, &lattice, precisions[p], expected);
    }
    free(expected);
    ps_frequencies_free(&grid);
}

/* A million points in one cell, against the referee; by formula and measured power. */
static void a_million_in_a_cell(void **state) {
    (void)state;
    enum { POINTS = 1000000 };
    const test_shape *shape = &test_shapes[4];
    assert_string_equal(shape->name, "one cell");
    for (unsigned dimension = 1; dimension <= 2; dimension++) {
        ps_frequencies grid = test_make_grid(dimension, 3 - (int32_t)dimension);
        pspec_pattern pattern = test_make_pattern(shape, dimension, POINTS, 3);
        double *expected =
            test_run_engine(&ps_host_direct, PS_EXTENDED, NULL, &grid, &pattern, 1, 1);
        for (size_t p = 0; p < num_precisions(); p++) {
            const double tolerance = tolerance_of(precisions[p]);
            const ps_problem problem = {
                .frequencies = &grid, .num_points = POINTS, .tolerance = tolerance};
            double *found = test_run_engine_to(&ps_torus_nufft, precisions[p], tolerance, device,
                                               &grid, &pattern, 1, 1);
            double error = 0;
            double power = 0;
            for (size_t i = 0; i < grid.num; i++) {
                error += pow(sqrt(found[i]) - sqrt(expected[i]), 2) / (double)grid.num;
                power += expected[i] / POINTS / (double)grid.num;
            }
            error = sqrt(2 * error / POINTS);
            const double formula =
                test_engine_error(&ps_torus_nufft, &problem, precisions[p], device, power);
            print_message("a million in a cell, %s d=%u: error %.2e bound %.2e\n",
                          ps_precision_name(precisions[p]), dimension, error, formula);
            assert_true(error <= formula);
            free(found);
        }
        free(expected);
        test_free_pattern(&pattern);
        ps_frequencies_free(&grid);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(white_noise),
        cmocka_unit_test(one_point),
        cmocka_unit_test(shifts),
        cmocka_unit_test(peaks),
        cmocka_unit_test(a_million_in_a_cell),
        cmocka_unit_test(work_groups),
        cmocka_unit_test(lines),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("torus_nufft", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
