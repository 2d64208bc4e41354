/* Local memory is part of what torus_nufft can do: whatever the device, no layout is offered whose
 * launches need more than it has, and what is offered runs.
 */
#include "harness.h"
#include "harness_plan.h"

#include "engines/torus/nufft/choice.h"
#include "engines/torus/nufft/layout.h"
#include "engines/torus/nufft/local.h"
#include "engines/engine.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>
#include <stdlib.h>

static ps_device *device;

/* ---- plans --------------------------------------------------------------------------------- */

/* What kernels/nufft/boxes.cl takes, written down once more. */
static uint64_t bytes_of_boxes(const ps_nufft_layout *layout) {
    const uint64_t chunk = 16;
    const unsigned axes = layout->choice.num_axes;
    uint64_t cells = 1;
    uint64_t windows = axes == 3 ? 4 : 5;
    for (unsigned i = 0; i < axes; i++) {
        const ps_nufft_axis *axis = &layout->choice.axes[i];
        const uint64_t behind = i + 1 == axes ? ps_nufft_bins(axis) : axis->window.width - 1;
        const uint64_t num = layout->boxes.num[i + 3 - axes];
        cells *= (axis->n + num - 1) / num + behind;
        windows += ps_nufft_bins(axis);
    }
    return (cells + chunk * windows) * layout->real_bytes + chunk * sizeof(uint32_t);
}

/* The lines that a pass of the grid of GPUs has at once, whose axes may be cut in halves: first the
 * real parts go through local memory, then the imaginary ones. */
static uint64_t bytes_of_passes(const ps_nufft_layout *layout) {
    uint64_t most = 0;
    for (unsigned i = 0; i < layout->grid.num_passes; i++) {
        const ps_nufft_pass *pass = &layout->grid.passes[i];
        const uint64_t numbers = (uint64_t)pass->lines_at_once * pass->length;
        most = numbers > most ? numbers : most;
    }
    return most * layout->real_bytes;
}

/* A row of lanes of the longest axis, which every transform of it takes. */
static uint64_t bytes_of_rows(const ps_nufft_layout *layout) {
    unsigned num = 0;
    const ps_nufft_axis *axes = ps_nufft_last_axes(&layout->choice, &num);
    uint64_t longest = layout->choice.variant->is_gridded ? layout->choice.axes[0].n : 0;
    for (unsigned i = 0; i < num; i++) {
        longest = axes[i].n > longest ? axes[i].n : longest;
    }
    return longest * 2 * layout->lanes * layout->real_bytes;
}

/* 1 where the layout was offered, else 0. */
static int check_layout(const ps_problem *problem, const ps_device_limits *limits,
                        ps_precision precision) {
    const bool is_refused = ps_torus_nufft.survey(problem, limits, precision).why_not != NULL;
    if (is_refused) {
        return 0;
    }
    const ps_nufft_layout layout = ps_nufft_layout_make(problem, limits, precision);
    const ps_nufft_variant *const variant = layout.choice.variant;
    assert_true(variant->local_bytes(&layout) <= limits->local_bytes);
    if (layout.grid.num_passes > 0) {
        assert_true(bytes_of_passes(&layout) <= variant->local_bytes(&layout));
    } else if (variant != &ps_nufft_whole && variant != &ps_nufft_strips) {
        /* their transforms are in global memory */
        assert_true(bytes_of_rows(&layout) <= variant->local_bytes(&layout));
    }
    if (variant == &ps_nufft_large) {
        assert_true(bytes_of_boxes(&layout) <= variant->local_bytes(&layout));
    }
    return 1;
}

static size_t pick(uint64_t *state, size_t num) {
    return (size_t)(test_uniform(state) * (double)num);
}

/* A device with 32 KiB, which OpenCL promises, to a megabyte. */
static ps_device_limits any_device(uint64_t *state) {
    ps_device_limits limits = pick(state, 3) == 0 ? test_gpu(true) : test_cpu();
    if (limits.is_cpu) {
        limits.native_double_lanes = 2u << pick(state, 3);
        limits.native_float_lanes = 2 * limits.native_double_lanes;
    }
    limits.local_bytes = ((uint64_t)32 << 10) << pick(state, 6);
    limits.local_bytes += pick(state, 2) * limits.local_bytes / 2;
    limits.max_allocation_bytes = (uint64_t)1 << 40;
    return limits;
}

