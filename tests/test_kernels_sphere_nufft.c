/* The kernels of sphere_nufft, one after the other as the engine runs them, on problems that are small enough for
 * Oclgrind: a few realizations side by side, weights, poles, both precisions, all degrees and even ones.
 */
#include "harness_sphere.h"

#include "engines/sphere_nufft.h"

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
    const double four_pi = 4 * acos(-1.0);
    double squares = 0;
    double num = 0;
    for (size_t j = 0; j < pattern->num_points; j++) {
        squares += pattern->weights[j] * pattern->weights[j];
    }
    for (size_t i = 0; i < degrees->num; i++) {
        num += 2 * degrees->vectors[i] + 1;
    }
    return sqrt(squares * num / four_pi);
}

/* Q(l) of the rows against the norm of the referee's coefficients, all degrees together. */
static double row_error(const pspec_pattern *pattern, const ps_frequencies *degrees,
                        const double *zeros, const double *row) {
    const double four_pi = 4 * acos(-1.0);
    double sum = 0;
    for (size_t i = 0; i < degrees->num; i++) {
        const int32_t l = degrees->vectors[i];
        const double exact = sqrt(test_degree_error(zeros, degrees->max_frequency, l, pattern));
        const double found = sqrt(row[i] * (2 * l + 1) / four_pi);
        sum += (found - exact) * (found - exact);
    }
    return sqrt(sum);
}

static void check_case(const sphere_case *what) {
    if (!ps_device_get_limits(device)->has_fp64) {
        return; /* needed in single precision, too */
    }
    ps_frequencies degrees = test_degrees(what->max_degree, what->only_even);
    const ps_problem problem = {.frequencies = &degrees,
                                .num_points = NUM_POINTS,
                                .num_realizations = REALIZATIONS,
                                .has_weights = true,
                                .tolerance = what->tolerance};
    const size_t L = (size_t)what->max_degree;
    double *zeros = calloc((L + 1) * (L + 2), sizeof(double));
    pspec_pattern patterns[REALIZATIONS];
    double scales[REALIZATIONS];
    int exponents[REALIZATIONS];
    void *engine = NULL;
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
        ps_sphere_nufft.create(&engine, &problem, what->precision, REALIZATIONS, device, error));
    assert_ok(ps_sphere_nufft.run(engine, &batch, &rows, error));
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
    ps_sphere_nufft.destroy(engine);
    ps_frequencies_free(&degrees);
    free(zeros);
}

static void single(void **state) {
    (void)state;
    check_case(&(sphere_case){5, PS_SINGLE, 1e-3, false});
    check_case(&(sphere_case){6, PS_SINGLE, 1e-5, true});
}

static void double_precision(void **state) {
    (void)state;
    check_case(&(sphere_case){4, PS_DOUBLE, 1e-9, false});
    check_case(&(sphere_case){6, PS_DOUBLE, 1e-6, true});
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(single),
                                       cmocka_unit_test(double_precision)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernels_sphere_nufft", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
