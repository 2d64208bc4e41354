/* A question that is asked again answers as a new one does, to the bit, whatever its patterns were
 * before: plan, frequencies and estimator stay where they fit, and go where they do not. */
#include "harness_public.h"

#include <string.h>

enum { SETS = 6, N = 40, PLANE = 2, SPHERE = 3 };

static pspec_context *context;
static double plane[2 * SETS * N * PLANE], sphere[2 * SETS * N * SPHERE], weights[SETS * N];
static double equal[SETS * N * PLANE], outside[SETS * N * PLANE]; /* bad for a plan; for anybody */

/* What is added, in up to two calls. */
typedef struct part {
    size_t num_sets, num_points;
    const double *points;
    const double *weights;
} part;
typedef struct step {
    part parts[2];
    const char *option; /* set before, and from here on; NULL: none */
    const char *value;
    bool is_refused;
} step;

/* A part without weights. */
#define OF(num_sets, num_points, points)                                                           \
    { num_sets, num_points, points, NULL }

static const step steps_of_plane[] = {
    {.parts = {OF(SETS, N, plane)}},
    {.parts = {OF(SETS, N, plane + SETS * N * PLANE)}}, /* the same shape */
    {.parts = {OF(2, N, plane), OF(SETS - 2, N, plane + 4 * N * PLANE)}},
    {.parts = {OF(SETS, N, outside)}, .is_refused = true},
    {.parts = {OF(SETS, N, plane)}},
    {.parts = {OF(2, N, plane)}}, /* fewer */
    {.parts = {OF(1, N, plane)}},
    {.parts = {OF(SETS, N / 2, plane)}},
    {.parts = {OF(1, N / 2, plane), OF(1, N, plane)}}, /* the largest is not the first */
    {.parts = {OF(2, N / 2, plane)}},
    {.parts = {{SETS, N, plane, weights}}},
    {.parts = {OF(SETS, N, plane)}},
    {.parts = {OF(SETS, N, equal)}}, /* planned twice */
    {.parts = {OF(SETS, N, plane)}},
    {.parts = {OF(SETS, N, plane)}, .option = "max-frequency", .value = "9"},
    {.parts = {OF(SETS, N, plane)}, .option = "tol", .value = "1e-9"},
    {.parts = {OF(SETS, N, plane)}, .option = "standard-error", .value = "0.5"},
};
static const step steps_of_sphere[] = {
    {.parts = {OF(SETS, N, sphere)}},
    {.parts = {OF(SETS, N, sphere + SETS * N * SPHERE)}},
    {.parts = {OF(3, N, sphere)}},
    {.parts = {{SETS, N, sphere, weights}}},
    {.parts = {OF(SETS, N, sphere)}, .option = "max-degree", .value = "5"},
};

static void add(pspec_question *question, const part *own, unsigned dimension) {
    if (own->num_sets > 0) {
        assert_int_equal(pspec_question_add(question, own->num_sets, own->num_points, dimension,
                                            own->points, own->weights),
                         PSPEC_OK);
    }
}

static void set_up(pspec_question *question, const step *own, unsigned dimension) {
    add(question, &own->parts[0], dimension);
    add(question, &own->parts[1], dimension);
}

/* The question has all options up to this step's. */
static pspec_question *make_new(const char *line, const step *steps, size_t i) {
    pspec_question *const question = test_public_question(context, line);
    for (size_t k = 0; k <= i; k++) {
        assert_true(steps[k].option == NULL ||
                    pspec_question_set(question, steps[k].option, steps[k].value) == PSPEC_OK);
    }
    return question;
}

static void walk(const char *line, const step *steps, size_t num, unsigned dimension) {
    pspec_question *const question = test_public_question(context, line);
    for (size_t i = 0; i < num; i++) {
        pspec_question *const fresh = make_new(line, steps, i);
        pspec_question_reset(question);
        assert_true(steps[i].option == NULL ||
                    pspec_question_set(question, steps[i].option, steps[i].value) == PSPEC_OK);
        set_up(question, &steps[i], dimension);
        set_up(fresh, &steps[i], dimension);
        if (steps[i].is_refused) {
            test_public_refuse(context, question, PSPEC_ERROR_INPUT, "set 1");
            pspec_question_destroy(fresh);
            continue;
        }
        pspec_answer *const again = test_public_answer(context, question);
        pspec_answer *const expected = test_public_answer(context, fresh);
        assert_string_equal(test_public_text(again, "engine"),
                            test_public_text(expected, "engine"));
        if (!test_public_same(again, expected)) {
            pspec_answer_write(again, context, "/dev/stderr", "csv");
            pspec_answer_write(expected, context, "/dev/stderr", "csv");
            fail_msg("%s: step %zu has other bits", line, i);
        }
        pspec_answer_destroy(again);
        pspec_answer_destroy(expected);
        pspec_question_destroy(fresh);
    }
    pspec_question_destroy(question);
}

static void answers_of_the_torus(void **state) {
    static const char *const lines[] = {"power state", "power engine=host_direct full",
                                        "power engine=torus_nufft fit=auto",
                                        "power normalize=integral"};
    (void)state;
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        walk(lines[i], steps_of_plane, sizeof steps_of_plane / sizeof steps_of_plane[0], PLANE);
    }
}

static void answers_of_the_sphere(void **state) {
    static const char *const lines[] = {"angular state", "pairs"};
    (void)state;
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        walk(lines[i], steps_of_sphere, sizeof steps_of_sphere / sizeof steps_of_sphere[0], SPHERE);
    }
}

/* A limit of memory is looked at whenever a question is asked. */
static void a_limit_counts_from_then_on(void **state) {
    pspec_question *const question = test_public_question(context, "power max-frequency=300");
    (void)state;
    set_up(question, &steps_of_plane[0], PLANE);
    pspec_answer_destroy(test_public_answer(context, question));
    pspec_context_set_memory_limit(context, (uint64_t)1 << 16);
    test_public_refuse(context, question, PSPEC_ERROR_MEMORY, "");
    pspec_context_set_memory_limit(context, 0);
    pspec_answer_destroy(test_public_answer(context, question));
    pspec_question_destroy(question);
}

/* Points of the samplers, and bad ones. */
static int make_points(void **state) {
    static const char *const lines[] = {"sample sampler=jittered points=40 realizations=12",
                                        "sample sampler=white-sphere points=40 realizations=12"};
    double *const all[] = {plane, sphere};
    const size_t sizes[] = {sizeof plane, sizeof sphere};
    uint64_t random = 5;
    (void)state;
    context = test_public_context();
    for (size_t i = 0; i < 2; i++) {
        pspec_answer *const answer = test_public_ask(context, lines[i], NULL, 0);
        memcpy(all[i], test_public_numbers(answer, "coordinates"), sizes[i]);
        pspec_answer_destroy(answer);
    }
    for (size_t i = 0; i < SETS * N; i++) {
        weights[i] = 0.5 + test_uniform(&random);
    }
    for (size_t i = 0; i < SETS * N * PLANE; i++) {
        equal[i] = 0.25;
        outside[i] = i == N ? 1.5 : 0.25;
    }
    return 0;
}

static int close_context(void **state) {
    (void)state;
    pspec_context_destroy(context);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answers_of_the_torus),
        cmocka_unit_test(answers_of_the_sphere),
        cmocka_unit_test(a_limit_counts_from_then_on),
    };
    return cmocka_run_group_tests_name("questions again", tests, make_points, close_context);
}
