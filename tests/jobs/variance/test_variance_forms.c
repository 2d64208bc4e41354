/* Predictions that leave frequencies out, or sum over shells or integrate over |k|, and what lies
 * beyond cut-offs. */
#include "harness_variance.h"

#include "jobs/variance/formulas.h"
#include "jobs/variance/tails.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;

static void near(const char *what, double found, double expected, double allowed) {
    if (!(fabs(found - expected) <= allowed)) {
        fail_msg("%s: %.17g, not %.17g within %g", what, found, expected, allowed);
    }
}

static ps_integrand *parse(const char *text, ps_sampler_domain where, unsigned dimension) {
    ps_integrand *integrand = NULL;
    const ps_integrand_place place = {where, dimension};
    assert_int_equal(ps_integrand_parse(&integrand, text, place, NULL), PSPEC_OK);
    return integrand;
}

/* ---- frequencies that do not matter -------------------------------------------------------- */

static bool skips(const test_variance *asked, const char *what) {
    const ps_needs *const needs = &asked->job->spectrum->needs;
    bool found = false;
    for (size_t i = 0; i < needs->num_skips; i++) {
        found = found || strncmp(needs->skips[i].what, what, strlen(what)) == 0;
    }
    return found;
}

static const struct {
    const char *sampler, *integrand, *more;
    int32_t given; /* cut-off; 0: of default */
    int32_t asked, cut;
} skipped[] = {
    {"jittered", "gaussian", NULL, 0, 80, 15},
    {"poisson-disk", "gaussian", "wave:k=3x-17", 0, 80, 17},
    {"white", "wave:k=2x1", "constant", 0, 80, 2},
    {"white", "constant", NULL, 0, 80, 1},
    {"halton", "gaussian:sigma=0.2", NULL, 12, 12, 4},
    {"white", "gaussian", NULL, 9, 9, 9},     /* below the reach */
    {"white", "gaussian", "disk", 0, 80, 80}, /* which has none */
    {"white-sphere", "harmonic:degree=6", "square", 0, 64, 6},
    {"fibonacci", "lobe:n=5", NULL, 0, 64, 16},
    {"white-hemisphere", "square", "constant", 0, 64, 2},
};

static void check_skip(size_t i) {
    double predicted[2];
    double error = 0;
    for (int no_skip = 0; no_skip < 2; no_skip++) {
        test_variance asked;
        test_variance_ask(&asked, skipped[i].sampler, 256, 8, skipped[i].integrand, device);
        if (skipped[i].more != NULL) {
            test_variance_add(&asked, skipped[i].more);
        }
        asked.question.spectrum.frequencies.max_frequency = skipped[i].given;
        asked.question.spectrum.accuracy.no_skip = no_skip != 0;
        asked.question.num_shifts = 0;
        const ps_prediction *const found = &test_variance_run(&asked)->prediction;
        const int32_t largest = test_variance_spectrum(&asked)->frequencies.max_frequency;
        const bool is_cut = skipped[i].cut < skipped[i].asked;
        assert_int_equal(largest, no_skip != 0 ? skipped[i].asked : skipped[i].cut);
        assert_int_equal(skips(&asked, "frequencies beyond") || skips(&asked, "degrees beyond"),
                         is_cut && no_skip == 0);
        if (is_cut) {
            assert_false(asked.job->beyond.matters);
        }
        const double e = 2 * asked.job->spectrum->problem.tolerance;
        error += 2 * e * sqrt(found->variance * found->white) + e * e * found->white;
        predicted[no_skip] = found->variance;
        test_variance_free(&asked);
    }
    near(skipped[i].integrand, predicted[0], predicted[1], error);
}

static void useless_frequencies(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof skipped / sizeof skipped[0]; i++) {
        check_skip(i);
    }
}

/* ---- shells -------------------------------------------------------------------------------- */

/* (1/N) sum of the powers of a ball, from the frequencies of the box. */
static double sum_of_ball(const test_variance *asked, double *held) {
    const ps_spectrum *const spectrum = test_variance_spectrum(asked);
    const ps_frequencies *const set = &spectrum->frequencies;
    const ps_integrand *const f = test_variance_integrand(asked, 0);
    const int64_t most = (int64_t)set->max_frequency * (set->max_frequency + 1);
    double sum = 0;
    *held = 0;
    for (size_t i = 0; i < set->num; i++) {
        double power = 0;
        const int32_t *const k = set->vectors + i * set->dimension;
        assert_ok(ps_integrand_powers(f, k, 1, &power, error));
        const bool is_in = ps_frequency_norm2(k, set->dimension) <= most;
        sum += is_in ? 2 * power * spectrum->powers[i].mean : 0;
        *held += is_in ? 2 * power : 0;
    }
    return sum / spectrum->mean_points;
}

