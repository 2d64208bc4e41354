/* What plans take: memory, its limits, time. Planning is a pure function: no device is opened here. */
#include "harness_plan.h"

#include "plan/cost_model.h"

#include <string.h>

/* ---- memory -------------------------------------------------------------------------------- */

static void memory_limits(void **state) {
    (void)state;
    const ps_frequencies set = test_lattice(2, 500);
    const ps_problem problem = test_problem(&set, 10000, 1e-3);
    ps_device_limits limits = test_cpu();
    ps_plan plan;
    limits.global_bytes = 1 << 20;
    test_make_plan(&plan, &problem, &limits, &test_any_plan);
    const ps_candidate *candidate = test_candidate(&plan, "torus_direct", PS_SINGLE);
    assert_true(candidate->is_applicable && !candidate->is_feasible);
    assert_int_equal(candidate->batch, 1);
    assert_non_null(strstr(candidate->reason, "above the limit of 1.05e+06"));
    assert_string_equal(plan.chosen->engine->name, "host_direct"); /* the host is not so small */
    const ps_plan_constraints limited = {.precision = -1, .memory_limit = 1000};
    test_make_plan(&plan, &problem, &limits, &limited);
    assert_null(plan.chosen);
    for (size_t i = 0; i < plan.num_candidates; i++) {
        assert_non_null(strstr(plan.candidates[i].reason, "above the limit of 1e+03"));
    }
    ps_error said = {0};
    assert_int_equal(ps_plan_require(&plan, &problem, &said), PSPEC_ERROR_MEMORY);
    assert_non_null(strstr(said.message, "above the limit of 1e+03"));
}

static void allocation_limits(void **state) {
    (void)state;
    const ps_frequencies set = test_lattice(2, 500);
    const ps_problem problem = test_problem(&set, 10000, 1e-3);
    ps_device_limits limits = test_cpu();
    ps_plan plan;
    limits.max_allocation_bytes = 1 << 20;
    test_make_plan(&plan, &problem, &limits, &test_any_plan);
    const ps_candidate *candidate = test_candidate(&plan, "torus_direct", PS_SINGLE);
    assert_false(candidate->is_applicable);
    assert_non_null(strstr(candidate->reason, "larger buffer"));
}

/* A batch fits into the budget of the device, and is 1 at least. */
static void batches(void **state) {
    (void)state;
    ps_work work = {.bytes_per_realization = 1e6, .largest_buffer_per_realization = 1e5};
    ps_device_limits limits = test_cpu(); /* half of 16 MiB of cache */
    assert_int_equal(ps_cost_batch(&work, &limits, 1000), 8);
    assert_int_equal(ps_cost_batch(&work, &limits, 5), 5);
    assert_int_equal(ps_cost_batch(&work, &limits, 0), 8);
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

/* More points or realizations, or twice the frequency with as many points for each of them, never cost less,
 * by any engine that applies. (With the points of the smaller grid, peaks of a lattice would do less harm to
 * the mean over the larger one, and windows could be narrower. Whole tiles make estimates uneven: 2 % here, up to
 * 20 % from one frequency to the next.) */
static void check_not_cheaper(const ps_problem *small, const ps_problem *large,
                              const ps_device_limits *limits, double slack) {
    ps_plan plans[2];
    test_make_plan(&plans[0], small, limits, &test_any_plan);
    test_make_plan(&plans[1], large, limits, &test_any_plan);
    for (size_t i = 0; i < plans[0].num_candidates; i++) {
        const ps_candidate *a = &plans[0].candidates[i], *b = &plans[1].candidates[i];
        if (a->is_applicable && b->is_applicable && !(b->seconds >= (1 - slack) * a->seconds)) {
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
        for (unsigned dimension = 1; dimension <= PS_MAX_TORUS_DIMENSION; dimension++) {
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_limits),
        cmocka_unit_test(allocation_limits),
        cmocka_unit_test(batches),
        cmocka_unit_test(cost_grows_with_the_problem),
    };
    return cmocka_run_group_tests_name("cost", tests, NULL, NULL);
}
