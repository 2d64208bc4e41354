/* The tolerance contract of every engine, swept 8 per decade: where its formula says that a
 * tolerance is kept, for white noise beforehand and for the power that was measured afterwards, the
 * error is below it; sets of every kind, against the referee. What the planner chooses keeps the
 * tolerance by its formula, and it refuses what nothing keeps.
 *
 * As in test_tolerance.c, sqrt(2) times the root mean square of | |S| - |S_ref| | stands for |dS|.
 * All kinds of sets go through an engine in one batch.
 */
#include "harness_shapes.h"

#include "engines/host/host_direct.h"
#include "plan/choose.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;

typedef struct problem_case {
    unsigned dimension;
    int32_t k;
    size_t num_points;
    double steps_per_decade;
    bool is_shown; /* errors at some tolerances, for docs/developer/accuracy.md */
} problem_case;

/* Few and many points in a cell, K below, at and beside multiples of vectors. */
static const problem_case cases[] = {
    {1, 100, 150, 8, false},  {1, 1, 1, 1, false},   {1, 3, 3000, 2, false}, {1, 600, 60, 2, false},
    {1, 2047, 100, 1, false}, {2, 12, 500, 8, true}, {2, 1, 1, 2, false},    {2, 2, 3, 1, false},
    {2, 3, 1, 1, false},      {2, 5, 7, 1, false},   {2, 7, 3000, 2, false}, {2, 16, 40, 1, false},
    {2, 40, 100, 2, false},   {3, 5, 300, 8, false}, {3, 1, 2, 1, false},    {3, 2, 1500, 2, false},
    {3, 9, 80, 2, false}};
enum { NUM_CASES = sizeof cases / sizeof cases[0] };

static const double most = 1e-2, least = 1e-15;

/* A case with the truth. */
typedef struct sweep {
    const problem_case *what;
    ps_frequencies grid;
    pspec_pattern patterns[TEST_SHAPES];
    double *expected;
    double squares[TEST_SHAPES], power[TEST_SHAPES]; /* sum w^2, mean effective power */
} sweep;

static sweep sweeps[NUM_CASES];

static void make_sweep(sweep *self, const problem_case *what) {
    self->what = what;
    self->grid = test_make_grid(what->dimension, what->k);
    for (size_t s = 0; s < TEST_SHAPES; s++) {
        self->patterns[s] =
            test_make_pattern(&test_shapes[s], what->dimension, what->num_points, 7);
        self->squares[s] = test_sum_of_squares(&self->patterns[s]);
    }
    self->expected = test_run_engine(&ps_host_direct, PS_EXTENDED, NULL, &self->grid,
                                     self->patterns, TEST_SHAPES, 1);
    for (size_t i = 0; i < TEST_SHAPES * self->grid.num; i++) {
        const size_t s = i / self->grid.num;
        self->power[s] += self->expected[i] / self->squares[s] / (double)self->grid.num;
    }
}

static int make_sweeps(void **state) {
    (void)state;
    for (size_t i = 0; i < NUM_CASES; i++) {
        make_sweep(&sweeps[i], &cases[i]);
    }
    return 0;
}

static int free_sweeps(void **state) {
    (void)state;
    for (size_t i = 0; i < NUM_CASES; i++) {
        for (size_t s = 0; s < TEST_SHAPES; s++) {
            test_free_pattern(&sweeps[i].patterns[s]);
        }
        free(sweeps[i].expected);
        ps_frequencies_free(&sweeps[i].grid);
    }
    return 0;
}

static ps_problem problem_of(const sweep *at, double tolerance) {
    return (ps_problem){.frequencies = &at->grid,
                        .num_points = at->what->num_points,
                        .num_realizations = TEST_SHAPES,
                        .has_weights = true,
                        .tolerance = tolerance};
}

/* ---- engines ----------------------------------------------------------------------------- */

typedef struct tried {
    const ps_engine *engine;
    ps_precision precision;
    double slack[TEST_SHAPES]; /* smallest bound / error */
    bool is_kept;
} tried;

/* For white noise. */
static double error_at_one(const tried *self, const sweep *at, double tolerance) {
    const ps_problem problem = problem_of(at, tolerance);
    return self->engine->survey(&problem, ps_device_get_limits(device), self->precision).error;
}

static void check_shape(tried *self, const sweep *at, size_t s, double tolerance,
                        const double *found, const void *state) {
    const double *expected = at->expected + s * at->grid.num;
    const double formula = self->engine->error_of_state(state, at->power[s], 0);
    const double likely_power = 1.05; /* white sets, up to chance */
    const bool is_promised = formula <= tolerance || at->power[s] <= likely_power;
    const double at_one = self->engine->error_of_state(state, 1, 0);
    double error = 0;
    for (size_t i = 0; i < at->grid.num; i++) {
        error += pow(sqrt(found[i]) - sqrt(expected[i]), 2) / (double)at->grid.num;
    }
    error = sqrt(2 * error / at->squares[s]);
    if (error > 0) {
        self->slack[s] = fmin(self->slack[s], formula / error);
    }
    const bool is_kept =
        error <= formula && (at_one > tolerance || !is_promised || error <= tolerance);
    if (!is_kept || (at->what->is_shown && fabs(remainder(log10(tolerance), 2)) < 0.01)) {
        print_message("%-12s %-6s %-15s tolerance %.0e error %.2e bound %.2e%s\n",
                      self->engine->name, ps_precision_name(self->precision), test_shapes[s].name,
                      tolerance, error, formula, at_one > tolerance ? " refused" : "");
    }
    if (!is_kept) {
        print_message("ABOVE: d=%u N=%zu K=%d power %.2g\n", at->what->dimension,
                      at->what->num_points, (int)at->what->k, at->power[s]);
        self->is_kept = false;
    }
}

