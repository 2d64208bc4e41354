/* The kernels of sphere_nufft and of sphere_grid, one after the other as the engines run them, on
 * problems that are small enough for Oclgrind: a few realizations side by side, weights, poles,
 * both precisions, all degrees and even ones.
 */
#include "harness_sphere.h"

#include "engines/engine.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

enum { REALIZATIONS = 3, NUM_POINTS = 21 };

static ps_device *device;
static uint64_t seed = 31;

typedef struct sphere_case {
    int32_t max_degree;
    ps_precision precision;
    double tolerance;
    bool only_even;
    uint64_t expected; /* realizations: one alone has a kernel of its own */
} sphere_case;

static pspec_pattern make_pattern(void) {
    double *points = test_sphere_white_set(NUM_POINTS, &seed);
    double *weights = calloc(NUM_POINTS, sizeof(double));
    assert_non_null(weights);
    for (size_t j = 0; j < NUM_POINTS; j++) {
        weights[j] = test_uniform(&seed) - 0.3;
    }
    test_sphere_point(points, 0, 0, 1);
    test_sphere_point(points + 3, 0, 0, -1);
    test_sphere_point(points + 6, 1e-9, 1, 1);
    return (pspec_pattern){.num_points = NUM_POINTS, .points = points, .weights = weights};
}

/* sqrt(V) of the tolerance, V = sum w^2 (2l + 1)/(4 pi) over the degrees. */
static double white_noise(const pspec_pattern *pattern, const ps_frequencies *degrees) {
    double squares = 0;
    double num = 0;
    for (size_t j = 0; j < pattern->num_points; j++) {
        squares += pattern->weights[j] * pattern->weights[j];
    }
    for (size_t i = 0; i < degrees->num; i++) {
        num += 2 * degrees->vectors[i] + 1;
    }
    return sqrt(squares * num / PS_FOUR_PI);
}

/* Q(l) of the rows against the norm of the referee's coefficients, all degrees together. */
static double row_error(const pspec_pattern *pattern, const ps_frequencies *degrees,
                        const double *zeros, const double *row) {
    double sum = 0;
    for (size_t i = 0; i < degrees->num; i++) {
        const int32_t l = degrees->vectors[i];
        const double exact = sqrt(test_degree_error(zeros, degrees->max_frequency, l, pattern));
        const double found = sqrt(row[i] * (2 * l + 1) / PS_FOUR_PI);
        sum += (found - exact) * (found - exact);
    }
    return sqrt(sum);
}

/* An engine in one of its layouts. */
typedef struct engine_layout {
    const ps_engine *engine;
    bool of_gpus;
} engine_layout;

static void check_case(const engine_layout *how, const sphere_case *what) {
    const ps_engine *const engine = how->engine;
    if (!ps_device_get_limits(device)->has_fp64) {
        return; /* needed in single precision, too */
    }
    ps_device_set_dedicated_local_memory(device, how->of_gpus);
    ps_frequencies degrees = test_degrees(what->max_degree, what->only_even);
    const ps_problem problem = {.frequencies = &degrees,
                                .num_points = NUM_POINTS,
                                .num_realizations = what->expected,
                                .has_weights = true,
                                .tolerance = what->tolerance};
    const size_t L = (size_t)what->max_degree;
    double *zeros = calloc((L + 1) * (L + 2), sizeof(double));
    pspec_pattern patterns[REALIZATIONS];
    double scales[REALIZATIONS];
    int exponents[REALIZATIONS];
    void *state = NULL;
    ps_rows rows = {0};
    assert_non_null(zeros);
    for (size_t r = 0; r < REALIZATIONS; r++) {
        patterns[r] = make_pattern();
        scales[r] = 1;
        exponents[r] = 0;
    }
    const ps_batch batch = {.num_patterns = REALIZATIONS,
                            .patterns = patterns,
                            .scales = scales,
                            .exponents = exponents};
    assert_ok(
        ps_engine_create(engine, &state, &problem, what->precision, REALIZATIONS, device, error));
    assert_ok(engine->run(state, &batch, &rows, error));
    assert_ok(ps_rows_wait(&rows, error));
    for (size_t r = 0; r < REALIZATIONS; r++) {
        const double limit = what->tolerance * white_noise(&patterns[r], &degrees);
        const double off =
            row_error(&patterns[r], &degrees, zeros, (const double *)rows.host + r * rows.stride);
        if (!(off <= limit)) {
            fail_msg("L = %d, realization %zu: %g, allowed %g", (int)what->max_degree, r, off,
                     limit);
        }
        free((double *)patterns[r].points);
        free((double *)patterns[r].weights);
    }
    ps_engine_destroy(engine, state);
    ps_frequencies_free(&degrees);
    free(zeros);
}

static void single(void **state) {
    check_case(*state, &(sphere_case){5, PS_SINGLE, 1e-3, false, REALIZATIONS});
    check_case(*state, &(sphere_case){6, PS_SINGLE, 1e-5, true, REALIZATIONS});
}

static void double_precision(void **state) {
    check_case(*state, &(sphere_case){4, PS_DOUBLE, 1e-9, false, REALIZATIONS});
    check_case(*state, &(sphere_case){6, PS_DOUBLE, 1e-6, true, REALIZATIONS});
}

static void one_by_one(void **state) {
    check_case(*state, &(sphere_case){40, PS_SINGLE, 1e-4, false, 1});
    check_case(*state, &(sphere_case){7, PS_DOUBLE, 1e-9, true, 1});
}

int main(void) {
    static engine_layout rings = {&ps_sphere_nufft, false}, gridded = {&ps_sphere_nufft, true};
    static engine_layout cells = {&ps_sphere_grid, false};
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(single, &rings),
                                       cmocka_unit_test_prestate(double_precision, &rings),
                                       cmocka_unit_test_prestate(one_by_one, &rings),
                                       cmocka_unit_test_prestate(single, &gridded),
                                       cmocka_unit_test_prestate(double_precision, &gridded),
                                       cmocka_unit_test_prestate(one_by_one, &gridded),
                                       cmocka_unit_test_prestate(single, &cells),
                                       cmocka_unit_test_prestate(double_precision, &cells)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernels_sphere_nufft", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
