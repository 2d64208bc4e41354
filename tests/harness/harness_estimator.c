#include "harness_estimator.h"

#include <stdlib.h>
#include <string.h>

test_sample test_make_sample(size_t num, unsigned dimension, size_t first, size_t step,
                             bool weighted) {
    uint64_t state = 11;
    test_sample out = {num, calloc(num, sizeof(pspec_pattern))};
    for (size_t r = 0; r < num; r++) {
        const size_t n = first + r * step;
        double *points = calloc(n * dimension, sizeof(double));
        double *weights = weighted ? calloc(n, sizeof(double)) : NULL;
        for (size_t i = 0; i < n * dimension; i++) {
            points[i] = test_uniform(&state);
        }
        for (size_t j = 0; weighted && j < n; j++) {
            weights[j] = test_uniform(&state) - 0.25;
        }
        out.patterns[r] = (pspec_pattern){dimension, n, points, weights};
    }
    return out;
}

void test_free_sample(test_sample *what) {
    for (size_t r = 0; r < what->num; r++) {
        free((void *)what->patterns[r].points);
        free((void *)what->patterns[r].weights);
    }
    free(what->patterns);
}

ps_frequencies test_make_lattice(unsigned dimension, int32_t k, bool ball) {
    ps_frequencies set = {0};
    assert_ok(ps_frequencies_lattice(&set, dimension, k, ball, error));
    assert_ok(ps_frequencies_enumerate(&set, error));
    return set;
}

ps_estimator_options test_make_options(const ps_frequencies *set, const ps_engine *engine,
                                       ps_precision precision, size_t num_points, size_t batch) {
    return (ps_estimator_options){
        .problem = {.frequencies = set, .num_points = num_points, .tolerance = 1},
        .engine = engine,
        .precision = precision,
        .batch = batch,
        .want_frequencies = true,
        .self_check = true};
}

ps_spectrum test_estimate(const ps_estimator_options *options, const test_sample *what,
                          size_t at_a_time, ps_device *device) {
    ps_estimator *estimator = NULL;
    ps_spectrum spectrum = {0};
    assert_ok(ps_estimator_create(&estimator, options, device, error));
    for (size_t r = 0; r < what->num; r += at_a_time) {
        const size_t rest = what->num - r;
        assert_ok(ps_estimator_add(estimator, what->patterns + r,
                                   rest < at_a_time ? rest : at_a_time, error));
    }
    assert_ok(ps_estimator_spectrum(estimator, &spectrum, error));
    ps_estimator_destroy(estimator);
    return spectrum;
}

bool test_is_same_bits(const ps_spectrum *a, const ps_spectrum *b) {
    assert_int_equal(a->num_bins, b->num_bins);
    assert_int_equal(a->frequencies.num, b->frequencies.num);
    assert_int_equal(a->powers != NULL, b->powers != NULL);
    const size_t num_powers = a->powers != NULL ? a->frequencies.num : 0; /* degrees are bins */
    return memcmp(a->bins, b->bins, a->num_bins * sizeof *a->bins) == 0 &&
           (num_powers == 0 || memcmp(a->powers, b->powers, num_powers * sizeof *a->powers) == 0);
}
