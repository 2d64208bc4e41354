/* Weighted sums of the estimator: in the units of its spectrum under every normalization, by
 * engines with rows on the device and on the host, on the torus and on the sphere; standard errors
 * over realizations; bits; white noise.
 */
#include "harness_estimator.h"

#include "engines/host/host_direct.h"
#include "engines/engine.h"

#include <math.h>
#include <stdlib.h>

static ps_device *device;

enum { M = 11, WEIGHTED = 2, FIRST = 40, STEP = 7, MOST = FIRST + (M - 1) * STEP };

typedef struct kind {
    const ps_engine *engine;
    ps_precision precision;
    bool is_on_sphere;
    double near; /* weights have the precision of rows on the device */
} kind;

static const kind kinds[] = {
    {&ps_torus_direct, PS_SINGLE, false, 1e-6},  {&ps_torus_direct, PS_DOUBLE, false, 1e-12},
    {&ps_torus_nufft, PS_SINGLE, false, 1e-6},   {&ps_host_direct, PS_EXTENDED, false, 1e-12},
    {&ps_sphere_direct, PS_SINGLE, true, 1e-6},  {&ps_sphere_direct, PS_DOUBLE, true, 1e-12},
    {&ps_host_direct, PS_EXTENDED, true, 1e-12},
};

typedef struct fixture {
    ps_frequencies set;
    test_sample sample;
    double *weights; /* [WEIGHTED][set.num] */
    ps_estimator_options options;
} fixture;

/* Of the cube, as directions from its middle. */
static void put_on_sphere(test_sample *sample) {
    for (size_t r = 0; r < sample->num; r++) {
        for (size_t j = 0; j < sample->patterns[r].num_points; j++) {
            double *u = (double *)sample->patterns[r].points + 3 * j;
            const double x = 2 * u[0] - 1, y = 2 * u[1] - 1, z = 2 * u[2] - 1;
            const double length = sqrt(x * x + y * y + z * z);
            u[0] = x / length;
            u[1] = y / length;
            u[2] = z / length;
        }
    }
}

/* Sets of M different N, with weights; a smooth weight, and one that is small and of any size. */
static void make_fixture(fixture *made, const kind *what, pspec_normalization normalization) {
    *made = (fixture){.sample = test_make_sample(M, what->is_on_sphere ? 3 : 2, FIRST, STEP, true)};
    uint64_t seed = 41;
    if (what->is_on_sphere) {
        put_on_sphere(&made->sample);
        assert_ok(ps_frequencies_degrees(&made->set, 40, false, error));
        assert_ok(ps_frequencies_enumerate(&made->set, error));
    } else {
        made->set = test_make_lattice(2, 25, false);
    }
    made->weights = calloc(WEIGHTED * made->set.num, sizeof *made->weights);
    for (size_t i = 0; i < made->set.num; i++) {
        made->weights[i] = 2 * exp(-(double)i / 50);
        made->weights[made->set.num + i] = 1e-45 * test_uniform(&seed) * test_uniform(&seed);
    }
    made->options = test_make_options(&made->set, what->engine, what->precision, MOST, 3);
    made->options.problem.num_realizations = M;
    made->options.problem.tolerance = 1e-3;
    made->options.normalization = normalization;
    made->options.weights = made->weights;
    made->options.num_weighted = WEIGHTED;
}

static void free_fixture(fixture *made) {
    ps_frequencies_free(&made->set);
    test_free_sample(&made->sample);
    free(made->weights);
}

/* The first `num` patterns; powers[set.num] or NULL. */
static void estimate(const fixture *what, const ps_estimator_options *options,
                     const pspec_pattern *patterns, size_t num, ps_mean *weighted,
                     ps_mean *powers) {
    ps_estimator *estimator = NULL;
    ps_spectrum spectrum = {0};
    assert_ok(ps_estimator_create(&estimator, options, device, error));
    assert_ok(ps_estimator_add(estimator, patterns, num, error));
    assert_ok(ps_estimator_weighted(estimator, weighted, error));
    assert_ok(ps_estimator_spectrum(estimator, &spectrum, error));
    for (size_t i = 0; powers != NULL && i < what->set.num; i++) {
        powers[i] = spectrum.powers[i];
    }
    ps_spectrum_free(&spectrum);
    ps_estimator_destroy(estimator);
}

