/* Planning is a pure function of problem, limits and constraints: no device is opened here. */
#include "harness.h"

#include "plan/choose.h"
#include "plan/cost_model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- machines that do not exist ------------------------------------------------------------ */

static ps_device_limits a_cpu(void) {
    return (ps_device_limits){.name = "a CPU",
                              .is_cpu = true,
                              .has_fp64 = true,
                              .compute_units = 8,
                              .clock_mhz = 3000,
                              .native_float_lanes = 8,
                              .native_double_lanes = 4,
                              .max_work_group_size = 4096,
                              .global_bytes = (uint64_t)16 << 30,
                              .max_allocation_bytes = (uint64_t)4 << 30,
                              .local_bytes = 32 << 10,
                              .cache_bytes = 16 << 20};
}

static ps_device_limits a_gpu(bool has_fp64) {
    return (ps_device_limits){.name = "a GPU",
                              .is_gpu = true,
                              .has_fp64 = has_fp64,
                              .has_dedicated_local_memory = true,
                              .compute_units = 40,
                              .clock_mhz = 1500,
                              .native_float_lanes = 1,
                              .native_double_lanes = has_fp64 ? 1 : 0,
                              .max_work_group_size = 1024,
                              .global_bytes = (uint64_t)8 << 30,
                              .max_allocation_bytes = (uint64_t)2 << 30,
                              .local_bytes = 64 << 10,
                              .cache_bytes = 4 << 20};
}

/* ---- problems ------------------------------------------------------------------------------ */

static ps_frequencies grid(unsigned dimension, int32_t max_frequency) {
    ps_frequencies set = {0};
    assert_ok(ps_frequencies_lattice(&set, dimension, max_frequency, true, error));
    return set;
}

static ps_problem problem_of(const ps_frequencies *set, uint64_t num_points, double tolerance) {
    return (ps_problem){.frequencies = set,
                        .num_points = num_points,
                        .num_realizations = 100,
                        .tolerance = tolerance};
}

static const ps_plan_constraints anything = {.precision = -1};

static void make(ps_plan *plan, const ps_problem *problem, const ps_device_limits *limits,
                 const ps_plan_constraints *constraints) {
    assert_ok(ps_plan_make(plan, problem, limits, constraints, error));
}

static const ps_candidate *find_candidate(const ps_plan *plan, const char *engine,
                                          ps_precision precision) {
    for (size_t i = 0; i < plan->num_candidates; i++) {
        if (strcmp(plan->candidates[i].engine->name, engine) == 0 &&
            plan->candidates[i].precision == precision) {
            return &plan->candidates[i];
        }
    }
    fail_msg("no candidate %s %s", engine, ps_precision_name(precision));
    return NULL;
}

/* ---- tests --------------------------------------------------------------------------------- */

static void same_question_same_answer(void **state) {
    (void)state;
    const ps_frequencies set = grid(2, 256);
    const ps_problem problem = problem_of(&set, 4096, 1e-5);
    const ps_device_limits limits = a_cpu();
    ps_plan plans[2];
    for (int i = 0; i < 2; i++) {
        make(&plans[i], &problem, &limits, &anything);
    }
    for (size_t i = 0; i < plans[0].num_candidates; i++) {
        const ps_candidate *a = &plans[0].candidates[i], *b = &plans[1].candidates[i];
        assert_true(a->engine == b->engine && a->precision == b->precision);
        assert_true(a->seconds == b->seconds && a->bytes == b->bytes && a->error == b->error);
        assert_true(a->is_chosen == b->is_chosen && a->batch == b->batch);
        assert_string_equal(a->reason, b->reason);
    }
}

/* Eight tolerances per decade: what is chosen keeps them, is the cheapest that does, and everybody
 * else has a reason. */
