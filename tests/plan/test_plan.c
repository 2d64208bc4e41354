/* Planning is a pure function of problem, limits and constraints: no device is opened here. */
#include "harness_plan.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void same_question_same_answer(void **state) {
    (void)state;
    const ps_frequencies set = test_lattice(2, 256);
    const ps_problem problem = test_problem(&set, 4096, 1e-5);
    const ps_device_limits limits = test_cpu();
    ps_plan plans[2];
    for (int i = 0; i < 2; i++) {
        test_make_plan(&plans[i], &problem, &limits, &test_any_plan);
    }
    for (size_t i = 0; i < plans[0].num_candidates; i++) {
        const ps_candidate *a = &plans[0].candidates[i], *b = &plans[1].candidates[i];
        assert_true(a->engine == b->engine && a->precision == b->precision);
        assert_true(a->seconds == b->seconds && a->bytes == b->bytes && a->error == b->error);
        assert_true(a->is_chosen == b->is_chosen && a->batch == b->batch);
        assert_string_equal(a->reason, b->reason);
    }
}

/* What is chosen keeps every tolerance, is the cheapest that does, and everybody else has a reason.
 */
static void check_tolerances(const ps_problem *base, const ps_device_limits *limits,
                             double mean_power, int per_decade) {
    const ps_plan_constraints constraints = {.precision = -1};
    double last_seconds = 0;
    for (int i = per_decade * 2; i <= per_decade * 16; i++) {
        ps_problem problem = *base;
        ps_plan plan;
        problem.tolerance = pow(10, -(double)i / per_decade);
        problem.expected_power = mean_power;
        test_make_plan(&plan, &problem, limits, &constraints);
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
    const ps_device_limits limits[] = {test_cpu(), test_gpu(true), test_gpu(false)};
    const double powers[] = {0.01, 1, 1e4};
    const ps_frequencies sets[] = {test_lattice(1, 100000), test_lattice(2, 200),
                                   test_lattice(6, 5)};
    for (size_t s = 0; s < 3; s++) {
        const ps_problem problem = test_problem(&sets[s], 10000, 1);
        for (size_t p = 0; p < 3; p++) {
            for (size_t i = 0; i < 3; i++) { /* a plan takes 5 ms */
                check_tolerances(&problem, &limits[i], powers[p], i == 0 && p == 1 ? 8 : 2);
            }
            check_tolerances(&problem, NULL, powers[p], 2);
        }
    }
}

static void without_a_device_the_host_does_it(void **state) {
    (void)state;
    const ps_frequencies set = test_lattice(2, 32);
    for (double tolerance = 1e-2; tolerance >= 1e-15; tolerance /= 10) {
        const ps_problem problem = test_problem(&set, 1000, tolerance);
        ps_plan plan;
        test_make_plan(&plan, &problem, NULL, &test_any_plan);
        assert_non_null(plan.chosen);
        assert_string_equal(plan.chosen->engine->name, "host_direct");
        assert_ok(ps_plan_require(&plan, &problem, error));
        assert_non_null(
            strstr(test_candidate(&plan, "torus_direct", PS_SINGLE)->reason, "OpenCL device"));
    }
}

static void devices_are_used_for_what_they_can(void **state) {
    (void)state;
    const ps_frequencies set = test_lattice(2, 500);
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
        const ps_device_limits limits = cases[i].is_gpu ? test_gpu(cases[i].has_fp64) : test_cpu();
        const ps_problem problem = test_problem(&set, 10000, cases[i].tolerance);
        ps_plan plan;
        test_make_plan(&plan, &problem, &limits, &test_any_plan);
        assert_non_null(plan.chosen);
        assert_string_equal(plan.chosen->engine->name, cases[i].engine);
        assert_int_equal(plan.chosen->precision, cases[i].precision);
        if (!limits.has_fp64) {
            const ps_candidate *candidate = test_candidate(&plan, "torus_direct", PS_DOUBLE);
            assert_false(candidate->is_applicable);
            assert_non_null(strstr(candidate->reason, "double precision"));
        }
    }
}

