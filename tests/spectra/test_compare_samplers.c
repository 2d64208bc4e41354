/* ps_compare on spectra of samplers: how often it raises a false alarm, and what it finds. */
#include "harness_public.h"

#include "spectra/compare.h"
#include "test_samplers.h"

#include <stdio.h>
#include <string.h>

enum { N = 64, K = 8, SAVED = 32, CHECKS = 300, MOST_BINS = 64 };

static const double rate = 0.05;

/* Of realizations first, first + 1, .. of a sampler. */
static pspec_answer *measure(pspec_context *context, pspec_question *question, const char *sampler,
                             uint64_t first, unsigned num) {
    const ps_sampler_request request = make_request(sampler, N, 2);
    double points[2 * N];
    pspec_question_reset(question);
    for (unsigned r = 0; r < num; r++) {
        generate_into(&request, first + r, points);
        assert_int_equal(pspec_question_add(question, 1, N, 2, points, NULL), PSPEC_OK);
    }
    return test_public_answer(context, question);
}

/* How many bins differ. */
static size_t compare(const pspec_answer *saved, unsigned num_saved, const pspec_answer *measured,
                      unsigned num_measured) {
    const pspec_answer *const answers[2] = {saved, measured};
    ps_compared sides[2][MOST_BINS];
    ps_comparison rows[MOST_BINS];
    size_t num = 0;
    size_t num_different = 0;
    for (int i = 0; i < 2; i++) {
        num = test_public_field(answers[i], "power", PSPEC_F64)->num;
        assert_true(num <= MOST_BINS);
        for (size_t b = 0; b < num; b++) {
            sides[i][b] = (ps_compared){test_public_numbers(answers[i], "power")[b],
                                        test_public_numbers(answers[i], "standard_error")[b], 0};
        }
    }
    assert_ok(ps_compare(rows, num, sides[0], num_saved, sides[1], num_measured, rate, error));
    for (size_t b = 0; b < num; b++) {
        num_different += rows[b].differs;
    }
    return num_different;
}

typedef struct experiment {
    const char *saved, *measured;
    unsigned num_measured;
    double least, most; /* share of checks that fail */
} experiment;

/* Every check has realizations of its own on both sides. */
static double share_of_failures(pspec_context *context, pspec_question *question,
                                const experiment *what, unsigned num_checks) {
    unsigned failed = 0;
    for (unsigned i = 0; i < num_checks; i++) {
        const uint64_t first = (uint64_t)i * (SAVED + what->num_measured);
        pspec_answer *saved = measure(context, question, what->saved, first, SAVED);
        pspec_answer *measured =
            measure(context, question, what->measured, first + SAVED, what->num_measured);
        failed += compare(saved, SAVED, measured, what->num_measured) > 0;
        pspec_answer_destroy(saved);
        pspec_answer_destroy(measured);
    }
    return (double)failed / num_checks;
}

/* The rate with a margin of 4 standard deviations of the count. */
static void rates(void **state) {
    (void)state;
    static const double at_most = 0.05 + 0.05;
    const experiment experiments[] = {
        {"white", "white", 4, 0.005, at_most},
        {"jittered", "jittered", 4, 0.005, at_most},
        {"jittered", "jittered", 1, 0.005, at_most},
        {"latin-hypercube", "latin-hypercube", 16, 0.005, at_most},
        {"sobol:scramble=owen", "sobol:scramble=owen", 4, 0, at_most},
        {"jittered", "white", 2, 1, 1},
        {"jittered", "latin-hypercube", 4, 1, 1},
        {"sobol:scramble=owen", "jittered", 4, 0.6, 1},
    };
    pspec_context *context = test_public_context();
    pspec_question *question = test_public_question(context, "power max-frequency=8 no-self-check");
    for (size_t i = 0; i < sizeof experiments / sizeof experiments[0]; i++) {
        const experiment *const what = &experiments[i];
        const bool is_same = strcmp(what->saved, what->measured) == 0;
        const double share =
            share_of_failures(context, question, what, is_same ? CHECKS : CHECKS / 10);
        print_message("%d sets of %s saved, %u of %s checked: %.3f fail\n", SAVED, what->saved,
                      what->num_measured, what->measured, share);
        assert_true(share >= what->least && share <= what->most);
    }
    pspec_question_destroy(question);
    pspec_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rates),
        cmocka_unit_test(test_gsl_is_left_alone),
    };
    test_watch_gsl();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
