/* What plans say of GPUs: seconds beside those that were measured, choices by the kind of device
 * alone. No device is opened. */
#include "harness_plan.h"

#include "device/kind.h"
#include "engines/torus/nufft/choice.h"
#include "engines/torus/nufft/layout.h"
#include "engines/torus/nufft/variant.h"
#include "plan/cost_model.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const unsigned ON_SPHERE = 0; /* in the place of a dimension */

static ps_frequencies frequencies_of(unsigned dimension, int32_t most) {
    ps_frequencies set = {0};
    if (dimension != ON_SPHERE) {
        return test_lattice(dimension, most);
    }
    assert_ok(ps_frequencies_degrees(&set, most, false, error));
    return set;
}

/* ---- seconds ------------------------------------------------------------------------------- */

/* Seconds of the kernels of one realization on an H200 (docs/developer/performance.md, "On a GPU"):
 * measured, less the sorts and sums over realizations that were replaced since, or predicted from
 * the time of a prototype where there is a new kernel (of sphere_nufft of sorts, boxes, transforms
 * of as many cells, and Legendre sums), or of sphere_direct from a third of the operations that an
 * H200 does in a second. */
static const struct {
    unsigned dimension;
    uint64_t num_points;
    int32_t most;
    uint64_t num_realizations;
    const char *engine;
    double seconds;
} jobs[] = {
    {2, 4096, 256, 4000, "torus_nufft", 6e-6},     {2, 16384, 512, 1000, "torus_nufft", 25e-6},
    {2, 65536, 1024, 64, "torus_nufft", 100e-6},   {2, 10000000, 1024, 1, "torus_nufft", 1.8e-3},
    {3, 1000000, 64, 4, "torus_nufft", 800e-6},    {1, 65536, 32768, 256, "torus_nufft", 10e-6},
    {2, 256, 32, 200000, "torus_direct", 0.09e-6}, {2, 1024, 128, 20000, "torus_direct", 4.9e-6},
    {2, 4096, 256, 4000, "torus_direct", 77e-6},   {1, 65536, 32768, 256, "torus_direct", 310e-6},
    {0, 1024, 128, 100, "sphere_direct", 8.5e-6},  {0, 4096, 256, 8, "sphere_direct", 137e-6},
    {0, 1024, 64, 20000, "sphere_nufft", 0.6e-6},  {0, 4096, 256, 1000, "sphere_nufft", 10e-6},
    {0, 1000000, 1000, 1, "sphere_nufft", 0.5e-3},
};

static void as_measured_on_an_h200(void **state) {
    (void)state;
    const ps_device_limits limits = test_h200();
    for (size_t i = 0; i < sizeof jobs / sizeof jobs[0]; i++) {
        ps_frequencies set = frequencies_of(jobs[i].dimension, jobs[i].most);
        ps_problem problem = test_problem(&set, jobs[i].num_points, 1e-6);
        problem.num_realizations = jobs[i].num_realizations;
        ps_plan plan;
        test_make_plan(&plan, &problem, &limits, &test_any_plan);
        const ps_candidate *const own = test_candidate(&plan, jobs[i].engine, PS_SINGLE);
        const double found = own->seconds / (double)jobs[i].num_realizations;
        assert_true(own->is_applicable);
        print_message("%u %8llu %5d %-13s %10.3g us, %10.3g measured: %.2f\n", jobs[i].dimension,
                      (unsigned long long)jobs[i].num_points, (int)jobs[i].most, jobs[i].engine,
                      found * 1e6, jobs[i].seconds * 1e6, found / jobs[i].seconds);
        if (found > 2 * jobs[i].seconds || found < jobs[i].seconds / 2) {
            fail_msg("%s N = %llu: %g s instead of %g", jobs[i].engine,
                     (unsigned long long)jobs[i].num_points, found, jobs[i].seconds);
        }
        ps_frequencies_free(&set);
    }
}

/* ---- choices ------------------------------------------------------------------------------- */

typedef void look(const ps_problem *problem);