static void no_layout_takes_more_than_there_is(void **state) {
    (void)state;
    enum { PROBLEMS = 120, LEAST_OFFERED = 40 };
    static const double most_frequencies[] = {1e5, 16000, 500};
    static const double tolerances[] = {1e-2, 1e-4, 1e-6, 1e-9, 1e-12};
    uint64_t random = 7;
    int offered = 0;
    for (int i = 0; i < PROBLEMS; i++) {
        const unsigned dimension = 1 + (unsigned)pick(&random, 3);
        const double most = most_frequencies[dimension - 1];
        ps_frequencies grid = test_lattice(dimension, (int32_t)pow(most, test_uniform(&random)));
        ps_problem problem = test_problem(&grid, (uint64_t)pow(1e9, test_uniform(&random)),
                                          tolerances[pick(&random, 5)]);
        problem.num_realizations = 1 + pick(&random, 100);
        const ps_device_limits limits = any_device(&random);
        offered += check_layout(&problem, &limits, pick(&random, 2) == 0 ? PS_SINGLE : PS_DOUBLE);
        ps_frequencies_free(&grid);
    }
    print_message("%d of %d problems have a layout\n", offered, PROBLEMS);
    assert_true(offered > LEAST_OFFERED);
}

/* Two million points at the largest frequency of a plain question. */
static void two_million_points(void **state) {
    (void)state;
    ps_device_limits limits = test_cpu();
    ps_frequencies grid = test_lattice(2, 7072);
    ps_problem problem = test_problem(&grid, 2000000, 1e-6);
    problem.num_realizations = 1;
    limits.local_bytes = 512 << 10;
    assert_int_equal(check_layout(&problem, &limits, PS_DOUBLE), 1);
    assert_int_equal(check_layout(&problem, &limits, PS_SINGLE), 1);
    ps_frequencies_free(&grid);
}

/* ---- runs ---------------------------------------------------------------------------------- */

typedef struct local_case {
    unsigned dimension;
    int32_t k;
    ps_precision precision;
    double tolerance;
    uint64_t planned_points; /* millions choose a grid */
} local_case;

static const local_case cases[] = {
    {1, 900, PS_DOUBLE, 1e-9, 0},       {2, 241, PS_SINGLE, 1e-6, 0},
    {2, 241, PS_SINGLE, 1e-6, 5000000}, {2, 241, PS_DOUBLE, 1e-9, 5000000},
    {3, 20, PS_DOUBLE, 1e-9, 0},        {3, 20, PS_DOUBLE, 1e-9, 5000000},
    {2, 9, PS_DOUBLE, 1e-6, 20000},
};

static double error_of(const double *found, const double *expected, size_t num, size_t num_points) {
    double sum = 0;
    for (size_t i = 0; i < num; i++) {
        sum += pow(sqrt(found[i]) - sqrt(expected[i]), 2);
    }
    return sqrt(sum / (double)num / (double)num_points);
}

/* Returns the numbers of a box, of a large set. */
static size_t run_with(const ps_problem *problem, ps_precision precision,
                       const pspec_pattern *pattern, const double *expected, uint64_t bytes) {
    ps_device_set_local_bytes(device, bytes);
    const ps_device_limits *limits = ps_device_get_limits(device);
    size_t reals = 0;
    if (check_layout(problem, limits, precision) == 1) {
        double *found =
            test_run_problem(&ps_torus_nufft, problem, precision, device, pattern, 1, 1);
        assert_true(error_of(found, expected, problem->frequencies->num, pattern->num_points) <=
                    problem->tolerance);
        const ps_nufft_layout layout = ps_nufft_layout_make(problem, limits, precision);
        const bool is_large = layout.choice.variant == &ps_nufft_large;
        reals = is_large ? ps_nufft_boxes_reals(&layout.boxes) : 0;
        free(found);
    }
    ps_device_set_local_bytes(device, 0);
    return reals;
}

/* Made for a device that has less and less, every layout runs within its tolerance. Returns whether
 * boxes became smaller. */
