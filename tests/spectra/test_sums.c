/* Mean and standard error from streamed sums, against two passes in long double. */
#include "harness.h"

#include "spectra/sums.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* Added up one after the other, or, running, as sums over realizations are. */
typedef struct adding {
    ps_sums plain;
    ps_running_sums running;
    bool is_running;
} adding;

static void begin(adding *adds, bool is_running) {
    *adds = (adding){.is_running = is_running};
    assert_ok(ps_running_sums_create(&adds->running, 1, 0, false, error));
}

static void add(adding *adds, double x) {
    if (adds->is_running) {
        assert_ok(ps_running_sums_reserve(&adds->running, adds->running.count + 1, error));
        ps_running_sums_add(&adds->running, &x, NULL);
    } else {
        ps_sums_add(&adds->plain, x);
    }
}

static void end(adding *adds, size_t count, double *mean, double *standard_error) {
    const ps_sums sums = adds->is_running ? ps_running_sums_get(&adds->running, 0) : adds->plain;
    ps_sums_finish(&sums, count, mean, standard_error);
    ps_running_sums_free(&adds->running);
}

static void finish_by(bool is_running, const double *x, size_t count, double *mean,
                      double *standard_error) {
    adding sums;
    begin(&sums, is_running);
    for (size_t i = 0; i < count; i++) {
        add(&sums, x[i]);
    }
    end(&sums, count, mean, standard_error);
}

static void finish(const double *x, size_t count, double *mean, double *standard_error) {
    double plain[2];
    finish_by(true, x, count, mean, standard_error);
    finish_by(false, x, count, &plain[0], &plain[1]);
    assert_true(isnan(plain[0]) || fabs(plain[0] - *mean) <= DBL_EPSILON * fabs(*mean));
    assert_true(isnan(plain[1]) || fabs(plain[1] - *standard_error) <= 1e-12 * *standard_error);
}

/* Relative error of the standard error within tolerance; the mean to the last bit but one. */
static void check_sums(const double *x, size_t count, double tolerance) {
    long double sum = 0;
    long double squares = 0;
    double mean = 0;
    double standard_error = 0;
    finish(x, count, &mean, &standard_error);
    for (size_t i = 0; i < count; i++) {
        sum += x[i];
    }
    const long double n = (long double)count;
    for (size_t i = 0; i < count; i++) {
        squares += (x[i] - sum / n) * (x[i] - sum / n);
    }
    const double expected = (double)sqrtl(squares / (n - 1) / n);
    assert_true(fabs(mean - (double)(sum / n)) <= DBL_EPSILON * fabs(mean));
    if (!(fabs(standard_error / expected - 1) <= tolerance)) {
        fail_msg("standard error of %zu numbers is %.17g, expected %.17g", count, standard_error,
                 expected);
    }
}

static void ordinary_numbers(void **state) {
    (void)state;
    enum { MOST = 1000 };
    double x[MOST];
    uint64_t seed = 7;
    for (size_t i = 0; i < MOST; i++) {
        x[i] = -log1p(-test_uniform(&seed)); /* like powers of white noise */
    }
    for (size_t count = 2; count <= MOST; count += count < 20 ? 1 : 97) {
        check_sums(x, count, 4 * DBL_EPSILON);
    }
}

/* A variance that is 1e-16 of the mean squared: raw sums in double would have no digit of it. */
static void small_beside_large(void **state) {
    (void)state;
    enum { COUNT = 100000 };
    double *x = malloc(COUNT * sizeof *x);
    uint64_t seed = 8;
    assert_non_null(x);
    for (size_t i = 0; i < COUNT; i++) {
        x[i] = 1e8 + test_uniform(&seed);
    }
    check_sums(x, COUNT, 1e-12);
    free(x);
}

static void two_numbers(void **state) {
    (void)state;
    double mean = 0;
    double standard_error = 0;
    finish((const double[]){1, 2}, 2, &mean, &standard_error);
    assert_true(mean == 1.5 && standard_error == 0.5);
    finish((const double[]){-3, 5}, 2, &mean, &standard_error);
    assert_true(mean == 1 && standard_error == 4);
    finish((const double[]){1, 1 + 4 * DBL_EPSILON}, 2, &mean, &standard_error);
    assert_true(standard_error == 2 * DBL_EPSILON);
}

