/* The streaming estimator: laws of the periodogram, different numbers of points, weights. */
#include "harness_estimator.h"

#include "engines/host/host_direct.h"
#include "engines/engine.h"

#include <math.h>
#include <stdlib.h>

static ps_device *device;

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
    ps_frequencies grid = test_make_lattice(3, 5, false);
    test_sample what = test_make_sample(1, 3, 333, 0, true);
    const ps_estimator_options options =
        test_make_options(&grid, &ps_torus_direct, PS_SINGLE, 333, 1);
    ps_spectrum before = test_estimate(&options, &what, 1, device);
    double *points = (double *)what.patterns[0].points;
    for (size_t i = 0; i < (size_t)3 * 333; i++) {
        points[i] = fmod(points[i] + (i % 3 == 0 ? 0.4142135 : 0.7320508), 1.0);
    }
    ps_spectrum after = test_estimate(&options, &what, 1, device);
    assert_true(root_distance(&before, &after) < law_tolerance * 10); /* N/W^2 is large here */
    ps_spectrum_free(&before);
    ps_spectrum_free(&after);
    test_free_sample(&what);
    ps_frequencies_free(&grid);
}

static void equal_points_have_power_n(void **state) {
    (void)state;
    enum { N = 100 };
    ps_frequencies grid = test_make_lattice(2, 20, false);
    test_sample what = test_make_sample(2, 2, N, 0, false);
    for (size_t r = 0; r < 2; r++) {
        for (size_t i = 0; i < (size_t)2 * N; i++) {
            ((double *)what.patterns[r].points)[i] = i % 2 == 0 ? 0.123456789 : 0.987654321;
        }
    }
    const ps_estimator_options options =
        test_make_options(&grid, &ps_torus_direct, PS_SINGLE, N, 2);
    ps_spectrum spectrum = test_estimate(&options, &what, 2, device);
    for (size_t b = 0; b < spectrum.num_bins; b++) {
        assert_true(fabs(spectrum.bins[b].power / N - 1) < 2e-6);
        assert_true(spectrum.bins[b].standard_error == 0); /* equal realizations: exactly */
    }
    ps_spectrum_free(&spectrum);
    test_free_sample(&what);
    ps_frequencies_free(&grid);
}

/* Coincident points may be merged: weights add. */
static void merging_duplicates_changes_nothing(void **state) {
    (void)state;
    const double points[] = {0.1, 0.7, 0.3, 0.2, 0.1, 0.7};
    const double unit[] = {1, 1, 1};
    const double merged_points[] = {0.1, 0.7, 0.3, 0.2};
    const double merged[] = {2, 1};
    ps_frequencies grid = test_make_lattice(2, 6, false);
    pspec_pattern three[] = {{2, 3, points, unit}};
    pspec_pattern two[] = {{2, 2, merged_points, merged}};
    const ps_estimator_options options =
        test_make_options(&grid, &ps_torus_direct, PS_SINGLE, 3, 1);
    ps_spectrum a = test_estimate(&options, &(test_sample){1, three}, 1, device);
    ps_spectrum b = test_estimate(&options, &(test_sample){1, two}, 1, device);
    for (size_t i = 0; i < a.frequencies.num; i++) { /* N differs: compare P / N */
        assert_true(fabs(a.powers[i].mean / 3 - b.powers[i].mean / 2) < law_tolerance);
    }
    ps_spectrum_free(&a);
    ps_spectrum_free(&b);
    ps_frequencies_free(&grid);
}

/* Realizations of different N: the mean of N |S|^2 / W^2, or mean(N) mean(|S|^2 / W^2); standard
 * errors likewise. */
static void check_different_points(pspec_normalization normalization) {
    enum { M = 9 };
    ps_frequencies grid = test_make_lattice(2, 4, false);
    test_sample what = test_make_sample(M, 2, 50, 17, true);
    double *squares =
        test_run_engine(&ps_host_direct, PS_EXTENDED, NULL, &grid, what.patterns, M, M);
    ps_estimator_options options = test_make_options(&grid, &ps_torus_direct, PS_SINGLE, 50, M);
    options.normalization = normalization;
    ps_spectrum spectrum = test_estimate(&options, &what, M, device);
    double mean_points = 0;
    double factors[M] = {0};
    for (size_t r = 0; r < M; r++) {
        double sum = 0;
        for (size_t j = 0; j < what.patterns[r].num_points; j++) {
            sum += what.patterns[r].weights[j];
        }
        factors[r] = 1 / sum / sum;
        mean_points += (double)what.patterns[r].num_points / M;
    }
    for (size_t r = 0; r < M; r++) {
        factors[r] *= normalization == PSPEC_NORMALIZATION_INTEGRAL
                          ? mean_points
                          : (double)what.patterns[r].num_points;
    }
    assert_true(fabs(spectrum.mean_points - mean_points) < 1e-12 * mean_points);
    assert_true(fabs(spectrum.points_error - 17 * sqrt(7.5 / M)) < 1e-12 * mean_points);
    assert_int_equal(spectrum.smallest_points, 50);
    assert_int_equal(spectrum.largest_points, 50 + 17 * (M - 1));
    for (size_t i = 0; i < grid.num; i++) {
        double mean = 0;
        double variance = 0;
        for (size_t r = 0; r < M; r++) {
            mean += squares[r * grid.num + i] * factors[r] / M;
        }
        for (size_t r = 0; r < M; r++) {
            variance += pow(squares[r * grid.num + i] * factors[r] - mean, 2) / (M - 1);
        }
        const double error = sqrt(variance / M);
        assert_true(fabs(spectrum.powers[i].mean - mean) < 1e-5 * mean);
        assert_true(fabs(spectrum.powers[i].standard_error - error) < 1e-5 * error);
    }
    free(squares);
    ps_spectrum_free(&spectrum);
    test_free_sample(&what);
    ps_frequencies_free(&grid);
}

