/* S(k) of sets on the torus beside a spectrum: against long double, of the same sums, to the bit;
 * of every realization, in order.
 */
#include "harness_estimator.h"

#include "engines/engine.h"
#include "engines/host/host_direct.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct job_case {
    const ps_engine *engine;
    ps_precision precision;
    double tolerance; /* of S, in sqrt(V) */
} job_case;

static const job_case cases[] = {{&ps_host_direct, PS_EXTENDED, 1e-15},
                                 {&ps_torus_direct, PS_SINGLE, 2e-6},
                                 {&ps_torus_direct, PS_DOUBLE, 5e-15}};
enum { NUM_CASES = sizeof cases / sizeof cases[0], NUM_SETS = 3 };

static ps_device *device;

/* What the job keeps of them. */
typedef struct kept {
    const ps_frequencies *set;
    const pspec_pattern *patterns;
    double tolerance;
    size_t num;
    double *last; /* [set->num][2] */
} kept;

static void check_one(const kept *seen, const pspec_pattern *pattern, const double *found) {
    double squares = 0;
    for (size_t j = 0; j < pattern->num_points; j++) {
        const double weight = pattern->weights != NULL ? pattern->weights[j] : 1;
        squares += weight * weight;
    }
    for (size_t i = 0; i < seen->set->num; i++) {
        long double re = 0;
        long double im = 0;
        for (size_t j = 0; j < pattern->num_points; j++) {
            long double turns = 0;
            for (unsigned axis = 0; axis < pattern->dimension; axis++) {
                turns += (long double)seen->set->vectors[i * pattern->dimension + axis] *
                         pattern->points[j * pattern->dimension + axis];
            }
            const long double angle =
                6.283185307179586476925286766559005768L * (turns - rintl(turns));
            const long double weight = pattern->weights != NULL ? pattern->weights[j] : 1;
            re += weight * cosl(angle);
            im -= weight * sinl(angle);
        }
        const double off = hypot(found[2 * i] - (double)re, found[2 * i + 1] - (double)im);
        if (!(off <= seen->tolerance * sqrt(squares) * 4)) {
            fail_msg("S of frequency %zu is %.17g, %.17g instead of %.17g, %.17g", i, found[2 * i],
                     found[2 * i + 1], (double)re, (double)im);
        }
    }
}

static pspec_status keep(void *payload, const double *coefficients, double weight_sum,
                         ps_error *inner) {
    kept *seen = payload;
    const pspec_pattern *pattern = &seen->patterns[seen->num];
    double sum = 0;
    (void)inner;
    for (size_t j = 0; j < pattern->num_points; j++) {
        sum += pattern->weights != NULL ? pattern->weights[j] : 1;
    }
    assert_true(fabs(weight_sum / sum - 1) < 1e-13);
    check_one(seen, pattern, coefficients);
    memcpy(seen->last, coefficients, 2 * seen->set->num * sizeof *coefficients);
    seen->num++;
    return PSPEC_OK;
}

