/* Questions of the library: points and numbers of the caller answer as files do, however they are
 * divided into calls; what cannot be meant is one sentence, and harms nothing. */
#include "harness_public.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { TEXT = 4096, SETS = 20, N = 24, PLANE = 2, SPHERE = 3 };

static char folder[] = "/tmp/test_questions_XXXXXX";
static pspec_context *context; /* of the test that runs */
static double plane[SETS][N][PLANE], sphere[SETS][N][SPHERE], weights[SETS * N];

/* ---- points of the caller -------------------------------------------------------------------- */

/* A question of every kind, with the best of its options. */
static const struct {
    const char *line;
    bool on_sphere;
} kinds[] = {
    {"power max-frequency=3 fit=auto", false},
    {"power max-frequency=3 scatter=1,1", false},
    {"angular max-degree=4 fit=auto", true},
    {"pairs max-degree=4", true},
    {"quadrature brdf=diffuse max-degree=3 drop-below-horizon", true},
    {"variance max-frequency=4 integrand=disk integrand=gaussian shifts=2", false},
    {"variance max-degree=3 integrand=square", true},
    {"check against=saved.npz", false},
    {"check homogeneous max-frequency=2", false},
};

static pspec_question *make(size_t i, const char *more) {
    char line[TEXT];
    snprintf(line, sizeof line, "%s engine=host_direct%s", kinds[i].line, more);
    return test_public_question(context, line);
}

static pspec_answer *finish(pspec_question *question) {
    pspec_answer *const answer = test_public_answer(context, question);
    pspec_question_destroy(question);
    return answer;
}

static void add(pspec_question *question, size_t first, size_t num, bool on_sphere) {
    assert_int_equal(on_sphere ? pspec_question_add(question, num, N, SPHERE, &sphere[first][0][0],
                                                    &weights[first * N])
                               : pspec_question_add(question, num, N, PLANE, &plane[first][0][0],
                                                    &weights[first * N]),
                     PSPEC_OK);
}

static int give(uint64_t realization, pspec_pattern *out, void *payload) {
    const bool on_sphere = *(const bool *)payload;
    if (realization >= SETS) {
        return 0;
    }
    out->dimension = on_sphere ? SPHERE : PLANE;
    out->num_points = N;
    out->points = on_sphere ? &sphere[realization][0][0] : &plane[realization][0][0];
    out->weights = &weights[realization * N];
    return 1;
}

/* Files, one call, calls of one, views and a function have the same bits, and so has a question
 * that is asked again. */
static void kinds_take_points_of_the_caller(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        bool on_sphere = kinds[i].on_sphere;
        pspec_answer *const expected = finish(make(
            i, on_sphere ? " weights=column files=sphere.txt" : " weights=column files=plane.txt"));
        pspec_question *const whole = make(i, "");
        pspec_question *const single = make(i, "");
        pspec_question *const given = make(i, "");
        pspec_question *const borrowed = make(i, "");
        const double *const points = on_sphere ? &sphere[0][0][0] : &plane[0][0][0];
        assert_int_equal(
            pspec_question_borrow(borrowed, SETS, N, on_sphere ? SPHERE : PLANE, points, weights),
            PSPEC_OK);
        add(whole, 0, SETS, on_sphere);
        for (size_t r = 0; r < SETS; r++) {
            add(single, r, 1, on_sphere);
        }
        assert_int_equal(pspec_question_give(given, 0, give, &on_sphere), PSPEC_OK);
        pspec_question *const all[] = {whole, single, given, borrowed, whole};
        for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
            pspec_answer *const answer = test_public_answer(context, all[k]);
            if (!test_public_same(answer, expected)) {
                pspec_answer_write(answer, context, "/dev/stderr", "csv");
                pspec_answer_write(expected, context, "/dev/stderr", "csv");
                fail_msg("%s: way %zu has other bits", kinds[i].line, k);
            }
            pspec_answer_destroy(answer);
        }
        pspec_question_destroy(whole);
        pspec_question_destroy(single);
        pspec_question_destroy(given);
        pspec_question_destroy(borrowed);
        pspec_answer_destroy(expected);
    }
}

