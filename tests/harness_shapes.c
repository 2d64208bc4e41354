#include "harness_shapes.h"

#include <math.h>
#include <stdlib.h>

static double white(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    (void)point;
    (void)num_points;
    (void)axis;
    return test_uniform(state);
}

static double jittered(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    const size_t cells = (size_t)ceil(sqrt((double)num_points));
    const size_t cell = axis % 2 == 0 ? point / cells : point % cells;
    return ((double)cell + test_uniform(state)) / (double)cells;
}

static double lattice(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    (void)state;
    return fmod((double)point * (axis == 0 ? 1 : axis == 1 ? 17 : 113) / (double)num_points, 1.0);
}

static double one_place(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    (void)point;
    (void)num_points;
    (void)state;
    return axis % 2 == 0 ? 0.3183098861837907 : 0.7071067811865476;
}

/* Within a thousandth: a cell of grids with up to a few hundred frequencies. */
static double one_cell(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    const double side = 1e-3;
    return one_place(point, num_points, axis, state) + side * test_uniform(state);
}

static double near_zero(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    (void)point;
    (void)num_points;
    (void)axis;
    return test_uniform(state) * 0x1p-20;
}

/* Pairs of equal points. */
static double duplicates(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    uint64_t own = point / 2 * 2 + axis;
    (void)num_points;
    (void)state;
    return test_uniform(&own);
}

/* The first and the last coordinate there are, and cell boundaries. */
static double boundaries(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    static const double places[] = {0, 1 - 0x1p-32, 0.5, 0.25, 1 - 0x1p-53, 0x1p-64, 0.125};
    (void)num_points;
    (void)axis;
    (void)point;
    return places[(size_t)(test_uniform(state) * 7)];
}

static double signed_weight(size_t point, uint64_t *state) {
    (void)point;
    return 2 * test_uniform(state) - 0.9;
}

/* Of either sign, over twelve decades. */
static double wild_weight(size_t point, uint64_t *state) {
    const double decades = 12;
    return (point % 2 == 0 ? 1 : -1) * pow(10, decades * (test_uniform(state) - 0.5));
}

const test_shape test_shapes[TEST_SHAPES] = {
    {"white", white, NULL},
    {"jittered", jittered, NULL},
    {"lattice", lattice, NULL},
    {"one place", one_place, NULL},
    {"one cell", one_cell, NULL},
    {"near zero", near_zero, NULL},
    {"duplicates", duplicates, NULL},
    {"boundaries", boundaries, NULL},
    {"signed weights", white, signed_weight},
    {"wild weights", white, wild_weight},
};

pspec_pattern test_make_pattern(const test_shape *shape, unsigned dimension, size_t num_points,
                                uint64_t seed) {
    double *points = calloc(num_points * dimension, sizeof(double));
    double *weights = shape->weight != NULL ? calloc(num_points, sizeof(double)) : NULL;
    for (size_t j = 0; j < num_points; j++) {
        for (unsigned axis = 0; axis < dimension; axis++) {
            points[j * dimension + axis] = shape->coordinate(j, num_points, axis, &seed);
        }
        if (weights != NULL) {
            weights[j] = shape->weight(j, &seed);
        }
    }
    return (pspec_pattern){dimension, num_points, points, weights};
}

void test_free_pattern(pspec_pattern *pattern) {
    free((void *)pattern->points);
    free((void *)pattern->weights);
    *pattern = (pspec_pattern){0};
}

double test_sum_of_squares(const pspec_pattern *pattern) {
    double sum = 0;
    for (size_t j = 0; j < pattern->num_points; j++) {
        const double weight = pattern->weights != NULL ? pattern->weights[j] : 1;
        sum += weight * weight;
    }
    return sum;
}

ps_frequencies test_make_grid(unsigned dimension, int32_t max_frequency) {
    ps_frequencies grid = {0};
    assert_ok(ps_frequencies_lattice(&grid, dimension, max_frequency, false, error));
    assert_ok(ps_frequencies_enumerate(&grid, error));
    return grid;
}
