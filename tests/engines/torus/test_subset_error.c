/* The standard error of a ring of which only a random subset was computed: is it the error that is
 * made?
 *
 * Many trials, each with a subset of its own. The mean square of the deviations must be the mean of
 * the squares of the standard errors, and two standard errors must hold as many deviations as they
 * should.
 */
#include "harness.h"

#include "frequencies/frequency_sample.h"
#include "math/pi.h"
#include "spectra/bins.h"
#include "spectra/spectrum.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DIMENSION = 4, RING = 3, NUM_POINTS = 16, MOST_REALIZATIONS = 8, PER_RING = 40 };

/* Points with independent coordinates, x_i uniform in [0, width_i): P(k) = 1 + (N - 1) prod
 * sinc^2(k_i width_i), which is white noise for widths 1. Otherwise frequencies of a ring differ by
 * a factor of 10, and the noise of neighbours is correlated. */
typedef struct widths {
    double of_axis[DIMENSION];
} widths;

static const widths white = {{1, 1, 1, 1}};
static const widths flat = {{0.05, 0.3, 0.4, 1}};

static double expected_power(const widths *w, const int32_t *k) {
    double product = 1;
    for (unsigned i = 0; i < DIMENSION; i++) {
        const double x = PS_PI * w->of_axis[i] * k[i];
        product *= k[i] == 0 ? 1 : pow(sin(x) / x, 2);
    }
    return 1 + (NUM_POINTS - 1) * product;
}

/* The last ring as a whole, and its mean. */
static ps_frequencies whole_ring(void) {
    ps_frequencies ball = {0};
    size_t num = 0;
    assert_ok(ps_frequencies_lattice(&ball, DIMENSION, RING, true, error));
    assert_ok(ps_frequencies_enumerate(&ball, error));
    for (size_t i = 0; i < ball.num; i++) {
        const int32_t *const k = ball.vectors + i * DIMENSION;
        if (ps_ring_of_norm2(ps_frequency_norm2(k, DIMENSION)) == RING) {
            memmove(ball.vectors + num * DIMENSION, k, DIMENSION * sizeof *k);
            num++;
        }
    }
    ball.num = num;
    ball.kind = PS_FREQUENCIES_LIST;
    return ball;
}

static double mean_expected(const widths *w, const ps_frequencies *ring) {
    double sum = 0;
    for (size_t i = 0; i < ring->num; i++) {
        sum += expected_power(w, ring->vectors + i * DIMENSION);
    }
    return sum / (double)ring->num;
}

static double power_of(const double (*points)[DIMENSION], const int32_t *k) {
    double re = 0;
    double im = 0;
    for (size_t j = 0; j < NUM_POINTS; j++) {
        double phase = 0;
        for (unsigned i = 0; i < DIMENSION; i++) {
            phase += k[i] * points[j][i];
        }
        re += cos(PS_TWO_PI * phase);
        im += sin(PS_TWO_PI * phase);
    }
    return (re * re + im * im) / NUM_POINTS;
}

static void make_points(double (*points)[DIMENSION], const widths *w, uint64_t *random) {
    for (size_t j = 0; j < NUM_POINTS; j++) {
        for (unsigned i = 0; i < DIMENSION; i++) {
            points[j][i] = w->of_axis[i] * test_uniform(random);
        }
    }
}

static ps_mean mean_of(const double *values, size_t num) {
    ps_sums sums = {0};
    ps_mean mean;
    for (size_t i = 0; i < num; i++) {
        ps_sums_add(&sums, values[i]);
    }
    ps_sums_finish(&sums, num, &mean.mean, &mean.standard_error);
    return mean;
}

/* A subset of the ring and its mean over realizations, as spectra have it. */
typedef struct trial {
    size_t num;
    uint32_t members[PER_RING];
    int32_t vectors[PER_RING][DIMENSION];
    ps_mean powers[PER_RING], ring;
} trial;

static void draw(trial *t, uint64_t seed, uint64_t *size) {
    ps_frequencies set = {0};
    const ps_frequency_sample sample = {DIMENSION, RING, {.kind = PS_BINS_ROUND}, PER_RING, seed};
    assert_ok(ps_frequencies_sample(&set, &sample, error));
    *size = set.rings[RING - 1].num_frequencies;
    t->num = PER_RING;
    memcpy(t->vectors, set.vectors + (set.num - PER_RING) * DIMENSION, sizeof t->vectors);
    for (uint32_t i = 0; i < PER_RING; i++) {
        t->members[i] = i;
    }
    ps_frequencies_free(&set);
}

