/* Sets of the caller under names, of several numbers of points. */
#include "harness_public.h"

#include <stdio.h>
#include <string.h>

enum { SETS = 20, N = 24, FEW = 6, NUM = 2, PLANE = 2 };

/* A name that comes again is the curve with its next number of points: rows are those of each
 * number alone, and so rates can be asked for. */
static void curves_have_several_numbers_of_points(void **state) {
    static double few[SETS][FEW][PLANE], plane[SETS][N][PLANE];
    uint64_t random = 3;
    static const char line[] = "variance max-frequency=4 integrand=disk engine=host_direct";
    static const struct {
        size_t num;
        const double *points;
        const char *more;
    } counts[NUM] = {{FEW, few[0][0], " points=6"}, {N, plane[0][0], " points=24"}};
    double expected[NUM];
    pspec_context *const context = test_public_context();
    (void)state;
    double *const numbers = &plane[0][0][0];
    for (size_t i = 0; i < sizeof plane / sizeof *numbers; i++) {
        numbers[i] = test_uniform(&random);
    }
    for (size_t r = 0; r < SETS; r++) {
        memcpy(few[r], plane[r], sizeof few[r]);
    }
    pspec_question *const all = test_public_question(
        context,
        "variance max-frequency=4 integrand=disk engine=host_direct points=6,24 rates=auto "
        "sampler=white realizations=8");
    for (size_t i = 0; i < NUM; i++) {
        char words[256];
        snprintf(words, sizeof words, "%s%s", line, counts[i].more);
        pspec_question *const one = test_public_question(context, words);
        pspec_question *const both[] = {one, all};
        for (size_t k = 0; k < 2; k++) {
            assert_int_equal(pspec_question_begin_set(both[k], "mine"), PSPEC_OK);
            assert_int_equal(
                pspec_question_add(both[k], SETS, counts[i].num, PLANE, counts[i].points, NULL),
                PSPEC_OK);
        }
        pspec_answer *const answer = test_public_answer(context, one);
        pspec_question_destroy(one);
        expected[i] = test_public_numbers(answer, "predicted")[0];
        pspec_answer_destroy(answer);
        if (i == 0) {
            test_public_refuse(context, all, PSPEC_ERROR_INVALID_ARGUMENT,
                               "the set mine has points of 1 number, and points names 2");
        }
    }
    pspec_answer *const answer = test_public_answer(context, all);
    assert_memory_equal(test_public_numbers(answer, "predicted") + NUM, expected, sizeof expected);
    assert_true(strstr(test_public_text(answer, "rates"), "white, disk: predicted N^") != NULL);
    pspec_answer_destroy(answer);
    assert_int_equal(pspec_question_begin_set(all, "mine"), PSPEC_OK);
    assert_int_equal(pspec_question_add(all, SETS, N, PLANE, plane[0][0], NULL), PSPEC_OK);
    test_public_refuse(context, all, PSPEC_ERROR_INVALID_ARGUMENT,
                       "the set mine has points of more than the 2 numbers that the option points");
    pspec_question_destroy(all);
    pspec_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(curves_have_several_numbers_of_points)};
    return cmocka_run_group_tests_name("question curves", tests, NULL, NULL);
}