static void choices_of_the_user(void **state) {
    (void)state;
    const ps_frequencies set = test_lattice(2, 100);
    const ps_problem problem = test_problem(&set, 1000, 1e-3);
    const ps_device_limits limits = test_cpu();
    ps_plan plan;
    for (const ps_engine *const *engine = ps_engines; *engine != NULL; engine++) {
        if (!((*engine)->domains & PS_ON_TORUS)) {
            continue;
        }
        for (int precision = PS_SINGLE; precision <= PS_EXTENDED; precision++) {
            const ps_plan_constraints constraints = {.engine = (*engine)->name,
                                                     .precision = precision};
            test_make_plan(&plan, &problem, &limits, &constraints);
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
    const ps_frequencies set = test_lattice(2, 10);
    const ps_problem problem = test_problem(&set, 10, 1e-3);
    const struct {
        const char *name, *nearest;
    } cases[] = {{"host", "host_direct"},
                 {"hots_direct", "host_direct"},
                 {"torus", "torus_nufft"},
                 {"torus-direct", "torus_direct"},
                 {"TORUS_DIRECT", "nearest is torus_direct"},
                 {"fourier", "fourier"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const ps_plan_constraints constraints = {.engine = cases[i].name, .precision = -1};
        ps_plan plan;
        ps_error said = {0};
        assert_int_equal(ps_plan_make(&plan, &problem, NULL, &constraints, &said),
                         PSPEC_ERROR_INVALID_ARGUMENT);
        assert_non_null(strstr(said.message, cases[i].name));
        assert_non_null(strstr(said.message, cases[i].nearest));
        assert_true((strstr(said.message, "nearest") == NULL) ==
                    (strcmp(cases[i].name, "fourier") == 0));
    }
}

static void tolerances_out_of_reach(void **state) {
    (void)state;
    const ps_frequencies set = test_lattice(2, 100);
    const ps_problem problem = test_problem(&set, 1000, 1e-17);
    const ps_device_limits limits = test_cpu();
    const int precisions[] = {-1, PS_SINGLE, PS_DOUBLE, PS_EXTENDED};
    for (size_t i = 0; i < 4; i++) {
        const ps_plan_constraints constraints = {.precision = precisions[i]};
        ps_plan plan;
        ps_error said = {0};
        char number[32];
        test_make_plan(&plan, &problem, &limits, &constraints);
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
    const ps_frequencies set = test_lattice(2, 100);
    const ps_problem problem = test_problem(&set, 1000, 1e-3);
    const ps_plan_constraints constraints = {.engine = "torus_direct", .precision = -1};
    ps_plan plan;
    ps_error said = {0};
    test_make_plan(&plan, &problem, NULL, &constraints);
    assert_null(plan.chosen);
    assert_int_equal(ps_plan_require(&plan, &problem, &said), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(said.message, "needs an OpenCL device"));
}

/* How many compute units a device has, how fast they are, their caches and what was measured choose
 * nothing: the same engine in the same precision, with the same error, layout and batch. */
static void check_kind(const ps_problem *problem, const ps_device_limits *first) {
    static const ps_figures slow = {
        .is_measured = true,
        .num_engines = 2,
        .engines = {{"torus_nufft", {100, 100, 1}}, {"sphere_grid", {100, 100, 1}}}};
    ps_plan plans[2];
    test_make_plan(&plans[0], problem, first, &test_any_plan);
    for (unsigned units = 1; units <= 64; units *= 64) {
        ps_device_limits other = *first;
        other.compute_units = units;
        other.clock_mhz = 500 + 37 * units;
        other.cache_bytes = (uint64_t)units << 20;
        other.figures = units > 1 ? &slow : NULL;
        test_make_plan(&plans[1], problem, &other, &test_any_plan);
        const ps_candidate *const a = plans[0].chosen;
        const ps_candidate *const b = plans[1].chosen;
        assert_true((a == NULL) == (b == NULL));
        if (a != NULL && (a->engine != b->engine || a->precision != b->precision)) {
            fail_msg("N = %llu, K = %d, %llu realizations: %s by %u units, %s by %u",
                     (unsigned long long)problem->num_points,
                     (int)problem->frequencies->max_frequency,
                     (unsigned long long)problem->num_realizations, a->engine->name,
                     first->compute_units, b->engine->name, units);
        }
        if (a != NULL) {
            assert_true(a->error == b->error);
            assert_true(a->device_bytes == b->device_bytes && a->batch == b->batch);
        }
    }
}

static void choices_are_of_the_kind(void **state) {
    (void)state;
    const ps_device_limits devices[] = {test_cpu(), test_gpu(true), test_gpu(false)};
    for (size_t i = 0; i < sizeof devices / sizeof devices[0]; i++) {
        for (uint64_t num_points = 64; num_points <= 1 << 16; num_points *= 32) {
            for (unsigned dimension = 0; dimension <= 3; dimension++) {
                for (int32_t largest = 16; largest <= 128; largest *= 8) {
                    ps_frequencies set = {0};
                    if (dimension == 0) {
                        assert_ok(ps_frequencies_degrees(&set, largest, false, error));
                    } else {
                        set = test_lattice(dimension, dimension < 3 ? largest : largest / 8);
                    }
                    for (uint64_t num = 1; num <= 100; num *= 100) {
                        ps_problem problem = test_problem(&set, num_points, 1e-6);
                        problem.num_realizations = num;
                        check_kind(&problem, &devices[i]);
                        problem.tolerance = 1e-10;
                        check_kind(&problem, &devices[i]);
                    }
                }
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_question_same_answer),
        cmocka_unit_test(choices_are_of_the_kind),
        cmocka_unit_test(every_tolerance_is_kept),
        cmocka_unit_test(without_a_device_the_host_does_it),
        cmocka_unit_test(devices_are_used_for_what_they_can),
        cmocka_unit_test(choices_of_the_user),
        cmocka_unit_test(unknown_engines),
        cmocka_unit_test(tolerances_out_of_reach),
        cmocka_unit_test(forced_to_a_device_that_is_not_there),
    };
    return cmocka_run_group_tests_name("plan", tests, NULL, NULL);
}
