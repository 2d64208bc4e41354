/* sphere_nufft and sphere_grid against sums in extended precision: sets of every kind, degrees
 * beside whole vectors, exact values of others. (tests/engines/test_engine_contract.c has what all
 * engines promise.)
 */
#include "harness_sphere.h"
#include "harness_sphere_shapes.h"

#include "engines/engine.h"

#include <math.h>
#include <stdlib.h>

static ps_device *device;
static const ps_engine *engine; /* of the test */

typedef struct sphere_case {
    int32_t max_degree;
    ps_precision precision;
    double tolerance;
    bool only_even;
} sphere_case;

/* Degrees at and beside whole vectors and runs of orders_chains.h; the smallest there are; two
 * whose rings are not all by differences where a set is alone. */
static const sphere_case cases[] = {
    {1, PS_SINGLE, 1e-4, false},   {2, PS_SINGLE, 1e-3, false},   {3, PS_SINGLE, 1e-6, false},
    {2, PS_SINGLE, 1e-5, true},    {7, PS_SINGLE, 1e-2, false},   {15, PS_SINGLE, 1e-5, false},
    {32, PS_SINGLE, 1e-5, false},  {33, PS_SINGLE, 1e-4, true},   {61, PS_SINGLE, 1e-6, false},
    {1, PS_DOUBLE, 1e-12, false},  {16, PS_DOUBLE, 1e-9, false},  {31, PS_DOUBLE, 1e-12, true},
    {64, PS_DOUBLE, 1e-6, false},  {67, PS_DOUBLE, 1e-13, false}, {130, PS_DOUBLE, 1e-12, false},
    {150, PS_SINGLE, 1e-5, true}, /* grids in strips */
    {300, PS_DOUBLE, 1e-10, true}, {301, PS_SINGLE, 1e-4, false},
};

enum { NUM_CASES = sizeof cases / sizeof cases[0] };

static bool can_run(const sphere_case *what) {
    (void)what;
    return ps_device_get_limits(device)->has_fp64; /* needed in single precision, too */
}

static ps_frequencies degrees_of(const sphere_case *what) {
    ps_frequencies set;
    assert_ok(ps_frequencies_degrees(&set, what->max_degree, what->only_even, error));
    assert_ok(ps_frequencies_enumerate(&set, error));
    return set;
}

/* A set alone and sets among others have kernels of their own. */
static bool is_alone(const sphere_case *what) {
    return what->max_degree % 3 == 0;
}

static ps_problem problem_of(const sphere_case *what, const ps_frequencies *set,
                             size_t num_points) {
    return (ps_problem){.frequencies = set,
                        .num_points = num_points,
                        .num_realizations = is_alone(what) ? 1 : 100,
                        .has_weights = true,
                        .tolerance = what->tolerance};
}

/* ---- against the referee ----------------------------------------------------------------- */

static double *run_coefficients(const ps_problem *problem, ps_precision precision,
                                const pspec_pattern *pattern) {
    const size_t L = (size_t)problem->frequencies->max_frequency;
    double *found = calloc((L + 1) * (L + 2), sizeof(double));
    void *state = NULL;
    assert_ok(ps_engine_create(engine, &state, problem, precision, 1, device, error));
    assert_ok(engine->coefficients(state, &(ps_batch){.num_patterns = 1, .patterns = pattern}, NULL,
                                   found, error));
    ps_engine_destroy(engine, state);
    return found;
}

static void check_shape(const sphere_case *what, const test_sphere_shape *shape,
                        size_t num_points) {
    const int32_t step = what->only_even ? 2 : 1;
    ps_frequencies set = degrees_of(what);
    pspec_pattern pattern = test_make_sphere_pattern(shape, num_points, 5);
    const ps_problem problem = problem_of(what, &set, num_points);
    double *found = run_coefficients(&problem, what->precision, &pattern);
    double *expected = test_sphere_coefficients(&pattern, set.max_frequency, step);
    double power = 0;
    const double error =
        test_sphere_error(found, expected, set.max_frequency, step, &pattern, &power);
    const double bound = test_engine_error(engine, &problem, what->precision, device, power);
    if (!(error <= bound)) {
        fail_msg("L=%d N=%zu %s tolerance %.0e %s: error %.2e, bound %.2e", (int)what->max_degree,
                 num_points, ps_precision_name(what->precision), what->tolerance, shape->name,
                 error, bound);
    }
    free(found);
    free(expected);
    test_free_sphere_pattern(&pattern);
    ps_frequencies_free(&set);
}

/* The contract has what is below this degree, of sets among others. */
static void agrees_with_the_referee(void **state) {
    enum { HIGH = 300, POINTS = 200, POINTS_AT_HIGH = 50 };
    engine = *state;
    for (size_t i = 0; i < NUM_CASES; i++) {
        const bool is_high = cases[i].max_degree >= HIGH;
        const bool is_asked = can_run(&cases[i]) && (is_high || is_alone(&cases[i]));
        for (size_t s = 0; s < TEST_SPHERE_SHAPES && is_asked; s++) {
            check_shape(&cases[i], &test_sphere_shapes[s], is_high ? POINTS_AT_HIGH : POINTS);
        }
    }
}