static void different_numbers_of_points(void **state) {
    (void)state;
    check_different_points(PSPEC_NORMALIZATION_POWER);
    check_different_points(PSPEC_NORMALIZATION_INTEGRAL);
}

/* White noise, exactly at finite N: <P> = 1, Var P = (N-1)/N, variance of a ring mean of n_b
 * lattice points 2 (N-1) / (N n_b) (docs/mathematics/torus.md#white-noise). 4 standard errors of
 * the estimates. */
static void white_noise(void **state) {
    (void)state;
    enum { M = 4000, N = 5 };
    const double variance = (N - 1.0) / N;
    ps_frequencies grid = test_make_lattice(2, 6, true);
    test_sample what = test_make_sample(M, 2, N, 0, false);
    const ps_estimator_options options =
        test_make_options(&grid, &ps_torus_direct, PS_SINGLE, N, 500);
    ps_spectrum spectrum = test_estimate(&options, &what, M, device);
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
    test_free_sample(&what);
    ps_frequencies_free(&grid);
}

/* Weights times a power of two, far outside the range of float, change no bit of the powers. */
static void weights_of_any_size(void **state) {
    (void)state;
    static const int exponents[] = {900, 130, -130, -900};
    ps_frequencies grid = test_make_lattice(2, 7, false);
    test_sample what = test_make_sample(3, 2, 64, 0, true);
    const ps_estimator_options options =
        test_make_options(&grid, &ps_torus_direct, PS_SINGLE, 64, 3);
    ps_spectrum expected = test_estimate(&options, &what, 3, device);
    for (size_t i = 0; i < sizeof exponents / sizeof exponents[0]; i++) {
        test_sample scaled = test_make_sample(3, 2, 64, 0, true);
        for (size_t j = 0; j < 64; j++) { /* of the second set only: realizations are independent */
            double *weights = (double *)scaled.patterns[1].weights;
            weights[j] = ldexp(weights[j], exponents[i]);
        }
        ps_spectrum found = test_estimate(&options, &scaled, 3, device);
        assert_true(test_is_same_bits(&expected, &found));
        ps_spectrum_free(&found);
        test_free_sample(&scaled);
    }
    ps_spectrum_free(&expected);
    test_free_sample(&what);
    ps_frequencies_free(&grid);
}

static void effective_normalization(void **state) {
    (void)state;
    ps_frequencies grid = test_make_lattice(1, 30, false);
    test_sample what = test_make_sample(2, 1, 64, 0, true);
    ps_estimator_options options = test_make_options(&grid, &ps_torus_direct, PS_SINGLE, 64, 2);
    ps_spectrum power = test_estimate(&options, &(test_sample){1, what.patterns}, 1, device);
    options.normalization = PSPEC_NORMALIZATION_EFFECTIVE;
    ps_spectrum effective = test_estimate(&options, &(test_sample){1, what.patterns}, 1, device);
    double sum = 0;
    double squares = 0;
    for (size_t j = 0; j < 64; j++) {
        sum += what.patterns[0].weights[j];
        squares += pow(what.patterns[0].weights[j], 2);
    }
    const double ratio = sum * sum / squares / 64; /* P_eff / P = ESS / N */
    assert_true(fabs(effective.sample_size.mean / (64 * ratio) - 1) < 1e-14);
    for (size_t i = 0; i < grid.num; i++) {
        assert_true(fabs(effective.powers[i].mean - ratio * power.powers[i].mean) <
                    1e-6 * effective.powers[i].mean);
        assert_true(isnan(effective.powers[i].standard_error)); /* one realization */
    }
    ps_spectrum_free(&power);
    ps_spectrum_free(&effective);
    test_free_sample(&what);
    ps_frequencies_free(&grid);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shifts_leave_the_power_unchanged),
        cmocka_unit_test(equal_points_have_power_n),
        cmocka_unit_test(merging_duplicates_changes_nothing),
        cmocka_unit_test(different_numbers_of_points),
        cmocka_unit_test(white_noise),
        cmocka_unit_test(weights_of_any_size),
        cmocka_unit_test(effective_normalization),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("estimator_laws", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