static void check_equal_numbers(bool is_running) {
    const double values[] = {0, 1, 0.1, 1.0 / 3, 1e-300, 1e8 + 0.1, 3.7e12, 1.2345678901234567e-5};
    const size_t counts[] = {2, 3, 7, 10, 1000, 100000, 1000000};
    for (size_t v = 0; v < sizeof values / sizeof values[0]; v++) {
        for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++) {
            adding sums;
            double mean = -1;
            double standard_error = -1;
            begin(&sums, is_running);
            for (size_t i = 0; i < counts[c]; i++) {
                add(&sums, values[v]);
            }
            end(&sums, counts[c], &mean, &standard_error);
            if (standard_error != 0) {
                fail_msg("%zu times %.17g has the standard error %.3g", counts[c], values[v],
                         standard_error);
            }
            assert_true(fabs(mean - values[v]) <= DBL_EPSILON * values[v]);
        }
    }
}

static void equal_numbers_have_no_error(void **state) {
    (void)state;
    check_equal_numbers(false);
    check_equal_numbers(true);
}

static void one_number_has_no_standard_error(void **state) {
    (void)state;
    double mean = 0;
    double standard_error = 0;
    finish((const double[]){0.3}, 1, &mean, &standard_error);
    assert_true(mean == 0.3 && isnan(standard_error));
    finish(NULL, 0, &mean, &standard_error);
    assert_true(isnan(mean) && isnan(standard_error));
}

/* ---- merged sums ---- */

static ps_sums sums_of(const double *x, size_t count) {
    ps_sums sums = {0};
    for (size_t i = 0; i < count; i++) {
        ps_sums_add(&sums, x[i]);
    }
    return sums;
}

/* All four numbers are of the sum to its last digit, also those that lie in low parts alone. */
static void merged_pairs_keep_low_parts(void **state) {
    (void)state;
    const double tiny = 0x1p-80;
    const ps_sums other = {1, tiny, 1, 3 * tiny};
    ps_sums sums = {1, 5 * tiny, 1, 7 * tiny};
    ps_sums_merge(&sums, &other, 1);
    assert_true(sums.sum == 2 && sums.sum_low == 6 * tiny);
    assert_true(sums.square == 2 && sums.square_low == 10 * tiny);
    ps_sums_merge(&sums, &other, 4); /* squares 16 times */
    assert_true(sums.sum == 6 && sums.sum_low == 10 * tiny);
    assert_true(sums.square == 18 && sums.square_low == 58 * tiny);
}

/* Where the factor has all digits, products are exact, too: f x and f^2 x are sums of two doubles
 * each. */
static void merged_pairs_keep_products(void **state) {
    (void)state;
    const double factor = 1 + DBL_EPSILON;
    const ps_sums other = {1 + DBL_EPSILON, 0, 1, 0};
    ps_sums sums = {0};
    ps_sums_merge(&sums, &other, factor);
    /* (1 + e)^2 = 1 + 2 e + e^2 */
    assert_true(sums.sum == 1 + 2 * DBL_EPSILON && sums.sum_low == DBL_EPSILON * DBL_EPSILON);
    assert_true(sums.square == 1 + 2 * DBL_EPSILON && sums.square_low == DBL_EPSILON * DBL_EPSILON);
}

/* Parts of numbers whose variance is 1e-16 of the mean squared, merged one after another and as a
 * tree, have the variance of the whole. */
static void merged_parts_keep_the_variance(void **state) {
    (void)state;
    enum { PARTS = 64, COUNT = 64 * PARTS };
    double x[COUNT];
    ps_sums parts[PARTS];
    uint64_t seed = 9;
    double expected[2];
    double found[2];
    for (size_t i = 0; i < COUNT; i++) {
        x[i] = 1e8 + test_uniform(&seed);
    }
    finish(x, COUNT, &expected[0], &expected[1]);
    ps_sums chain = {0};
    for (size_t i = 0; i < PARTS; i++) {
        parts[i] = sums_of(x + i * (COUNT / PARTS), COUNT / PARTS);
        ps_sums_merge(&chain, &parts[i], 1);
    }
    for (size_t step = 1; step < PARTS; step *= 2) {
        for (size_t i = 0; i < PARTS; i += 2 * step) {
            ps_sums_merge(&parts[i], &parts[i + step], 1);
        }
    }
    const ps_sums both[] = {chain, parts[0]};
    for (size_t i = 0; i < 2; i++) {
        ps_sums_finish(&both[i], COUNT, &found[0], &found[1]);
        assert_true(found[0] == expected[0]);
        assert_true(fabs(found[1] / expected[1] - 1) < 1e-12);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ordinary_numbers),
        cmocka_unit_test(small_beside_large),
        cmocka_unit_test(two_numbers),
        cmocka_unit_test(equal_numbers_have_no_error),
        cmocka_unit_test(one_number_has_no_standard_error),
        cmocka_unit_test(merged_pairs_keep_low_parts),
        cmocka_unit_test(merged_pairs_keep_products),
        cmocka_unit_test(merged_parts_keep_the_variance),
    };
    return cmocka_run_group_tests_name("sums", tests, NULL, NULL);
}
