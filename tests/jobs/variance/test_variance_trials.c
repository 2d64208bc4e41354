/* Variances against plain loops: the prediction from the powers of every frequency, the measurement
 * from the values at the points of every realization. */
#include "harness_variance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device, *gpu;

static void near(const char *what, double found, double expected, double allowed) {
    if (!(fabs(found - expected) <= allowed)) {
        fail_msg("%s: %.17g, not %.17g within %g", what, found, expected, allowed);
    }
}

/* ---- prediction ---------------------------------------------------------------------------- */

/* (1/N) sum P |f_k|^2 over the box; *held has the energy in it. */
static double sum_box(const test_variance *asked, double *held) {
    const ps_integrand *const integrand = test_variance_integrand(asked, 0);
    const ps_spectrum *const spectrum = test_variance_spectrum(asked);
    const ps_frequencies *const set = &spectrum->frequencies;
    double *const powers = calloc(set->num, sizeof *powers);
    double sum = 0;
    assert_non_null(powers);
    assert_non_null(spectrum->powers);
    assert_ok(ps_integrand_powers(integrand, set->vectors, set->num, powers, error));
    *held = 0;
    for (size_t i = 0; i < set->num; i++) {
        *held += 2 * powers[i];
        sum += 2 * powers[i] * spectrum->powers[i].mean;
    }
    free(powers);
    return sum / spectrum->mean_points;
}

static void the_prediction_is_a_sum(void **state) {
    static const struct {
        const char *sampler, *integrand;
    } cases[] = {
        {"white", "disk"},           {"jittered", "gaussian"}, {"poisson-disk", "disk:radius=0.1"},
        {"halton", "box:sides=0.3"}, {"white", "half-plane"},
    };
    (void)state;
    for (size_t i = 0; i < 2 * (sizeof cases / sizeof cases[0]); i++) {
        test_variance asked;
        double held = 0;
        test_variance_ask(&asked, cases[i / 2].sampler, 36, 5, cases[i / 2].integrand,
                          i % 2 == 0 ? device : NULL);
        const ps_variance_row *const row = test_variance_run(&asked);
        const double sum = sum_box(&asked, &held);
        const double num = test_variance_spectrum(&asked)->mean_points;
        const double energy = ps_integrand_energy(test_variance_integrand(&asked, 0));
        near(cases[i / 2].integrand, row->prediction.lower, sum, 1e-5 * sum);
        near(cases[i / 2].integrand, row->prediction.variance - row->prediction.lower,
             (energy - held) / num, 1e-9 * row->prediction.white);
        test_variance_free(&asked);
    }
}

/* ---- measurement --------------------------------------------------------------------------- */

static double estimate(const test_variance *asked, size_t i, const double *points, size_t num) {
    const ps_integrand *const integrand = test_variance_integrand(asked, i);
    const double volume = asked->question.spectrum.on_hemisphere ? 2 * acos(-1.0)
                          : asked->question.spectrum.on_sphere   ? 4 * acos(-1.0)
                                                                 : 1;
    double *const values = calloc(num, sizeof *values);
    long double sum = 0;
    assert_non_null(values);
    ps_integrand_values(integrand, points, num, values);
    for (size_t j = 0; j < num; j++) {
        sum += values[j];
    }
    free(values);
    return (double)(volume * sum / num);
}

/* Mean of squares about the integral over realizations M .. 2M - 1, and its standard error. */
static ps_mean loop(const test_variance *asked, size_t i) {
    const uint64_t num = asked->question.spectrum.num_realizations;
    const double exact = ps_integrand_integral(test_variance_integrand(asked, i));
    long double sum = 0;
    long double *const squares = calloc(num, sizeof *squares);
    long double spread = 0;
    assert_non_null(squares);
    for (uint64_t r = 0; r < num; r++) {
        size_t num_points = 0;
        double *const points = test_variance_points(asked, num + r, &num_points);
        const long double off = estimate(asked, i, points, num_points) - (long double)exact;
        squares[r] = off * off;
        sum += squares[r];
        free(points);
    }
    for (uint64_t r = 0; r < num; r++) {
        spread += (squares[r] - sum / num) * (squares[r] - sum / num);
    }
    free(squares);
    return (ps_mean){(double)(sum / num), (double)sqrtl(spread / num / (num - 1))};
}

/* Values of the device are doubles where it has them. */
static double precision_of(const ps_device *with) {
    return with == NULL || ps_device_get_limits(with)->has_fp64 ? 1e-12 : 1e-5;
}

static void check_loop(const char *sampler, uint64_t num_realizations, const char *first,
                       const char *second, ps_device *with) {
    test_variance asked;
    test_variance_ask(&asked, sampler, 48, num_realizations, first, with);
    test_variance_add(&asked, second);
    asked.question.is_moved = false;
    asked.question.spectrum.max_degree = 2; /* what is predicted is not looked at */
    asked.question.spectrum.frequencies.max_frequency = 2;
    const ps_variance_row *const rows = test_variance_run(&asked);
    for (size_t i = 0; i < 2; i++) {
        const ps_mean expected = loop(&asked, i);
        const double relative = precision_of(with);
        near(sampler, rows[i].measured, expected.mean, relative * expected.mean);
        near(sampler, rows[i].measured_error, expected.standard_error,
             relative * 10 * expected.standard_error);
        assert_true(isnan(rows[i].z_score));
    }
    test_variance_free(&asked);
}

/* 300 realizations are more than a batch; where points vary, so do the sizes of sets. A GPU makes
 * the others itself. */