/* More patterns, another average; a named one is a curve beside a sampler's. */
static void patterns_are_added_and_forgotten(void **state) {
    (void)state;
    pspec_question *const question = make(0, " state");
    add(question, 0, 8, false);
    pspec_answer *const first = test_public_answer(context, question);
    add(question, 8, 12, false);
    pspec_answer *const all = test_public_answer(context, question);
    assert_false(test_public_same(first, all));
    pspec_question_reset(question);
    test_public_refuse(context, question, PSPEC_ERROR_INVALID_ARGUMENT, "nothing to take");
    add(question, 8, 12, false);
    pspec_answer *const second = test_public_answer(context, question);
    const pspec_answer *const parts[] = {first, second};
    pspec_answer *merged = NULL;
    test_public_refused(context, pspec_answer_merge(&merged, context, parts, 2), PSPEC_OK, "");
    assert_memory_equal(test_public_numbers(merged, "power"), test_public_numbers(all, "power"),
                        3 * sizeof(double));
    pspec_answer_destroy(merged);
    pspec_answer_destroy(second);
    pspec_question_reset(question);
    add(question, 0, 8, false);
    pspec_answer *const again = finish(question);
    assert_true(test_public_same(first, again));
    pspec_question *const curves =
        test_public_question(context, "power sampler=jittered points=24 max-frequency=3 "
                                      "realizations=8 engine=host_direct");
    assert_int_equal(pspec_question_begin_set(curves, "mine"), PSPEC_OK);
    add(curves, 0, 8, false);
    pspec_answer *const both = finish(curves);
    const pspec_field *const names = test_public_field(both, "sampler", PSPEC_TEXT);
    const pspec_field *const power = test_public_field(both, "power", PSPEC_F64);
    const size_t rings = pspec_answer_find(first, "power")->num;
    assert_int_equal(names->num, 2 * rings);
    assert_string_equal(((const char *const *)names->data)[rings], "mine");
    assert_memory_equal((const double *)power->data + rings, test_public_numbers(first, "power"),
                        rings * sizeof(double));
    pspec_question *const ranked =
        test_public_question(context, "variance sampler=jittered points=24 max-frequency=3 "
                                      "realizations=8 integrand=disk shifts=2 rank "
                                      "engine=host_direct");
    assert_int_equal(pspec_question_begin_set(ranked, "mine"), PSPEC_OK);
    add(ranked, 0, SETS, false);
    pspec_answer *const ranking = finish(ranked);
    assert_string_equal(test_public_text(ranking, "ranking_first"), "jittered");
    pspec_answer_destroy(ranking);
    pspec_answer_destroy(first);
    pspec_answer_destroy(all);
    pspec_answer_destroy(again);
    pspec_answer_destroy(both);
}

/* F(x, y) = x, whose integral is 1/2; payload: calls. */
static int take_x(size_t num, unsigned dimension, const double *points, double *values,
                  void *payload) {
    ++*(size_t *)payload;
    for (size_t i = 0; i < num; i++) {
        values[i] = points[i * dimension];
    }
    return *(size_t *)payload > 1000000;
}

/* Without moves the mean square of estimate minus integral is a sum over the sets. */
static void integrands_are_measured(void **state) {
    (void)state;
    size_t calls = 0;
    double expected = 0;
    pspec_question *const question =
        test_public_question(context, "variance max-frequency=3 in-place engine=host_direct");
    assert_int_equal(pspec_question_integrand(question, "x", 0.5, take_x, &calls), PSPEC_OK);
    test_public_refused(context, pspec_question_integrand(question, "y", 0.5, NULL, NULL),
                        PSPEC_ERROR_INVALID_ARGUMENT, "a function of its values");
    assert_int_equal(pspec_question_add(question, SETS, N, PLANE, &plane[0][0][0], NULL), PSPEC_OK);
    pspec_answer *const answer = test_public_answer(context, question);
    const size_t measured = SETS / 2; /* the others predict */
    for (size_t r = measured; r < SETS; r++) {
        double sum = 0;
        for (size_t j = 0; j < N; j++) {
            sum += plane[r][j][0];
        }
        expected += (sum / N - 0.5) * (sum / N - 0.5) / (double)(SETS - measured);
    }
    const double found = *test_public_numbers(answer, "measured");
    if (!(fabs(found / expected - 1) < 1e-12)) {
        pspec_answer_write(answer, context, "/dev/stderr", "csv");
        fail_msg("%.17g instead of %.17g", found, expected);
    }
    assert_true(calls > 0);
    pspec_question *const light = test_public_question(context, "light");
    assert_int_equal(pspec_question_integrand(light, "x", 0.5, take_x, &calls), PSPEC_OK);
    test_public_refuse(context, light, PSPEC_ERROR_INVALID_ARGUMENT, "caller are not known");
    pspec_question_destroy(light);
    calls = 1000000;
    test_public_refuse(context, question, PSPEC_ERROR_INPUT, "gave no values");
    pspec_answer_destroy(answer);
    pspec_question_destroy(question);
}

