/* The tolerance contract on the sphere from the planner to the coefficients, eight tolerances to a
 * decade, sets of every kind against the referee: each engine and precision that the planner would
 * take has an error below what it announces for the power of the set, and where that power was
 * known beforehand, this is below the tolerance. Where nothing is chosen, nothing could be, and it
 * is refused.
 */
#include "harness_sphere.h"
#include "harness_sphere_shapes.h"

#include "math/pi.h"
#include "plan/choose.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;

typedef struct problem_case {
    int32_t max_degree;
    bool only_even;
    size_t num_points;
    double steps_per_decade;  /* planned as for white noise */
    double steps_with_powers; /* planned for the power of each set */
} problem_case;

static const problem_case cases[] = {
    {20, false, 150, 8, 1}, {21, true, 150, 1, 0}, {12, false, 2000, 1, 0}};

static const double most = 1e-2;
enum { DECADES = 10, SHAPES = TEST_SPHERE_SHAPES + 1 };

/* A lattice on one circle of latitude, as many points as the set has. */
static void circle(const ps_stress_spot *at, double u[3]) {
    const double theta = 0.8;
    const double phi = PS_TWO_PI * (double)at->point / (double)at->num_points;
    u[0] = sin(theta) * cos(phi);
    u[1] = sin(theta) * sin(phi);
    u[2] = cos(theta);
}

static const test_sphere_shape one_circle = {"circle", .place = circle};

/* A set with the truth. */
typedef struct sample {
    const char *name;
    pspec_pattern pattern;
    double *expected;
    double power; /* mean effective power */
} sample;

/* Smallest bound / error of an engine and a precision. */
typedef struct record {
    const char *engine;
    ps_precision precision;
    unsigned num_runs;
    double slack;
} record;

typedef struct sweep {
    const problem_case *what;
    ps_frequencies degrees;
    sample samples[SHAPES];
    record records[PS_MAX_CANDIDATES];
} sweep;

static int32_t step_of(const sweep *self) {
    return self->degrees.degree_step;
}

static void make_sweep(sweep *self, const problem_case *what) {
    *self = (sweep){.what = what, .degrees = test_degrees(what->max_degree, what->only_even)};
    for (size_t s = 0; s < SHAPES; s++) {
        const test_sphere_shape *shape =
            s < TEST_SPHERE_SHAPES ? &test_sphere_shapes[s] : &one_circle;
        sample *one = &self->samples[s];
        one->name = shape->name;
        one->pattern = test_make_sphere_pattern(shape, what->num_points, 3);
        one->expected =
            test_sphere_coefficients(&one->pattern, self->degrees.max_frequency, step_of(self));
        test_sphere_error(one->expected, one->expected, self->degrees.max_frequency, step_of(self),
                          &one->pattern, &one->power);
    }
}

static void free_sweep(sweep *self) {
    for (size_t s = 0; s < SHAPES; s++) {
        free(self->samples[s].expected);
        test_free_sphere_pattern(&self->samples[s].pattern);
    }
    ps_frequencies_free(&self->degrees);
}

/* ---- one candidate ----------------------------------------------------------------------- */

static void check_sample(sweep *self, const sample *one, const ps_problem *problem,
                         const ps_candidate *candidate, void *state, record *smallest) {
    const size_t L = (size_t)self->degrees.max_frequency;
    double *found = calloc((L + 1) * (L + 2), sizeof *found);
    double power = 0;
    assert_ok(candidate->engine->coefficients(
        state, &(ps_batch){.num_patterns = 1, .patterns = &one->pattern}, NULL, found, error));
    const double error =
        test_sphere_error(found, one->expected, (int32_t)L, step_of(self), &one->pattern, &power);
    const double bound =
        candidate->engine->error_of_state(state, one->power, problem->weight_share);
    const bool is_promised = problem->expected_power > 0 || one->power <= 1;
    if (!(error <= bound) || (is_promised && !(bound <= problem->tolerance))) {
        fail_msg("%s L=%zu N=%zu power %.3g, %s %s, tolerance %.2e: error %.2e, bound %.2e",
                 one->name, L, self->what->num_points, one->power, candidate->engine->name,
                 ps_precision_name(candidate->precision), problem->tolerance, error, bound);
    }
    smallest->slack = error > 0 ? fmin(smallest->slack, bound / error) : smallest->slack;
    smallest->num_runs++;
    free(found);
}

