/* The streaming estimator: bits that depend on nothing but the realizations. */
#include "harness_estimator.h"

#include "engines/host/host_direct.h"
#include "engines/engine.h"

#include <math.h>

static ps_device *device;

/* ---- same bits --------------------------------------------------------------------------- */

static void check_bits(const ps_frequencies *set, const ps_engine *engine, ps_precision precision) {
    static const size_t batches[] = {1, 2, 7, 16, 23, 64};
    static const size_t group_sizes[] = {1, 3, 64};
    test_sample what = test_make_sample(23, set->dimension, 40, 3, true);
    ps_estimator_options options = test_make_options(set, engine, precision, 200, 23);
    ps_spectrum first = test_estimate(&options, &what, 23, device);
    for (size_t i = 0; i < sizeof batches / sizeof batches[0]; i++) {
        options.batch = batches[i];
        ps_spectrum again = test_estimate(&options, &what, i % 2 == 0 ? 23 : 5, device);
        assert_true(test_is_same_bits(&first, &again));
        ps_spectrum_free(&again);
    }
    for (size_t i = 0; i < sizeof group_sizes / sizeof group_sizes[0]; i++) {
        ps_device_set_group_size(device, group_sizes[i]);
        ps_spectrum again = test_estimate(&options, &what, 23, device);
        assert_true(test_is_same_bits(&first, &again));
        ps_spectrum_free(&again);
    }
    ps_device_set_group_size(device, 0);
    ps_spectrum_free(&first);
    test_free_sample(&what);
}

static void same_bits_for_every_batch(void **state) {
    (void)state;
    const bool has_fp64 = ps_device_get_limits(device)->has_fp64;
    for (unsigned dimension = 1; dimension <= 3; dimension++) {
        ps_frequencies grid = test_make_lattice(dimension, dimension < 3 ? 9 : 4, dimension == 2);
        check_bits(&grid, &ps_torus_direct, PS_SINGLE);
        if (has_fp64) {
            check_bits(&grid, &ps_torus_direct, PS_DOUBLE);
        }
        ps_frequencies_free(&grid);
    }
    ps_frequencies grid = test_make_lattice(2, 5, true);
    check_bits(&grid, &ps_host_direct, PS_EXTENDED);
    ps_frequencies_free(&grid);
}

/* A device that allows no buffer larger than a row of powers: sums of all modes and of their
 * squares, four times as much, are in several. */
static void same_bits_in_small_buffers(void **state) {
    (void)state;
    ps_frequencies grid = test_make_lattice(2, 100, false);
    test_sample what = test_make_sample(3, 2, 200, 0, false);
    ps_estimator_options options = test_make_options(&grid, &ps_torus_nufft, PS_SINGLE, 200, 1);
    options.problem.num_realizations = what.num;
    options.problem.tolerance = 1e-3;
    for (int mean_only = 0; mean_only < 2; mean_only++) {
        options.mean_only = mean_only == 1;
        ps_spectrum first = test_estimate(&options, &what, 3, device);
        const ps_work work =
            ps_torus_nufft.survey(&options.problem, ps_device_get_limits(device), PS_SINGLE).work;
        ps_device_set_max_allocation(device, (uint64_t)work.row_bytes);
        ps_spectrum again = test_estimate(&options, &what, 3, device);
        ps_device_set_max_allocation(device, 0);
        assert_true(test_is_same_bits(&first, &again));
        ps_spectrum_free(&first);
        ps_spectrum_free(&again);
    }
    test_free_sample(&what);
    ps_frequencies_free(&grid);
}

/* Several chunks and slabs: N is far above both, and differs from set to set. */
static void same_bits_for_large_sets(void **state) {
    (void)state;
    ps_frequencies grid = test_make_lattice(2, 3, true);
    test_sample what = test_make_sample(3, 2, 70001, 1111, false);
    ps_estimator_options options = test_make_options(&grid, &ps_torus_direct, PS_SINGLE, 80000, 3);
    ps_spectrum first = test_estimate(&options, &what, 3, device);
    options.batch = 1;
    ps_spectrum second = test_estimate(&options, &what, 1, device);
    options.problem.num_points = 80000; /* reference N as before; the engine grows on its way */
    ps_spectrum third = test_estimate(&options, &what, 2, device);
    assert_true(test_is_same_bits(&first, &second));
    assert_true(test_is_same_bits(&first, &third));
    ps_spectrum_free(&first);
    ps_spectrum_free(&second);
    ps_spectrum_free(&third);
    test_free_sample(&what);
    ps_frequencies_free(&grid);
}