/* Only the direction of a vector counts. */
static void lengths_do_not_count(void **state) {
    engine = *state;
    const sphere_case what = {20, PS_DOUBLE, 1e-12, false};
    if (!can_run(&what)) {
        skip();
    }
    ps_frequencies set = degrees_of(&what);
    pspec_pattern pattern = test_make_sphere_pattern(&test_sphere_shapes[0], 50, 5);
    const ps_problem problem = problem_of(&what, &set, 50);
    double *expected = test_run_problem(engine, &problem, PS_DOUBLE, device, &pattern, 1, 1);
    double *longer = calloc(3 * pattern.num_points, sizeof(double));
    for (size_t i = 0; i < 3 * pattern.num_points; i++) {
        longer[i] = pattern.points[i] * (1 + 1e-6);
    }
    const pspec_pattern other = {.num_points = pattern.num_points, .points = longer};
    double *found = test_run_problem(engine, &problem, PS_DOUBLE, device, &other, 1, 1);
    for (size_t i = 0; i < set.num; i++) {
        assert_true(fabs(found[i] - expected[i]) <= 1e-11 * (1 + expected[i]));
    }
    free(found);
    free(expected);
    free(longer);
    test_free_sphere_pattern(&pattern);
    ps_frequencies_free(&set);
}

/* ---- hemispheres ------------------------------------------------------------------------- */

/* Even degrees, to the bit, are those of the whole sphere up to the same degree. (Not of
 * sphere_grid, which adds a point and the one opposite to it for them.) */
static void hemisphere_is_half_of_the_sphere(void **state) {
    engine = *state;
    for (size_t i = 0; i < NUM_CASES; i++) {
        sphere_case what = cases[i];
        if (!can_run(&what) || what.max_degree % 2 != 0) {
            continue;
        }
        pspec_pattern pattern = test_make_sphere_pattern(&test_sphere_shapes[0], 60, 5);
        what.only_even = false;
        ps_frequencies all = degrees_of(&what);
        what.only_even = true;
        ps_frequencies even = degrees_of(&what);
        const ps_problem whole = problem_of(&what, &all, 60);
        const ps_problem half = problem_of(&what, &even, 60);
        double *expected = test_run_problem(engine, &whole, what.precision, device, &pattern, 1, 1);
        double *found = test_run_problem(engine, &half, what.precision, device, &pattern, 1, 1);
        for (size_t j = 0; j < even.num; j++) {
            assert_memory_equal(&found[j], &expected[2 * j + 1], sizeof(double));
        }
        free(found);
        free(expected);
        test_free_sphere_pattern(&pattern);
        ps_frequencies_free(&all);
        ps_frequencies_free(&even);
    }
}

/* ---- exact values ------------------------------------------------------------------------ */

/* Q(l) to l = 2000, errors of its root by error(); of one degree, which may be off by more than the
 * mean. */
static void check_exact(const test_set *set, const sphere_case *what) {
    const double of_one_degree = 4;
    ps_frequencies degrees = degrees_of(what);
    const pspec_pattern pattern = test_pattern(set);
    const ps_problem problem = problem_of(what, &degrees, set->num_points);
    if (engine->survey(&problem, ps_device_get_limits(device), what->precision).why_not != NULL) {
        ps_frequencies_free(&degrees);
        return; /* the table of L = 2000 is too large */
    }
    double *found = test_run_problem(engine, &problem, what->precision, device, &pattern, 1, 1);
    const double bound =
        of_one_degree * sqrt(set->weight_square_sum) *
        test_engine_error(engine, &problem, what->precision, device, (double)set->num_points);
    const cJSON *row;
    cJSON_ArrayForEach(row, cJSON_GetObjectItem(set->json, "pl")) {
        const int l = cJSON_GetArrayItem(row, 0)->valueint;
        const double q = fmax(0, test_number(cJSON_GetArrayItem(row, 1)));
        if (l == 0 || l > what->max_degree) {
            continue;
        }
        const double error = fabs(sqrt(found[l - 1]) - sqrt(q));
        if (!(error <= bound)) {
            fail_msg("%s l=%d: Q %.17g instead of %.17g, bound of the root %.2e", set->name, l,
                     found[l - 1], q, bound);
        }
    }
    free(found);
    ps_frequencies_free(&degrees);
}

static void agrees_with_exact_values(void **state) {
    engine = *state;
    static const sphere_case exact[] = {{2000, PS_DOUBLE, 1e-11, false},
                                        {2000, PS_SINGLE, 1e-4, false},
                                        {64, PS_DOUBLE, 1e-13, false}};
    cJSON *json = test_read_reference("sphere.json");
    const cJSON *item;
    cJSON_ArrayForEach(item, cJSON_GetObjectItem(json, "sets")) {
        test_set set = test_read_sphere_set(item);
        for (size_t i = 0; i < sizeof exact / sizeof exact[0] && can_run(&exact[i]); i++) {
            check_exact(&set, &exact[i]);
        }
        free(set.points);
        free(set.weights);
    }
    cJSON_Delete(json);
}

int main(void) {
    void *const nufft = (void *)(uintptr_t)&ps_sphere_nufft; /* cmocka's states are not constant */
    void *const grid = (void *)(uintptr_t)&ps_sphere_grid;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(agrees_with_the_referee, nufft),
        cmocka_unit_test_prestate(lengths_do_not_count, nufft),
        cmocka_unit_test_prestate(hemisphere_is_half_of_the_sphere, nufft),
        cmocka_unit_test_prestate(agrees_with_exact_values, nufft),
        cmocka_unit_test_prestate(agrees_with_the_referee, grid),
        cmocka_unit_test_prestate(lengths_do_not_count, grid),
        cmocka_unit_test_prestate(agrees_with_exact_values, grid),
    };
    device = test_open_device();
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    ps_device_close(device);
    return failed;
}
