/* The streaming estimator: bits that depend on nothing but the realizations, laws of the periodogram,
 * different numbers of points, weights, refused memory, the self-check.
 */
#include "harness.h"

#include "engines/host_direct.h"
#include "engines/torus_direct.h"
#include "job/estimator.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;

/* ---- fixtures ---------------------------------------------------------------------------- */

typedef struct sample {
    size_t num;
    pspec_pattern *patterns;
} sample;

/* num white patterns of first, first + step, ... points. */
static sample make_sample(size_t num, unsigned dimension, size_t first, size_t step,
                          bool weighted) {
    uint64_t state = 11;
    sample out = {num, calloc(num, sizeof(pspec_pattern))};
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

static void free_sample(sample *what) {
    for (size_t r = 0; r < what->num; r++) {
        free((void *)what->patterns[r].points);
        free((void *)what->patterns[r].weights);
    }
    free(what->patterns);
}

static ps_frequencies make_lattice(unsigned dimension, int32_t k, bool ball) {
    ps_frequencies set = {0};
    assert_ok(ps_frequencies_lattice(&set, dimension, k, ball, error));
    assert_ok(ps_frequencies_enumerate(&set, error));
    return set;
}

static ps_estimator_options make_options(const ps_frequencies *set, const ps_engine *engine,
                                         ps_precision precision, size_t num_points, size_t batch) {
    return (ps_estimator_options){
        .problem = {.frequencies = set, .num_points = num_points, .tolerance = 1},
        .engine = engine,
        .precision = precision,
        .batch = batch,
        .want_frequencies = true,
        .self_check = true};
}

/* Spectrum of the sample, given to the estimator `at_a_time` realizations at once. */
static ps_spectrum estimate(const ps_estimator_options *options, const sample *what,
                            size_t at_a_time) {
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

static bool is_same_bits(const ps_spectrum *a, const ps_spectrum *b) {
    assert_int_equal(a->num_bins, b->num_bins);
    assert_int_equal(a->frequencies.num, b->frequencies.num);
    return memcmp(a->bins, b->bins, a->num_bins * sizeof *a->bins) == 0 &&
           memcmp(a->powers, b->powers, a->frequencies.num * sizeof *a->powers) == 0;
}

/* ---- same bits --------------------------------------------------------------------------- */

static void check_bits(const ps_frequencies *set, const ps_engine *engine, ps_precision precision) {
    static const size_t batches[] = {1, 2, 7, 16, 23, 64};
    static const size_t group_sizes[] = {1, 3, 64};
    sample what = make_sample(23, set->dimension, 40, 3, true);
    ps_estimator_options options = make_options(set, engine, precision, 200, 23);
    ps_spectrum first = estimate(&options, &what, 23);
    for (size_t i = 0; i < sizeof batches / sizeof batches[0]; i++) {
        options.batch = batches[i];
        ps_spectrum again = estimate(&options, &what, i % 2 == 0 ? 23 : 5);
        assert_true(is_same_bits(&first, &again));
        ps_spectrum_free(&again);
    }
    for (size_t i = 0; i < sizeof group_sizes / sizeof group_sizes[0]; i++) {
        ps_device_set_group_size(device, group_sizes[i]);
        ps_spectrum again = estimate(&options, &what, 23);
        assert_true(is_same_bits(&first, &again));
        ps_spectrum_free(&again);
    }
    ps_device_set_group_size(device, 0);
    ps_spectrum_free(&first);
    free_sample(&what);
}

static void same_bits_for_every_batch(void **state) {
    (void)state;
    const bool has_fp64 = ps_device_get_limits(device)->has_fp64;
    for (unsigned dimension = 1; dimension <= 3; dimension++) {
        ps_frequencies grid = make_lattice(dimension, dimension < 3 ? 9 : 4, dimension == 2);
        check_bits(&grid, &ps_torus_direct, PS_SINGLE);
        if (has_fp64) {
            check_bits(&grid, &ps_torus_direct, PS_DOUBLE);
        }
        ps_frequencies_free(&grid);
    }
    ps_frequencies grid = make_lattice(2, 5, true);
    check_bits(&grid, &ps_host_direct, PS_EXTENDED);
    ps_frequencies_free(&grid);
}

/* Several chunks and slabs: N is far above both, and differs from set to set. */
static void same_bits_for_large_sets(void **state) {
    (void)state;
    ps_frequencies grid = make_lattice(2, 3, true);
    sample what = make_sample(3, 2, 70001, 1111, false);
    ps_estimator_options options = make_options(&grid, &ps_torus_direct, PS_SINGLE, 80000, 3);
    ps_spectrum first = estimate(&options, &what, 3);
    options.batch = 1;
    ps_spectrum second = estimate(&options, &what, 1);
    options.problem.num_points = 80000; /* reference N as before; the engine grows on its way */
    ps_spectrum third = estimate(&options, &what, 2);
    assert_true(is_same_bits(&first, &second));
    assert_true(is_same_bits(&first, &third));
    ps_spectrum_free(&first);
    ps_spectrum_free(&second);
    ps_spectrum_free(&third);
    free_sample(&what);
    ps_frequencies_free(&grid);
}

/* ---- laws -------------------------------------------------------------------------------- */

/* Largest | sqrt(P) - sqrt(P') | over frequencies: what a tolerance of S allows. */
static double root_distance(const ps_spectrum *a, const ps_spectrum *b) {
    double largest = 0;
    for (size_t i = 0; i < a->frequencies.num; i++) {
        largest = fmax(largest, fabs(sqrt(a->powers[i].mean) - sqrt(b->powers[i].mean)));
    }
    return largest;
}

static const double law_tolerance = 2e-6; /* a few single-precision errors of 2e-7 */

static void shifts_leave_the_power_unchanged(void **state) {
    (void)state;
    ps_frequencies grid = make_lattice(3, 5, false);
    sample what = make_sample(1, 3, 333, 0, true);
    const ps_estimator_options options = make_options(&grid, &ps_torus_direct, PS_SINGLE, 333, 1);
    ps_spectrum before = estimate(&options, &what, 1);
    double *points = (double *)what.patterns[0].points;
    for (size_t i = 0; i < (size_t)3 * 333; i++) {
        points[i] = fmod(points[i] + (i % 3 == 0 ? 0.4142135 : 0.7320508), 1.0);
    }
    ps_spectrum after = estimate(&options, &what, 1);
    assert_true(root_distance(&before, &after) < law_tolerance * 10); /* N/W^2 is large here */
    ps_spectrum_free(&before);
    ps_spectrum_free(&after);
    free_sample(&what);
    ps_frequencies_free(&grid);
}

static void equal_points_have_power_n(void **state) {
    (void)state;
    enum { N = 100 };
    ps_frequencies grid = make_lattice(2, 20, false);
    sample what = make_sample(2, 2, N, 0, false);
    for (size_t r = 0; r < 2; r++) {
        for (size_t i = 0; i < (size_t)2 * N; i++) {
            ((double *)what.patterns[r].points)[i] = i % 2 == 0 ? 0.123456789 : 0.987654321;
        }
    }
    const ps_estimator_options options = make_options(&grid, &ps_torus_direct, PS_SINGLE, N, 2);
    ps_spectrum spectrum = estimate(&options, &what, 2);
    for (size_t b = 0; b < spectrum.num_bins; b++) {
        assert_true(fabs(spectrum.bins[b].power / N - 1) < 2e-6);
        assert_true(spectrum.bins[b].standard_error == 0); /* equal realizations: exactly */
    }
    ps_spectrum_free(&spectrum);
    free_sample(&what);
    ps_frequencies_free(&grid);
}

/* Coincident points may be merged: weights add. */
static void merging_duplicates_changes_nothing(void **state) {
    (void)state;
    const double points[] = {0.1, 0.7, 0.3, 0.2, 0.1, 0.7};
    const double unit[] = {1, 1, 1};
    const double merged_points[] = {0.1, 0.7, 0.3, 0.2};
    const double merged[] = {2, 1};
    ps_frequencies grid = make_lattice(2, 6, false);
    pspec_pattern three[] = {{2, 3, points, unit}};
    pspec_pattern two[] = {{2, 2, merged_points, merged}};
    const ps_estimator_options options = make_options(&grid, &ps_torus_direct, PS_SINGLE, 3, 1);
    ps_spectrum a = estimate(&options, &(sample){1, three}, 1);
    ps_spectrum b = estimate(&options, &(sample){1, two}, 1);
    for (size_t i = 0; i < a.frequencies.num; i++) { /* N differs: compare P / N */
        assert_true(fabs(a.powers[i].mean / 3 - b.powers[i].mean / 2) < law_tolerance);
    }
    ps_spectrum_free(&a);
    ps_spectrum_free(&b);
    ps_frequencies_free(&grid);
}

/* Realizations of different N: mean(N) mean(|S|^2 / W^2), standard error likewise. */
static void different_numbers_of_points(void **state) {
    (void)state;
    enum { M = 9 };
    ps_frequencies grid = make_lattice(2, 4, false);
    sample what = make_sample(M, 2, 50, 17, true);
    double *squares =
        test_run_engine(&ps_host_direct, PS_EXTENDED, NULL, &grid, what.patterns, M, M);
    const ps_estimator_options options = make_options(&grid, &ps_torus_direct, PS_SINGLE, 50, M);
    ps_spectrum spectrum = estimate(&options, &what, M);
    double mean_points = 0;
    double inverse_w2[M] = {0};
    for (size_t r = 0; r < M; r++) {
        double sum = 0;
        for (size_t j = 0; j < what.patterns[r].num_points; j++) {
            sum += what.patterns[r].weights[j];
        }
        inverse_w2[r] = 1 / sum / sum;
        mean_points += (double)what.patterns[r].num_points;
    }
    mean_points /= M;
    assert_true(spectrum.mean_points == mean_points);
    assert_int_equal(spectrum.smallest_points, 50);
    assert_int_equal(spectrum.largest_points, 50 + 17 * (M - 1));
    for (size_t i = 0; i < grid.num; i++) {
        double mean = 0;
        double variance = 0;
        for (size_t r = 0; r < M; r++) {
            mean += squares[r * grid.num + i] * inverse_w2[r] / M;
        }
        for (size_t r = 0; r < M; r++) {
            variance += pow(squares[r * grid.num + i] * inverse_w2[r] - mean, 2) / (M - 1);
        }
        const double error = mean_points * sqrt(variance / M);
        assert_true(fabs(spectrum.powers[i].mean - mean_points * mean) < 1e-5 * mean_points * mean);
        assert_true(fabs(spectrum.powers[i].standard_error - error) < 1e-5 * error);
    }
    free(squares);
    ps_spectrum_free(&spectrum);
    free_sample(&what);
    ps_frequencies_free(&grid);
}

/* White noise, exactly at finite N: <P> = 1, Var P = (N-1)/N, variance of a ring mean of n_b lattice
 * points 2 (N-1) / (N n_b) (mathematics.md 1.2). 4 standard errors of the estimates. */
static void white_noise(void **state) {
    (void)state;
    enum { M = 4000, N = 5 };
    const double variance = (N - 1.0) / N;
    ps_frequencies grid = make_lattice(2, 6, true);
    sample what = make_sample(M, 2, N, 0, false);
    const ps_estimator_options options = make_options(&grid, &ps_torus_direct, PS_SINGLE, N, 500);
    ps_spectrum spectrum = estimate(&options, &what, M);
    double mean = 0;
    double measured = 0;
    for (size_t i = 0; i < grid.num; i++) {
        mean += spectrum.powers[i].mean / (double)grid.num;
        measured += pow(spectrum.powers[i].standard_error, 2) * M / (double)grid.num;
    }
    const double samples = (double)grid.num * M;
    assert_true(fabs(mean - 1) < 4 * sqrt(variance / samples));
    /* The fourth central moment of P is below 9, that of an exponential. */
    assert_true(fabs(measured - variance) < 4 * sqrt(9 / samples));
    for (size_t b = 0; b < spectrum.num_bins; b++) {
        const double expected = 2 * variance / (double)spectrum.bins[b].count;
        const double found = pow(spectrum.bins[b].standard_error, 2) * M;
        assert_true(fabs(found / expected - 1) < 4 * sqrt(9.0 / M));
        assert_true(fabs(spectrum.bins[b].power - 1) < 4 * spectrum.bins[b].standard_error);
        /* averaged noise: each frequency is exponential with mean 1 over M, up to sampling */
        const double noise_db = 10 * log10(variance / M);
        const double spread = 10 * sqrt(2 / ((double)spectrum.bins[b].count / 2 - 1));
        assert_true(fabs(spectrum.bins[b].anisotropy_db - noise_db) < 4 * spread);
    }
    ps_spectrum_free(&spectrum);
    free_sample(&what);
    ps_frequencies_free(&grid);
}

static void effective_normalization(void **state) {
    (void)state;
    ps_frequencies grid = make_lattice(1, 30, false);
    sample what = make_sample(2, 1, 64, 0, true);
    ps_estimator_options options = make_options(&grid, &ps_torus_direct, PS_SINGLE, 64, 2);
    ps_spectrum power = estimate(&options, &(sample){1, what.patterns}, 1);
    options.normalization = PSPEC_NORMALIZATION_EFFECTIVE;
    ps_spectrum effective = estimate(&options, &(sample){1, what.patterns}, 1);
    double sum = 0;
    double squares = 0;
    for (size_t j = 0; j < 64; j++) {
        sum += what.patterns[0].weights[j];
        squares += pow(what.patterns[0].weights[j], 2);
    }
    const double ratio = sum * sum / squares / 64; /* P_eff / P = ESS / N */
    for (size_t i = 0; i < grid.num; i++) {
        assert_true(fabs(effective.powers[i].mean - ratio * power.powers[i].mean) <
                    1e-6 * effective.powers[i].mean);
        assert_true(isnan(effective.powers[i].standard_error)); /* one realization */
    }
    ps_spectrum_free(&power);
    ps_spectrum_free(&effective);
    free_sample(&what);
    ps_frequencies_free(&grid);
}

/* ---- bad input --------------------------------------------------------------------------- */

static pspec_status add_one(pspec_pattern pattern, pspec_normalization normalization,
                            ps_error *error) {
    ps_frequencies grid = make_lattice(2, 3, true);
    ps_estimator *estimator = NULL;
    ps_estimator_options options = make_options(&grid, &ps_torus_direct, PS_SINGLE, 4, 1);
    options.normalization = normalization;
    assert_int_equal(ps_estimator_create(&estimator, &options, device, error), PSPEC_OK);
    const pspec_status status = ps_estimator_add(estimator, &pattern, 1, error);
    ps_estimator_destroy(estimator);
    ps_frequencies_free(&grid);
    return status;
}

static void bad_patterns(void **state) {
    (void)state;
    const double good[] = {0.1, 0.2, 0.3, 0.4};
    const double outside[] = {0.1, 0.2, 1.0, 0.4};
    const double nan_point[] = {0.1, NAN, 0.3, 0.4};
    const double zero_sum[] = {1, -1};
    const double none[] = {0, 0};
    const double infinite[] = {1, INFINITY};
    const struct {
        pspec_pattern pattern;
        pspec_normalization normalization;
        const char *part;
    } cases[] = {
        {{2, 2, outside, NULL}, 0, "point 2: coordinate 1 "},
        {{2, 2, nan_point, NULL}, 0, "point 1: coordinate nan"},
        {{3, 1, good, NULL}, 0, "dimension 3 instead of 2"},
        {{2, 0, good, NULL}, 0, "no points"},
        {{2, 2, good, zero_sum}, 0, "--normalize effective"},
        {{2, 2, good, none}, PSPEC_NORMALIZATION_EFFECTIVE, "all weights are 0"},
        {{2, 2, good, infinite}, 0, "weight inf is not finite"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_error error = {0};
        assert_int_equal(add_one(cases[i].pattern, cases[i].normalization, &error),
                         PSPEC_ERROR_INPUT);
        if (strstr(error.message, cases[i].part) == NULL) {
            fail_msg("\"%s\" is not in \"%s\"", cases[i].part, error.message);
        }
    }
    ps_error error = {0};
    assert_int_equal(
        add_one((pspec_pattern){2, 2, good, zero_sum}, PSPEC_NORMALIZATION_EFFECTIVE, &error),
        PSPEC_OK);
}

/* ---- engines that misbehave -------------------------------------------------------------- */

enum { MOST_BATCH = 3 };

/* torus_direct on a device that refuses memory for more than MOST_BATCH realizations. */
static pspec_status create_small(void **state, const ps_problem *problem, ps_precision precision,
                                 size_t batch, ps_device *on, ps_error *error) {
    *state = NULL;
    return batch > MOST_BATCH ? ps_fail(error, PSPEC_ERROR_MEMORY, "refused")
                              : ps_torus_direct.create(state, problem, precision, batch, on, error);
}

static pspec_status refuse(void **state, const ps_problem *problem, ps_precision precision,
                           size_t batch, ps_device *on, ps_error *error) {
    (void)problem;
    (void)precision;
    (void)batch;
    (void)on;
    *state = NULL;
    return ps_fail(error, PSPEC_ERROR_MEMORY, "refused");
}

static void refused_memory_halves_the_batch(void **state) {
    (void)state;
    ps_engine small = ps_torus_direct;
    small.create = create_small;
    ps_frequencies grid = make_lattice(2, 6, true);
    sample what = make_sample(20, 2, 30, 0, false);
    ps_estimator_options options = make_options(&grid, &ps_torus_direct, PS_SINGLE, 30, 20);
    ps_spectrum expected = estimate(&options, &what, 20);
    options.engine = &small;
    ps_spectrum found = estimate(&options, &what, 20);
    assert_true(is_same_bits(&expected, &found));
    small.create = refuse;
    ps_estimator *estimator = NULL;
    ps_error error = {0};
    assert_int_equal(ps_estimator_create(&estimator, &options, device, &error), PSPEC_ERROR_MEMORY);
    assert_null(estimator);
    ps_spectrum_free(&expected);
    ps_spectrum_free(&found);
    free_sample(&what);
    ps_frequencies_free(&grid);
}

/* A driver that computes 1 % too much. */
static pspec_status run_wrongly(void *state, const ps_batch *batch, ps_rows *rows,
                                ps_error *error) {
    double scales[8];
    for (size_t r = 0; r < batch->num_patterns; r++) {
        scales[r] = batch->scales[r] * 1.01;
    }
    const ps_batch wrong = {batch->num_patterns, batch->patterns, scales};
    return ps_torus_direct.run(state, &wrong, rows, error);
}

static void the_self_check_finds_a_wrong_device(void **state) {
    (void)state;
    ps_engine wrong = ps_torus_direct;
    wrong.run = run_wrongly;
    ps_frequencies grid = make_lattice(2, 6, true);
    sample what = make_sample(2, 2, 30, 0, false);
    ps_estimator_options options = make_options(&grid, &wrong, PS_SINGLE, 30, 2);
    ps_estimator *estimator = NULL;
    ps_error error = {0};
    assert_ok(ps_estimator_create(&estimator, &options, device, error));
    assert_int_equal(ps_estimator_add(estimator, what.patterns, 2, &error), PSPEC_ERROR_CHECK);
    assert_non_null(strstr(error.message, "self-check failed"));
    ps_estimator_destroy(estimator);
    free_sample(&what);
    ps_frequencies_free(&grid);
}

static void nothing_added(void **state) {
    (void)state;
    ps_frequencies grid = make_lattice(2, 6, true);
    const ps_estimator_options options = make_options(&grid, &ps_torus_direct, PS_SINGLE, 30, 2);
    ps_estimator *estimator = NULL;
    ps_spectrum spectrum = {0};
    ps_error error = {0};
    assert_ok(ps_estimator_create(&estimator, &options, device, error));
    assert_int_equal(ps_estimator_spectrum(estimator, &spectrum, &error), PSPEC_ERROR_INPUT);
    ps_estimator_destroy(estimator);
    ps_frequencies_free(&grid);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_bits_for_every_batch),
        cmocka_unit_test(same_bits_for_large_sets),
        cmocka_unit_test(shifts_leave_the_power_unchanged),
        cmocka_unit_test(equal_points_have_power_n),
        cmocka_unit_test(merging_duplicates_changes_nothing),
        cmocka_unit_test(different_numbers_of_points),
        cmocka_unit_test(white_noise),
        cmocka_unit_test(effective_normalization),
        cmocka_unit_test(bad_patterns),
        cmocka_unit_test(refused_memory_halves_the_batch),
        cmocka_unit_test(the_self_check_finds_a_wrong_device),
        cmocka_unit_test(nothing_added),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("estimator", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