static bool run_case(const local_case *what) {
    enum { POINTS = 2000 };
    ps_frequencies grid = {0};
    double *points = calloc((size_t)POINTS * what->dimension, sizeof *points);
    uint64_t random = 3;
    size_t fewest = SIZE_MAX;
    size_t most = 0;
    for (size_t i = 0; i < (size_t)POINTS * what->dimension; i++) {
        points[i] = test_uniform(&random);
    }
    const pspec_pattern pattern = {what->dimension, POINTS, points, NULL};
    assert_ok(ps_frequencies_lattice(&grid, what->dimension, what->k, false, error));
    assert_ok(ps_frequencies_enumerate(&grid, error));
    const ps_problem problem = {.frequencies = &grid,
                                .num_points = POINTS,
                                .num_realizations = 1,
                                .tolerance = what->tolerance,
                                .planned_points = what->planned_points};
    double *expected = test_run_engine(&ps_torus_direct, PS_DOUBLE, device, &grid, &pattern, 1, 1);
    for (uint64_t bytes = 256 << 10; bytes >= 8 << 10; bytes /= 2) {
        const size_t reals = run_with(&problem, what->precision, &pattern, expected, bytes);
        fewest = reals > 0 && reals < fewest ? reals : fewest;
        most = reals > most ? reals : most;
    }
    free(expected);
    free(points);
    ps_frequencies_free(&grid);
    return fewest < most;
}

static void what_is_planned_runs(void **state) {
    (void)state;
    bool has_smaller = false;
    if (!ps_device_get_limits(device)->has_fp64) {
        skip();
    }
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        has_smaller = run_case(&cases[i]) || has_smaller;
    }
    assert_true(has_smaller);
}

/* Every engine, on the torus and on the sphere, with the 32 KiB that OpenCL promises. */
static void engines_run_with_the_least(void **state) {
    (void)state;
    enum { POINTS = 300, LARGEST = 40 };
    double points[3 * POINTS], places[2 * POINTS];
    uint64_t random = 5;
    for (size_t j = 0; j < POINTS; j++) {
        const double z = 2 * test_uniform(&random) - 1;
        const double angle = 6 * test_uniform(&random);
        points[3 * j] = sqrt(1 - z * z) * cos(angle);
        points[3 * j + 1] = sqrt(1 - z * z) * sin(angle);
        points[3 * j + 2] = z;
        places[2 * j] = test_uniform(&random);
        places[2 * j + 1] = test_uniform(&random);
    }
    ps_frequencies degrees = {0};
    ps_frequencies grid = {0};
    assert_ok(ps_frequencies_degrees(&degrees, LARGEST, false, error));
    assert_ok(ps_frequencies_enumerate(&degrees, error));
    assert_ok(ps_frequencies_lattice(&grid, 2, LARGEST, false, error));
    assert_ok(ps_frequencies_enumerate(&grid, error));
    ps_device_set_local_bytes(device, 32 << 10);
    for (size_t e = 0; ps_engines[e] != NULL; e++) {
        const bool is_sphere = (ps_engines[e]->domains & PS_ON_SPHERE) != 0;
        const ps_problem problem = {.frequencies = is_sphere ? &degrees : &grid,
                                    .num_points = POINTS,
                                    .num_realizations = 1,
                                    .measure = is_sphere ? PS_OF_PAIR_SUMS : PS_OF_AMPLITUDES,
                                    .tolerance = 1e-4};
        const pspec_pattern pattern = {is_sphere ? 3 : 2, POINTS, is_sphere ? points : places,
                                       NULL};
        if (ps_engines[e]->needs_device &&
            ps_engines[e]->survey(&problem, ps_device_get_limits(device), PS_SINGLE).why_not ==
                NULL) {
            free(test_run_problem(ps_engines[e], &problem, PS_SINGLE, device, &pattern, 1, 1));
        }
    }
    ps_device_set_local_bytes(device, 0);
    ps_frequencies_free(&degrees);
    ps_frequencies_free(&grid);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_layout_takes_more_than_there_is),
        cmocka_unit_test(two_million_points),
        cmocka_unit_test(what_is_planned_runs),
        cmocka_unit_test(engines_run_with_the_least),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("nufft_local", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
