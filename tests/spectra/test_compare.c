/* The comparison of two averages: false alarms and power, counted; exact cases; numbers that are
 * none.
 *
 * Counts have binomial limits of 4 standard deviations, with fixed seeds: a test that passes once
 * passes always. */
#include "harness.h"

#include "math/pi.h"
#include "math/random/distributions.h"
#include "math/random/random.h"
#include "spectra/compare.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void assert_near(double found, double expected, double tolerance) {
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("%.17g instead of %.17g", found, expected);
    }
}

/* Fails, with that part of a sentence. */
#define assert_refused(expected, part, call)                                                       \
    do {                                                                                           \
        ps_error refusal = {0};                                                                    \
        ps_error *const error = &refusal;                                                          \
        assert_int_equal(call, expected);                                                          \
        assert_non_null(strstr(refusal.message, part));                                            \
    } while (0)

/* ---- powers that scatter like gamma variables ---------------------------------------------- */

enum { NUM_BINS = 20, LARGEST_M = 100 };

/* Of mean 1 and shape twice / 2: twice / 2 exponential variables, and the square of a normal one.
 */
static double draw_gamma(ps_random *random, unsigned twice) {
    double product = 1;
    double sum = 0;
    for (unsigned i = 0; i < twice / 2; i++) {
        product *= 1 - ps_random_uniform(random);
    }
    if (twice % 2 != 0) {
        const double radius2 = -2 * log(1 - ps_random_uniform(random));
        const double cosine = cos(PS_TWO_PI * ps_random_uniform(random));
        sum = radius2 * cosine * cosine / 2;
    }
    return (sum - log(product)) / (twice / 2.0);
}

/* Powers that are 0 but for one realization in ten: a lattice that a shift seldom hits. */
static double draw_rare(ps_random *random) {
    const unsigned one_in = 10;
    return ps_random_below(random, one_in) == 0 ? one_in * draw_gamma(random, 2) : 1e-9;
}

/* shape 0: rare events. */
static ps_compared draw_mean(ps_random *random, unsigned twice_shape, unsigned m, double mean) {
    double values[LARGEST_M];
    double sum = 0;
    double squares = 0;
    for (unsigned r = 0; r < m; r++) {
        values[r] = mean * (twice_shape > 0 ? draw_gamma(random, twice_shape) : draw_rare(random));
        sum += values[r];
    }
    for (unsigned r = 0; r < m; r++) {
        squares += (values[r] - sum / m) * (values[r] - sum / m);
    }
    return (ps_compared){sum / m, m > 1 ? sqrt(squares / (m - 1) / m) : NAN, 0};
}

typedef struct experiment {
    unsigned twice_shape, num_saved, num_measured, num_checks;
    double change; /* power of the last bin of the measured side, 1 without a change */
} experiment;

typedef struct counts {
    unsigned any, last; /* checks where any bin, and where the last bin differs */
    double detectable;  /* mean over the checks, of the last bin */
} counts;

static counts run_experiment(const experiment *what, double rate) {
    counts out = {0};
    ps_random random = ps_random_init(what->num_saved * 1000 + what->num_measured,
                                      PS_STREAM_COORDINATES, what->twice_shape);
    for (unsigned i = 0; i < what->num_checks; i++) {
        ps_compared sides[2][NUM_BINS];
        ps_comparison rows[NUM_BINS];
        unsigned num = 0;
        for (unsigned b = 0; b < NUM_BINS; b++) {
            const double change = b + 1 == NUM_BINS ? what->change : 1;
            sides[0][b] = draw_mean(&random, what->twice_shape, what->num_saved, 1);
            sides[1][b] = draw_mean(&random, what->twice_shape, what->num_measured, change);
        }
        assert_ok(ps_compare(rows, NUM_BINS, sides[0], what->num_saved, sides[1],
                             what->num_measured, rate, error));
        for (unsigned b = 0; b < NUM_BINS; b++) {
            num += rows[b].differs;
        }
        out.any += num > 0;
        out.last += rows[NUM_BINS - 1].differs;
        out.detectable += rows[NUM_BINS - 1].detectable / what->num_checks;
    }
    return out;
}

static const double rate = 0.05;

/* Few and many realizations, one set against many, rings of one, three halves, four and ten
 * frequencies. Where many realizations tell the scatter the rate is not only a bound. Rare events
 * are no gamma variables: there it is exceeded, by less than 3. */