static void measure(trial *t, const widths *w, size_t num_realizations, uint64_t *random) {
    double powers[PER_RING][MOST_REALIZATIONS];
    double rings[MOST_REALIZATIONS];
    for (size_t r = 0; r < num_realizations; r++) {
        double points[NUM_POINTS][DIMENSION];
        double sum = 0;
        make_points(points, w, random);
        for (size_t i = 0; i < t->num; i++) {
            powers[i][r] = power_of((const double(*)[DIMENSION])points, t->vectors[i]);
            sum += powers[i][r];
        }
        rings[r] = sum / (double)t->num;
    }
    for (size_t i = 0; i < t->num; i++) {
        t->powers[i] = mean_of(powers[i], num_realizations);
    }
    t->ring = mean_of(rings, num_realizations);
}

/* What comes out of the trials. */
typedef struct calibration {
    size_t num, num_within;
    double deviation, squares, errors;
} calibration;

static void note(calibration *c, double deviation, double standard_error) {
    c->num++;
    c->deviation += deviation;
    c->squares += deviation * deviation;
    c->errors += standard_error * standard_error;
    c->num_within += fabs(deviation) <= 2 * standard_error;
}

/* least, most: of mean square deviation over mean square standard error. coverage: least share of
 * deviations within two standard errors. */
static void check(const char *name, const calibration *c, double least, double most,
                  double coverage) {
    const double num = (double)c->num;
    const double ratio = c->squares / c->errors;
    const double within = (double)c->num_within / num;
    const double bias = c->deviation / sqrt(c->squares); /* in standard deviations of the mean */
    print_message("%s: (rms deviation / rms standard error)^2 %.3f, within two %.3f, bias %.2f\n",
                  name, ratio, within, bias);
    if (!(least <= ratio && ratio <= most && within >= coverage && fabs(bias) < 4)) {
        fail_msg("%s: the standard error is not the error", name);
    }
}

/* Deviations from the ring's true mean, all of it over all realizations that there could be. */
static calibration try_process(const widths *w, size_t num_realizations, size_t num_trials) {
    calibration c = {0};
    uint64_t random = 17;
    ps_frequencies ring = whole_ring();
    const double truth = mean_expected(w, &ring);
    for (size_t i = 0; i < num_trials; i++) {
        trial t;
        uint64_t size = 0;
        draw(&t, i, &size);
        assert_int_equal(size, ring.num);
        measure(&t, w, num_realizations, &random);
        const double standard_error =
            ps_subset_standard_error(t.powers, t.members, t.num, size, t.ring.standard_error);
        assert_true(standard_error >= t.ring.standard_error || num_realizations == 1);
        note(&c, t.ring.mean - truth, standard_error);
    }
    ps_frequencies_free(&ring);
    return c;
}

/* 1500 trials: the ratio has a standard deviation of 4 %, more where deviations have longer tails.
 * What is below one is the price of never stating less than the error over the realizations. */
enum { TRIALS = 1500 };

static void of_white_noise(void **state) {
    (void)state;
    const calibration c = try_process(&white, MOST_REALIZATIONS, TRIALS);
    check("white noise, 8 realizations", &c, 0.75, 1.15, 0.9);
}

static void of_an_anisotropic_process(void **state) {
    (void)state;
    const calibration c = try_process(&flat, MOST_REALIZATIONS, TRIALS);
    check("anisotropic process, 8 realizations", &c, 0.8, 1.2,
          0.8); /* skew: few bright frequencies */
}

/* One realization says nothing about others; what it does say is the whole error when the noise of
 * different frequencies is independent, but for the share of the ring that was computed. */
static void of_one_realization(void **state) {
    (void)state;
    ps_frequencies ring = whole_ring();
    const calibration c = try_process(&white, 1, TRIALS);
    const double share = (double)PER_RING / (double)ring.num;
    check("white noise, 1 realization", &c, 0.85 / (1 - share), 1.2 / (1 - share), 0.85);
    ps_frequencies_free(&ring);
}

