/* What is skipped, why and what it saves: every skip on and off. */
#include "harness_plan.h"

#include "math/pi.h"
#include "plan/needs.h"

#include <math.h>
#include <string.h>

/* A grid whose realizations differ, in the plane. */
static ps_needs_question ordinary(void) {
    return (ps_needs_question){
        .dimension = 2, .max_frequency = 64, .max_norm2 = 64 * 65, .num_realizations = 100};
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
        question.accuracy.no_skip = no_skip != 0;
        const ps_needs needs = ps_needs_find(&question);
        assert_non_null(find_skip(&needs, "-k"));
        assert_true(find_skip(&needs, "-k")->share == 0.5);
        question.max_frequency = 0; /* a list is taken as it is */
        const ps_needs of_list = ps_needs_find(&question);
        assert_null(find_skip(&of_list, "-k"));
        assert_null(find_skip(&of_list, "corners"));
    }
}

static void standard_error(void **state) {
    (void)state;
    ps_needs_question question = ordinary();
    question.accuracy.standard_error = 0.1;
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
    question.accuracy.standard_error = 0.1;
    question.accuracy.no_skip = true;
    assert_false(ps_needs_find(&question).sequential);
    question = ordinary();
    assert_false(ps_needs_find(&question).sequential);
}

static void corners(void **state) {
    (void)state;
    ps_needs_question question = ordinary();
    const double balls[] = {1, PS_PI / 4, PS_PI / 6, PS_PI * PS_PI / 32};
    for (unsigned dimension = 2; dimension <= 4; dimension++) {
        question.dimension = dimension;
        const ps_needs needs = ps_needs_find(&question);
        assert_non_null(find_skip(&needs, "corners"));
        assert_true(fabs(find_skip(&needs, "corners")->share - (1 - balls[dimension - 1])) < 1e-12);
    }
    question.dimension = 1;
    const ps_needs line = ps_needs_find(&question);
    assert_null(find_skip(&line, "corners"));
    question.dimension = 2;
    question.wants_full_array = true;
    const ps_needs full = ps_needs_find(&question);
    assert_null(find_skip(&full, "corners"));
}

