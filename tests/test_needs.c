/* What is skipped, why and what it saves: every skip on and off. */
#include "harness.h"

#include "plan/needs.h"

#include <math.h>
#include <string.h>

/* A grid whose realizations differ, in the plane. */
static ps_needs_question ordinary(void) {
    return (ps_needs_question){.dimension = 2, .max_frequency = 64, .num_realizations = 100};
}

static const ps_skip *find_skip(const ps_needs *needs, const char *what) {
    for (size_t i = 0; i < needs->num_skips; i++) {
        if (strstr(needs->skips[i].what, what) != NULL) {
            assert_true(strlen(needs->skips[i].why) > 0);
            assert_true(needs->skips[i].share >= 0 && needs->skips[i].share < 1);
            return &needs->skips[i];
        }
    }
    return NULL;
}

static void symmetry_is_always_used(void **state) {
    (void)state;
    for (int no_skip = 0; no_skip <= 1; no_skip++) {
        ps_needs_question question = ordinary();
        question.no_skip = no_skip != 0;
        const ps_needs needs = ps_needs_find(&question);
        assert_non_null(find_skip(&needs, "-k"));
        assert_true(find_skip(&needs, "-k")->share == 0.5);
        question.max_frequency = 0; /* a list is taken as it is */
        const ps_needs of_list = ps_needs_find(&question);
        assert_null(find_skip(&of_list, "-k"));
        assert_false(of_list.only_ball);
    }
}

static void standard_error(void **state) {
    (void)state;
    ps_needs_question question = ordinary();
    question.standard_error = 0.1;
    question.expected_realizations = 25;
    ps_needs needs = ps_needs_find(&question);
    assert_true(needs.sequential);
    assert_true(find_skip(&needs, "beyond the standard error")->share == 0.75);
    question.expected_realizations = 1000; /* more than there are */
    needs = ps_needs_find(&question);
    assert_true(needs.sequential && find_skip(&needs, "beyond the standard error")->share == 0);
    question.has_constant_power = true; /* one will do anyway */
    assert_false(ps_needs_find(&question).sequential);
    question = ordinary();
    question.standard_error = 0.1;
    question.no_skip = true;
    assert_false(ps_needs_find(&question).sequential);
    question = ordinary();
    assert_false(ps_needs_find(&question).sequential);
}

static void corners(void **state) {
    (void)state;
    ps_needs_question question = ordinary();
    const double pi = 3.14159265358979323846;
    const double balls[] = {1, pi / 4, pi / 6, pi * pi / 32};
    for (unsigned dimension = 2; dimension <= 4; dimension++) {
        question.dimension = dimension;
        const ps_needs needs = ps_needs_find(&question);
        assert_true(needs.only_ball);
        assert_true(fabs(find_skip(&needs, "corners")->share - (1 - balls[dimension - 1])) < 1e-12);
    }
    question.dimension = 1;
    assert_false(ps_needs_find(&question).only_ball);
    question.dimension = 2;
    question.wants_full_array = true;
    const ps_needs full = ps_needs_find(&question);
    assert_false(full.only_ball);
    assert_null(find_skip(&full, "corners"));
}

/* What is left out because a random subset is asked for; that is no skip to be turned off. */
static void subsets(void **state) {
    (void)state;
    ps_needs_question question = ordinary();
    for (int no_skip = 0; no_skip <= 1; no_skip++) {
        question.no_skip = no_skip != 0;
        question.share_not_drawn = 0.75;
        const ps_needs needs = ps_needs_find(&question);
        assert_true(find_skip(&needs, "random subset")->share == 0.75);
        question.share_not_drawn = 0;
        const ps_needs all = ps_needs_find(&question);
        assert_null(find_skip(&all, "random subset"));
    }
}

static void one_realization_for_all(void **state) {
    (void)state;
    ps_needs_question question = ordinary();
    assert_false(ps_needs_find(&question).one_realization);
    question.has_constant_power = true;
    const ps_needs needs = ps_needs_find(&question);
    assert_true(needs.one_realization);
    assert_true(fabs(find_skip(&needs, "realizations")->share - 0.99) < 1e-15);
    question.num_realizations = 1; /* nothing to leave out */
    const ps_needs single = ps_needs_find(&question);
    assert_false(single.one_realization);
    assert_null(find_skip(&single, "realizations"));
}

static void shifts(void **state) {
    (void)state;
    ps_needs_question question = ordinary();
    assert_false(ps_needs_find(&question).no_shift);
    question.is_homogenized = true;
    const ps_needs needs = ps_needs_find(&question);
    assert_true(needs.no_shift);
    assert_non_null(find_skip(&needs, "shift"));
}

static void everything_is_done_on_request(void **state) {
    (void)state;
    ps_needs_question question = ordinary();
    question.is_homogenized = question.has_constant_power = true;
    assert_int_equal(ps_needs_find(&question).num_skips, 4);
    question.no_skip = true;
    const ps_needs needs = ps_needs_find(&question);
    assert_false(needs.only_ball || needs.one_realization || needs.no_shift);
    assert_int_equal(needs.num_skips, 1);
}

static void description(void **state) {
    (void)state;
    ps_text text = {0};
    ps_needs_question question = ordinary();
    const ps_needs needs = ps_needs_find(&question);
    ps_needs_describe(&needs, &text);
    for (size_t i = 0; i < needs.num_skips; i++) {
        assert_non_null(strstr(ps_text_string(&text), needs.skips[i].what));
        assert_non_null(strstr(ps_text_string(&text), needs.skips[i].why));
    }
    assert_non_null(strstr(ps_text_string(&text), "); "));
    ps_text_free(&text);
    const ps_needs none = {0};
    ps_needs_describe(&none, &text);
    assert_string_equal(ps_text_string(&text), "nothing");
    ps_text_free(&text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(symmetry_is_always_used),
        cmocka_unit_test(standard_error),
        cmocka_unit_test(corners),
        cmocka_unit_test(subsets),
        cmocka_unit_test(one_realization_for_all),
        cmocka_unit_test(shifts),
        cmocka_unit_test(everything_is_done_on_request),
        cmocka_unit_test(description),
    };
    return cmocka_run_group_tests_name("needs", tests, NULL, NULL);
}