/* ---- one dimension --------------------------------------------------------------------------- */

/* Rings have one frequency each: the device's sums are the same numbers, whether anybody asks for
 * frequencies or not, and those of the referee, which forms rings by themselves. */
static void rings_of_one_frequency(void **state) {
    (void)state;
    ps_frequencies grid = test_make_lattice(1, 700, false);
    test_sample what = test_make_sample(23, 1, 40, 3, true);
    ps_estimator_options options = test_make_options(&grid, &ps_torus_direct, PS_SINGLE, 200, 7);
    ps_spectrum with = test_estimate(&options, &what, 23, device);
    options.want_frequencies = false;
    ps_spectrum without = test_estimate(&options, &what, 23, device);
    options = test_make_options(&grid, &ps_host_direct, PS_EXTENDED, 200, 7);
    ps_spectrum referee = test_estimate(&options, &what, 23, device);
    const double near = 1e-4;
    assert_int_equal(with.num_bins, 700);
    for (size_t b = 0; b < with.num_bins; b++) {
        assert_true(with.bins[b].power == with.powers[b].mean);
        assert_true(with.bins[b].standard_error == with.powers[b].standard_error);
        assert_true(with.bins[b].power == without.bins[b].power);
        assert_true(with.bins[b].standard_error == without.bins[b].standard_error);
        assert_true(fabs(with.bins[b].power - referee.bins[b].power) < near);
        assert_true(fabs(with.bins[b].standard_error - referee.bins[b].standard_error) < near);
    }
    ps_spectrum_free(&with);
    ps_spectrum_free(&without);
    ps_spectrum_free(&referee);
    test_free_sample(&what);
    ps_frequencies_free(&grid);
}

/* ---- mean only --------------------------------------------------------------------------- */

/* Means without standard errors have the bits of those with them. */
static void check_mean_only(const ps_frequencies *set, const ps_engine *engine,
                            ps_precision precision) {
    test_sample what = test_make_sample(23, set->dimension, 40, 3, true);
    ps_estimator_options options = test_make_options(set, engine, precision, 200, 7);
    ps_spectrum with = test_estimate(&options, &what, 23, device);
    options.mean_only = true;
    ps_spectrum without = test_estimate(&options, &what, 23, device);
    assert_int_equal(with.num_bins, without.num_bins);
    for (size_t b = 0; b < with.num_bins; b++) {
        assert_true(with.bins[b].power == without.bins[b].power);
        assert_true(with.bins[b].standard_error > 0);
        assert_true(isnan(without.bins[b].standard_error));
    }
    for (size_t i = 0; i < set->num; i++) {
        assert_true(with.powers[i].mean == without.powers[i].mean);
        assert_true(with.powers[i].standard_error > 0);
        assert_true(isnan(without.powers[i].standard_error));
    }
    ps_spectrum_free(&with);
    ps_spectrum_free(&without);
    test_free_sample(&what);
}

static void same_means_without_standard_errors(void **state) {
    (void)state;
    ps_frequencies grid = test_make_lattice(2, 9, false);
    check_mean_only(&grid, &ps_torus_direct, PS_SINGLE);
    if (ps_device_get_limits(device)->has_fp64) {
        check_mean_only(&grid, &ps_torus_direct, PS_DOUBLE);
    }
    check_mean_only(&grid, &ps_host_direct, PS_EXTENDED);
    ps_frequencies_free(&grid);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_bits_for_every_batch),
        cmocka_unit_test(same_bits_in_small_buffers),
        cmocka_unit_test(same_bits_for_large_sets),
        cmocka_unit_test(rings_of_one_frequency),
        cmocka_unit_test(same_means_without_standard_errors),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("estimator", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