static void false_alarms(void **state) {
    (void)state;
    static const struct {
        experiment what;
        double least, most; /* in units of the rate */
    } cases[] = {{{2, 100, 1, 500, 1}, 0.5, 1}, {{2, 100, 4, 500, 1}, 0.4, 1},
                 {{3, 16, 16, 1000, 1}, 0, 1},  {{20, 64, 8, 500, 1}, 0.5, 1},
                 {{8, 4, 4, 1000, 1}, 0, 1},    {{3, 2, 1, 1000, 1}, 0, 1},
                 {{2, 8, 100, 500, 1}, 0.2, 1}, {{0, 16, 16, 500, 1}, 0, 3}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const experiment *const what = &cases[i].what;
        const double n = what->num_checks;
        const double limit = 4 * sqrt(rate * (1 - rate) * n);
        const unsigned found = run_experiment(what, rate).any;
        print_message("shape %g, M = %u and %u: %.3f false alarms at %g\n", what->twice_shape / 2.0,
                      what->num_saved, what->num_measured, found / n, rate);
        assert_true(found <= cases[i].most * rate * n + limit);
        assert_true(found >= cases[i].least * rate * n - limit / 2);
    }
}

/* What is called detectable is found with probability 0.9, and half of it seldom. */
static void power(void **state) {
    (void)state;
    static const experiment cases[] = {
        {16, 64, 16, 300, 1}, {8, 100, 4, 300, 1}, {40, 64, 1, 300, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        experiment what = cases[i];
        const double detectable = run_experiment(&what, rate).detectable;
        what.change = 1 + detectable;
        const double found = (double)run_experiment(&what, rate).last / what.num_checks;
        what.change = 1 + detectable / 4;
        const double seldom = (double)run_experiment(&what, rate).last / what.num_checks;
        print_message("shape %g, M = %u and %u: %.3g more power is found in %.3f\n",
                      what.twice_shape / 2.0, what.num_saved, what.num_measured, detectable, found);
        assert_true(found > 0.82 && found < 0.98);
        assert_true(seldom < 0.3);
    }
}

/* ---- exact cases --------------------------------------------------------------------------- */

static ps_comparison compare_one(ps_compared saved, uint64_t num_saved, ps_compared measured,
                                 uint64_t num_measured) {
    ps_comparison row;
    assert_ok(ps_compare(&row, 1, &saved, num_saved, &measured, num_measured, 0.01, error));
    return row;
}

static void deterministic_sets(void **state) {
    (void)state;
    const ps_compared set = {0.5, 0, 1e-6};
    ps_comparison row = compare_one(set, 2, (ps_compared){0.5 + 1.9e-6, 0, 1e-6}, 2);
    assert_true(!row.differs && row.p_value == 1 && row.score == 0);
    row = compare_one(set, 2, (ps_compared){0.5 + 2.1e-6, 0, 1e-6}, 1);
    assert_true(row.differs && row.p_value == 0 && row.score == HUGE_VAL);
    row = compare_one(set, 2, (ps_compared){0, 0, 1e-6}, 2);
    assert_true(row.differs && row.score == -HUGE_VAL);
    /* nothing is there on both sides, or rounding */
    assert_false(compare_one((ps_compared){0, 0, 0}, 9, (ps_compared){0, 0, 0}, 1).differs);
    assert_false(
        compare_one((ps_compared){1e-31, 1e-32, 1e-12}, 9, (ps_compared){3e-30, 1e-30, 1e-12}, 9)
            .differs);
    assert_true(
        compare_one((ps_compared){0, 0, 1e-12}, 16, (ps_compared){1, 0.2, 1e-12}, 16).differs);
}

/* Both numerical errors count against a difference, one after the other. */
static void numerical_errors(void **state) {
    (void)state;
    const ps_compared saved = {1, 0.01, 0};
    const double score = compare_one(saved, 50, (ps_compared){1.05, 0.01, 0}, 50).score;
    const double less = compare_one(saved, 50, (ps_compared){1.07, 0.01, 0.02}, 50).score;
    assert_true(score > 3 && score < 3.7);
    assert_true(fabs(score - less) < 0.1);
    assert_true(compare_one(saved, 50, (ps_compared){1.05, 0.01, 0.06}, 50).score == 0);
    /* all of the error of S in a hundredth of the frequencies: |S|^2 = 0.04 V */
    assert_near(ps_compared_error(0.04, 1e-3, 0.01, 1), 2 * 0.2 * 1e-2 + 1e-4, 1e-15);
    assert_near(ps_compared_error(0.08, 1e-3, 0.01, 2), 2 * (2 * 0.2 * 1e-2 + 1e-4), 1e-15);
}

/* Where realizations of both sides scatter alike, by s around 1, that is the scatter of both
 * together, however many there are of each; with it, what is detectable has a closed form. */
static void scatter_of_both_sides(void **state) {
    (void)state;
    static const uint64_t nums[][2] = {{2, 2}, {16, 16}, {3, 50}, {50, 3}, {9, 1}, {1, 9}};
    const double s = 0.3;
    const double ninety_percent = 1.2815515655446004;
    for (size_t i = 0; i < sizeof nums / sizeof nums[0]; i++) {
        const double m = (double)nums[i][0];
        const double n = (double)nums[i][1];
        const ps_compared saved = {1, m > 1 ? s / sqrt(m) : NAN, 0};
        const ps_compared measured = {1, n > 1 ? s / sqrt(n) : NAN, 0};
        const double score = ps_student_score(0.01, (m + n - 2) / (1 + s * s));
        const double expected = expm1((score + ninety_percent) * s * sqrt(1 / m + 1 / n));
        const double found = compare_one(saved, nums[i][0], measured, nums[i][1]).detectable;
        assert_near(found / expected, 1, 1e-9);
    }
}

/* Adjusted probabilities by hand, and the verdicts at the first of them. */
static void holm(void **state) {
    (void)state;
    enum { BINS = 4 };
    ps_compared saved[BINS];
    ps_compared measured[BINS];
    ps_comparison rows[BINS];
    static const double powers[BINS] = {1.01, 1.6, 1.3, 1.25};
    for (int b = 0; b < BINS; b++) {
        saved[b] = (ps_compared){1, 0.05, 0};
        measured[b] = (ps_compared){powers[b], powers[b] * 0.05, 0};
    }
    assert_ok(ps_compare(rows, BINS, saved, 20, measured, 20, 0.05, error));
    assert_true(rows[1].adjusted_p_value == 4 * rows[1].p_value);
    assert_true(rows[2].adjusted_p_value == 3 * rows[2].p_value);
    assert_true(rows[3].adjusted_p_value == 2 * rows[3].p_value);
    assert_true(rows[0].adjusted_p_value == rows[0].p_value && rows[0].p_value > 0.5);
    assert_true(rows[1].differs && rows[2].differs && rows[3].differs && !rows[0].differs);
    assert_ok(ps_compare(rows, BINS, saved, 20, measured, 20, rows[1].adjusted_p_value, error));
    assert_true(rows[1].differs && !rows[2].differs && !rows[3].differs);
    /* never less than what comes before it */
    measured[3] = measured[2];
    assert_ok(ps_compare(rows, BINS, saved, 20, measured, 20, 0.05, error));
    assert_true(rows[2].adjusted_p_value == rows[3].adjusted_p_value);
}

static void nonsense(void **state) {
    (void)state;
    const ps_compared saved[2] = {{1, NAN, 1e-9}, {0.5, NAN, 1e-9}};
    const ps_compared other[2] = {{1, NAN, 1e-9}, {0.7, NAN, 1e-9}};
    ps_comparison rows[2];
    assert_refused(PSPEC_ERROR_INPUT, "1 of 2 bins are not equal",
                   ps_compare(rows, 2, saved, 1, other, 1, 0.01, error));
    assert_ok(ps_compare(rows, 2, saved, 1, saved, 1, 0.01, error));
    assert_false(rows[0].differs || rows[1].differs);
    assert_refused(PSPEC_ERROR_INPUT, "no rings",
                   ps_compare(rows, 0, saved, 9, other, 9, 0.01, error));
    static const double rates[] = {0, 1, -1, 2, NAN};
    for (size_t i = 0; i < sizeof rates / sizeof rates[0]; i++) {
        assert_refused(PSPEC_ERROR_INVALID_ARGUMENT, "false alarm rate",
                       ps_compare(rows, 2, saved, 9, other, 9, rates[i], error));
    }
    /* what is no number is not that number */
    assert_true(compare_one((ps_compared){1, 0.1, 0}, 9, (ps_compared){NAN, 0.1, 0}, 9).differs);
}

static void numbers_of_modes(void **state) {
    (void)state;
    ps_frequencies set;
    assert_ok(ps_frequencies_lattice(&set, 3, 4, true, error));
    assert_true(ps_compared_modes(&set) == 9 * 9 * 9 - 1);
    for (int is_even = 0; is_even < 2; is_even++) {
        double expected = 0;
        assert_ok(ps_frequencies_degrees(&set, 7, is_even != 0, error));
        for (int l = 1 + is_even; l <= 7; l += 1 + is_even) {
            expected += 2 * l + 1;
        }
        assert_true(ps_compared_modes(&set) == expected);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(false_alarms),
        cmocka_unit_test(power),
        cmocka_unit_test(deterministic_sets),
        cmocka_unit_test(numerical_errors),
        cmocka_unit_test(scatter_of_both_sides),
        cmocka_unit_test(holm),
        cmocka_unit_test(nonsense),
        cmocka_unit_test(numbers_of_modes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
