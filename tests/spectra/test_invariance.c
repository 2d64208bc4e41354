/* The phases of samplers: how often homogeneous ones raise an alarm, and what is found of others.
 */
#include "harness.h"

#include "math/pi.h"
#include "spectra/phases/invariance.h"
#include "test_samplers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A check of realizations 0, 1, .. of a sampler. */
typedef struct experiment {
    const char *sampler;
    bool homogenize;
    size_t num_points;
    unsigned dimension;
    int32_t max_frequency;
    unsigned num_sets;
    double rate;
} experiment;

/* exp(-2 pi i k x) for |k| <= K. */
static void find_waves(double x, int32_t most, double (*out)[2]) {
    for (int32_t k = -most; k <= most; k++) {
        out[k + most][0] = cos(PS_TWO_PI * k * x);
        out[k + most][1] = -sin(PS_TWO_PI * k * x);
    }
}

/* S(0), then S(k) of every frequency. */
static void find_amplitudes(const ps_frequencies *set, const double *points, size_t num,
                            double *out) {
    enum { MOST = 128 };
    static double waves[PS_MAX_DIMENSION][2 * MOST + 1][2];
    const int32_t most = set->max_frequency;
    assert_true(most <= MOST);
    for (size_t i = 0; i < 2 * (1 + set->num); i++) {
        out[i] = 0;
    }
    out[0] = (double)num;
    for (size_t j = 0; j < num; j++) {
        for (unsigned axis = 0; axis < set->dimension; axis++) {
            find_waves(points[j * set->dimension + axis], most, waves[axis]);
        }
        for (size_t i = 0; i < set->num; i++) {
            double re = 1;
            double im = 0;
            for (unsigned axis = 0; axis < set->dimension; axis++) {
                const double *const wave =
                    waves[axis][set->vectors[i * set->dimension + axis] + most];
                const double real = re * wave[0] - im * wave[1];
                im = re * wave[1] + im * wave[0];
                re = real;
            }
            out[2 + 2 * i] += re;
            out[3 + 2 * i] += im;
        }
    }
}

static double *make_amplitudes(const experiment *one, const ps_frequencies *set, uint64_t seed) {
    ps_sampler_request request = make_request(one->sampler, one->num_points, one->dimension);
    double *const out = calloc(one->num_sets * 2 * (1 + set->num), sizeof *out);
    double *const points = calloc(one->num_points * one->dimension, sizeof *points);
    request.seed = seed;
    request.homogenize = one->homogenize;
    for (unsigned r = 0; r < one->num_sets; r++) {
        generate_into(&request, r, points);
        find_amplitudes(set, points, one->num_points, out + r * 2 * (1 + set->num));
    }
    free(points);
    return out;
}

/* The label of the worst phase, where one is not uniform. */
static bool raises_alarm(const experiment *one, const ps_frequencies *set,
                         ps_invariance *invariance, uint64_t seed, ps_phase_label *worst) {
    const size_t num = ps_invariance_count(set);
    double *const amplitudes = make_amplitudes(one, set, seed);
    ps_phase_test *const tests = calloc(num, sizeof *tests);
    ps_phase_label *const labels = calloc(num, sizeof *labels);
    bool is_alarm = false;
    for (unsigned r = 0; r < one->num_sets; r += (unsigned)ps_invariance_sets(invariance)) {
        const size_t left = one->num_sets - r;
        const size_t most = ps_invariance_sets(invariance);
        ps_invariance_add(invariance, left < most ? left : most, amplitudes, r, tests);
    }
    assert_ok(ps_phase_tests_judge(tests, num, one->rate, error));
    ps_invariance_label(invariance, false, labels);
    size_t first = 0;
    for (size_t i = 0; i < num; i++) {
        is_alarm = is_alarm || tests[i].differs;
        first = tests[i].p_value < tests[first].p_value ? i : first;
    }
    *worst = labels[first];
    free(amplitudes);
    free(tests);
    free(labels);
    return is_alarm;
}

/* With these seeds; *worst is of the last. */
static unsigned count_alarms(const experiment *one, uint64_t first, unsigned num,
                             ps_phase_label *worst) {
    ps_frequencies set;
    ps_invariance *invariance = NULL;
    const double rounding = 1e-9;
    unsigned alarms = 0;
    assert_ok(ps_frequencies_lattice(&set, one->dimension, one->max_frequency, false, error));
    const size_t count = ps_invariance_count(&set);
    assert_ok(ps_frequencies_enumerate(&set, error));
    assert_int_equal(count, ps_invariance_count(&set));
    assert_ok(ps_invariance_create(&invariance, &set, rounding, error));
    for (unsigned i = 0; i < num; i++) {
        alarms += raises_alarm(one, &set, invariance, first + i, worst);
    }
    ps_invariance_destroy(invariance);
    ps_frequencies_free(&set);
    return alarms;
}

/* The table of docs/mathematics/statistics.md#homogeneity. */
static void false_alarms(void **state) {
    (void)state;
    enum { CHECKS = 200 };
    const double rate = 0.05;
    static const char *const samplers[] = {"white", "jittered", "latin-hypercube", "regular",
                                           "sobol"};
    for (size_t i = 0; i < sizeof samplers / sizeof samplers[0]; i++) {
        const experiment one = {samplers[i], i > 0, 16, 2, 8, 32, rate};
        ps_phase_label worst;
        const unsigned alarms = count_alarms(&one, 100, CHECKS, &worst);
        const double scatter = sqrt(CHECKS * rate * (1 - rate));
        printf("%s: %u alarms of %d\n", samplers[i], alarms, CHECKS);
        if (fabs(alarms - CHECKS * rate) > 3 * scatter) {
            fail_msg("%s: %u alarms of %d at a rate of %g", samplers[i], alarms, CHECKS, rate);
        }
    }
}

/* One point in each cell of 4^3: products off the axes weigh less. */
static void jitter_in_three_dimensions(void **state) {
    (void)state;
    enum { SEEDS = 8 };
    const experiment one = {"jittered", false, 64, 3, 8, 128, 1e-3};
    ps_phase_label worst;
    assert_int_equal(count_alarms(&one, 1, SEEDS, &worst), SEEDS);
}

/* One point in each of 16 slices of each axis shows on the axes alone. */
static void strata_of_axes(void **state) {
    (void)state;
    const experiment one = {"latin-hypercube", false, 16, 2, 80, 64, 1e-3};
    ps_phase_label worst;
    assert_int_equal(count_alarms(&one, 1, 1, &worst), 1);
    assert_true(worst.is_product && (worst.axes == 1 || worst.axes == 2));
    assert_int_equal(worst.k[0] + worst.k[1], 16);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(false_alarms),
        cmocka_unit_test(jitter_in_three_dimensions),
        cmocka_unit_test(strata_of_axes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
