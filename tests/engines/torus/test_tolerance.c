/* The tolerance contract: the error formula of every engine holds, for sets unlike white noise too.
 *
 * Powers give | |S| - |S_ref| |, the part of dS along S. Rounding errors have no preferred
 * direction, so sqrt(2) times its root mean square stands for |dS|.
 */
#include "harness.h"

#include "engines/host/host_direct.h"
#include "engines/engine.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NUM_POINTS = 1000 };

static ps_device *device;

typedef struct shape {
    const char *name;
    double (*coordinate)(size_t point, unsigned axis, uint64_t *state);
    double (*weight)(size_t point, uint64_t *state); /* NULL: unit weights */
} shape;

static double white(size_t point, unsigned axis, uint64_t *state) {
    (void)point;
    (void)axis;
    return test_uniform(state);
}

static double jittered(size_t point, unsigned axis, uint64_t *state) {
    const size_t cells = 32; /* 1024 cells, the last 24 empty */
    const size_t cell = axis % 2 == 0 ? point / cells : point % cells;
    return ((double)cell + test_uniform(state)) / (double)cells;
}

static double lattice(size_t point, unsigned axis, uint64_t *state) {
    (void)state;
    return fmod((double)point * (axis % 2 == 0 ? 1 : 17) / NUM_POINTS, 1.0);
}

/* Sorted in one dimension: every run of points adds up in step at low frequencies, S does not. */
static double sorted(size_t point, unsigned axis, uint64_t *state) {
    (void)axis;
    return ((double)point + test_uniform(state)) / NUM_POINTS;
}

static double one_place(size_t point, unsigned axis, uint64_t *state) {
    (void)point;
    (void)state;
    return axis % 2 == 0 ? 0.3183098861837907 : 0.7071067811865476;
}

static double near_zero(size_t point, unsigned axis, uint64_t *state) {
    (void)point;
    (void)axis;
    return test_uniform(state) * 0x1p-20;
}

static double signed_weight(size_t point, uint64_t *state) {
    (void)point;
    return 2 * test_uniform(state) - 0.9;
}

static double wild_weight(size_t point, uint64_t *state) {
    (void)point;
    const double decades = 24;
    return pow(10, decades * (test_uniform(state) - 0.5));
}

static const shape shapes[] = {
    {"white", white, NULL},
    {"jittered", jittered, NULL},
    {"lattice", lattice, NULL},
    {"one place", one_place, NULL},
    {"near zero", near_zero, NULL},
    {"signed weights", white, signed_weight},
    {"wild weights", white, wild_weight},
};

typedef struct measured {
    double error, formula; /* in units of sqrt(sum w^2) */
} measured;

static double sum_of_squares(const pspec_pattern *pattern) {
    double sum = 0;
    for (size_t j = 0; j < pattern->num_points; j++) {
        const double weight = pattern->weights != NULL ? pattern->weights[j] : 1;
        sum += weight * weight;
    }
    return sum;
}

static measured measure(const ps_frequencies *set, const pspec_pattern *pattern,
                        ps_precision precision) {
    double *found = test_run_engine(&ps_torus_direct, precision, device, set, pattern, 1, 1);
    double *expected = test_run_engine(&ps_host_direct, PS_EXTENDED, NULL, set, pattern, 1, 1);
    const double squares = sum_of_squares(pattern);
    const double num = (double)set->num;
    double error = 0;
    double power = 0;
    for (size_t i = 0; i < set->num; i++) {
        error += pow(sqrt(found[i]) - sqrt(expected[i]), 2) / num / squares;
        power += expected[i] / num / squares;
    }
    const ps_problem problem = {
        .frequencies = set, .num_points = pattern->num_points, .tolerance = 1};
    free(found);
    free(expected);
    return (measured){sqrt(2 * error),
                      test_engine_error(&ps_torus_direct, &problem, precision, device, power)};
}

static pspec_pattern make_pattern(const shape *what, unsigned dimension, size_t num_points) {
    uint64_t state = 7;
    double *points = calloc(num_points * dimension, sizeof(double));
    double *weights = what->weight != NULL ? calloc(num_points, sizeof(double)) : NULL;
    for (size_t j = 0; j < num_points; j++) {
        for (unsigned axis = 0; axis < dimension; axis++) {
            points[j * dimension + axis] = what->coordinate(j, axis, &state);
        }
        if (weights != NULL) {
            weights[j] = what->weight(j, &state);
        }
    }
    test_normalize_weights(weights, weights != NULL ? num_points : 0);
    return (pspec_pattern){dimension, num_points, points, weights};
}

static void free_pattern(pspec_pattern *pattern) {
    free((void *)pattern->points);
    free((void *)pattern->weights);
}

static void check(const shape *what, const ps_frequencies *set, size_t num_points,
                  ps_precision precision) {
    pspec_pattern pattern = make_pattern(what, set->dimension, num_points);
    const measured result = measure(set, &pattern, precision);
    print_message("%-15s d=%u N=%-5zu %-6s error %.2e formula %.2e slack %.2f\n", what->name,
                  set->dimension, num_points, ps_precision_name(precision), result.error,
                  result.formula, result.formula / result.error);
    assert_true(result.error <= result.formula);
    free_pattern(&pattern);
}

