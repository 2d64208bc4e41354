/* Realizations that torus_nufft does by one work-group each, whole or in strips, against direct
 * sums in extended precision: sets of every kind. (tests/engines/test_engine_contract.c has what
 * all engines promise.)
 */
#include "harness_shapes.h"

#include "engines/host/host_direct.h"
#include "engines/nufft/choose.h"
#include "engines/nufft/sizes/whole.h"
#include "engines/torus/nufft/torus_nufft.h"

#include <math.h>
#include <stdlib.h>

static ps_device *device;

typedef struct whole_case {
    unsigned dimension;
    int32_t k;
    ps_precision precision;
    double tolerance;
    size_t planned_points; /* many, so that it goes this way */
    ps_nufft_way way;
} whole_case;

/* K at and beside whole vectors; grids of one vector of columns and more; strips, of which the last
 * vector of frequencies has one, and all. */
static const whole_case cases[] = {
    {1, 1, PS_SINGLE, 1e-4, 400, PS_NUFFT_WHOLE},
    {1, 37, PS_SINGLE, 1e-6, 500, PS_NUFFT_WHOLE},
    {1, 1000, PS_SINGLE, 1e-3, 3000, PS_NUFFT_WHOLE},
    {1, 37, PS_DOUBLE, 1e-12, 500, PS_NUFFT_WHOLE},
    {1, 800, PS_DOUBLE, 1e-9, 900, PS_NUFFT_WHOLE},
    {2, 5, PS_SINGLE, 1e-3, 1000, PS_NUFFT_WHOLE},
    {2, 15, PS_SINGLE, 1e-6, 4000, PS_NUFFT_WHOLE},
    {2, 16, PS_SINGLE, 1e-5, 4000, PS_NUFFT_WHOLE},
    {2, 33, PS_SINGLE, 1e-2, 9000, PS_NUFFT_WHOLE},
    {2, 63, PS_DOUBLE, 1e-9, 20000, PS_NUFFT_WHOLE},
    {2, 20, PS_DOUBLE, 1e-6, 4000, PS_NUFFT_WHOLE},
    {2, 160, PS_SINGLE, 1e-6, 20000, PS_NUFFT_STRIPS},
    {2, 159, PS_SINGLE, 1e-6, 20000, PS_NUFFT_STRIPS},
    {2, 135, PS_DOUBLE, 1e-9, 20000, PS_NUFFT_STRIPS},
};

enum { NUM_CASES = sizeof cases / sizeof cases[0] };

static ps_problem problem_of(const whole_case *what, const ps_frequencies *grid) {
    return (ps_problem){.frequencies = grid,
                        .num_points = what->planned_points,
                        .num_realizations = 100,
                        .has_weights = true,
                        .tolerance = what->tolerance};
}

static bool can_run(const whole_case *what) {
    return what->precision == PS_SINGLE || ps_device_get_limits(device)->has_fp64;
}

static double error_of(const double *found, const double *expected, const ps_frequencies *grid,
                       const pspec_pattern *pattern, double *power) {
    double sum = 0;
    const double squares = test_sum_of_squares(pattern);
    *power = 0;
    for (size_t i = 0; i < grid->num; i++) {
        sum += pow(sqrt(found[i]) - sqrt(expected[i]), 2) / (double)grid->num;
        *power += expected[i] / squares / (double)grid->num;
    }
    return sqrt(2 * sum / squares);
}

static void check_shape(const whole_case *what, const test_shape *shape, size_t num_points) {
    ps_frequencies grid = test_make_grid(what->dimension, what->k);
    pspec_pattern pattern = test_make_pattern(shape, what->dimension, num_points, 5);
    const ps_problem problem = problem_of(what, &grid);
    const ps_device_limits *limits = ps_device_get_limits(device);
    double power = 0;
    const ps_nufft_choice choice = ps_nufft_choose(&problem, limits, what->precision);
    if (ps_nufft_way_of(&choice) != what->way) {
        fail_msg("d=%u K=%d goes way %d", what->dimension, (int)what->k,
                 (int)ps_nufft_way_of(&choice));
    }
    double *found =
        test_run_problem(&ps_torus_nufft, &problem, what->precision, device, &pattern, 1, 1);
    double *expected = test_run_engine(&ps_host_direct, PS_EXTENDED, NULL, &grid, &pattern, 1, 1);
    const double error = error_of(found, expected, &grid, &pattern, &power);
    const double bound =
        test_engine_error(&ps_torus_nufft, &problem, what->precision, device, power);
    if (!(error <= bound)) {
        print_message("d=%u K=%d N=%zu %s %s: error %.1e, bound %.1e\n", what->dimension,
                      (int)what->k, num_points, ps_precision_name(what->precision), shape->name,
                      error, bound);
    }
    assert_true(error <= bound);
    free(found);
    free(expected);
    test_free_pattern(&pattern);
    ps_frequencies_free(&grid);
}