static void check_tolerances(const ps_problem *base, const ps_device_limits *limits,
                             double mean_power) {
    const ps_plan_constraints constraints = {.precision = -1};
    double last_seconds = 0;
    for (int i = 8 * 2; i <= 8 * 16; i++) {
        ps_problem problem = *base;
        ps_plan plan;
        problem.tolerance = pow(10, -i / 8.0);
        problem.expected_power = mean_power;
        make(&plan, &problem, limits, &constraints);
        size_t num_chosen = 0;
        for (size_t c = 0; c < plan.num_candidates; c++) {
            const ps_candidate *candidate = &plan.candidates[c];
            num_chosen += candidate->is_chosen;
            assert_true(candidate->reason[0] != '\0');
            assert_true(!candidate->is_feasible || candidate->error <= problem.tolerance);
            assert_true(!candidate->is_feasible || candidate->seconds >= plan.chosen->seconds);
            assert_true(!candidate->is_chosen || candidate == plan.chosen);
        }
        assert_int_equal(num_chosen, plan.chosen != NULL);
        if (plan.chosen != NULL) {
            assert_true(plan.chosen->error > 0 && plan.chosen->error <= problem.tolerance);
            assert_true(plan.chosen->seconds > 0 && plan.chosen->bytes > 0);
            assert_true(plan.chosen->seconds >= last_seconds); /* accuracy is never cheaper */
            last_seconds = plan.chosen->seconds;
        } else {
            assert_true(problem.tolerance < 2e-16 * sqrt(mean_power) + 1e-17);
        }
    }
}

static void every_tolerance_is_kept(void **state) {
    (void)state;
    const ps_device_limits limits[] = {a_cpu(), a_gpu(true), a_gpu(false)};
    const double powers[] = {0.01, 1, 1e4};
    const ps_frequencies sets[] = {grid(1, 100000), grid(2, 200), grid(6, 5)};
    for (size_t s = 0; s < 3; s++) {
        const ps_problem problem = problem_of(&sets[s], 10000, 1);
        for (size_t p = 0; p < 3; p++) {
            for (size_t i = 0; i < 3; i++) {
                check_tolerances(&problem, &limits[i], powers[p]);
            }
            check_tolerances(&problem, NULL, powers[p]);
        }
    }
}

static void without_a_device_the_host_does_it(void **state) {
    (void)state;
    const ps_frequencies set = grid(2, 32);
    for (double tolerance = 1e-2; tolerance >= 1e-15; tolerance /= 10) {
        const ps_problem problem = problem_of(&set, 1000, tolerance);
        ps_plan plan;
        make(&plan, &problem, NULL, &anything);
        assert_non_null(plan.chosen);
        assert_string_equal(plan.chosen->engine->name, "host_direct");
        assert_ok(ps_plan_require(&plan, &problem, error));
        assert_non_null(
            strstr(find_candidate(&plan, "torus_direct", PS_SINGLE)->reason, "OpenCL device"));
    }
}

static void devices_are_used_for_what_they_can(void **state) {
    (void)state;
    const ps_frequencies set = grid(2, 500);
    const struct {
        bool is_gpu, has_fp64;
        double tolerance;
        const char *engine;
        ps_precision precision;
    } cases[] = {{false, true, 1e-4, "torus_nufft", PS_SINGLE},
                 {false, true, 1e-10, "torus_nufft", PS_DOUBLE},
                 {true, true, 1e-4, "torus_nufft", PS_SINGLE},
                 {true, true, 1e-10, "torus_nufft", PS_DOUBLE},
                 {true, false, 1e-4, "torus_nufft", PS_SINGLE},
                 {true, false, 1e-10, "host_direct", PS_EXTENDED}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const ps_device_limits limits = cases[i].is_gpu ? a_gpu(cases[i].has_fp64) : a_cpu();
        const ps_problem problem = problem_of(&set, 10000, cases[i].tolerance);
        ps_plan plan;
        make(&plan, &problem, &limits, &anything);
        assert_non_null(plan.chosen);
        assert_string_equal(plan.chosen->engine->name, cases[i].engine);
        assert_int_equal(plan.chosen->precision, cases[i].precision);
        if (!limits.has_fp64) {
            const ps_candidate *candidate = find_candidate(&plan, "torus_direct", PS_DOUBLE);
            assert_false(candidate->is_applicable);
            assert_non_null(strstr(candidate->reason, "double precision"));
        }
    }
}

