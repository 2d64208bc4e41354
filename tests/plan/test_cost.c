/* What plans take: memory, its limits, time. Planning is a pure function: no device is opened here.
 */
#include "harness_plan.h"

#include "engines/torus/nufft/choice.h"
#include "engines/torus/nufft/cost.h"
#include "engines/engine.h"
#include "plan/cost_model.h"

#include <math.h>
#include <string.h>

/* ---- memory -------------------------------------------------------------------------------- */

/* Of a large grid by direct sums, on a device where something is only a megabyte. */
static void plan_on_small_device(ps_plan *plan, uint64_t global_bytes, uint64_t allocation_bytes) {
    const ps_frequencies set = test_lattice(2, 500);
    const ps_problem problem = test_problem(&set, 10000, 1e-3);
    ps_device_limits limits = test_cpu();
    limits.is_cpu = false; /* memory of its own */
    limits.global_bytes = global_bytes > 0 ? global_bytes : limits.global_bytes;
    limits.max_allocation_bytes =
        allocation_bytes > 0 ? allocation_bytes : limits.max_allocation_bytes;
    test_make_plan(plan, &problem, &limits, &test_any_plan);
}

static void device_limits(void **state) {
    (void)state;
    ps_plan plan;
    plan_on_small_device(&plan, 1 << 20, 0);
    const ps_candidate *candidate = test_candidate(&plan, "torus_direct", PS_SINGLE);
    assert_true(candidate->is_applicable && !candidate->is_feasible);
    assert_int_equal(candidate->batch, 1);
    assert_non_null(strstr(candidate->reason, "above its limit of 1.05e+06"));
    assert_string_equal(plan.chosen->engine->name, "host_direct"); /* the host is not so small */
    plan_on_small_device(&plan, 0, 1 << 20);
    candidate = test_candidate(&plan, "torus_direct", PS_SINGLE);
    assert_false(candidate->is_applicable);
    assert_non_null(strstr(candidate->reason, "larger buffer"));
}

static void limit_of_the_user(void **state) {
    (void)state;
    const ps_frequencies set = test_lattice(2, 500);
    const ps_problem problem = test_problem(&set, 10000, 1e-3);
    const ps_device_limits limits = test_cpu();
    const ps_plan_constraints limited = {.precision = -1, .memory_limit = 1000};
    ps_plan plan;
    test_make_plan(&plan, &problem, &limits, &limited);
    assert_null(plan.chosen);
    for (size_t i = 0; i < plan.num_candidates; i++) {
        assert_non_null(strstr(plan.candidates[i].reason, "above the limit of 1e+03"));
    }
    ps_error said = {0};
    assert_int_equal(ps_plan_require(&plan, &problem, &said), PSPEC_ERROR_MEMORY);
    assert_non_null(strstr(said.message, "above the limit of 1e+03"));
}

/* A batch fits into the budget of the device, and is 1 at least. */
static void batches(void **state) {
    (void)state;
    ps_work work = {.bytes_per_realization = 1e6, .largest_buffer_per_realization = 1e5};
    ps_device_limits limits = test_cpu();
    limits.cache_bytes = 1000; /* half of the typical 32 MiB of cache, whatever this device has */
    assert_int_equal(ps_cost_batch(&work, &limits, 1000), 16);
    assert_int_equal(ps_cost_batch(&work, &limits, 5), 5);
    assert_int_equal(ps_cost_batch(&work, &limits, 0), 16);
    assert_int_equal(ps_cost_batch(&work, NULL, 1000), 1);
    limits.max_allocation_bytes = 300000;
    assert_int_equal(ps_cost_batch(&work, &limits, 1000), 3);
    limits.max_allocation_bytes = 1;
    assert_int_equal(ps_cost_batch(&work, &limits, 1000), 1);
    limits = test_cpu();
    work.fixed_bytes = 1e12; /* more than there is */
    assert_int_equal(ps_cost_batch(&work, &limits, 1000), 1);
}

/* ---- cost ---------------------------------------------------------------------------------- */

/* More points or realizations, or twice the frequency with as many points for each of them, never
 * cost less, by any engine that applies. (With the points of the smaller grid, peaks of a lattice
 * would do less harm to the mean over the larger one, and windows could be narrower. Whole tiles
 * make estimates uneven: 2 % here, up to 20 % from one frequency to the next.) */
