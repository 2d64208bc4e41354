/* Sampled rings through the whole of the library: against complete rings, white noise and lattices
 * in four to six dimensions.
 */
#include "harness_public.h"

#include <math.h>
#include <stdio.h>

static pspec_answer *ask(pspec_context *context, unsigned dimension, int k, const char *more,
                         size_t num_realizations, size_t num_points) {
    char line[256];
    test_sample what = test_make_sample(num_realizations, dimension, num_points, 0, false);
    snprintf(line, sizeof line, "power max-frequency=%d engine=host_direct %s", k, more);
    pspec_answer *answer = test_public_ask(context, line, what.patterns, num_realizations);
    test_free_sample(&what);
    return answer;
}

/* ---- against complete rings -------------------------------------------------------------- */

static void complete_rings_have_the_same_bits(void **state) {
    (void)state;
    pspec_context *context = pspec_context_create();
    for (unsigned dimension = 1; dimension <= 5; dimension++) {
        for (int shells = 0; shells <= 1; shells++) {
            pspec_answer *all = ask(context, dimension, 3, shells ? "bins=shells" : "", 3, 20);
            pspec_answer *sampled =
                ask(context, dimension, 3,
                    shells ? "bins=shells per-ring=100000" : "per-ring=100000", 3, 20);
            assert_true(test_public_same(all, sampled));
            pspec_answer_destroy(all);
            pspec_answer_destroy(sampled);
        }
    }
    pspec_context_destroy(context);
}

/* Rings with few frequencies are complete: their means are those of the whole. The others hold the
 * powers that the whole has at the same frequencies. */
static void small_rings_are_complete(void **state) {
    (void)state;
    enum { PER_RING = 30 };
    pspec_context *context = pspec_context_create();
    pspec_answer *all = ask(context, 3, 5, "", 3, 20);
    pspec_answer *sampled = ask(context, 3, 5, "per-ring=30", 3, 20);
    const pspec_field *const counts = test_public_field(all, "count", PSPEC_I64);
    const int64_t *const other = test_public_field(sampled, "count", PSPEC_I64)->data;
    const double *const a = test_public_numbers(all, "power");
    const double *const b = test_public_numbers(sampled, "power");
    const double *const errors = test_public_numbers(sampled, "standard_error");
    size_t num_complete = 0;
    assert_int_equal(counts->num, 5);
    for (size_t i = 0; i < counts->num; i++) {
        const int64_t count = ((const int64_t *)counts->data)[i];
        const bool is_complete = count / 2 <= PER_RING;
        assert_int_equal(count, other[i]);
        assert_true(fabs(test_public_numbers(all, "frequency")[i] /
                             test_public_numbers(sampled, "frequency")[i] -
                         1) < 1e-14);
        num_complete += is_complete;
        if (is_complete) {
            assert_true(fabs(a[i] / b[i] - 1) < 1e-14);
            assert_true(fabs(test_public_numbers(all, "standard_error")[i] / errors[i] - 1) <
                        1e-12);
        } else {
            assert_true(fabs(a[i] - b[i]) < 5 * errors[i] && errors[i] > 0);
        }
    }
    assert_true(num_complete > 0 && num_complete < counts->num);
    pspec_answer_destroy(all);
    pspec_answer_destroy(sampled);
    pspec_context_destroy(context);
}

/* ---- laws -------------------------------------------------------------------------------- */

static void white_noise_in_many_dimensions(void **state) {
    (void)state;
    enum { REALIZATIONS = 60, K = 30 };
    pspec_context *context = pspec_context_create();
    for (unsigned dimension = 4; dimension <= 6; dimension++) {
        pspec_answer *answer = ask(context, dimension, K, "per-ring=8", REALIZATIONS, 16);
        const pspec_field *const power = test_public_field(answer, "power", PSPEC_F64);
        double squares = 0;
        assert_int_equal(power->num, K);
        for (size_t b = 0; b < K; b++) {
            const double deviation = (((const double *)power->data)[b] - 1) /
                                     test_public_numbers(answer, "standard_error")[b];
            squares += deviation * deviation;
            assert_true(fabs(deviation) < 4.5);
        }
        assert_true(fabs(squares / K - 1) < 5 * sqrt(2.0 / K)); /* chi-square */
        pspec_answer_destroy(answer);
    }
    pspec_context_destroy(context);
}

/* A grid of 2^d points: power N where all k_i are even, else 0. Shells of odd |k|^2 hold nothing,
 * that of |k|^2 = 4 in six dimensions 12 peaks among 252 frequencies. */
static void peaks_of_a_grid(void **state) {
    (void)state;
    enum { DIMENSION = 6, NUM = 64, SEEDS = 200 };
    double points[NUM][DIMENSION];
    for (unsigned j = 0; j < NUM; j++) {
        for (unsigned i = 0; i < DIMENSION; i++) {
            points[j][i] = (j >> i & 1) * 0.5;
        }
    }
    const pspec_pattern pattern = {DIMENSION, NUM, &points[0][0], NULL};
    pspec_context *context = pspec_context_create();
    pspec_question *const question = test_public_question(
        context, "power max-frequency=2 per-ring=40 bins=shells engine=host_direct");
    double sum = 0;
    double squares = 0;
    test_public_add(question, &pattern, 1);
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        assert_int_equal(pspec_question_set_number(question, "seed", (double)seed), PSPEC_OK);
        pspec_answer *answer = test_public_answer(context, question);
        const pspec_field *const power = test_public_field(answer, "power", PSPEC_F64);
        const double *const powers = power->data;
        assert_int_equal(power->num, 6);
        for (size_t b = 0; b < power->num; b += 2) {
            assert_true(fabs(powers[b]) < 1e-12);
        }
        assert_int_equal(((const int64_t *)pspec_answer_find(answer, "count")->data)[3], 252);
        const double error = test_public_numbers(answer, "standard_error")[3];
        sum += powers[3];
        squares += error * error;
        pspec_answer_destroy(answer);
    }
    pspec_question_destroy(question);
    const double expected = 12.0 / 252 * NUM;
    assert_true(fabs(sum / SEEDS - expected) < 4 * sqrt(squares) / SEEDS);
    pspec_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(complete_rings_have_the_same_bits),
        cmocka_unit_test(small_rings_are_complete),
        cmocka_unit_test(white_noise_in_many_dimensions),
        cmocka_unit_test(peaks_of_a_grid),
    };
    return cmocka_run_group_tests_name("per_ring", tests, NULL, NULL);
}