static void the_measurement_is_a_loop(void **state) {
    ps_device *const with[] = {device, gpu, NULL};
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        check_loop("white", 300, "disk", "gaussian:sigma=0.2", with[i]);
        check_loop("jittered", 300, "box", "gaussian", with[i]);
        check_loop("poisson-disk", 20, "half-plane", "disk:radius=0.4", with[i]);
        check_loop("white-sphere", 300, "cap", "harmonic", with[i]);
        check_loop("white-hemisphere", 300, "cap", "square", with[i]);
    }
}

/* Estimates of sets that the device makes are those of the host's points, to the bit, however few
 * are made at a time; those that one sampler or integrand leaves to the host are made there. */
static void a_gpu_makes_the_sets(void **state) {
    static const struct {
        const char *sampler, *integrand;
        bool is_made;
    } cases[] = {{"white", "disk", true},
                 {"sobol:scramble=owen", "gaussian", true},
                 {"white-hemisphere:morph=diffuse", "cap", true},
                 {"poisson-disk", "disk", false}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_mean found[3];
        for (size_t way = 0; way < 3; way++) { /* made, a few at a time; by the host */
            test_variance asked;
            test_variance_ask(&asked, cases[i].sampler, 1100, 150, cases[i].integrand,
                              way < 2 ? gpu : device);
            asked.question.num_shifts = 3;
            asked.question.spectrum.max_degree = 2;
            asked.question.spectrum.frequencies.max_frequency = 2;
            asked.question.spectrum.limits.constraints.memory_limit = way == 1 ? 4 << 20 : 0;
            const uint64_t before = test_count_launches(gpu, "sampler_coordinates");
            const ps_variance_row *const row = test_variance_run(&asked);
            found[way] = (ps_mean){row->measured, row->measured_error};
            const uint64_t num = test_count_launches(gpu, "sampler_coordinates") - before;
            assert_true(way < 2 && cases[i].is_made ? num > way : num == 0);
            test_variance_free(&asked);
        }
        assert_memory_equal(&found[0], &found[1], sizeof found[0]);
        near(cases[i].sampler, found[0].mean, found[2].mean, 1e-12 * found[2].mean);
    }
}

/* The mean over more shifts is of the same sets, and the prediction knows nothing of it. */
static void shifts_are_of_the_measurement(void **state) {
    static const char *const samplers[] = {"jittered", "healpix-jittered"};
    static const char *const integrands[] = {"disk", "cap"};
    (void)state;
    for (size_t i = 0; i < 2; i++) {
        test_variance asked;
        test_variance_ask(&asked, samplers[i], 48, 30, integrands[i], device);
        const ps_variance_row once = *test_variance_run(&asked);
        asked.question.num_shifts = 50;
        const ps_variance_row often = *test_variance_run(&asked);
        assert_memory_equal(&once.prediction.variance, &often.prediction.variance,
                            sizeof once.prediction.variance);
        assert_memory_equal(&once.prediction.standard_error, &often.prediction.standard_error,
                            sizeof(double));
        assert_memory_equal(&once.prediction.lower, &often.prediction.lower,
                            sizeof once.prediction.lower);
        assert_memory_equal(&once.prediction.upper, &often.prediction.upper,
                            sizeof once.prediction.upper);
        assert_true(often.measured != once.measured);
        /* a set has less to add to its shifts' spread */
        assert_true(often.measured_error < 0.5 * once.measured_error);
        near("shifts", often.measured, often.prediction.variance,
             5 * hypot(often.measured_error, often.prediction.standard_error));
        test_variance_free(&asked);
    }
}

/* The same seed and cut-off, the same bits, whatever else is asked: integrands beside it. */
static void integrands_do_not_meet(void **state) {
    test_variance alone, beside;
    (void)state;
    test_variance_ask(&alone, "jittered", 64, 40, "gaussian", device);
    test_variance_ask(&beside, "jittered", 64, 40, "disk", device);
    test_variance_add(&beside, "gaussian");
    test_variance_add(&beside, "constant");
    alone.question.spectrum.frequencies.max_frequency = 12; /* by default the Gaussian's own */
    beside.question.spectrum.frequencies.max_frequency = 12;
    const ps_variance_row *const one = test_variance_run(&alone);
    const ps_variance_row *const three = test_variance_run(&beside);
    assert_memory_equal(one, three + 1, sizeof *one);
    test_variance_free(&alone);
    test_variance_free(&beside);
}

/* One point at 0, and two at 0 and (1/2, 1/2) that the wave does not tell apart: the same moves
 * would have the same squares. */
static void samplers_and_numbers_have_moves_of_their_own(void **state) {
    static const struct {
        const char *sampler;
        size_t num_points;
    } cases[] = {{"sobol", 1}, {"sobol", 2}, {"hammersley", 1}};
    enum { NUM_CASES = sizeof cases / sizeof cases[0] };
    double measured[NUM_CASES];
    (void)state;
    for (size_t i = 0; i < NUM_CASES; i++) {
        test_variance asked;
        test_variance_ask(&asked, cases[i].sampler, cases[i].num_points, 50, "wave:k=2x2", device);
        const ps_variance_row *const row = test_variance_run(&asked);
        measured[i] = row->measured;
        near(cases[i].sampler, row->measured, 0.5, 5 * row->measured_error);
        for (size_t k = 0; k < i; k++) {
            assert_true(fabs(measured[i] - measured[k]) > 1e-6);
        }
        test_variance_free(&asked);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_prediction_is_a_sum),
        cmocka_unit_test(the_measurement_is_a_loop),
        cmocka_unit_test(a_gpu_makes_the_sets),
        cmocka_unit_test(shifts_are_of_the_measurement),
        cmocka_unit_test(integrands_do_not_meet),
        cmocka_unit_test(samplers_and_numbers_have_moves_of_their_own),
    };
    device = test_open_device();
    gpu = test_open_gpu();
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    ps_device_close(device);
    ps_device_close(gpu);
    return failed;
}
