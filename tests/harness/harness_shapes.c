#include "harness_shapes.h"

pspec_pattern test_make_pattern(const test_shape *shape, unsigned dimension, size_t num_points,
                                uint64_t seed) {
    pspec_pattern pattern;
    assert_ok(ps_stress_shape_make(shape, dimension, num_points, seed, &pattern, error));
    test_normalize_weights((double *)pattern.weights, pattern.weights != NULL ? num_points : 0);
    return pattern;
}

void test_free_pattern(pspec_pattern *pattern) {
    ps_stress_pattern_free(pattern);
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