/* The error of the choice alone: many subsets of the ring of one fixed set. */
static calibration try_set(const double (*points)[DIMENSION], size_t num_trials) {
    calibration c = {0};
    double truth = 0;
    ps_frequencies ring = whole_ring();
    for (size_t i = 0; i < ring.num; i++) {
        truth += power_of(points, ring.vectors + i * DIMENSION) / (double)ring.num;
    }
    for (size_t i = 0; i < num_trials; i++) {
        trial t;
        uint64_t size = 0;
        double sum = 0;
        draw(&t, i, &size);
        for (size_t j = 0; j < t.num; j++) {
            t.powers[j] = (ps_mean){power_of(points, t.vectors[j]), NAN};
            sum += t.powers[j].mean / (double)t.num;
        }
        note(&c, sum - truth, ps_subset_standard_error(t.powers, t.members, t.num, size, NAN));
    }
    ps_frequencies_free(&ring);
    return c;
}

/* One point in every sixteenth of every axis: frequencies along an axis have nearly no power. */
static void make_latin(double (*points)[DIMENSION], uint64_t *random) {
    for (unsigned i = 0; i < DIMENSION; i++) {
        for (size_t j = 0; j < NUM_POINTS; j++) { /* shuffles while it fills */
            const size_t other = (size_t)(test_uniform(random) * (double)(j + 1));
            points[j][i] = points[other][i];
            points[other][i] = ((double)j + test_uniform(random)) / NUM_POINTS;
        }
    }
}

static void of_one_set(void **state) {
    (void)state;
    double points[NUM_POINTS][DIMENSION] = {{0}};
    uint64_t random = 3;
    make_points(points, &white, &random);
    const calibration of_white = try_set((const double(*)[DIMENSION])points, TRIALS);
    check("one white set", &of_white, 0.85, 1.15, 0.9);
    make_latin(points, &random);
    const calibration of_latin = try_set((const double(*)[DIMENSION])points, TRIALS);
    check("one latin hypercube", &of_latin, 0.85, 1.15, 0.9);
    make_points(points, &flat, &random);
    const calibration of_flat = try_set((const double(*)[DIMENSION])points, TRIALS);
    check("one anisotropic set", &of_flat, 0.85, 1.15, 0.85);
}

/* Peaks of power N at even frequencies, nothing elsewhere. The error is right on average; single
 * subsets with few peaks cannot know of the others, and fewer deviations are within two standard
 * errors. */
static void of_a_lattice(void **state) {
    (void)state;
    double points[NUM_POINTS][DIMENSION];
    for (unsigned j = 0; j < NUM_POINTS; j++) {
        for (unsigned i = 0; i < DIMENSION; i++) {
            points[j][i] = (j >> i & 1) * 0.5;
        }
    }
    const calibration c = try_set((const double(*)[DIMENSION])points, TRIALS);
    check("lattice", &c, 0.85, 1.15, 0.6);
}

/* ---- the formula itself ------------------------------------------------------------------ */

static void formula(void **state) {
    (void)state;
    const ps_mean powers[] = {{1, 0.1}, {3, 0.2}, {100, 100}, {2, 0.2}};
    const uint32_t members[] = {0, 1, 3};
    const double noise = (0.01 + 0.04 + 0.04) / 3;
    /* mean 2, sample variance 1; 3 of 12 */
    const double expected = sqrt(0.09 + 0.75 / 3 * (1 - 1.5 * (noise - 0.09)));
    assert_true(fabs(ps_subset_standard_error(powers, members, 3, 12, 0.3) / expected - 1) < 1e-14);
    assert_true(fabs(ps_subset_standard_error(powers, members, 3, 12, NAN) - 0.5) < 1e-15);
    assert_true(ps_subset_standard_error(powers, members, 3, 3, 0.3) == 0.3);
    assert_true(isnan(ps_subset_standard_error(powers, members, 3, 3, NAN)));
    /* noise above the variance over the ring: the error over the realizations remains */
    const ps_mean noisy[] = {{1, 2}, {1, 2}, {1, 2}, {1, 2}};
    assert_true(ps_subset_standard_error(noisy, members, 3, 12, 0.5) == 0.5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(formula),
        cmocka_unit_test(of_white_noise),
        cmocka_unit_test(of_an_anisotropic_process),
        cmocka_unit_test(of_one_realization),
        cmocka_unit_test(of_one_set),
        cmocka_unit_test(of_a_lattice),
    };
    return cmocka_run_group_tests_name("subset_error", tests, NULL, NULL);
}