static void check_not_cheaper(const ps_problem *small, const ps_problem *large,
                              const ps_device_limits *limits, double slack) {
    const double rounding = 1e-15; /* a GPU that waits takes as long with one realization more */
    ps_plan plans[2];
    test_make_plan(&plans[0], small, limits, &test_any_plan);
    test_make_plan(&plans[1], large, limits, &test_any_plan);
    for (size_t i = 0; i < plans[0].num_candidates; i++) {
        const ps_candidate *a = &plans[0].candidates[i], *b = &plans[1].candidates[i];
        if (a->is_applicable && b->is_applicable &&
            !(b->seconds >= (1 - slack - rounding) * a->seconds)) {
            fail_msg("%s %s: %.17g s for d = %u K = %d N = %llu, then %.17g s", a->engine->name,
                     ps_precision_name(a->precision), a->seconds, small->frequencies->dimension,
                     (int)small->frequencies->max_frequency, (unsigned long long)small->num_points,
                     b->seconds);
        }
    }
}

static void cost_grows_with_the_problem(void **state) {
    (void)state;
    const ps_device_limits limits[] = {test_cpu(), test_gpu(true)};
    static const int32_t largest[] = {30000, 1000, 60, 12, 6, 4};
    for (size_t l = 0; l < 2; l++) {
        for (unsigned dimension = 1; dimension <= PS_MAX_DIMENSION; dimension++) {
            for (int32_t k = 1; k < largest[dimension - 1]; k += 1 + k / 8) {
                const ps_frequencies small = test_lattice(dimension, k);
                const ps_frequencies large = test_lattice(dimension, 2 * k);
                ps_problem problem = test_problem(&small, 5000, 1e-3);
                ps_problem other = problem;
                other.frequencies = &large;
                other.num_points <<= dimension;
                check_not_cheaper(&problem, &other, &limits[l], 0.05);
                other = problem;
                other.num_points += 1 + (uint64_t)k;
                check_not_cheaper(&problem, &other, &limits[l], 0);
                other = problem;
                other.num_realizations++;
                check_not_cheaper(&problem, &other, &limits[l], 0);
            }
        }
    }
}

/* ---- direct sums of the sphere --------------------------------------------------------------- */

static double harmonics_of(int32_t max_degree, uint64_t num_points, uint64_t num_realizations) {
    const ps_device_limits limits = test_cpu();
    ps_frequencies degrees = {0};
    assert_ok(ps_frequencies_degrees(&degrees, max_degree, false, error));
    ps_problem problem = test_problem(&degrees, num_points, 1e-4);
    problem.num_realizations = num_realizations;
    const double found = ps_sphere_direct.survey(&problem, &limits, PS_SINGLE).work.harmonics;
    ps_frequencies_free(&degrees);
    return found;
}

/* The kernel walks up blocks of 8 degrees, whatever there is of them, and points come to the device
 * before: few degrees cost far more than their (L + 1)(L + 2) / 2 harmonics of a point, many nearly
 * those. */
static void few_degrees_cost_whole_blocks(void **state) {
    (void)state;
    const double points = 1024;
    assert_true(harmonics_of(4, 1024, 1000) >= 1000 * points * 5 * 8);
    assert_true(harmonics_of(4, 1024, 1000) >= 1000 * points * 10 * 15);
    assert_true(harmonics_of(9, 1024, 1000) >= 1000 * points * 12 * 8);
    const double many = 1001.0 * 1002 / 2;
    assert_true(harmonics_of(1000, 1024, 1000) <= 1.2 * 1000 * points * many);
}

/* One realization of up to 16 orders is one work-item: the other core of the typical CPU waits. */
static void one_item_has_one_core(void **state) {
    (void)state;
    const double alone = harmonics_of(12, 1 << 20, 1);
    assert_true(alone > 0.6 * harmonics_of(12, 1 << 20, 2));
    assert_true(harmonics_of(12, 1 << 20, 1000) < 1000 * alone);
}

/* The table of the host is most of what few points cost at large degrees: one, and one for every
 * realization where it does not fit into memory as a whole. */