/* Looks at some problems of all kinds. */
static void sweep(look *at) {
    static const uint64_t points[] = {100, 1024, 16384, 100000, 3000000};
    static const int32_t most[][3] = {
        {16, 64, 500}, {200, 5000, 30000}, {12, 64, 600}, {4, 12, 60}};
    static const double tolerances[] = {1e-3, 1e-6, 1e-9};
    for (unsigned dimension = 0; dimension <= 3; dimension++) {
        for (size_t i = 0; i < 10; i++) {
            ps_frequencies set = frequencies_of(dimension, most[dimension][i % 3]);
            ps_problem problem = test_problem(&set, points[i % 5], tolerances[(i + i / 3) % 3]);
            problem.num_realizations = i / 2 % 2 == 0 ? 1 : 1000;
            at(&problem);
            ps_frequencies_free(&set);
        }
    }
}

/* Seconds of all realizations by one variant of torus_nufft; infinite where it does not do. */
static double seconds_of_variant(const ps_nufft_variant *variant, const ps_problem *problem,
                                 const ps_device_limits *limits, ps_precision precision) {
    const ps_nufft_variant *const only[] = {variant, NULL};
    const ps_nufft_choice choice = ps_nufft_choose_among(only, problem, limits, precision);
    const ps_nufft_layout layout = ps_nufft_layout_of(&choice, problem, limits, precision);
    const double num_points = (double)problem->num_points;
    const double sets = (double)problem->num_realizations;
    if (layout.lanes == 0 || ps_nufft_error(&choice, problem, precision,
                                            ps_expected_power(problem)) > problem->tolerance) {
        return HUGE_VAL;
    }
    const double flops = ps_nufft_flops_of_layout(&layout, precision, num_points);
    const ps_work work = {.transform_flops = sets * flops,
                          .launches = variant->count_launches(&layout, num_points, sets)};
    return ps_cost_typical(&work, limits, precision);
}

/* Nothing that would keep the tolerance and has room is more than 1.2 times cheaper than what is
 * chosen, whichever engine and variant it is of. */
static void check_best(const ps_problem *problem) {
    const ps_device_limits limits = test_h200();
    ps_plan plan;
    test_make_plan(&plan, problem, &limits, &test_any_plan);
    assert_non_null(plan.chosen);
    double least = HUGE_VAL;
    for (size_t i = 0; i < plan.num_candidates; i++) {
        least = plan.candidates[i].is_feasible ? fmin(least, plan.candidates[i].cost) : least;
    }
    for (size_t v = 0; ps_nufft_variants[v] != NULL; v++) {
        for (int p = PS_SINGLE; p <= PS_DOUBLE && ps_problem_domain(problem) == PS_ON_TORUS; p++) {
            const ps_nufft_variant *const variant = ps_nufft_variants[v];
            least =
                variant->on_gpus
                    ? fmin(least, seconds_of_variant(variant, problem, &limits, (ps_precision)p))
                    : least;
        }
    }
    if (plan.chosen->cost > 1.2 * least) {
        fail_msg("d = %u N = %llu K = %d R = %llu tol = %g: %g s of %s, %g would do",
                 problem->frequencies->dimension, (unsigned long long)problem->num_points,
                 (int)problem->frequencies->max_frequency,
                 (unsigned long long)problem->num_realizations, problem->tolerance,
                 plan.chosen->cost, plan.chosen->engine->name, least);
    }
}

static void nothing_is_much_cheaper(void **state) {
    (void)state;
    sweep(check_best);
}

static void assert_same_choice(const ps_problem *problem, const ps_device_limits *a,
                               const ps_device_limits *b) {
    ps_plan plans[2];
    test_make_plan(&plans[0], problem, a, &test_any_plan);
    test_make_plan(&plans[1], problem, b, &test_any_plan);
    assert_int_equal(plans[0].num_candidates, plans[1].num_candidates);
    for (size_t i = 0; i < plans[0].num_candidates; i++) {
        const ps_candidate *const one = &plans[0].candidates[i], *const two =
                                                                     &plans[1].candidates[i];
        assert_int_equal(one->is_chosen, two->is_chosen);
        assert_int_equal(one->batch, two->batch);
        assert_true(one->cost == two->cost && one->error == two->error && one->bytes == two->bytes);
        assert_string_equal(one->reason, two->reason);
    }
}