static void agrees_with_direct_sums(void **state) {
    (void)state;
    for (size_t i = 0; i < NUM_CASES; i++) {
        for (size_t s = 0; s < TEST_SHAPES && can_run(&cases[i]); s++) {
            const size_t num_points =
                cases[i].way == PS_NUFFT_STRIPS ? 40 : 300; /* many frequencies */
            check_shape(&cases[i], &test_shapes[s], num_points);
        }
    }
}

/* In one dimension the grid is the product of the lengths, both transforms keep less than they
 * have, and every frequency has a place of its own. */
static void lengths_of_lines(void **state) {
    (void)state;
    for (int32_t k = 1; k < 3000; k += 1 + k / 3) {
        ps_frequencies grid = test_make_grid(1, k);
        const ps_problem problem = {.frequencies = &grid, .num_points = 2000, .tolerance = 1e-4};
        const ps_nufft_choice choice = ps_nufft_choose(&problem, NULL, PS_SINGLE);
        uint32_t kept[2];
        assert_true(choice.is_whole);
        ps_nufft_whole_kept(&choice, kept);
        assert_int_equal(choice.lengths[0] * choice.lengths[1], choice.axes[0].n);
        assert_true(2 * kept[0] <= choice.lengths[0] && 2 * kept[1] + 1 <= choice.lengths[1]);
        assert_true(choice.lengths[0] * kept[1] >= (uint32_t)k);
        ps_frequencies_free(&grid);
    }
}

/* Not where local memory is apart, as on GPUs: there the engine goes another way. */
static void only_with_caches(void **state) {
    (void)state;
    ps_device_limits limits = *ps_device_get_limits(device);
    ps_frequencies grid = test_make_grid(2, 16);
    const ps_problem problem = {.frequencies = &grid, .num_points = 4000, .tolerance = 1e-4};
    limits.has_dedicated_local_memory = true;
    assert_false(ps_nufft_choose(&problem, &limits, PS_SINGLE).is_whole);
    ps_frequencies_free(&grid);
}

static ps_nufft_way way_for(const ps_frequencies *grid, size_t num_points,
                            uint64_t num_realizations) {
    const ps_problem problem = {.frequencies = grid,
                                .num_points = num_points,
                                .num_realizations = num_realizations,
                                .tolerance = 1e-6};
    const ps_nufft_choice choice =
        ps_nufft_choose(&problem, ps_device_get_limits(device), PS_SINGLE);
    return ps_nufft_way_of(&choice);
}

/* A set alone in strips would have one core; files may have any number of sets. Where the tiles of
 * one set are more than a buffer may have, the engine has another way, and is not refused. */
static void only_where_strips_pay(void **state) {
    (void)state;
    ps_frequencies grid = test_make_grid(2, 160);
    assert_int_equal(way_for(&grid, 20000, 0), PS_NUFFT_STRIPS);
    assert_int_equal(way_for(&grid, 20000, 2), PS_NUFFT_STRIPS);
    assert_int_not_equal(way_for(&grid, 20000, 1), PS_NUFFT_STRIPS);
    ps_frequencies_free(&grid);
    assert_ok(ps_frequencies_lattice(&grid, 2, 4096, false, error));
    const ps_problem problem = {
        .frequencies = &grid, .num_points = 65536, .num_realizations = 100, .tolerance = 1e-6};
    assert_int_not_equal(way_for(&grid, 65536, 100), PS_NUFFT_STRIPS);
    assert_null(ps_torus_nufft.survey(&problem, ps_device_get_limits(device), PS_SINGLE).why_not);
    ps_frequencies_free(&grid);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lengths_of_lines),
        cmocka_unit_test(only_with_caches),
        cmocka_unit_test(only_where_strips_pay),
        cmocka_unit_test(agrees_with_direct_sums),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("nufft_whole", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
