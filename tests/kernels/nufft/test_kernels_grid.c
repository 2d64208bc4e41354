/* The grid of GPUs (host/engines/torus/nufft/grid/), on a device that is taken for one: against
 * torus_direct in double precision, on the first grid of every kind: axes, precisions, boxes,
 * radices, lines in one piece and in two halves, sums in pairs, sets in chunks. */
#include "harness_shapes.h"

#include "engines/torus/nufft/layout.h"
#include "engines/engine.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;

typedef struct grid_case {
    unsigned dimension;
    int32_t K;
    ps_precision precision;
    double tolerance;
    size_t num_points, planned_points, chunk; /* chunk 0: all points of a set */
    uint64_t local_kib, items, other_items;   /* of a work-group, together and alone */
    const char *says;
} grid_case;

enum { SETS = 3 };

/* Lines of 4096 and more numbers go in two halves through 16 KiB; a plan of millions of points
 * has pairs. */
static const grid_case cases[] = {
    {1, 37, PS_SINGLE, 1e-6, 60, 0, 0, 48, 0, 64, "passes=1"},
    {1, 5000, PS_SINGLE, 1e-6, 200, 0, 0, 16, 64, 64, "passes=2"},
    {1, 1000, PS_DOUBLE, 1e-9, 200, 1000000, 0, 48, 256, 256, "passes=1"},
    {2, 9, PS_SINGLE, 1e-6, 60, 0, 0, 48, 64, 64, "boxes=1x16x16 copies=1"},
    {2, 130, PS_SINGLE, 1e-6, 2000, 300000, 0, 48, 128, 128, "boxes=1x32x32 copies=4"},
    {2, 33, PS_SINGLE, 1e-5, 2000, 5000000, 0, 32, 256, 512, "copies=4"},
    {2, 21, PS_DOUBLE, 1e-12, 300, 0, 0, 48, 32, 32, "boxes=1x32x32"},
    {3, 4, PS_SINGLE, 1e-5, 100, 0, 0, 48, 64, 64, "boxes=8x16x16"},
    {3, 7, PS_DOUBLE, 1e-9, 500, 0, 0, 32, 64, 64, "boxes=4x4x4"},
    {3, 6, PS_SINGLE, 3e-6, 900, 5000000, 0, 48, 512, 96, "copies=1"},
    {2, 12, PS_SINGLE, 1e-5, 200, 20000000, 32, 48, 64, 64, "passes=2"},
    {1, 90, PS_DOUBLE, 1e-9, 100, 20000000, 16, 48, 64, 64, "passes=1"},
};

static ps_problem make_problem(const grid_case *what, const ps_frequencies *grid) {
    return (ps_problem){.frequencies = grid,
                        .num_points = what->chunk > 0 ? what->chunk : what->num_points,
                        .planned_points = what->planned_points,
                        .num_realizations = SETS,
                        .has_weights = true,
                        .tolerance = what->tolerance};
}

static void begin_gpu(const grid_case *what) {
    ps_device_set_dedicated_local_memory(device, true);
    ps_device_set_local_bytes(device, what->local_kib << 10);
    ps_device_set_group_size(device, what->items);
}

static void end_gpu(void) {
    ps_device_set_group_size(device, 0);
    ps_device_set_local_bytes(device, 0);
    ps_device_set_dedicated_local_memory(device, false);
}

static void check_choice(const grid_case *what, const ps_problem *problem) {
    const ps_nufft_layout layout =
        ps_nufft_layout_make(problem, ps_device_get_limits(device), what->precision);
    ps_text text = {0};
    assert_ptr_equal(layout.choice.variant,
                     what->chunk > 0 ? &ps_nufft_grid_chunks : &ps_nufft_grid);
    assert_true(layout.lanes > 0);
    layout.choice.variant->describe(&layout, &text);
    print_message("d=%u K=%d n=%u:%s\n", what->dimension, (int)what->K, layout.choice.axes[0].n,
                  ps_text_string(&text));
    assert_true(strstr(ps_text_string(&text), what->says) != NULL ||
                ps_device_is_simulator(ps_device_get_limits(device))); /* it has 32 KiB */
    ps_text_free(&text);
}

static void check_errors(const grid_case *what, const ps_problem *problem,
                         const pspec_pattern *sets, const double *found, const double *expected) {
    const size_t num = problem->frequencies->num;
    for (size_t r = 0; r < SETS; r++) {
        double sum = 0;
        for (size_t i = r * num; i < (r + 1) * num; i++) {
            sum += pow(sqrt(found[i]) - sqrt(expected[i]), 2) / (double)num;
        }
        const double measured = sqrt(2 * sum / test_sum_of_squares(&sets[r]));
        print_message("    N=%zu: %.1e of %.1e\n", sets[r].num_points, measured, what->tolerance);
        assert_true(measured <= what->tolerance);
    }
}

static void check_case(const grid_case *what) {
    static const size_t shapes[SETS] = {TEST_WHITE, TEST_SIGNED_WEIGHTS, TEST_WHITE};
    ps_frequencies grid = test_make_grid(what->dimension, what->K);
    const ps_problem problem = make_problem(what, &grid);
    pspec_pattern sets[SETS];
    for (size_t r = 0; r < SETS; r++) {
        sets[r] =
            test_make_pattern(&test_shapes[shapes[r]], what->dimension, what->num_points >> r, r);
    }
    double *expected = test_run_engine(&ps_torus_direct, PS_DOUBLE, device, &grid, sets, SETS, 1);
    begin_gpu(what);
    check_choice(what, &problem);
    double *found =
        test_run_problem(&ps_torus_nufft, &problem, what->precision, device, sets, SETS, SETS);
    ps_device_set_group_size(device, what->other_items);
    double *again =
        test_run_problem(&ps_torus_nufft, &problem, what->precision, device, sets, SETS, 1);
    end_gpu();
    check_errors(what, &problem, sets, found, expected);
    assert_memory_equal(again, found, SETS * grid.num * sizeof(double));
    for (size_t r = 0; r < SETS; r++) {
        test_free_pattern(&sets[r]);
    }
    free(expected);
    free(found);
    free(again);
    ps_frequencies_free(&grid);
}

static void agrees_with_direct_sums(void **state) {
    (void)state;
    const ps_device_limits *const limits = ps_device_get_limits(device);
    const size_t most_points = ps_device_is_simulator(limits) ? 100 : SIZE_MAX; /* it is slow */
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        if ((cases[i].precision == PS_SINGLE || limits->has_fp64) &&
            cases[i].num_points <= most_points) {
            check_case(&cases[i]);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agrees_with_direct_sums),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernels_grid", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
