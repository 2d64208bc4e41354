/* The streaming estimator given bad patterns, engines that are refused memory, and a device that
 * computes wrongly.
 */
#include "harness_estimator.h"
#include "harness_sphere.h"

#include "engines/engine.h"
#include "engines/host/host_direct.h"

#include <math.h>
#include <string.h>

static ps_device *device;

/* ---- bad input --------------------------------------------------------------------------- */

static pspec_status add_one(pspec_pattern pattern, pspec_normalization normalization,
                            ps_error *error) {
    ps_frequencies grid = test_make_lattice(2, 3, true);
    ps_estimator *estimator = NULL;
    ps_estimator_options options = test_make_options(&grid, &ps_torus_direct, PS_SINGLE, 4, 1);
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

/* Engines look at coordinates while they convert them: what is said is what a look at one set after
 * the other would say, and the batches before stay in the sums. */
static void check_first_bad(const ps_engine *engine, bool weighted, const char *expected) {
    enum { SETS = 5, POINTS = 40 };
    double x[SETS][2 * POINTS];
    double weights[POINTS];
    pspec_pattern patterns[SETS];
    uint64_t random = 3;
    ps_error error = {0};
    for (size_t r = 0; r < SETS; r++) {
        for (size_t i = 0; i < 2 * POINTS; i++) {
            x[r][i] = test_uniform(&random);
        }
        patterns[r] = (pspec_pattern){2, POINTS, x[r], NULL};
    }
    for (size_t j = 0; j < POINTS; j++) {
        weights[j] = INFINITY;
    }
    x[3][2 * 30 + 1] = -0.25;
    x[4][0] = 1;
    patterns[4].weights = weighted ? weights : NULL;
    ps_frequencies grid = test_make_lattice(2, 9, false);
    const ps_precision precision = engine == &ps_host_direct ? PS_EXTENDED : PS_SINGLE;
    ps_estimator_options options = test_make_options(&grid, engine, precision, POINTS, 3);
    ps_estimator *estimator = NULL;
    assert_int_equal(ps_estimator_create(&estimator, &options, device, &error), PSPEC_OK);
    assert_int_equal(ps_estimator_add(estimator, patterns, SETS, &error), PSPEC_ERROR_INPUT);
    assert_string_equal(error.message, expected);
    assert_int_equal(ps_estimator_num_realizations(estimator), 3);
    assert_int_equal(ps_estimator_add(estimator, patterns, 3, &error), PSPEC_OK);
    assert_int_equal(ps_estimator_num_realizations(estimator), 6);
    ps_estimator_destroy(estimator);
    ps_frequencies_free(&grid);
}

static void first_bad_pattern(void **state) {
    (void)state;
    static const ps_engine *const engines[] = {&ps_torus_direct, &ps_torus_nufft, &ps_host_direct};
    static const char expected[] = "set 4, point 31: coordinate -0.25 is outside [0,1)";
    for (size_t i = 0; i < sizeof engines / sizeof engines[0]; i++) {
        check_first_bad(engines[i], false, expected);
        check_first_bad(engines[i], true, expected);
    }
}

/* ---- engines that misbehave -------------------------------------------------------------- */

enum { MOST_BATCH = 3 };

/* torus_direct on a device that refuses memory for more than MOST_BATCH realizations. */
static pspec_status create_small(void *state, const ps_problem *problem, ps_precision precision,
                                 size_t batch, ps_device *on, ps_error *error) {
    return batch > MOST_BATCH ? ps_fail(error, PSPEC_ERROR_MEMORY, "refused")
                              : ps_torus_direct.create(state, problem, precision, batch, on, error);
}

static pspec_status refuse(void *state, const ps_problem *problem, ps_precision precision,
                           size_t batch, ps_device *on, ps_error *error) {
    (void)state;
    (void)problem;
    (void)precision;
    (void)batch;
    (void)on;
    return ps_fail(error, PSPEC_ERROR_MEMORY, "refused");
}

static void refused_memory_halves_the_batch(void **state) {
    (void)state;
    ps_engine small = ps_torus_direct;
    small.create = create_small;
    ps_frequencies grid = test_make_lattice(2, 6, true);
    test_sample what = test_make_sample(20, 2, 30, 0, false);
    ps_estimator_options options = test_make_options(&grid, &ps_torus_direct, PS_SINGLE, 30, 20);
    ps_spectrum expected = test_estimate(&options, &what, 20, device);
    options.engine = &small;
    ps_spectrum found = test_estimate(&options, &what, 20, device);
    assert_true(test_is_same_bits(&expected, &found));
    small.create = refuse;
    ps_estimator *estimator = NULL;
    ps_error error = {0};
    assert_int_equal(ps_estimator_create(&estimator, &options, device, &error), PSPEC_ERROR_MEMORY);
    assert_null(estimator);
    ps_spectrum_free(&expected);
    ps_spectrum_free(&found);
    test_free_sample(&what);
    ps_frequencies_free(&grid);
}

/* torus_direct on a driver that allocates when a batch is launched, and refuses larger ones from
 * the second on. */
static size_t num_runs;

static pspec_status run_small(void *state, const ps_batch *batch, ps_rows *rows, ps_error *error) {
    return num_runs++ > 0 && batch->num_patterns > MOST_BATCH
               ? ps_fail(error, PSPEC_ERROR_MEMORY, "refused")
               : ps_torus_direct.run(state, batch, rows, error);
}

static void memory_refused_in_the_middle_halves_the_batch(void **state) {
    (void)state;
    ps_engine small = ps_torus_direct;
    small.run = run_small;
    ps_frequencies grid = test_make_lattice(2, 6, true);
    test_sample what = test_make_sample(20, 2, 30, 0, false);
    ps_estimator_options options = test_make_options(&grid, &ps_torus_direct, PS_SINGLE, 30, 8);
    ps_spectrum expected = test_estimate(&options, &what, 20, device);
    options.engine = &small;
    num_runs = 0;
    ps_spectrum found = test_estimate(&options, &what, 20, device);
    assert_int_equal(num_runs, 1 + 2 + 6); /* 8; 8 and 4 in vain; 12 by two */
    assert_true(test_is_same_bits(&expected, &found));
    ps_spectrum_free(&expected);
    ps_spectrum_free(&found);
    test_free_sample(&what);
    ps_frequencies_free(&grid);
}

/* More realizations than were announced want larger sums, which the device refuses whatever the
 * batch. What was added before stays, and is gone on with when there is memory. */
static void refused_sums_lose_nothing(void **state) {
    (void)state;
    enum { SETS = 200, BATCH = 50, POINTS = 5 };
    ps_frequencies grid = test_make_lattice(2, 6, true);
    test_sample what = test_make_sample(SETS, 2, POINTS, 0, false);
    const ps_estimator_options options =
        test_make_options(&grid, &ps_torus_direct, PS_SINGLE, POINTS, BATCH);
    ps_spectrum expected = test_estimate(&options, &what, SETS, device);
    ps_spectrum found = {0};
    ps_estimator *estimator = NULL;
    ps_error refused = {0};
    assert_ok(ps_estimator_create(&estimator, &options, device, error));
    assert_ok(ps_estimator_add(estimator, what.patterns, BATCH, error));
    ps_device_set_max_allocation(device, 64);
    assert_int_equal(ps_estimator_add(estimator, what.patterns + BATCH, SETS - BATCH, &refused),
                     PSPEC_ERROR_MEMORY);
    assert_non_null(strstr(refused.message, "bytes per allocation"));
    ps_device_set_max_allocation(device, 0);
    const size_t done = (size_t)ps_estimator_num_realizations(estimator);
    assert_ok(ps_estimator_add(estimator, what.patterns + done, SETS - done, error));
    assert_ok(ps_estimator_spectrum(estimator, &found, error));
    assert_true(test_is_same_bits(&expected, &found));
    ps_estimator_destroy(estimator);
    ps_spectrum_free(&expected);
    ps_spectrum_free(&found);
    test_free_sample(&what);
    ps_frequencies_free(&grid);
}

/* ---- queues ------------------------------------------------------------------------------ */

enum { DEGREE = 20 };

/* How often nothing was left for the device to do while the host waited, and the spectrum (and
 * C_l^2, where it is wanted). */
static uint64_t count_waits(const ps_estimator_options *options, const test_sample *what,
                            size_t num, ps_spectrum *out, ps_mean *c2) {
    ps_estimator *estimator = NULL;
    assert_ok(ps_estimator_create(&estimator, options, device, error));
    const uint64_t before = ps_device_num_waits(device);
    for (size_t r = 0; r < num; r += options->batch) {
        assert_ok(ps_estimator_add(estimator, what->patterns + r, options->batch, error));
    }
    assert_ok(ps_estimator_spectrum(estimator, out, error));
    if (options->want_c2) {
        ps_estimator_c2(estimator, c2);
    }
    ps_estimator_destroy(estimator);
    return ps_device_num_waits(device) - before;
}

/* Points of a sample to the sphere. */
static void scale_to_sphere(test_sample *what) {
    for (size_t r = 0; r < what->num; r++) {
        double *u = (double *)what->patterns[r].points;
        for (size_t j = 0; j < what->patterns[r].num_points; j++, u += 3) {
            const double length = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
            for (unsigned axis = 0; axis < 3; axis++) {
                u[axis] /= length;
            }
        }
    }
}

/* On a device with memory of its own the host waits as often for many batches as for few, and bits
 * are those of one memory and of other batches. */
static void check_waits(const ps_engine *engine, size_t batch, bool weighted) {
    enum { POINTS = 40, OTHER_BATCH = 6 };
    const size_t sets = 12 * batch;
    const bool on_sphere = engine->domains == PS_ON_SPHERE;
    ps_frequencies grid = on_sphere ? test_degrees(DEGREE, false) : test_make_lattice(2, 9, false);
    test_sample what = test_make_sample(sets, on_sphere ? 3 : 2, POINTS, 0, weighted);
    ps_estimator_options options = test_make_options(&grid, engine, PS_SINGLE, POINTS, batch);
    options.problem.measure = engine->sums_pairs ? PS_OF_PAIR_SUMS : PS_OF_AMPLITUDES;
    options.want_c2 = engine->sums_pairs;
    if (on_sphere) {
        scale_to_sphere(&what);
    }
    ps_estimator_options other = options;
    other.batch = OTHER_BATCH;
    ps_spectrum expected = {0};
    ps_spectrum few = {0};
    ps_spectrum many = {0};
    ps_mean c2[2][DEGREE] = {0};
    ps_device_set_dedicated_local_memory(device, true);
    (void)count_waits(&other, &what, sets, &expected, c2[0]);
    ps_device_set_unified_memory(device, false);
    const uint64_t waits_of_few = count_waits(&options, &what, 3 * batch, &few, c2[1]);
    const uint64_t waits_of_many = count_waits(&options, &what, sets, &many, c2[1]);
    ps_device_set_unified_memory(device, true);
    ps_device_set_dedicated_local_memory(device, false);
    assert_int_equal(waits_of_few, waits_of_many);
    assert_true(test_is_same_bits(&expected, &many));
    assert_memory_equal(c2[0], c2[1], sizeof c2[0]);
    ps_spectrum_free(&expected);
    ps_spectrum_free(&few);
    ps_spectrum_free(&many);
    test_free_sample(&what);
    ps_frequencies_free(&grid);
}

static void batches_follow_without_waiting(void **state) {
    (void)state;
    check_waits(&ps_torus_direct, 2, false);
    check_waits(&ps_torus_direct, 2, true);
    check_waits(&ps_torus_nufft, 2, false);
    check_waits(&ps_sphere_direct, 2, true);
    check_waits(&ps_sphere_grid, 70, false); /* more than it does at once */
    check_waits(&ps_sphere_nufft, 2, true);
    check_waits(&ps_pairs_direct, 2, true);
    check_waits(&ps_pairs_histogram, 2, false);
}

/* A driver whose sums are too large by this share. */
static double wrong_share;

static pspec_status run_wrongly(void *state, const ps_batch *batch, ps_rows *rows,
                                ps_error *error) {
    double scales[8];
    for (size_t r = 0; r < batch->num_patterns; r++) {
        scales[r] = batch->scales[r] * pow(1 + wrong_share, 2);
    }
    ps_batch wrong = *batch;
    wrong.scales = scales;
    return ps_torus_direct.run(state, &wrong, rows, error);
}

static pspec_status run_a_wrong_device(double share, ps_error *error) {
    ps_engine wrong = ps_torus_direct;
    wrong.run = run_wrongly;
    wrong_share = share;
    ps_frequencies grid = test_make_lattice(2, 6, true);
    test_sample what = test_make_sample(2, 2, 30, 0, false);
    ps_estimator_options options = test_make_options(&grid, &wrong, PS_SINGLE, 30, 2);
    ps_estimator *estimator = NULL;
    assert_int_equal(ps_estimator_create(&estimator, &options, device, error), PSPEC_OK);
    const pspec_status status = ps_estimator_add(estimator, what.patterns, 2, error);
    ps_estimator_destroy(estimator);
    test_free_sample(&what);
    ps_frequencies_free(&grid);
    return status;
}

/* 8 (1 + s) times the engine's error is allowed where |S| is s times that of white noise: of eight
 * entries some have s > 1 / 2, where 24 s is more. */
static void the_self_check_finds_a_wrong_device(void **state) {
    (void)state;
    ps_frequencies grid = test_make_lattice(2, 6, true);
    const ps_problem problem = {
        .frequencies = &grid, .num_points = 30, .num_realizations = 2, .tolerance = 1};
    const double e = test_engine_error(&ps_torus_direct, &problem, PS_SINGLE, device, 1);
    ps_error error = {0};
    assert_int_equal(run_a_wrong_device(2 * e, &error), PSPEC_OK);
    assert_int_equal(run_a_wrong_device(24 * e, &error), PSPEC_ERROR_CHECK);
    assert_non_null(strstr(error.message, "self-check failed"));
    ps_frequencies_free(&grid);
}

static void nothing_added(void **state) {
    (void)state;
    ps_frequencies grid = test_make_lattice(2, 6, true);
    const ps_estimator_options options =
        test_make_options(&grid, &ps_torus_direct, PS_SINGLE, 30, 2);
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
        cmocka_unit_test(bad_patterns),
        cmocka_unit_test(first_bad_pattern),
        cmocka_unit_test(refused_memory_halves_the_batch),
        cmocka_unit_test(memory_refused_in_the_middle_halves_the_batch),
        cmocka_unit_test(refused_sums_lose_nothing),
        cmocka_unit_test(batches_follow_without_waiting),
        cmocka_unit_test(the_self_check_finds_a_wrong_device),
        cmocka_unit_test(nothing_added),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("estimator_faults", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