/* Nothing new where an engine does not look at the tolerance. */
static bool is_as_before(const tried *self, const sweep *at, double tolerance, double before) {
    return before > 0 && strcmp(self->engine->name, "torus_nufft") != 0 &&
           error_at_one(self, at, tolerance) == error_at_one(self, at, before);
}

static void sweep_tolerances(tried *self, const sweep *at) {
    double before = 0;
    const int last = (int)(log10(most / least) * at->what->steps_per_decade + 0.5);
    for (int i = 0; i <= last; i++) {
        const double tolerance = most * pow(10, -i / at->what->steps_per_decade);
        const ps_problem problem = problem_of(at, tolerance);
        /* A little beyond what the engine can do, to see it say so. */
        const bool is_hopeless = error_at_one(self, at, tolerance) > 4 * tolerance && before > 0;
        if (is_hopeless || is_as_before(self, at, tolerance, before)) {
            continue;
        }
        double *found = test_run_engine_to(self->engine, self->precision, tolerance, device,
                                           &at->grid, at->patterns, TEST_SHAPES, TEST_SHAPES);
        void *state = NULL;
        assert_ok(
            ps_engine_create(self->engine, &state, &problem, self->precision, 1, device, error));
        for (size_t s = 0; s < TEST_SHAPES; s++) {
            check_shape(self, at, s, tolerance, found + s * at->grid.num, state);
        }
        ps_engine_destroy(self->engine, state);
        free(found);
        before = tolerance;
    }
}

static void check_engine(const ps_engine *engine, ps_precision precision) {
    tried self = {.engine = engine, .precision = precision, .is_kept = true};
    for (unsigned dimension = 1; dimension <= 3; dimension++) {
        for (size_t s = 0; s < TEST_SHAPES; s++) {
            self.slack[s] = HUGE_VAL;
        }
        for (size_t i = 0; i < NUM_CASES; i++) {
            const ps_problem problem = problem_of(&sweeps[i], most);
            if (cases[i].dimension == dimension &&
                engine->survey(&problem, ps_device_get_limits(device), precision).why_not == NULL) {
                sweep_tolerances(&self, &sweeps[i]);
            }
        }
        for (size_t s = 0; s < TEST_SHAPES; s++) {
            print_message("%-12s %-6s d=%u %-15s smallest slack %.2f\n", engine->name,
                          ps_precision_name(precision), dimension, test_shapes[s].name,
                          self.slack[s]);
        }
    }
    assert_true(self.is_kept);
}

static void check_engines(ps_precision precision) {
    if (precision == PS_DOUBLE && !ps_device_get_limits(device)->has_fp64) {
        skip();
    }
    for (size_t i = 0; ps_engines[i] != NULL; i++) {
        if (ps_engines[i]->domains & PS_ON_TORUS && ps_engines[i]->has_precision[precision]) {
            check_engine(ps_engines[i], precision);
        }
    }
}

static void single_precision(void **state) {
    (void)state;
    check_engines(PS_SINGLE);
}

static void double_precision(void **state) {
    (void)state;
    check_engines(PS_DOUBLE);
}

/* ---- the planner ------------------------------------------------------------------------- */

static void check_plan(const ps_problem *problem, const ps_plan_constraints *constraints) {
    ps_plan plan = {0};
    ps_error failure = {0};
    bool could_be = false;
    assert_ok(ps_plan_make(&plan, problem, ps_device_get_limits(device), constraints, error));
    for (size_t i = 0; i < plan.num_candidates; i++) {
        const ps_candidate *one = &plan.candidates[i];
        could_be = could_be ||
                   (one->is_applicable && !one->is_excluded && one->error <= problem->tolerance);
        assert_true(!one->is_feasible || one->error <= problem->tolerance);
    }
    assert_true((plan.chosen != NULL) == could_be);
    assert_int_equal(ps_plan_require(&plan, problem, &failure),
                     could_be ? PSPEC_OK : PSPEC_ERROR_TOLERANCE);
}

/* By every engine and precision alone, and freely. */
static void plans(void **state) {
    (void)state;
    for (size_t i = 0; i < NUM_CASES; i++) {
        for (int step = 0; step <= 18; step++) {
            const ps_problem problem = problem_of(&sweeps[i], most * pow(10, -step));
            check_plan(&problem, &(ps_plan_constraints){.precision = -1});
            check_plan(&problem,
                       &(ps_plan_constraints){.engine = "torus_nufft", .precision = PS_SINGLE});
            if (ps_device_get_limits(device)->has_fp64) {
                check_plan(&problem,
                           &(ps_plan_constraints){.engine = "torus_nufft", .precision = PS_DOUBLE});
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plans),
        cmocka_unit_test(single_precision),
        cmocka_unit_test(double_precision),
    };
    device = test_open_device();
    const int failures =
        cmocka_run_group_tests_name("tolerance_sweep", tests, make_sweeps, free_sweeps);
    ps_device_close(device);
    return failures;
}