/* ---- nonsense -------------------------------------------------------------------------------- */

static int give_nothing(uint64_t realization, pspec_pattern *out, void *payload) {
    (void)realization, (void)out, (void)payload;
    return -7;
}

static void nonsense_is_one_sentence(void **state) {
    (void)state;
    const pspec_status bad = PSPEC_ERROR_INVALID_ARGUMENT;
    pspec_question *question = NULL;
    test_public_refused(context, pspec_question_create(&question, context, "pwer"), bad,
                        "did you mean power?");
    test_public_refused(context, pspec_question_create(&question, context, NULL), bad, "no name");
    assert_null(question);
    question = test_public_question(context, "power max-frequency=3 engine=host_direct");
    static const struct {
        const char *option, *value, *piece;
    } options[] = {{"brdf", "diffuse", "takes no option \"brdf\""},
                   {"binz", "floor", "did you mean bins?"},
                   {NULL, "floor", "has no name"},
                   {"bins", "flor", "flor"},
                   {"bins", NULL, "needs a value"},
                   {"files", NULL, "no name of a file"},
                   {"files", "-", "- is none"},
                   {"output", "-", "- is none"}};
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++) {
        test_public_refused(context,
                            pspec_question_set(question, options[i].option, options[i].value), bad,
                            options[i].piece);
    }
    test_public_refused(context, pspec_question_begin_set(question, "a,b"), bad,
                        "no name of a set");
    test_public_refused(context, pspec_question_add(question, 1, 0, 2, plane[0][0], NULL), bad,
                        "at least one point");
    test_public_refused(context, pspec_question_add(question, 1, N, 7, plane[0][0], NULL), bad,
                        "of 7 numbers");
    test_public_refused(context, pspec_question_begin_set(question, "memory"), bad,
                        "no name of a set");
    test_public_refused(context, pspec_question_add(question, SIZE_MAX, N, 2, plane[0][0], NULL),
                        PSPEC_ERROR_MEMORY, "no memory for so many");
    test_public_refused(context,
                        pspec_question_add(question, 1, SIZE_MAX / 2 + 2, 2, plane[0][0], NULL),
                        PSPEC_ERROR_MEMORY, "no memory for so many");
    test_public_refused(context, pspec_question_give(question, 0, NULL, NULL), bad, "no function");
    pspec_context_set_memory_limit(context, sizeof plane - 1);
    test_public_refused(context, pspec_question_add(question, SETS, N, PLANE, plane[0][0], NULL),
                        PSPEC_ERROR_MEMORY, "pspec_question_give()");
    pspec_context_set_memory_limit(context, 0);
    add(question, 0, 2, false); /* all of it was no harm */
    test_public_refused(context, pspec_question_give(question, 0, give, NULL), bad,
                        "has patterns already");
    pspec_answer *const answer = finish(question);
    pspec_answer *const expected = test_public_ask(
        context,
        "power max-frequency=3 weights=column files=plane.txt select-sets=1..2 engine=host_direct",
        NULL, 0);
    assert_true(test_public_same(answer, expected));
    pspec_answer_destroy(answer);
    pspec_answer_destroy(expected);
    question = make(0, "");
    assert_int_equal(pspec_question_give(question, 0, give_nothing, NULL), PSPEC_OK);
    test_public_refuse(context, question, PSPEC_ERROR_INPUT, "gave no set 1 (-7)");
    pspec_question_reset(question);
    plane[1][2][0] += 1;
    add(question, 0, 2, false);
    plane[1][2][0] -= 1;
    test_public_refuse(context, question, PSPEC_ERROR_INPUT, "set 2, row 3");
    pspec_question_destroy(question);
    test_public_refused(context, pspec_question_set(NULL, "points", "8"), bad, "");
    pspec_question_destroy(NULL);
    pspec_question_reset(NULL);
    pspec_answer_destroy(NULL);
}

