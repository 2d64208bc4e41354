/* Exponents and crossings: exact laws, errors of what depends on each other, and what is refused.
 */
#include "harness.h"

#include "harness_angular.h"

#include "jobs/variance/rates.h"
#include "math/random/random.h"

#include <math.h>
#include <string.h>

enum { MOST = 12 };
static const double THREE_ERRORS = 0.0027; /* of normal numbers */

/* Each value is the same part of all: no scatter but what blocks have. */
static ps_log_variance make(double points, double variance, double error) {
    ps_log_variance out;
    ps_block_sums blocks = {0};
    for (int i = 0; i < 4; i++) {
        ps_block_sums_add(&blocks, i % 2 == 0 ? 1 : 3);
    }
    ps_log_variance_make(&out, points, (ps_mean){variance, error}, &blocks);
    return out;
}

/* Independent ones: a block each. */
static ps_log_variance make_alone(size_t i, double points, double value, double error) {
    ps_log_variance out = {.points = points, .value = value, .error = error};
    out.deviations[i] = error;
    return out;
}

/* ---- blocks -------------------------------------------------------------------------------- */

static double product(const double *a, const double *b) {
    double sum = 0;
    for (size_t i = 0; i < PS_MOST_BLOCKS; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

static void blocks_have_the_errors_of_means(void **state) {
    (void)state;
    ps_random random = ps_random_init(3, 0, 0);
    static const uint64_t counts[] = {2, 3, 100, 256};
    for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++) {
        ps_block_sums x = {0};
        ps_block_sums y = {0};
        ps_sums sums[3] = {{0}};
        double mean = 0;
        double error[3];
        double a[PS_MOST_BLOCKS];
        double b[PS_MOST_BLOCKS];
        for (uint64_t i = 0; i < counts[c]; i++) {
            const double u = ps_random_uniform(&random);
            const double v = ps_random_uniform(&random) + u;
            ps_block_sums_add(&x, u);
            ps_block_sums_add(&y, v);
            ps_sums_add(&sums[0], u);
            ps_sums_add(&sums[1], v);
            ps_sums_add(&sums[2], u + v);
        }
        assert_int_equal(ps_block_sums_deviations(&x, a), counts[c]);
        assert_int_equal(ps_block_sums_deviations(&y, b), counts[c]);
        for (int i = 0; i < 3; i++) {
            ps_sums_finish(&sums[i], counts[c], &mean, &error[i]);
        }
        test_assert_near(sqrt(product(a, a)), error[0], 1e-13);
        test_assert_near(sqrt(product(b, b)), error[1], 1e-13);
        /* Var(x + y) = Var x + Var y + 2 Cov */
        const double both = error[2] * error[2];
        test_assert_near(product(a, a) + product(b, b) + 2 * product(a, b), both, 1e-13);
    }
}

static void many_numbers_have_few_blocks(void **state) {
    (void)state;
    ps_block_sums x = {0};
    double a[PS_MOST_BLOCKS];
    assert_int_equal(ps_block_sums_deviations(&x, a), 0);
    ps_block_sums_add(&x, 5);
    assert_int_equal(ps_block_sums_deviations(&x, a), 0);
    for (int i = 1; i < 1000; i++) {
        ps_block_sums_add(&x, 5);
    }
    /* 250 of four */
    assert_int_equal(ps_block_sums_deviations(&x, a), 250);
    assert_int_equal(x.length, 4);
    test_assert_near(product(a, a), 0, 1e-28);
    ps_block_sums_add(&x, 7); /* a block of one: 1001 numbers, of mean 5 + 2/1001 */
    assert_int_equal(ps_block_sums_deviations(&x, a), 251);
    test_assert_near(a[250], (2 - 2. / 1001) / 1001 * sqrt(251. / 250), 1e-15);
}

/* ---- rates --------------------------------------------------------------------------------- */

static void laws_are_given_back(void **state) {
    (void)state;
    static const double rates[] = {1, 1.5, 2, 4. / 3, 0};
    ps_log_variance logs[MOST];
    ps_rate found;
    ps_error error = {0};
    for (size_t r = 0; r < sizeof rates / sizeof rates[0]; r++) {
        for (size_t i = 0; i < MOST; i++) {
            const double n = pow(2, (double)i + 4);
            const double variance = 0.3 * pow(n, -rates[r]);
            logs[i] = make(n, variance, (double)(i % 3 + 1) * 1e-9 * variance);
        }
        for (size_t num = 2; num <= MOST; num++) {
            assert_int_equal(ps_rate_fit(&found, logs, num, &error), PSPEC_OK);
            test_assert_near(found.rate.value, rates[r], 1e-12);
            assert_true(num == 2 ? isnan(found.change.value) : fabs(found.change.value) < 1e-11);
            assert_true(found.from == 16 && found.to == logs[num - 1].points);
        }
        test_assert_near(ps_rate_between(&logs[2], &logs[5]).value, rates[r], 1e-12);
    }
}

static void a_curve_has_its_change(void **state) {
    (void)state;
    ps_log_variance logs[5];
    ps_rate found;
    ps_error error = {0};
    for (size_t i = 0; i < 5; i++) {
        const double octaves = (double)i;
        /* exponents 1, 1.25, 1.5, 1.75 between neighbours */
        const double value = -log(2) * (octaves + 0.125 * octaves * (octaves - 1));
        logs[i] = make_alone(i, pow(2, octaves), value, 1e-6);
    }
    assert_int_equal(ps_rate_fit(&found, logs, 5, &error), PSPEC_OK);
    test_assert_near(found.change.value, 0.25, 1e-12);
    test_assert_near(found.rate.value, 1.375, 1e-12);
    test_assert_near(ps_rate_between(&logs[3], &logs[4]).value, 1.75, 1e-12);
}

/* Errors: of independent ones as the normal equations have it, of one common factor none, of two
 * that go against each other twice. */
static void errors_know_what_depends(void **state) {
    (void)state;
    ps_log_variance logs[3];
    ps_rate found;
    ps_error error = {0};
    for (size_t i = 0; i < 3; i++) {
        logs[i] = make_alone(i, exp((double)i), -(double)i, 0.1);
    }
    assert_int_equal(ps_rate_fit(&found, logs, 3, &error), PSPEC_OK);
    test_assert_near(found.rate.error, 0.1 / sqrt(2), 1e-14);
    for (size_t i = 0; i < 3; i++) {
        logs[i] = make_alone(0, exp((double)i), -(double)i, 0.1);
    }
    assert_int_equal(ps_rate_fit(&found, logs, 3, &error), PSPEC_OK);
    test_assert_near(found.rate.error, 0, 1e-14);
    logs[2].deviations[0] = -0.1;
    assert_int_equal(ps_rate_fit(&found, logs, 3, &error), PSPEC_OK);
    test_assert_near(found.rate.error, 0.1, 1e-14);
    test_assert_near(ps_rate_between(&logs[0], &logs[2]).error, 0.1, 1e-14);
}

static void refuse(const ps_log_variance *logs, size_t num, const char *sentence) {
    ps_rate found;
    ps_error error = {0};
    assert_int_equal(ps_rate_fit(&found, logs, num, &error), PSPEC_ERROR_INPUT);
    if (strstr(error.message, sentence) == NULL) {
        fail_msg("\"%s\", not \"%s\"", error.message, sentence);
    }
}

static void what_is_no_line_has_a_sentence(void **state) {
    (void)state;
    ps_log_variance logs[2] = {make(16, 1, 0.1), make(64, 0.5, 0.1)};
    refuse(logs, 0, "there are 0");
    refuse(logs, 1, "there is 1");
    logs[1] = make(16, 0.5, 0.1);
    refuse(logs, 2, "there is 1");
    logs[1] = make(64, 0.5, 0);
    refuse(logs, 2, "at N = 64 has no standard error");
    logs[1] = make(64, 0.5, NAN);
    refuse(logs, 2, "at N = 64 has no standard error");
    logs[1] = make(64, 0, 0);
    refuse(logs, 2, "at N = 64 is 0");
    logs[0] = make(16, NAN, NAN);
    refuse(logs, 2, "at N = 16 is 0 or unknown");
}

/* Of what is no line the rate is a mean of slopes with weights that errors have no part in:
 * u (n - u) of the gap before number u of n, where gaps are equal. */
static void a_rate_is_a_mean_of_slopes(void **state) {
    (void)state;
    const double values[] = {0, -1, -2.5, -4, -7};
    ps_log_variance logs[5];
    ps_rate found;
    ps_error error = {0};
    double slopes = 0;
    double square = 0;
    for (size_t i = 0; i < 5; i++) {
        const double own = 0.1 * pow(2, (double)i);
        logs[i] = make_alone(i, exp((double)i), values[i], own);
        slopes += i > 0 ? (double)(i * (5 - i)) / 20 * (values[i - 1] - values[i]) : 0;
        square += pow(((double)i - 2) / 10 * own, 2);
    }
    assert_int_equal(ps_rate_fit(&found, logs, 5, &error), PSPEC_OK);
    test_assert_near(found.rate.value, slopes, 1e-14);
    test_assert_near(found.rate.error, sqrt(square), 1e-14);
}

/* The logarithm of a mean with the relative error e is e^2/2 too small on average. */
static void logarithms_are_not_biased(void **state) {
    (void)state;
    const ps_log_variance one = make(16, 0.5, 0.1);
    const ps_log_variance exact = make(16, 0.5, 0);
    test_assert_near(one.value, log(0.5) + 0.02, 1e-15);
    test_assert_near(one.error, 0.2, 1e-15);
    test_assert_near(exact.value, log(0.5), 1e-15);
}

/* ---- noise --------------------------------------------------------------------------------- */

/* Means of M numbers of a gamma distribution with mean 1 and an even number of halves, half of each
 * being that of the same realization at the N before, as nested sets have it. */
static void simulate(ps_log_variance *logs, size_t num, double factor, double rate, uint64_t m,
                     ps_random *random) {
    enum { TERMS = 4 };
    ps_block_sums blocks[MOST] = {{0}};
    ps_sums sums[MOST] = {{0}};
    for (uint64_t r = 0; r < m; r++) {
        double before = 0;
        for (size_t i = 0; i < num; i++) {
            double own = 0;
            for (int t = 0; t < TERMS; t++) {
                own -= log(1 - ps_random_uniform(random)) / TERMS;
            }
            const double x = i == 0 ? own : (own + before) / 2;
            before = own;
            ps_block_sums_add(&blocks[i], x);
            ps_sums_add(&sums[i], x);
        }
    }
    for (size_t i = 0; i < num; i++) {
        const double n = pow(2, 4 + (double)i);
        const double law = factor * pow(n, -rate);
        ps_mean mean;
        ps_sums_finish(&sums[i], m, &mean.mean, &mean.standard_error);
        mean.mean *= law;
        mean.standard_error *= law;
        ps_log_variance_make(&logs[i], n, mean, &blocks[i]);
    }
}

/* Of 1000 seeds: how many lie within one standard error, and the mean square of scores. */
typedef struct calibration {
    double within, square, mean;
} calibration;

static void add_score(calibration *self, ps_uncertain found, double exact) {
    const double score = (found.value - exact) / found.error;
    self->within += fabs(score) < 1 ? 1e-3 : 0;
    self->square += score * score / 1000;
    self->mean += score / 1000;
}

/* 0.683 has the standard deviation 0.015. */
static void assert_calibrated(const char *what, uint64_t m, const calibration *found,
                              double square) {
    if (!(fabs(found->within - 0.683) < 0.05 && found->square < square &&
          fabs(found->mean) < 0.25)) {
        fail_msg("%s, M = %d: within %.3f, square %.3f, mean %.3f", what, (int)m, found->within,
                 found->square, found->mean);
    }
    print_message("%s, M = %d: within %.3f, square %.3f, mean %.3f\n", what, (int)m, found->within,
                  found->square, found->mean);
}

static void errors_are_calibrated(void **state) {
    (void)state;
    static const uint64_t counts[] = {10, 40, 300};
    static const double squares[] = {1.35, 1.2, 1.2};
    /* by Student's quantiles ten realizations do not always tell the ends apart */
    static const size_t fewest[] = {960, 990, 990};
    for (size_t c = 0; c < 3; c++) {
        calibration rates = {0};
        calibration changes = {0};
        calibration crossings = {0};
        size_t num_crossings = 0;
        for (uint64_t seed = 0; seed < 1000; seed++) {
            ps_random random = ps_random_init(seed, 0, counts[c]);
            ps_log_variance a[MOST];
            ps_log_variance b[MOST];
            ps_crossing memory[MOST];
            ps_crossings found;
            ps_rate rate;
            ps_error error = {0};
            simulate(a, MOST, 1, 1.5, counts[c], &random);
            simulate(b, MOST, 0.0625, 1, counts[c], &random); /* N = 256 */
            assert_int_equal(ps_rate_fit(&rate, a, 8, &error), PSPEC_OK);
            assert_int_equal(ps_crossings_find(&found, memory, a, b, MOST, THREE_ERRORS, &error),
                             PSPEC_OK);
            add_score(&rates, rate.rate, 1.5);
            add_score(&changes, rate.change, 0);
            num_crossings += found.num;
            const double points = memory[0].points.value;
            if (found.num == 1) {
                assert_false(memory[0].is_a_below);
                add_score(
                    &crossings,
                    (ps_uncertain){.value = log(points), .error = memory[0].points.error / points},
                    log(256));
            }
        }
        assert_in_range(num_crossings, fewest[c], 1010);
        assert_calibrated("rates", counts[c], &rates, squares[c]);
        assert_calibrated("changes", counts[c], &changes, squares[c]);
        assert_calibrated("crossings", counts[c], &crossings, squares[c]);
    }
}

/* ---- crossings ----------------------------------------------------------------------------- */

static void lines_cross_where_they_do(void **state) {
    (void)state;
    ps_log_variance a[MOST];
    ps_log_variance b[MOST];
    ps_crossing memory[MOST];
    ps_crossings found;
    ps_error error = {0};
    /* N^-1.5 and N^-1/20: at N = 400, of which 256 and 512 alone are told apart */
    for (size_t i = 0; i < MOST; i++) {
        const double n = pow(2, (double)i + 1);
        a[i] = make_alone(i, n, -1.5 * log(n), 0.02);
        b[i] = make_alone(MOST + i, n, -log(20 * n), 0.02);
    }
    assert_int_equal(ps_crossings_find(&found, memory, a, b, MOST, THREE_ERRORS, &error), PSPEC_OK);
    assert_int_equal(found.num, 1);
    assert_int_equal(found.num_a, 4);
    assert_int_equal(found.num_b, 8);
    assert_false(memory[0].is_a_below);
    test_assert_near(memory[0].points.value, 400, 1e-9);
    /* ln(a/b) = (ln 400 - ln N) / 2 at both ends, of which a share t and 1 - t counts */
    const double t = log(400. / 256) / log(2);
    test_assert_near(memory[0].points.error, 400 * 2 * 0.02 * sqrt(2) * hypot(t, 1 - t), 1e-9);
    assert_int_equal(ps_crossings_find(&found, memory, b, a, MOST, THREE_ERRORS, &error), PSPEC_OK);
    assert_true(found.num == 1 && memory[0].is_a_below);
    /* the end that is known less well counts by its share */
    a[8] = make_alone(8, 512, a[8].value, 0.03);
    assert_int_equal(ps_crossings_find(&found, memory, a, b, MOST, THREE_ERRORS, &error), PSPEC_OK);
    test_assert_near(memory[0].points.error,
                     400 * 2 * hypot((1 - t) * hypot(0.02, 0.02), t * hypot(0.03, 0.02)), 1e-9);
    /* not told apart between 64 and 2048: the line goes through all of them */
    for (size_t i = 0; i < MOST; i++) {
        a[i].error = a[i].deviations[i] = 0.25;
        b[i].error = b[i].deviations[MOST + i] = 0.02;
    }
    assert_int_equal(ps_crossings_find(&found, memory, a, b, MOST, THREE_ERRORS, &error), PSPEC_OK);
    assert_int_equal(found.num, 1);
    test_assert_near(memory[0].points.value, 400, 1e-9);
    assert_true(memory[0].points.error < 400 * 2 * 0.25);
    /* at other N, of the same law */
    for (size_t i = 0; i < MOST; i++) {
        const double n = b[i].points * (i % 2 == 0 ? 1.03 : 0.98);
        b[i] = make_alone(MOST + i, n, -log(20 * n), 0.02);
    }
    assert_true(ps_crossings_have_same_points(a, b, MOST));
    assert_int_equal(ps_crossings_find(&found, memory, a, b, MOST, THREE_ERRORS, &error), PSPEC_OK);
    assert_int_equal(found.num, 1);
    test_assert_near(memory[0].points.value, 400, 1e-9);
    for (size_t i = 0; i < MOST; i++) {
        a[i] = make_alone(i, a[i].points, a[i].value, 0.02);
    }
    assert_int_equal(ps_crossings_find(&found, memory, a, b, MOST, THREE_ERRORS, &error), PSPEC_OK);
    const double share[] = {log(256 / b[7].points) / log(b[8].points / b[7].points),
                            log(512 / b[8].points) / log(b[9].points / b[8].points)};
    const double at_a = hypot(1 - t, t);
    const double at_b = hypot(hypot((1 - t) * (1 - share[0]), t * share[1]),
                              (1 - t) * share[0] + t * (1 - share[1]));
    test_assert_near(memory[0].points.error, 400 * 2 * 0.02 * hypot(at_a, at_b), 1e-9);
    b[3].points *= 1.1;
    assert_false(ps_crossings_have_same_points(a, b, MOST));
    assert_false(ps_crossings_have_same_points(a, b + 1, 1));
    /* and not at all */
    assert_int_equal(ps_crossings_find(&found, memory, a, a, MOST, THREE_ERRORS, &error), PSPEC_OK);
    assert_true(found.num == 0 && found.num_a == 0 && found.num_b == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_have_the_errors_of_means),
        cmocka_unit_test(many_numbers_have_few_blocks),
        cmocka_unit_test(laws_are_given_back),
        cmocka_unit_test(a_curve_has_its_change),
        cmocka_unit_test(errors_know_what_depends),
        cmocka_unit_test(a_rate_is_a_mean_of_slopes),
        cmocka_unit_test(logarithms_are_not_biased),
        cmocka_unit_test(what_is_no_line_has_a_sentence),
        cmocka_unit_test(errors_are_calibrated),
        cmocka_unit_test(lines_cross_where_they_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
