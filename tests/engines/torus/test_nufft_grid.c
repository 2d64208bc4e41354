/* Very large sets through torus_nufft: spread on a grid of all axes, chunk by chunk, against
 * torus_direct in double precision. Plans for millions of points choose the grid; the sets of the
 * tests are smaller.
 */
#include "harness.h"

#include "engines/torus/nufft/choice.h"
#include "engines/torus/nufft/layout.h"
#include "engines/engine.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;

enum { PLANNED_POINTS = 5000000 };

typedef struct grid_case {
    unsigned dimension;
    int32_t k;
    ps_precision precision;
    double tolerance;
    size_t num_points;
    bool has_weights;
} grid_case;

/* Odd K, so that tiles are not full; sets smaller and larger than a chunk. */
static const grid_case cases[] = {
    {2, 9, PS_SINGLE, 1e-6, 70000, false},  {2, 9, PS_SINGLE, 1e-6, 5000, true},
    {2, 241, PS_SINGLE, 1e-3, 3000, false}, {2, 241, PS_SINGLE, 1e-6, 3000, true},
    {2, 230, PS_DOUBLE, 1e-9, 3000, true},  {2, 230, PS_DOUBLE, 1e-12, 1, false},
    {3, 5, PS_SINGLE, 2e-6, 9000, false},   {3, 7, PS_SINGLE, 2e-6, 500, true},
};

static pspec_pattern make_pattern(const grid_case *what, size_t num_points) {
    uint64_t state = 42 + what->num_points;
    double *points = calloc(num_points * what->dimension, sizeof(double));
    double *weights = what->has_weights ? calloc(num_points, sizeof(double)) : NULL;
    for (size_t i = 0; i < num_points * what->dimension; i++) {
        points[i] = test_uniform(&state);
    }
    points[0] = 1 - 0x1p-53; /* windows that go on at the other end, on every axis */
    points[what->dimension - 1] = 0;
    for (size_t j = 0; j < num_points && weights != NULL; j++) {
        weights[j] = 2 * test_uniform(&state) - 0.9;
    }
    return (pspec_pattern){what->dimension, num_points, points, weights};
}

static void free_pattern(const pspec_pattern *pattern) {
    free((void *)pattern->points);
    free((void *)pattern->weights);
}

static double sum_of_squares(const pspec_pattern *pattern) {
    double sum = 0;
    for (size_t j = 0; j < pattern->num_points; j++) {
        sum += pattern->weights != NULL ? pattern->weights[j] * pattern->weights[j] : 1;
    }
    return sum;
}

static double run_case(const grid_case *what, ps_frequencies *grid, double **found,
                       const pspec_pattern *pattern) {
    const ps_problem problem = {.frequencies = grid,
                                .num_points = PLANNED_POINTS,
                                .num_realizations = 1,
                                .tolerance = what->tolerance};
    assert_true(ps_nufft_choose(&problem, NULL, what->precision).variant == &ps_nufft_large);
    *found = test_run_problem(&ps_torus_nufft, &problem, what->precision, device, pattern, 1, 1);
    return test_engine_error(&ps_torus_nufft, &problem, what->precision, device, 1.2);
}

static void check_case(const grid_case *what) {
    ps_frequencies grid = {0};
    const pspec_pattern pattern = make_pattern(what, what->num_points);
    assert_ok(ps_frequencies_lattice(&grid, what->dimension, what->k, false, error));
    assert_ok(ps_frequencies_enumerate(&grid, error));
    double *found = NULL;
    const double bound = run_case(what, &grid, &found, &pattern);
    double *expected = test_run_engine(&ps_torus_direct, PS_DOUBLE, device, &grid, &pattern, 1, 1);
    double sum = 0;
    for (size_t i = 0; i < grid.num; i++) {
        sum += pow(sqrt(found[i]) - sqrt(expected[i]), 2) / (double)grid.num;
    }
    const double measured = sqrt(2 * sum / sum_of_squares(&pattern));
    print_message("d=%u K=%-3d N=%-5zu %s tolerance %.0e: error %.1e, bound %.1e\n",
                  what->dimension, (int)what->k, what->num_points,
                  ps_precision_name(what->precision), what->tolerance, measured, bound);
    assert_true(measured <= bound && measured <= what->tolerance);
    free(expected);
    free(found);
    free_pattern(&pattern);
    ps_frequencies_free(&grid);
}

static void agrees_with_direct_sums(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        if (cases[i].precision == PS_SINGLE || ps_device_get_limits(device)->has_fp64) {
            check_case(&cases[i]);
        }
    }
}