/* ---- lists ----------------------------------------------------------------------------------- */

/* Every kind has options and fields; facts of options are in columns. */
static void lists_are_answers(void **state) {
    (void)state;
    pspec_answer *answer = NULL;
    for (size_t i = 0; pspec_answer_kind(i) != NULL; i++) {
        assert_int_equal(pspec_options_table(&answer, context, pspec_answer_kind(i)), PSPEC_OK);
        const pspec_field *const option = test_public_field(answer, "option", PSPEC_TEXT);
        const char *const *const type = test_public_field(answer, "type", PSPEC_TEXT)->data;
        for (size_t row = 0; row < option->num; row++) {
            const char *const name = ((const char *const *)option->data)[row];
            assert_string_not_equal(name, "device"); /* is that of the context */
            assert_true(type[row][0] != '\0');
            if (strcmp(name, "realizations") == 0) {
                assert_string_equal(type[row], "integer");
            }
        }
        pspec_answer_destroy(answer);
    }
    test_public_refused(context, pspec_options_table(&answer, context, "pwer"),
                        PSPEC_ERROR_INVALID_ARGUMENT, "did you mean power?");
    assert_null(answer);
}

/* ---- all ------------------------------------------------------------------------------------- */

static void write_sets(const char *path, const double *points, unsigned dimension) {
    FILE *const file = fopen(path, "w");
    assert_non_null(file);
    for (size_t j = 0; j < SETS * (size_t)N; j++) {
        for (unsigned i = 0; i < dimension; i++) {
            fprintf(file, "%.17g ", points[j * dimension + i]);
        }
        fprintf(file, "%.17g", weights[j]);
        fputs((j + 1) % N == 0 && j + 1 < SETS * (size_t)N ? "\n#\n" : "\n", file);
    }
    assert_int_equal(fclose(file), 0);
}

/* The points of the plane are those of the sampler white. */
static void make_points(void) {
    pspec_answer *answer =
        test_public_ask(context, "sample sampler=white points=24 realizations=20", NULL, 0);
    memcpy(plane, test_public_numbers(answer, "coordinates"), sizeof plane);
    pspec_answer_destroy(answer);
    answer = test_public_ask(context, "sample sampler=white-hemisphere points=24 realizations=20",
                             NULL, 0);
    memcpy(sphere, test_public_numbers(answer, "coordinates"), sizeof sphere);
    pspec_answer_destroy(answer);
    uint64_t random = 3;
    for (size_t i = 0; i < SETS * (size_t)N; i++) {
        weights[i] = 0.5 + test_uniform(&random);
    }
}

static int make_folder(void **state) {
    (void)state;
    assert_non_null(mkdtemp(folder));
    assert_int_equal(chdir(folder), 0);
    assert_int_equal(setenv("POINTSPEC_CACHE_DIR", folder, 1), 0);
    unsetenv("POINTSPEC_MEMORY");
    context = test_public_context();
    make_points();
    write_sets("plane.txt", &plane[0][0][0], PLANE);
    write_sets("sphere.txt", &sphere[0][0][0], SPHERE);
    pspec_answer_destroy(test_public_ask(
        context,
        "power sampler=white points=24 realizations=8 seed=5 max-frequency=3 output=saved.npz "
        "engine=host_direct",
        NULL, 0));
    return 0;
}

static int remove_folder(void **state) {
    (void)state;
    char command[TEXT];
    pspec_context_destroy(context);
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kinds_take_points_of_the_caller),
        cmocka_unit_test(patterns_are_added_and_forgotten),
        cmocka_unit_test(integrands_are_measured),
        cmocka_unit_test(nonsense_is_one_sentence),
        cmocka_unit_test(lists_are_answers),
    };
    return cmocka_run_group_tests_name("questions", tests, make_folder, remove_folder);
}