/* only: NULL, or the sample that the problem knows the power of. */
static void check_candidate(sweep *self, const ps_problem *problem, const ps_candidate *candidate,
                            const sample *only, record *smallest) {
    void *state = NULL;
    if (smallest->num_runs > 0 && strcmp(smallest->engine, "sphere_direct") == 0) {
        return; /* it does not look at the tolerance */
    }
    if (smallest->num_runs == 0) {
        *smallest = (record){candidate->engine->name, candidate->precision, 0, HUGE_VAL};
    }
    assert_ok(ps_engine_create(candidate->engine, &state, problem, candidate->precision,
                               candidate->batch, device, error));
    for (size_t s = 0; s < SHAPES; s++) {
        if (only == NULL || only == &self->samples[s]) {
            check_sample(self, &self->samples[s], problem, candidate, state, smallest);
        }
    }
    ps_engine_destroy(candidate->engine, state);
}

/* ---- plans ------------------------------------------------------------------------------- */

static void check_choice(const ps_plan *plan, const ps_problem *problem) {
    ps_error failure = {0};
    bool could_be = false;
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *one = &plan->candidates[i];
        assert_true(one->is_feasible == (one->is_applicable &&
                                         one->error <= problem->tolerance)); /* memory is plenty */
        could_be = could_be || one->is_feasible;
    }
    assert_true((plan->chosen != NULL) == could_be);
    assert_int_equal(ps_plan_require(plan, problem, &failure),
                     could_be ? PSPEC_OK : PSPEC_ERROR_TOLERANCE);
}

/* For a set whose power is known, or for white noise (NULL) and all sets. */
static void check_tolerance(sweep *self, double tolerance, const sample *only) {
    const ps_plan_constraints free_choice = {.precision = -1};
    const ps_problem problem = {.frequencies = &self->degrees,
                                .num_points = self->what->num_points,
                                .num_realizations = 1,
                                .has_weights = true,
                                .tolerance = tolerance,
                                .expected_power = only != NULL ? only->power : 0};
    ps_plan plan = {0};
    assert_ok(ps_plan_make(&plan, &problem, ps_device_get_limits(device), &free_choice, error));
    check_choice(&plan, &problem);
    for (size_t i = 0; i < plan.num_candidates; i++) {
        if (plan.candidates[i].is_feasible && plan.candidates[i].engine->needs_device) {
            check_candidate(self, &problem, &plan.candidates[i], only, &self->records[i]);
        }
    }
}

static void check_decades(sweep *self, double steps, const sample *only) {
    for (int i = 0; i <= (int)(DECADES * steps); i++) {
        check_tolerance(self, most * pow(10, -i / steps), only);
    }
}

static void print_records(const sweep *self) {
    for (size_t i = 0; i < PS_MAX_CANDIDATES; i++) {
        const record *one = &self->records[i];
        if (one->num_runs > 0) {
            print_message("%-13s %-7s L=%d N=%zu: %u sets, smallest slack %.2f\n", one->engine,
                          ps_precision_name(one->precision), (int)self->what->max_degree,
                          self->what->num_points, one->num_runs, one->slack);
        }
    }
}

static void every_tolerance(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        sweep self;
        make_sweep(&self, &cases[i]);
        check_decades(&self, cases[i].steps_per_decade, NULL);
        for (size_t s = 0; s < SHAPES && cases[i].steps_with_powers > 0; s++) {
            if (self.samples[s].power > 1) {
                check_decades(&self, cases[i].steps_with_powers, &self.samples[s]);
            }
        }
        print_records(&self);
        free_sweep(&self);
    }
}

/* A tolerance beyond all, and engines that alone are not good enough. */
static void refusals(void **state) {
    (void)state;
    ps_frequencies degrees = test_degrees(20, false);
    for (size_t i = 0; ps_engines[i] != NULL; i++) {
        if (!(ps_engines[i]->domains & PS_ON_SPHERE) || ps_engines[i]->sums_pairs) {
            continue;
        }
        const ps_plan_constraints alone = {.engine = ps_engines[i]->name, .precision = -1};
        const ps_problem problem = {
            .frequencies = &degrees, .num_points = 150, .num_realizations = 1, .tolerance = 1e-20};
        ps_plan plan = {0};
        ps_error failure = {0};
        assert_ok(ps_plan_make(&plan, &problem, ps_device_get_limits(device), &alone, error));
        assert_null(plan.chosen);
        assert_int_equal(ps_plan_require(&plan, &problem, &failure), PSPEC_ERROR_TOLERANCE);
    }
    ps_frequencies_free(&degrees);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_tolerance),
        cmocka_unit_test(refusals),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("sphere_tolerance", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