/* A realization is the same to the bit wherever it stands in a batch. */
static void batches_change_nothing(void **state) {
    (void)state;
    enum { REALIZATIONS = 3 };
    const grid_case *what = &cases[0];
    ps_frequencies grid = {0};
    pspec_pattern patterns[REALIZATIONS];
    assert_ok(ps_frequencies_lattice(&grid, what->dimension, what->k, false, error));
    assert_ok(ps_frequencies_enumerate(&grid, error));
    const ps_problem problem = {.frequencies = &grid,
                                .num_points = PLANNED_POINTS,
                                .num_realizations = REALIZATIONS,
                                .tolerance = what->tolerance};
    for (size_t r = 0; r < REALIZATIONS; r++) {
        patterns[r] = make_pattern(what, 20000 - 7000 * r);
    }
    double *together = test_run_problem(&ps_torus_nufft, &problem, what->precision, device,
                                        patterns, REALIZATIONS, REALIZATIONS);
    double *alone = test_run_problem(&ps_torus_nufft, &problem, what->precision, device, patterns,
                                     REALIZATIONS, 1);
    assert_memory_equal(together, alone, REALIZATIONS * grid.num * sizeof(double));
    for (size_t r = 0; r < REALIZATIONS; r++) {
        free_pattern(&patterns[r]);
    }
    free(together);
    free(alone);
    ps_frequencies_free(&grid);
}

/* A grid in buffers that the device allows, however small, has the bits of one in one piece. */
static void split_grids(void **state) {
    (void)state;
    static const struct {
        grid_case what;
        uint64_t limits[2];
    } splits[] = {
        {{2, 241, PS_SINGLE, 1e-6, 3000, true}, {2000000, 600000}},
        {{3, 20, PS_SINGLE, 2e-6, 3000, true}, {4300000, 3600000}},
    };
    for (size_t i = 0; i < sizeof splits / sizeof splits[0]; i++) {
        const grid_case *what = &splits[i].what;
        ps_frequencies grid = {0};
        const pspec_pattern pattern = make_pattern(what, what->num_points);
        assert_ok(ps_frequencies_lattice(&grid, what->dimension, what->k, false, error));
        assert_ok(ps_frequencies_enumerate(&grid, error));
        const ps_problem problem = {.frequencies = &grid,
                                    .num_points = what->num_points,
                                    .planned_points = PLANNED_POINTS,
                                    .num_realizations = 1,
                                    .tolerance = what->tolerance};
        double *whole =
            test_run_problem(&ps_torus_nufft, &problem, what->precision, device, &pattern, 1, 1);
        for (size_t j = 0; j < 2; j++) {
            ps_device_set_max_allocation(device, splits[i].limits[j]);
            const ps_nufft_layout layout =
                ps_nufft_layout_make(&problem, ps_device_get_limits(device), what->precision);
            print_message("d=%u K=%d: %u slabs, %u of %u tiles at a time\n", what->dimension,
                          (int)what->k, layout.num_slabs, layout.tiles_at_once, layout.num_tiles);
            assert_true(layout.choice.variant == &ps_nufft_large && layout.num_slabs > 1);
            assert_true(j == 0 || layout.tiles_at_once < layout.num_tiles);
            assert_null(
                ps_torus_nufft.survey(&problem, ps_device_get_limits(device), what->precision)
                    .why_not);
            double *split = test_run_problem(&ps_torus_nufft, &problem, what->precision, device,
                                             &pattern, 1, 1);
            assert_memory_equal(split, whole, grid.num * sizeof(double));
            ps_device_set_max_allocation(device, 0);
            free(split);
        }
        free(whole);
        free_pattern(&pattern);
        ps_frequencies_free(&grid);
    }
}

/* Memory does not grow with the points, but for finer grids: lattices of so many points have high
 * peaks. */
static void memory_does_not_grow(void **state) {
    (void)state;
    const double bytes_per_point = 2 * sizeof(double);
    ps_frequencies grid = {0};
    assert_ok(ps_frequencies_lattice(&grid, 2, 300, false, error));
    const ps_device_limits *limits = ps_device_get_limits(device);
    double first = 0;
    for (double num = 1e7; num <= 1e9; num *= 10) {
        const ps_problem problem = {.frequencies = &grid,
                                    .num_points = (uint64_t)num,
                                    .num_realizations = 1,
                                    .tolerance = 1e-3};
        const ps_survey survey = ps_torus_nufft.survey(&problem, limits, PS_SINGLE);
        const ps_work work = survey.work;
        assert_null(survey.why_not);
        assert_true(work.fixed_bytes < num * bytes_per_point);
        assert_true(first == 0 || work.fixed_bytes < 4 * first);
        first = first == 0 ? work.fixed_bytes : first;
    }
    ps_frequencies_free(&grid);
}

/* No row of a fine grid is so long: that is known without looking for lengths of transforms. */
static void largest_frequencies(void **state) {
    (void)state;
    for (unsigned dimension = 1; dimension <= 3; dimension++) {
        const ps_frequencies grid = {
            .kind = PS_FREQUENCIES_BOX, .dimension = dimension, .max_frequency = PS_MAX_FREQUENCY};
        const ps_problem problem = {.frequencies = &grid, .num_points = 1000000, .tolerance = 1e-6};
        for (int precision = PS_SINGLE; precision <= PS_DOUBLE; precision++) {
            assert_int_equal(ps_nufft_choose(&problem, NULL, (ps_precision)precision).num_axes, 0);
        }
        assert_non_null(
            ps_torus_nufft.survey(&problem, ps_device_get_limits(device), PS_SINGLE).why_not);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agrees_with_direct_sums),
        cmocka_unit_test(batches_change_nothing),
        cmocka_unit_test(split_grids),
        cmocka_unit_test(memory_does_not_grow),
        cmocka_unit_test(largest_frequencies),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("nufft_grid", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