static void for_all_kinds(void (*check)(const kind *, pspec_normalization)) {
    static const pspec_normalization normalizations[] = {
        PSPEC_NORMALIZATION_POWER, PSPEC_NORMALIZATION_INTEGRAL, PSPEC_NORMALIZATION_EFFECTIVE};
    const bool has_fp64 = ps_device_get_limits(device)->has_fp64;
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        for (size_t j = 0; j < sizeof normalizations / sizeof normalizations[0]; j++) {
            if (kinds[i].precision != PS_DOUBLE || has_fp64) {
                check(&kinds[i], normalizations[j]);
            }
        }
    }
}

/* ---- laws -------------------------------------------------------------------------------- */

/* The mean of weighted sums is the weighted sum of mean powers. */
static void check_mean(const kind *what, pspec_normalization normalization) {
    fixture made;
    make_fixture(&made, what, normalization);
    ps_mean *powers = calloc(made.set.num, sizeof *powers);
    ps_mean found[WEIGHTED];
    estimate(&made, &made.options, made.sample.patterns, M, found, powers);
    for (size_t w = 0; w < WEIGHTED; w++) {
        double sum = 0;
        for (size_t i = 0; i < made.set.num; i++) {
            sum += made.weights[w * made.set.num + i] * powers[i].mean;
        }
        assert_true(fabs(found[w].mean / sum - 1) < what->near);
    }
    free(powers);
    free_fixture(&made);
}

static void sums_of_the_spectrum(void **state) {
    (void)state;
    for_all_kinds(check_mean);
}

/* Every realization alone, in the units of the whole: mean(N) |S|^2 / W^2 is mean(N) / N_r times
 * the sum of r alone. */
static void find_each(const fixture *what, double (*values)[WEIGHTED]) {
    const double mean_points = (FIRST + MOST) / 2.0;
    ps_estimator *estimator = NULL;
    assert_ok(ps_estimator_create(&estimator, &what->options, device, error));
    for (size_t r = 0; r < M; r++) {
        const pspec_pattern *pattern = &what->sample.patterns[r];
        const bool is_mean = what->options.normalization == PSPEC_NORMALIZATION_INTEGRAL;
        const double unit = is_mean ? mean_points / (double)pattern->num_points : 1;
        ps_mean alone[WEIGHTED];
        ps_estimator_reset(estimator);
        assert_ok(ps_estimator_add(estimator, pattern, 1, error));
        assert_ok(ps_estimator_weighted(estimator, alone, error));
        for (size_t w = 0; w < WEIGHTED; w++) {
            values[r][w] = unit * alone[w].mean;
            assert_true(isnan(alone[w].standard_error));
        }
    }
    ps_estimator_destroy(estimator);
}

static void check_error(const kind *what, pspec_normalization normalization) {
    fixture made;
    make_fixture(&made, what, normalization);
    double values[M][WEIGHTED];
    ps_mean found[WEIGHTED];
    estimate(&made, &made.options, made.sample.patterns, M, found, NULL);
    find_each(&made, values);
    for (size_t w = 0; w < WEIGHTED; w++) {
        double mean = 0;
        double squares = 0;
        for (size_t r = 0; r < M; r++) {
            mean += values[r][w] / M;
        }
        for (size_t r = 0; r < M; r++) {
            squares += pow(values[r][w] - mean, 2);
        }
        const double scatter = sqrt(squares / (M - 1) / M);
        assert_true(fabs(found[w].mean / mean - 1) < 1e-12);
        assert_true(fabs(found[w].standard_error / scatter - 1) < 1e-11);
    }
    free_fixture(&made);
}

static void standard_errors(void **state) {
    (void)state;
    for_all_kinds(check_error);
}

/* Under one normalization: others differ by factors of realizations. */
static void check_bits(const kind *what, pspec_normalization normalization) {
    static const size_t batches[] = {1, 2, M, 32};
    if (normalization != PSPEC_NORMALIZATION_INTEGRAL) {
        return;
    }
    fixture made;
    make_fixture(&made, what, normalization);
    ps_mean first[WEIGHTED];
    estimate(&made, &made.options, made.sample.patterns, M, first, NULL);
    for (size_t i = 0; i < sizeof batches / sizeof batches[0]; i++) {
        ps_mean again[WEIGHTED];
        made.options.batch = batches[i];
        estimate(&made, &made.options, made.sample.patterns, M, again, NULL);
        assert_memory_equal(first, again, sizeof first);
    }
    free_fixture(&made);
}