static void choices_of_the_user(void **state) {
    (void)state;
    const ps_frequencies set = grid(2, 100);
    const ps_problem problem = problem_of(&set, 1000, 1e-3);
    const ps_device_limits limits = a_cpu();
    ps_plan plan;
    for (const ps_engine *const *engine = ps_engines; *engine != NULL; engine++) {
        for (int precision = PS_SINGLE; precision <= PS_EXTENDED; precision++) {
            const ps_plan_constraints constraints = {.engine = (*engine)->name,
                                                     .precision = precision};
            make(&plan, &problem, &limits, &constraints);
            if ((*engine)->has_precision[precision]) {
                assert_true(plan.chosen->engine == *engine);
                assert_int_equal(plan.chosen->precision, precision);
            } else {
                ps_error said = {0};
                assert_null(plan.chosen);
                assert_int_equal(ps_plan_require(&plan, &problem, &said),
                                 PSPEC_ERROR_INVALID_ARGUMENT);
            }
            for (size_t i = 0; i < plan.num_candidates; i++) {
                const ps_candidate *candidate = &plan.candidates[i];
                assert_true(candidate->is_chosen || candidate->is_excluded);
                assert_true(candidate->is_chosen ||
                            strstr(candidate->reason, "excludes it") != NULL);
            }
        }
    }
}