/* With coefficients and without, powers have the same bits; alone, coefficients have. */
static void check_set(const ps_frequencies *set, size_t num_points, bool has_weights) {
    test_sample what = test_make_sample(NUM_SETS, set->dimension, num_points, 3, has_weights);
    for (size_t i = 0; i < NUM_CASES; i++) {
        ps_estimator *plain = NULL;
        ps_estimator *both = NULL;
        ps_spectrum expected;
        ps_spectrum found;
        double *alone = calloc(2 * set->num, sizeof *alone);
        kept seen = {set, what.patterns, cases[i].tolerance, 0,
                     calloc(2 * set->num, sizeof *alone)};
        ps_estimator_options options =
            test_make_options(set, cases[i].engine, cases[i].precision, num_points + 9, 2);
        options.problem.has_weights = has_weights;
        assert_ok(ps_estimator_create(&plain, &options, device, error));
        options.batch = 1;
        options.problem.harmonics = PS_EXPONENTIALS;
        options.coefficients = calloc(2 * set->num, sizeof *alone);
        options.keep = keep;
        options.payload = &seen;
        assert_ok(ps_estimator_create(&both, &options, device, error));
        assert_ok(ps_estimator_add(plain, what.patterns, NUM_SETS, error));
        assert_ok(ps_estimator_add(both, what.patterns, NUM_SETS, error));
        assert_int_equal(seen.num, NUM_SETS);
        assert_ok(ps_estimator_spectrum(plain, &expected, error));
        assert_ok(ps_estimator_spectrum(both, &found, error));
        assert_true(test_is_same_bits(&expected, &found));
        assert_ok(ps_estimator_coefficients(plain, &what.patterns[NUM_SETS - 1], PS_EXPONENTIALS,
                                            alone, error));
        assert_memory_equal(alone, seen.last, 2 * set->num * sizeof *alone);
        ps_spectrum_free(&expected);
        ps_spectrum_free(&found);
        ps_estimator_destroy(plain);
        ps_estimator_destroy(both);
        free(options.coefficients);
        free(seen.last);
        free(alone);
    }
    test_free_sample(&what);
}

static void grids(void **state) {
    (void)state;
    static const int32_t largest[] = {40, 9, 4, 2, 1, 1};
    for (unsigned dimension = 1; dimension <= PS_MAX_DIMENSION; dimension++) {
        for (int is_ball = 0; is_ball < 2; is_ball++) {
            ps_frequencies set = {0};
            assert_ok(ps_frequencies_lattice(&set, dimension, largest[dimension - 1], is_ball != 0,
                                             error));
            assert_ok(ps_frequencies_enumerate(&set, error));
            check_set(&set, 60, dimension % 2 != 0);
            ps_frequencies_free(&set);
        }
    }
}

/* More points than a slab of the tables. */
static void slabs(void **state) {
    (void)state;
    ps_frequencies set = {0};
    assert_ok(ps_frequencies_lattice(&set, 2, 2, false, error));
    assert_ok(ps_frequencies_enumerate(&set, error));
    check_set(&set, 2500, true);
    ps_frequencies_free(&set);
}

static void lists(void **state) {
    (void)state;
    const int32_t vectors[] = {0, 0, 0, 1, -2, 3, 1000, 7, -9, 1, 1, 1, -5, 0, 2};
    ps_frequencies set = {0};
    int32_t *copy = malloc(sizeof vectors);
    memcpy(copy, vectors, sizeof vectors);
    assert_ok(ps_frequencies_list(&set, 3, 5, copy, error));
    check_set(&set, 60, true);
    ps_frequencies_free(&set);
}

/* The planner takes an engine that has them, and one realization at a time. */
static void plans(void **state) {
    (void)state;
    ps_frequencies set = {0};
    ps_plan plan;
    assert_ok(ps_frequencies_lattice(&set, 2, 16, false, error));
    const ps_plan_constraints constraints = {.precision = -1};
    ps_problem problem = {
        .frequencies = &set, .num_points = 256, .num_realizations = 100, .tolerance = 1e-6};
    for (int wants = 0; wants < 2; wants++) {
        problem.harmonics = wants ? PS_EXPONENTIALS : PS_NO_HARMONICS;
        assert_ok(ps_plan_make(&plan, &problem, ps_device_get_limits(device), &constraints, error));
        assert_non_null(plan.chosen);
        assert_true(wants ? plan.chosen->engine->coefficients != NULL && plan.chosen->batch == 1
                          : plan.chosen->engine->coefficients == NULL && plan.chosen->batch > 1);
    }
    ps_frequencies_free(&set);
}

static int open_device(void **state) {
    (void)state;
    device = test_open_device();
    return device == NULL;
}

static int close_device(void **state) {
    (void)state;
    ps_device_close(device);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grids),
        cmocka_unit_test(slabs),
        cmocka_unit_test(lists),
        cmocka_unit_test(plans),
    };
    return cmocka_run_group_tests_name("torus_coefficients", tests, open_device, close_device);
}