static void same_bits_for_every_batch(void **state) {
    (void)state;
    for_all_kinds(check_bits);
}

/* A reset forgets; nothing comes of no realizations. */
static void reset(void **state) {
    (void)state;
    fixture made;
    make_fixture(&made, &kinds[0], PSPEC_NORMALIZATION_POWER);
    ps_estimator *estimator = NULL;
    ps_error nothing = {0};
    ps_mean expected[WEIGHTED];
    ps_mean found[WEIGHTED];
    estimate(&made, &made.options, made.sample.patterns, 4, expected, NULL);
    assert_ok(ps_estimator_create(&estimator, &made.options, device, error));
    assert_ok(ps_estimator_add(estimator, made.sample.patterns + 2, M - 2, error));
    ps_estimator_reset(estimator);
    assert_int_equal(ps_estimator_weighted(estimator, found, &nothing), PSPEC_ERROR_INPUT);
    assert_ok(ps_estimator_add(estimator, made.sample.patterns, 4, error));
    assert_ok(ps_estimator_weighted(estimator, found, error));
    assert_memory_equal(found, expected, sizeof found);
    ps_estimator_destroy(estimator);
    free_fixture(&made);
}

/* A device that allows no buffer larger than a row of powers: every vector of weights has its own.
 */
static void small_buffers(void **state) {
    (void)state;
    fixture made;
    make_fixture(&made, &kinds[2], PSPEC_NORMALIZATION_POWER);
    ps_mean expected[WEIGHTED];
    ps_mean found[WEIGHTED];
    made.options.batch = 1;
    estimate(&made, &made.options, made.sample.patterns, M, expected, NULL);
    const ps_work work =
        ps_torus_nufft.survey(&made.options.problem, ps_device_get_limits(device), PS_SINGLE).work;
    ps_device_set_max_allocation(device, (uint64_t)work.row_bytes);
    estimate(&made, &made.options, made.sample.patterns, M, found, NULL);
    ps_device_set_max_allocation(device, 0);
    assert_memory_equal(found, expected, sizeof found);
    free_fixture(&made);
}

/* White noise with weights 1/n: the mean is 1, and the variance of the mean of n frequencies, which
 * are uncorrelated, (N - 1) / (N n) (docs/mathematics/torus.md#white-noise). 4 standard errors. */
static void white_noise(void **state) {
    (void)state;
    enum { SETS = 4000, N = 5 };
    ps_frequencies grid = test_make_lattice(2, 6, true);
    test_sample what = test_make_sample(SETS, 2, N, 0, false);
    double *weights = calloc(grid.num, sizeof *weights);
    ps_estimator *estimator = NULL;
    ps_mean found;
    ps_estimator_options options = test_make_options(&grid, &ps_torus_direct, PS_SINGLE, N, 500);
    for (size_t i = 0; i < grid.num; i++) {
        weights[i] = 1 / (double)grid.num;
    }
    options.weights = weights;
    options.num_weighted = 1;
    assert_ok(ps_estimator_create(&estimator, &options, device, error));
    assert_ok(ps_estimator_add(estimator, what.patterns, SETS, error));
    assert_ok(ps_estimator_weighted(estimator, &found, error));
    const double expected = (N - 1.0) / N / (double)grid.num / SETS;
    assert_true(fabs(found.mean - 1) < 4 * found.standard_error);
    assert_true(fabs(pow(found.standard_error, 2) / expected - 1) < 4 * sqrt(9.0 / SETS));
    ps_estimator_destroy(estimator);
    free(weights);
    test_free_sample(&what);
    ps_frequencies_free(&grid);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_of_the_spectrum),
        cmocka_unit_test(standard_errors),
        cmocka_unit_test(same_bits_for_every_batch),
        cmocka_unit_test(reset),
        cmocka_unit_test(small_buffers),
        cmocka_unit_test(white_noise),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("estimator_weighted", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