/* Whatever was measured of a device: as it is, a thousand times slower, a thousand times faster. */
static void check_figures(const ps_problem *problem) {
    const ps_device_limits devices[] = {test_cpu(), test_gpu(true)};
    for (size_t i = 0; i < 2 * 2; i++) {
        const double factor = i % 2 == 0 ? 1e3 : 1e-3;
        ps_device_limits measured = devices[i / 2];
        ps_figures figures = {.is_measured = true,
                              .flops = {1e12 * factor, 1e12},
                              .sent_bytes = 1e10 * factor,
                              .launches = 1e5 * factor};
        for (size_t e = 0; ps_engines[e] != NULL; e++) {
            ps_engine_figure *const row = ps_figures_row(&figures, ps_engines[e]->name);
            for (size_t p = 0; p < PS_FIGURES_PRECISIONS; p++) {
                row->scales[p] = (e + p) % 2 == 0 ? factor : 1 / factor;
            }
        }
        measured.figures = &figures;
        assert_same_choice(problem, &devices[i / 2], &measured);
        assert_string_equal(ps_device_kind_of(&measured).text,
                            ps_device_kind_of(&devices[i / 2]).text);
    }
}

static void measured_figures_choose_nothing(void **state) {
    (void)state;
    sweep(check_figures);
}

/* ---- kinds --------------------------------------------------------------------------------- */

/* Another card of the same kind. */
static void check_kind(const ps_problem *problem) {
    const ps_device_limits one = test_h200();
    ps_device_limits other = one;
    snprintf(other.name, sizeof other.name, "another");
    other.compute_units = 7;
    other.clock_mhz = 500;
    other.cache_bytes = 1 << 20;
    assert_string_equal(ps_device_kind_of(&one).text, ps_device_kind_of(&other).text);
    assert_same_choice(problem, &one, &other);
}

static void equal_kinds_choose_alike(void **state) {
    (void)state;
    sweep(check_kind);
}

static void kinds_say_what_was_probed(void **state) {
    (void)state;
    ps_device_limits limits = test_h200();
    assert_string_equal(ps_device_kind_of(&limits).probed, "gpu local=48K group=1024 double=1/2");
    limits.double_cost = 64;
    assert_string_equal(ps_device_kind_of(&limits).probed, "gpu local=48K group=1024 double=1/64");
    limits.double_cost = 0; /* a driver that does not say */
    limits.local_bytes = 16 << 10;
    assert_string_equal(ps_device_kind_of(&limits).probed, "gpu local=16K group=1024 double=1/2");
    limits.has_fp64 = false;
    assert_string_equal(ps_device_kind_of(&limits).probed, "gpu local=16K group=1024 double=none");
    limits = test_cpu();
    assert_string_equal(ps_device_kind_of(&limits).probed, "");
}

/* What was found is part of the kind of device. */
static void matrix_units_are_in_the_kind(void **state) {
    (void)state;
    ps_device_limits limits = test_cpu();
    limits.units = PS_UNITS_NONE;
    const ps_device_kind plain = ps_device_kind_of(&limits);
    limits.units = PS_UNITS_PTX;
    const ps_device_kind with_units = ps_device_kind_of(&limits);
    assert_memory_equal(with_units.text, plain.text, strlen(plain.text));
    assert_string_equal(with_units.text + strlen(plain.text), ", matrix units ptx");
}