static void unknown_engines(void **state) {
    (void)state;
    const ps_frequencies set = grid(2, 10);
    const ps_problem problem = problem_of(&set, 10, 1e-3);
    const struct {
        const char *name, *nearest;
    } cases[] = {{"host", "host_direct"},   {"hots_direct", "host_direct"},
                 {"torus", "torus_nufft"},  {"torus-direct", "torus_direct"},
                 {"TORUS_DIRECT", "torus"}, {"", "torus"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const ps_plan_constraints constraints = {.engine = cases[i].name, .precision = -1};
        ps_plan plan;
        ps_error said = {0};
        assert_int_equal(ps_plan_make(&plan, &problem, NULL, &constraints, &said),
                         PSPEC_ERROR_INVALID_ARGUMENT);
        assert_non_null(strstr(said.message, cases[i].name));
        assert_non_null(strstr(said.message, cases[i].nearest));
    }
}

static void tolerances_out_of_reach(void **state) {
    (void)state;
    const ps_frequencies set = grid(2, 100);
    const ps_problem problem = problem_of(&set, 1000, 1e-17);
    const ps_device_limits limits = a_cpu();
    const int precisions[] = {-1, PS_SINGLE, PS_DOUBLE, PS_EXTENDED};
    for (size_t i = 0; i < 4; i++) {
        const ps_plan_constraints constraints = {.precision = precisions[i]};
        ps_plan plan;
        ps_error said = {0};
        char number[32];
        make(&plan, &problem, &limits, &constraints);
        assert_null(plan.chosen);
        assert_int_equal(ps_plan_require(&plan, &problem, &said), PSPEC_ERROR_TOLERANCE);
        double best = INFINITY;
        for (size_t c = 0; c < plan.num_candidates; c++) {
            const ps_candidate *candidate = &plan.candidates[c];
            best = !candidate->is_excluded ? fmin(best, candidate->error) : best;
        }
        snprintf(number, sizeof number, "%.2g", best);
        assert_non_null(strstr(said.message, "1e-17"));
        assert_non_null(strstr(said.message, number));
    }
}

static void forced_to_a_device_that_is_not_there(void **state) {
    (void)state;
    const ps_frequencies set = grid(2, 100);
    const ps_problem problem = problem_of(&set, 1000, 1e-3);
    const ps_plan_constraints constraints = {.engine = "torus_direct", .precision = -1};
    ps_plan plan;
    ps_error said = {0};
    make(&plan, &problem, NULL, &constraints);
    assert_null(plan.chosen);
    assert_int_equal(ps_plan_require(&plan, &problem, &said), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(said.message, "needs an OpenCL device"));
}

/* ---- memory -------------------------------------------------------------------------------- */

static void memory_limits(void **state) {
    (void)state;
    const ps_frequencies set = grid(2, 500);
    const ps_problem problem = problem_of(&set, 10000, 1e-3);
    ps_device_limits limits = a_cpu();
    ps_plan plan;
    limits.global_bytes = 1 << 20;
    make(&plan, &problem, &limits, &anything);
    const ps_candidate *candidate = find_candidate(&plan, "torus_direct", PS_SINGLE);
    assert_true(candidate->is_applicable && !candidate->is_feasible);
    assert_int_equal(candidate->batch, 1);
    assert_non_null(strstr(candidate->reason, "above the limit of 1.05e+06"));
    assert_string_equal(plan.chosen->engine->name, "host_direct"); /* the host is not so small */
    const ps_plan_constraints limited = {.precision = -1, .memory_limit = 1000};
    make(&plan, &problem, &limits, &limited);
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
    const ps_frequencies set = grid(2, 500);
    const ps_problem problem = problem_of(&set, 10000, 1e-3);
    ps_device_limits limits = a_cpu();
    ps_plan plan;
    limits.max_allocation_bytes = 1 << 20;
    make(&plan, &problem, &limits, &anything);
    const ps_candidate *candidate = find_candidate(&plan, "torus_direct", PS_SINGLE);
    assert_false(candidate->is_applicable);
    assert_non_null(strstr(candidate->reason, "larger buffer"));
}

/* A batch fits into the budget of the device, and is 1 at least. */
static void batches(void **state) {
    (void)state;
    ps_work work = {.bytes_per_realization = 1e6, .largest_buffer_per_realization = 1e5};
    ps_device_limits limits = a_cpu(); /* half of 16 MiB of cache */
    assert_int_equal(ps_cost_batch(&work, &limits, 1000), 8);
    assert_int_equal(ps_cost_batch(&work, &limits, 5), 5);
    assert_int_equal(ps_cost_batch(&work, &limits, 0), 8);
    assert_int_equal(ps_cost_batch(&work, NULL, 1000), 1);
    limits.max_allocation_bytes = 300000;
    assert_int_equal(ps_cost_batch(&work, &limits, 1000), 3);
    limits.max_allocation_bytes = 1;
    assert_int_equal(ps_cost_batch(&work, &limits, 1000), 1);
    limits = a_cpu();
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
    make(&plans[0], small, limits, &anything);
    make(&plans[1], large, limits, &anything);
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
    const ps_device_limits limits[] = {a_cpu(), a_gpu(true)};
    static const int32_t largest[] = {30000, 1000, 60, 12, 6, 4};
    for (size_t l = 0; l < 2; l++) {
        for (unsigned dimension = 1; dimension <= PS_MAX_TORUS_DIMENSION; dimension++) {
            for (int32_t k = 1; k < largest[dimension - 1]; k += 1 + k / 8) {
                const ps_frequencies small = grid(dimension, k);
                const ps_frequencies large = grid(dimension, 2 * k);
                ps_problem problem = problem_of(&small, 5000, 1e-3);
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
        cmocka_unit_test(same_question_same_answer),
        cmocka_unit_test(every_tolerance_is_kept),
        cmocka_unit_test(without_a_device_the_host_does_it),
        cmocka_unit_test(devices_are_used_for_what_they_can),
        cmocka_unit_test(choices_of_the_user),
        cmocka_unit_test(unknown_engines),
        cmocka_unit_test(tolerances_out_of_reach),
        cmocka_unit_test(forced_to_a_device_that_is_not_there),
        cmocka_unit_test(memory_limits),
        cmocka_unit_test(allocation_limits),
        cmocka_unit_test(batches),
        cmocka_unit_test(cost_grows_with_the_problem),
    };
    return cmocka_run_group_tests_name("plan", tests, NULL, NULL);
}