/* What is left out because a random subset is asked for; that is no skip to be turned off. */
static void subsets(void **state) {
    (void)state;
    ps_needs_question question = ordinary();
    for (int no_skip = 0; no_skip <= 1; no_skip++) {
        question.accuracy.no_skip = no_skip != 0;
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
    assert_true(ps_needs_find(&question).no_frequency_errors);
    question.accuracy.no_skip = true;
    const ps_needs needs = ps_needs_find(&question);
    assert_false(needs.one_realization || needs.no_shift);
    assert_null(find_skip(&needs, "corners"));
    assert_false(needs.no_frequency_errors);
    assert_int_equal(needs.num_skips, 1);
}

/* Those of rings come from rings; a list, one dimension and arrays have frequencies of their own.
 */
static void errors_of_frequencies(void **state) {
    (void)state;
    ps_needs_question question = ordinary();
    assert_true(ps_needs_find(&question).no_frequency_errors);
    question.wants_frequency_errors = true;
    assert_false(ps_needs_find(&question).no_frequency_errors);
    question = ordinary();
    question.dimension = 1;
    assert_false(ps_needs_find(&question).no_frequency_errors);
    question = ordinary();
    question.max_frequency = 0;
    assert_false(ps_needs_find(&question).no_frequency_errors);
}

/* ---- what depends on the plan ---------------------------------------------------------------- */

/* A problem of the torus for a device with vectors, and double precision if it is to have that. */
typedef struct planned {
    ps_frequencies frequencies;
    ps_problem problem;
    ps_device_limits limits;
    ps_plan_constraints constraints;
    ps_needs_strict strict;
    ps_plan plan;
} planned;

static ps_needs plan(planned *job, double tolerance, double strict_tolerance, bool has_double,
                     bool no_skip) {
    ps_needs_question question = ordinary();
    question.accuracy.no_skip = no_skip;
    ps_needs needs = ps_needs_find(&question);
    *job = (planned){.limits = test_cpu(), .constraints = {.precision = -1}};
    job->limits.has_fp64 = has_double;
    assert_ok(ps_frequencies_lattice(&job->frequencies, 2, 64, true, error));
    job->problem = (ps_problem){.frequencies = &job->frequencies,
                                .num_points = 1024,
                                .num_realizations = 100,
                                .tolerance = tolerance};
    job->strict.tolerance = strict_tolerance;
    assert_ok(ps_needs_plan(&needs, &job->plan, &job->problem, &job->limits, &job->constraints,
                            &job->strict, error));
    assert_non_null(job->plan.chosen);
    return needs;
}

static void precision(void **state) {
    (void)state;
    planned job;
    ps_needs needs = plan(&job, 1e-4, 1e-4, true, false);
    const ps_candidate *const exact = ps_plan_cheapest(&job.plan, PS_DOUBLE);
    const ps_skip *const skip = find_skip(&needs, "double precision");
    assert_int_equal(job.plan.chosen->precision, PS_SINGLE);
    assert_non_null(strstr(skip->why, "within the tolerance"));
    assert_true(fabs(skip->share - (1 - job.plan.chosen->seconds / exact->seconds)) < 1e-12);
    needs = plan(&job, 1e-4, 1e-4, true, true); /* and with --no-skip it is what is done */
    assert_int_equal(job.plan.chosen->precision, PS_DOUBLE);
    assert_null(find_skip(&needs, "precision"));
    needs = plan(&job, 1e-4, 1e-4, false, true); /* as far as there is any */
    assert_int_equal(job.plan.chosen->precision, PS_SINGLE);
    needs = plan(&job, 1e-4, 1e-4, false, false);
    assert_null(find_skip(&needs, "precision"));
    needs = plan(&job, 1e-12, 1e-12, true, false); /* double precision is needed */
    assert_int_equal(job.plan.chosen->precision, PS_DOUBLE);
    assert_null(find_skip(&needs, "precision"));
}

/* A statistical target that is looser than the tolerance. */
static void digits(void **state) {
    (void)state;
    planned job;
    ps_needs needs = plan(&job, 1e-3, 1e-6, true, false);
    assert_non_null(strstr(find_skip(&needs, "double precision")->why, "--standard-error"));
    needs = plan(&job, 1e-9, 1e-12, true, false); /* double precision both times */
    assert_non_null(strstr(find_skip(&needs, "digits beyond")->why, "--floor"));
}

/* Beside other work the share is less. */
static void share_is_of_the_job(void **state) {
    (void)state;
    planned job;
    ps_needs needs = plan(&job, 1e-4, 1e-4, true, false);
    const double alone = find_skip(&needs, "double precision")->share;
    job.strict.other_seconds = job.plan.chosen->seconds;
    assert_ok(ps_needs_plan(&needs, &job.plan, &job.problem, &job.limits, &job.constraints,
                            &job.strict, error));
    const double beside = find_skip(&needs, "double precision")->share;
    assert_true(beside > 0 && beside < alone);
}

/* What nobody could turn on is for `plan`, not for headers; planning again does not list things
 * twice. */
static void matters_of_course(void **state) {
    (void)state;
    planned job;
    ps_text text = {0};
    ps_needs needs = plan(&job, 1e-4, 1e-4, true, false);
    const size_t num = needs.num_skips;
    assert_true(find_skip(&needs, "kernels of other engines")->is_matter_of_course);
    assert_ok(ps_needs_plan(&needs, &job.plan, &job.problem, &job.limits, &job.constraints,
                            &job.strict, error));
    assert_int_equal(needs.num_skips, num);
    ps_needs_describe(&needs, &text);
    assert_null(strstr(ps_text_string(&text), "kernels"));
    ps_text_free(&text);
    job.constraints.engine = "host_direct";
    assert_ok(
        ps_needs_plan(&needs, &job.plan, &job.problem, NULL, &job.constraints, &job.strict, error));
    assert_non_null(find_skip(&needs, "OpenCL devices"));
    assert_null(find_skip(&needs, "kernels"));
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
        cmocka_unit_test(errors_of_frequencies),
        cmocka_unit_test(precision),
        cmocka_unit_test(digits),
        cmocka_unit_test(share_is_of_the_job),
        cmocka_unit_test(matters_of_course),
        cmocka_unit_test(description),
    };
    return cmocka_run_group_tests_name("needs", tests, NULL, NULL);
}