/* Where double precision is slow, single precision is worth more. */
static void slow_doubles_cost(void **state) {
    (void)state;
    const ps_frequencies set = test_lattice(2, 64);
    const ps_problem problem = test_problem(&set, 1024, 1e-9);
    ps_device_limits limits = test_h200();
    ps_plan plans[2];
    test_make_plan(&plans[0], &problem, &limits, &test_any_plan);
    limits.double_cost = 64;
    test_make_plan(&plans[1], &problem, &limits, &test_any_plan);
    assert_true(test_candidate(&plans[1], "torus_direct", PS_DOUBLE)->cost >
                20 * test_candidate(&plans[0], "torus_direct", PS_DOUBLE)->cost);
    assert_true(test_candidate(&plans[1], "torus_direct", PS_SINGLE)->cost ==
                test_candidate(&plans[0], "torus_direct", PS_SINGLE)->cost);
}

/* The smallest that there are: an engine, or a sentence. */
static void check_small(const ps_problem *problem) {
    for (size_t i = 0; i < 2 * 2; i++) {
        ps_device_limits limits = test_gpu(i % 2 == 0);
        limits.local_bytes = (uint64_t)(16 << 10) << i / 2;
        limits.max_work_group_size = 64;
        ps_plan plan;
        ps_error said = {0};
        test_make_plan(&plan, problem, &limits, &test_any_plan);
        if (ps_plan_require(&plan, problem, &said) != PSPEC_OK) {
            assert_true(strlen(said.message) > 0);
        }
        for (size_t c = 0; c < plan.num_candidates; c++) {
            const ps_candidate *const one = &plan.candidates[c];
            assert_true(one->is_applicable ? isfinite(one->cost) && one->cost > 0
                                           : strlen(one->reason) > 0);
            assert_true(limits.has_fp64 || !one->engine->needs_device ||
                        one->precision != PS_DOUBLE || !one->is_applicable);
        }
    }
}

static void small_gpus_have_an_engine_or_a_sentence(void **state) {
    (void)state;
    sweep(check_small);
}

/* Very many points on the few cells of K = 3 in space are two boxes, which two work-groups add to:
 * sums at each frequency keep all of a GPU busy. Larger grids have more boxes. */
static void few_boxes_are_left_to_sums(void **state) {
    (void)state;
    static const int32_t most[] = {3, 64};
    static const char *const chosen[] = {"torus_direct", "torus_nufft"};
    const ps_device_limits limits = test_h200();
    for (size_t i = 0; i < 2; i++) {
        const ps_frequencies set = test_lattice(3, most[i]);
        ps_problem problem = test_problem(&set, 10000000, 1e-6);
        problem.num_realizations = 1;
        ps_plan plan;
        test_make_plan(&plan, &problem, &limits, &test_any_plan);
        assert_string_equal(plan.chosen->engine->name, chosen[i]);
    }
}

/* A box of one cell and what windows of 16 touch behind it take 32 KiB in double precision. */
static void boxes_that_do_not_fit_are_said_so(void **state) {
    (void)state;
    const ps_frequencies set = test_lattice(3, 40);
    ps_device_limits limits = test_h200();
    ps_plan plan;
    const ps_problem problem = test_problem(&set, 100000, 1e-14);
    limits.local_bytes = 32 << 10;
    test_make_plan(&plan, &problem, &limits, &test_any_plan);
    const ps_candidate *const own = test_candidate(&plan, "torus_nufft", PS_DOUBLE);
    assert_false(own->is_applicable);
    assert_string_equal(own->reason,
                        "a row or a box of the fine grid does not fit into local memory");
    assert_string_equal(plan.chosen->engine->name, "torus_direct");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_measured_on_an_h200),
        cmocka_unit_test(nothing_is_much_cheaper),
        cmocka_unit_test(measured_figures_choose_nothing),
        cmocka_unit_test(equal_kinds_choose_alike),
        cmocka_unit_test(kinds_say_what_was_probed),
        cmocka_unit_test(matrix_units_are_in_the_kind),
        cmocka_unit_test(slow_doubles_cost),
        cmocka_unit_test(few_boxes_are_left_to_sums),
        cmocka_unit_test(boxes_that_do_not_fit_are_said_so),
        cmocka_unit_test(small_gpus_have_an_engine_or_a_sentence),
    };
    return cmocka_run_group_tests_name("gpu_costs", tests, NULL, NULL);
}