static ps_frequencies make_list(unsigned dimension, size_t num, int32_t reach) {
    uint64_t state = 3;
    int32_t *vectors = calloc(num * dimension, sizeof(int32_t));
    ps_frequencies set = {0};
    for (size_t i = 0; i < num * dimension; i++) {
        vectors[i] = (int32_t)((2 * test_uniform(&state) - 1) * reach);
    }
    assert_ok(ps_frequencies_list(&set, dimension, num, vectors, error));
    return set;
}

static void check_shapes(ps_precision precision) {
    if (precision == PS_DOUBLE && !ps_device_get_limits(device)->has_fp64) {
        skip();
    }
    ps_frequencies grid = {0};
    assert_ok(ps_frequencies_lattice(&grid, 2, 12, false, error));
    assert_ok(ps_frequencies_enumerate(&grid, error));
    ps_frequencies list = make_list(2, 100, 1000000);
    ps_frequencies far = make_list(3, 100, PS_MAX_FREQUENCY);
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; i++) {
        check(&shapes[i], &grid, NUM_POINTS, precision);
        check(&shapes[i], &list, NUM_POINTS, precision);
        check(&shapes[i], &far, NUM_POINTS, precision);
    }
    ps_frequencies_free(&grid);
    ps_frequencies_free(&list);
    ps_frequencies_free(&far);
}

static void single_precision(void **state) {
    (void)state;
    check_shapes(PS_SINGLE);
}

static void double_precision(void **state) {
    (void)state;
    check_shapes(PS_DOUBLE);
}

/* Sizes around runs, chunks and slabs; the formula does not depend on N. */
static void numbers_of_points(void **state) {
    (void)state;
    static const size_t sizes[] = {1, 2, 7, 8, 9, 31, 32, 33, 1023, 1024, 1025, 65537};
    ps_frequencies list = make_list(1, 24, 5000);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        check(&shapes[0], &list, sizes[i], PS_SINGLE);
        if (ps_device_get_limits(device)->has_fp64) {
            check(&shapes[0], &list, sizes[i], PS_DOUBLE);
        }
    }
    ps_frequencies_free(&list);
}

static void sorted_points(void **state) {
    (void)state;
    const shape what = {"sorted", sorted, NULL};
    static const int32_t reaches[] = {1, 2, 4, 10, 100};
    for (size_t i = 0; i < sizeof reaches / sizeof reaches[0]; i++) {
        ps_frequencies grid = {0};
        assert_ok(ps_frequencies_lattice(&grid, 1, reaches[i], false, error));
        assert_ok(ps_frequencies_enumerate(&grid, error));
        check(&what, &grid, NUM_POINTS, PS_SINGLE);
        if (ps_device_get_limits(device)->has_fp64) {
            check(&what, &grid, NUM_POINTS, PS_DOUBLE);
        }
        ps_frequencies_free(&grid);
        ps_frequencies list = make_list(1, 14, reaches[i] + 1);
        check(&what, &list, NUM_POINTS, PS_SINGLE);
        ps_frequencies_free(&list);
    }
}

/* Products by the model of matrix units (names end in *): zeros behind the last point, and second
 * sums, of which N decides, as in the formula. */
static void check_by_units(const shape *what, const ps_frequencies *grid, size_t num_points,
                           ps_precision precision) {
    char name[32];
    shape by_units = *what;
    snprintf(name, sizeof name, "%s*", what->name);
    by_units.name = name;
    check(&by_units, grid, num_points, precision);
}

static void matrix_units(void **state) {
    static const size_t sizes[] = {1, 17, 129, NUM_POINTS};
    const size_t most_points = 4096;
    ps_frequencies grid = {0};
    (void)state;
    assert_ok(ps_frequencies_lattice(&grid, 2, 12, false, error));
    assert_ok(ps_frequencies_enumerate(&grid, error));
    ps_device_set_dedicated_local_memory(device, true);
    ps_device_set_units(device, PS_UNITS_EMULATED);
    for (int p = PS_SINGLE; p <= (ps_device_get_limits(device)->has_fp64 ? PS_DOUBLE : PS_SINGLE);
         p++) {
        for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; i++) {
            for (size_t n = 0; n < sizeof sizes / sizeof sizes[0]; n++) {
                check_by_units(&shapes[i], &grid, sizes[n], (ps_precision)p);
            }
        }
        check_by_units(&shapes[0], &grid, most_points, (ps_precision)p);
    }
    ps_device_set_units(device, PS_UNITS_NONE);
    ps_device_set_dedicated_local_memory(device, false);
    ps_frequencies_free(&grid);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sorted_points),    cmocka_unit_test(single_precision),
        cmocka_unit_test(double_precision), cmocka_unit_test(numbers_of_points),
        cmocka_unit_test(matrix_units),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("tolerance", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