static void shells(void **state) {
    static const char *const samplers[] = {"latin-hypercube", "jittered", "white"};
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        double held = 0;
        test_variance box, ball;
        test_variance_ask(&box, samplers[i], 64, 10, "disk", device);
        box.question.spectrum.frequencies.max_frequency = 12;
        test_variance_run(&box);
        const double lower = sum_of_ball(&box, &held);
        test_variance_ask(&ball, samplers[i], 64, 10, "disk", device);
        ball.question.spectrum.frequencies.max_frequency = 12;
        ball.question.spectrum.wants_full_array = false;
        ball.question.over_shells = true;
        for (int no_skip = 0; no_skip < 2; no_skip++) {
            ball.question.spectrum.accuracy.no_skip = no_skip != 0;
            const ps_prediction *const found = &test_variance_run(&ball)->prediction;
            const double tail = ps_integrand_energy(test_variance_integrand(&ball, 0)) - held;
            near(samplers[i], found->lower, lower, 1e-5 * lower);
            near(samplers[i], found->variance - found->lower, tail / 64, 1e-13);
        }
        test_variance_free(&ball);
        test_variance_free(&box);
    }
}

static void refuse(const char *sampler, const char *integrand, bool over_shells,
                   const char *sentence) {
    test_variance asked;
    ps_error found = {0};
    test_variance_ask(&asked, sampler, 16, 2, integrand, device);
    asked.question.over_shells = over_shells;
    asked.question.wants_paper = !over_shells;
    assert_int_equal(ps_variance_question_check(&asked.question, &found),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    if (strstr(found.message, sentence) == NULL) {
        fail_msg("%s", found.message);
    }
    test_variance_free(&asked);
}

static void refused(void **state) {
    (void)state;
    refuse("white", "box", true, "integrand box: its powers depend on more than |k|");
    refuse("white", "gaussian:cut=yes", true, "integrand gaussian: its powers depend");
    refuse("white-sphere", "cap", true, "degrees are exact as they are");
    refuse("white", "half-plane", false, "integrand half-plane: the integral of the paper");
    refuse("white", "constant", false, "integrand constant: the integral of the paper");
    refuse("white-sphere", "cap", false, "integrand cap: the integral of the paper");
}

/* ---- (E-13) -------------------------------------------------------------------------------- */

static double sinc(double x) {
    return x == 0 ? 1 : sin(PS_PI * x) / (PS_PI * x);
}

/* Rings of m x m jittered points in the plane by their expectation, 1 - sinc^2 sinc^2; m = 0: white
 * noise. *exact is the sum over all of the box, with what lies beyond as white. */
static void fill_rings(ps_spectrum *out, double m, const ps_integrand *f, double *exact) {
    const ps_frequencies *const set = &out->frequencies;
    *exact = ps_integrand_energy(f);
    for (size_t i = 0; i < set->num; i++) {
        const int32_t *const k = set->vectors + 2 * i;
        const double stratum = m > 0 ? sinc(k[0] / m) * sinc(k[1] / m) : 0;
        const int64_t ring = ps_ring_of_norm2(ps_frequency_norm2(k, 2));
        double power = 0;
        assert_ok(ps_integrand_powers(f, k, 1, &power, error));
        *exact -= 2 * stratum * stratum * power;
        if (ring <= (int64_t)out->num_bins) {
            ps_spectrum_bin *const bin = &out->bins[ring - 1];
            bin->count++;
            bin->power += (1 - stratum * stratum - bin->power) / (double)bin->count;
        }
    }
}

static double ratio(const char *integrand, double m) {
    enum { NUM = 80 };
    ps_spectrum_bin bins[NUM] = {{0}};
    ps_integrand *const f = parse(integrand, PS_SAMPLES_TORUS, 2);
    ps_spectrum spectrum = {.mean_points = 64, .num_bins = NUM, .bins = bins};
    double exact = 0;
    double found = 0;
    assert_ok(ps_frequencies_lattice(&spectrum.frequencies, 2, NUM, false, error));
    assert_ok(ps_frequencies_enumerate(&spectrum.frequencies, error));
    fill_rings(&spectrum, m, f, &exact);
    assert_ok(ps_radial_variance(&found, f, &spectrum, error));
    ps_frequencies_free(&spectrum.frequencies);
    ps_integrand_destroy(f);
    return found * 64 / exact;
}

/* Of white noise what is neglected is f_0^2/N. Of jittered points nothing, and what is left is that
 * rings are wide beside what P does between them, for few points. */
static void paper_formula(void **state) {
    (void)state;
    near("white disk", ratio("disk:radius=0.25", 0), 1 / (1 - PS_PI / 16), 1e-12);
    near("white disk", ratio("disk:radius=0.25", 0), 1.244, 5e-4);
    near("white Gaussian", ratio("gaussian:sigma=0.1", 0), 1.144, 5e-4);
    near("jittered disk", ratio("disk:radius=0.25", 8), 1, 0.01);
    near("jittered disk", ratio("disk:radius=0.25", 16), 1, 0.001);
    near("jittered Gaussian", ratio("gaussian:sigma=0.1", 8), 1, 0.003);
    near("jittered Gaussian", ratio("gaussian:sigma=0.1", 16), 1, 0.001);
}

/* The same rings, of sets that are drawn: the mean of white noise is 1 within some errors. */
static void measured_paper_formula(void **state) {
    test_variance asked;
    (void)state;
    test_variance_ask(&asked, "white", 64, 400, "disk", device);
    asked.question.wants_paper = true;
    asked.question.num_shifts = 0;
    const ps_variance_row *row = test_variance_run(&asked);
    near("white", row->paper / row->prediction.white, 1.2443,
         10 * row->prediction.standard_error / row->prediction.white);
    test_variance_free(&asked);
    test_variance_ask(&asked, "jittered", 256, 400, "disk", device);
    asked.question.wants_paper = true;
    asked.question.num_shifts = 0;
    row = test_variance_run(&asked);
    near("jittered", row->paper / row->prediction.variance, 1, 0.02);
    asked.question.wants_paper = false;
    assert_true(isnan(test_variance_run(&asked)->paper));
    test_variance_free(&asked);
}

/* ---- beyond cut-offs ----------------------------------------------------------------------- */

static double beyond(const char *text, unsigned dimension, bool over_shells, int32_t cutoff) {
    ps_integrand *const f = parse(text, PS_SAMPLES_TORUS, dimension);
    ps_frequencies set = {0};
    double held = 0;
    assert_ok(ps_frequencies_lattice(&set, dimension, cutoff, over_shells, error));
    assert_ok(ps_frequencies_enumerate(&set, error));
    double *const weights = calloc(set.num, sizeof *weights);
    assert_non_null(weights);
    assert_ok(ps_prediction_weigh(f, &set, over_shells, NULL, weights, &held, error));
    const double rest = ps_integrand_energy(f) - held;
    free(weights);
    ps_frequencies_free(&set);
    ps_integrand_destroy(f);
    return rest;
}

static void check_tails(const char *text, unsigned dimension, bool over_shells) {
    static const int32_t cutoffs[] = {1, 2, 5, 17};
    ps_integrand *const f = parse(text, PS_SAMPLES_TORUS, dimension);
    ps_tails *tails = NULL;
    assert_ok(ps_tails_create(&tails, f, over_shells, error));
    for (size_t i = 0; i < sizeof cutoffs / sizeof cutoffs[0]; i++) {
        const double exact = beyond(text, dimension, over_shells, cutoffs[i]);
        const double found = ps_tails_beyond(tails, cutoffs[i]);
        near(text, found, exact, 1e-13 * ps_integrand_energy(f));
        const double least = ps_tails_find(tails, found);
        assert_true(least <= cutoffs[i] && ps_tails_beyond(tails, least) <= found);
        assert_true(least == 1 || ps_tails_beyond(tails, least - 1) > found);
    }
    ps_tails_destroy(tails);
    ps_integrand_destroy(f);
}

static void tails_as_predictions_have_them(void **state) {
    (void)state;
    check_tails("disk", 1, false);
    check_tails("disk", 2, false);
    check_tails("disk", 2, true);
    check_tails("disk", 3, false);
    check_tails("disk", 3, true);
    check_tails("box:sides=0.3x0.6", 2, false);
    check_tails("half-plane", 2, false);
    check_tails("gaussian", 2, false);
    check_tails("gaussian:cut=yes", 2, false);
}

/* Per/(2 pi^2 R) of a ball, far beyond what is summed; and what has a reach, or degrees. */
static void tails_far_away(void **state) {
    ps_tails *tails = NULL;
    ps_integrand *f = parse("disk", PS_SAMPLES_TORUS, 2);
    (void)state;
    assert_ok(ps_tails_create(&tails, f, true, error));
    near("disk", ps_tails_beyond(tails, 1e5), 0.25 / (PS_PI * 1e5), 0.02 * 0.25 / (PS_PI * 1e5));
    near("disk", ps_tails_find(tails, 0.25 / (PS_PI * 1e5)), 1e5, 3e3);
    assert_true(isinf(ps_tails_find(tails, 0)));
    ps_tails_destroy(tails);
    ps_integrand_destroy(f);
    f = parse("wave:k=100000x3", PS_SAMPLES_TORUS, 2);
    assert_ok(ps_tails_create(&tails, f, false, error));
    assert_true(ps_tails_beyond(tails, 99) == 0.5 && ps_tails_find(tails, 0.1) == 100000);
    ps_tails_destroy(tails);
    ps_integrand_destroy(f);
    f = parse("harmonic:degree=7", PS_SAMPLES_SPHERE, 3);
    assert_ok(ps_tails_create(&tails, f, false, error));
    assert_true(ps_tails_beyond(tails, 6) == 1 && ps_tails_find(tails, 0.5) == 7);
    ps_tails_destroy(tails);
    ps_integrand_destroy(f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(useless_frequencies),
        cmocka_unit_test(shells),
        cmocka_unit_test(refused),
        cmocka_unit_test(paper_formula),
        cmocka_unit_test(measured_paper_formula),
        cmocka_unit_test(tails_as_predictions_have_them),
        cmocka_unit_test(tails_far_away),
    };
    device = test_open_device();
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    ps_device_close(device);
    return failed;
}