static void tables_are_counted(void **state) {
    (void)state;
    const double degrees = 32768;
    assert_true(harmonics_of(32768, 2, 1) > 100 * degrees * degrees / 2);
    assert_true(harmonics_of(32768, 2, 10) > 9 * harmonics_of(32768, 2, 1));
    assert_true(harmonics_of(500, 2, 10) < 9 * harmonics_of(500, 2, 1));
}

/* Transforms are for many points, direct sums for few, at few degrees, too. */
static void choice_at_few_degrees(void **state) {
    (void)state;
    static const struct {
        int32_t max_degree;
        uint64_t num_points;
        bool is_direct;
    } cases[] = {{4, 1024, false}, {8, 256, false}, {16, 16, true}, {256, 16, true}};
    const ps_device_limits limits = test_cpu();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_frequencies degrees = {0};
        ps_plan plan;
        assert_ok(ps_frequencies_degrees(&degrees, cases[i].max_degree, false, error));
        ps_problem problem = test_problem(&degrees, cases[i].num_points, 1e-4);
        problem.num_realizations = 1000;
        test_make_plan(&plan, &problem, &limits, &test_any_plan);
        assert_true((plan.chosen->engine == &ps_sphere_direct) == cases[i].is_direct);
        ps_frequencies_free(&degrees);
    }
}

/* ---- parts of fast transforms -------------------------------------------------------------- */

/* Adds what the choice for a device counts, which is its flops. */
static void add_counts(ps_nufft_counts *most, unsigned dimension, int32_t max_frequency,
                       uint64_t num_points, const ps_device_limits *limits) {
    const ps_frequencies set = test_lattice(dimension, max_frequency);
    const ps_problem problem = test_problem(&set, num_points, 1e-3);
    const ps_nufft_choice choice = ps_nufft_choose(&problem, limits, PS_SINGLE);
    const ps_nufft_counts counts = ps_nufft_count(&choice, PS_SINGLE, (double)num_points);
    double cycles = 0;
    for (size_t part = 0; part < PS_NUFFT_NUM_PARTS; part++) {
        most->num[part] += counts.num[part];
        cycles += counts.num[part] * ps_nufft_cycles[part];
    }
    /* two fused operations in a cycle */
    const double flops = ps_nufft_flops(&choice, PS_SINGLE, (double)num_points);
    assert_true(fabs(flops - 4 * choice.lanes * cycles) <= 1e-9 * flops);
}

/* Every part that has cycles is counted somewhere: tiles in two and three dimensions, large grids
 * without and with pairs of numbers, a whole realization on a small grid and on one beyond the
 * nearest cache, strips whose tiles are beyond caches, the grid of GPUs. What is not counted is
 * never measured either (bench/cycles.c). */
static void every_part_is_counted(void **state) {
    (void)state;
    static const struct {
        unsigned dimension;
        int32_t max_frequency;
        uint64_t num_points;
    } cases[] = {{2, 300, 64}, {3, 10, 100},   {2, 500, 20000000}, {2, 500, 2000000000},
                 {2, 8, 1024}, {2, 64, 16384}, {2, 500, 16384}};
    const ps_device_limits gpu = test_gpu(true);
    ps_nufft_counts most = {{0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        add_counts(&most, cases[i].dimension, cases[i].max_frequency, cases[i].num_points, NULL);
    }
    add_counts(&most, 2, 500, 16384, &gpu);
    for (size_t part = 0; part < PS_NUFFT_NUM_PARTS; part++) {
        if (!(most.num[part] > 0 && ps_nufft_cycles[part] > 0)) {
            fail_msg("part %zu: %g of %g cycles", part, most.num[part], ps_nufft_cycles[part]);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(device_limits),
        cmocka_unit_test(limit_of_the_user),
        cmocka_unit_test(batches),
        cmocka_unit_test(cost_grows_with_the_problem),
        cmocka_unit_test(few_degrees_cost_whole_blocks),
        cmocka_unit_test(one_item_has_one_core),
        cmocka_unit_test(tables_are_counted),
        cmocka_unit_test(choice_at_few_degrees),
        cmocka_unit_test(every_part_is_counted),
    };
    return cmocka_run_group_tests_name("cost", tests, NULL, NULL);
}
