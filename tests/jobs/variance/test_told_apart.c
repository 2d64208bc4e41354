/* Which variances are told apart: probabilities, and how often those of equal samplers are. */
#include "harness.h"

#include "harness_angular.h"

#include "jobs/variance/rates.h"
#include "math/pi.h"
#include "math/random/random.h"

enum { MOST_SAMPLERS = 10 };

/* Independent ones, of exponential numbers with mean 1. */
static void simulate_alone(ps_log_variance *logs, size_t num, uint64_t m, ps_random *random) {
    for (size_t i = 0; i < num; i++) {
        ps_block_sums blocks = {0};
        ps_sums sums = {0};
        ps_mean mean;
        for (uint64_t r = 0; r < m; r++) {
            const double x = -log(1 - ps_random_uniform(random));
            ps_block_sums_add(&blocks, x);
            ps_sums_add(&sums, x);
        }
        ps_sums_finish(&sums, m, &mean.mean, &mean.standard_error);
        ps_log_variance_make(&logs[i], 16, mean, &blocks);
    }
}

/* Student's probabilities, closed for one and two degrees of freedom; the score is without the
 * factor of few blocks, and squares that scatter take degrees away. */
static void probabilities_are_those_of_student(void **state) {
    (void)state;
    const double scores[] = {0, 0.5, 3, 40};
    for (size_t i = 0; i < sizeof scores / sizeof scores[0]; i++) {
        const double t = scores[i];
        const ps_uncertain one = {.value = 1 + 0.1 * t, .plain = 0.1, .freedom = 1};
        const ps_uncertain two = {.value = 1 - 0.1 * t, .plain = 0.1, .freedom = 2};
        test_assert_near(ps_uncertain_p_value(&one, 1), 1 - 2 / PS_PI * atan(t), 1e-14);
        test_assert_near(ps_uncertain_p_value(&two, 1), 1 - t / sqrt(2 + t * t), 1e-14);
    }
    const ps_uncertain exact = {.value = 1};
    const ps_uncertain unknown = PS_UNCERTAIN_NONE;
    assert_true(ps_uncertain_p_value(&exact, 1) == 1 && ps_uncertain_p_value(&exact, 2) == 0);
    assert_true(isnan(ps_uncertain_p_value(&unknown, 1)));
    /* eight numbers of 1 and 3: a relative variance of 2/7 */
    ps_block_sums blocks = {0};
    ps_log_variance logs[2];
    const double factors[] = {1, -1};
    for (int i = 0; i < 8; i++) {
        ps_block_sums_add(&blocks, i % 2 == 0 ? 1 : 3);
    }
    ps_log_variance_make(&logs[0], 16, (ps_mean){2, sqrt(8. / 7 / 8)}, &blocks);
    ps_log_variance_make(&logs[1], 16, (ps_mean){2, 0}, &blocks);
    const ps_uncertain found = ps_log_variances_combine(logs, factors, 2);
    test_assert_near(found.freedom, 7 / (1 + 2. / 7), 1e-14);
    test_assert_near(found.plain, sqrt(1. / 28), 1e-14);
    test_assert_near(found.error, sqrt(1. / 28 * 7 / 5), 1e-14);
}

/* Equal samplers that scatter as powers at one frequency do, each compared with each and with what
 * is known, as --rank does: a ranking in a thousand may tell any apart. */
static void equal_ones_are_told_apart_one_time_in_a_thousand(void **state) {
    (void)state;
    enum { NUM_RANKINGS = 2000, MOST_ALARMS = 8 }; /* 2 are expected, 9 once in 4000 times */
    static const struct {
        uint64_t realizations;
        size_t samplers;
    } cases[] = {{8, 2}, {8, 10}, {20, 10}, {100, 3}};
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        const size_t num = cases[c].samplers;
        const double rate = 1e-3 / (double)(num * (num + 1) / 2);
        int num_alarms = 0;
        for (uint64_t seed = 0; seed < NUM_RANKINGS; seed++) {
            ps_random random =
                ps_random_init(seed, (ps_random_stream)(1 + c), cases[c].realizations);
            ps_log_variance logs[MOST_SAMPLERS + 1];
            double least = 1;
            simulate_alone(logs, num, cases[c].realizations, &random);
            logs[num] = (ps_log_variance){.points = 16};
            for (size_t a = 0; a <= num; a++) {
                for (size_t b = 0; b < a; b++) {
                    const ps_log_variance both[] = {logs[a], logs[b]};
                    const double factors[] = {1, -1};
                    const ps_uncertain ratio = ps_log_variances_combine(both, factors, 2);
                    least = fmin(least, ps_uncertain_p_value(&ratio, 0));
                }
            }
            num_alarms += least <= rate;
        }
        print_message("M = %d, %d samplers: %d alarms\n", (int)cases[c].realizations, (int)num,
                      num_alarms);
        assert_true(num_alarms <= MOST_ALARMS);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(probabilities_are_those_of_student),
        cmocka_unit_test(equal_ones_are_told_apart_one_time_in_a_thousand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
