/* Answers of the library are those of the program, byte for byte: the same options, by names to one
 * and as words to the other, give the same files. */
#include "harness_program.h"

#include "base/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { TEXT = 4096, EXIT_CHECK = 3, MOST_FILES = 3 };

static char folder[] = "/tmp/test_answers_XXXXXX";
static pspec_context *context; /* of the test that runs */

/* A question, and the files that it writes; the first is that of output. */
static const struct {
    const char *line, *files[MOST_FILES];
} questions[] = {
    {"power sampler=jittered sampler=white points=64 realizations=3 bins=shells max-frequency=6 "
     "output=two.csv",
     {"two.csv"}},
    {"power sampler=jittered points=16..64,100 realizations=3 max-frequency=6 output=sizes.npy",
     {"sizes.npy", "sizes.json"}},
    {"power sampler=halton points=50 full=full.npy tol=1e-9 max-frequency=5 output=h.npz",
     {"h.npz", "full.npy", "full.standard_error.npy"}},
    {"power weights=weights.txt normalize=effective max-frequency=4 output=files.json "
     "files=sets.txt files=more.txt",
     {"files.json"}},
    {"power sampler=white points=32 max-frequency=3 output=odd.json format=json", {"odd.json"}},
    {"angular sampler=white-sphere points=40 realizations=4 max-degree=7 seed=9 "
     "output=angular.json",
     {"angular.json"}},
    {"angular sampler=fibonacci-hemisphere points=30 hemisphere max-degree=6 coefficients=c.npy "
     "output=one.csv",
     {"one.csv", "c.npy"}},
    {"pairs sampler=white-sphere points=40 realizations=2 max-degree=5 output=pairs.npz",
     {"pairs.npz"}},
    {"quadrature brdf=diffuse sampler=white-hemisphere sampler=fibonacci-hemisphere points=16,48 "
     "max-degree=6 output=rules.json",
     {"rules.json"}},
    {"quadrature brdf=glossy:n=8 sampler=fibonacci-hemisphere points=40 weights=optimal "
     "smoothness=1.25 weights-out=w.npy output=optimal.csv",
     {"optimal.csv", "w.npy"}},
    {"truncation brdf=phong:n=8 max-degree=5 output=truncation.csv", {"truncation.csv"}},
    {"variance sampler=jittered sampler=white integrand=disk:radius=0.25 "
     "integrand=coefficients:file=own.txt points=16..64 realizations=20 shifts=2 max-frequency=8 "
     "output=variance.csv",
     {"variance.csv"}},
    {"variance weights=weights.txt integrand=gaussian output=measured.json max-frequency=6 "
     "files=sets.txt files=more.txt",
     {"measured.json"}},
    {"variance sampler=jittered points=16 realizations=4 integrand=disk shifts=0 tail=1e-3 "
     "output=cut.csv max-frequency=4",
     {"cut.csv"}},
    {"power sampler=jittered points=64 realizations=8 max-frequency=8 output=saved.npz",
     {"saved.npz"}},
    {"check against=saved.npz sampler=jittered seed=2 output=same.csv", {"same.csv"}},
    {"check against=saved.npz sampler=white seed=2 output=other.csv", {"other.csv"}},
    {"sample sampler=jittered points=64 realizations=3 seed=7 homogenize output=points.txt",
     {"points.txt"}},
    {"sample sampler=white points=10 format=rps output=white.rps", {"white.rps"}},
    {"convert output=sets.npy files=points.txt files=points.txt", {"sets.npy"}},
    {"convert select-points=3..9 output=part.csv files=sets.npy", {"part.csv"}},
    {"run output=run files=scene.yaml", {"run/p.csv", "run/q.csv"}},
    {"run output=other files=other.yaml", {"other/p.csv"}},
};

static void rename_file(const char *path, char expected[TEXT]) {
    snprintf(expected, TEXT, "expected_%s",
             strchr(path, '/') != NULL ? strchr(path, '/') + 1 : path);
    assert_int_equal(rename(path, expected), 0);
}

static void hear(const char *sentence, void *payload) {
    ps_text_append(payload, "%s", sentence);
}

/* The program's exit status 3 is a verdict here, with the same sentence, and its warnings are heard
 * by the context's. */
static void compare(const char *line, const char *const *files) {
    char expected[MOST_FILES][TEXT];
    size_t num_said = 0;
    ps_text heard = {0};
    ps_text said = {0};
    const int status = test_ask_program("", line);
    assert_true(status == 0 || status == EXIT_CHECK);
    for (size_t i = 0; i < MOST_FILES && files[i] != NULL; i++) {
        rename_file(files[i], expected[i]);
    }
    pspec_context_set_warnings(context, hear, &heard);
    pspec_answer *const answer = test_public_ask(context, line, NULL, 0);
    const char *const verdict = pspec_answer_verdict(answer);
    assert_true((status == EXIT_CHECK) == (verdict[0] != '\0'));
    for (size_t i = 0; i < MOST_FILES && files[i] != NULL; i++) {
        test_assert_same_file(files[i], expected[i]);
    }
    char *const bytes = test_read_whole("said", &num_said);
    if (heard.length > 0 || verdict[0] != '\0') {
        ps_text_append(&said, "pointspec %.*s: %s%s\n", (int)strcspn(line, " "), line,
                       ps_text_string(&heard), verdict);
    }
    assert_string_equal(bytes, ps_text_string(&said));
    if (strstr(line, "output=run") == NULL && pspec_answer_num_fields(answer) > 0 &&
        pspec_answer_field(answer, 0)->group == PSPEC_COLUMN &&
        strstr(line, "output=other ") == NULL &&
        strstr(line, "format=") == NULL) { /* and from the object */
        snprintf(expected[0], TEXT, "again_%s", files[0]);
        assert_int_equal(pspec_answer_write(answer, context, expected[0], NULL), PSPEC_OK);
        test_assert_same_file(expected[0], files[0]);
    }
    pspec_context_set_warnings(context, NULL, NULL);
    ps_text_free(&heard);
    ps_text_free(&said);
    free(bytes);
    pspec_answer_destroy(answer);
}

static void files_are_those_of_the_program(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof questions / sizeof questions[0]; i++) {
        if (system("rm -rf results run other") != 0) {
            fail_msg("folders stay");
        }
        compare(questions[i].line, questions[i].files);
    }
}

/* The program prints the same plan, seconds and all. */
static void plans_are_those_of_the_program(void **state) {
    (void)state;
    static const char *const lines[] = {
        "power sampler=white points=4096 realizations=99",
        "quadrature brdf=glossy:n=8 sampler=fibonacci-hemisphere points=64 weights=optimal",
        "sample sampler=white points=100000", "run cache=0 files=scene.yaml"};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        pspec_question *const question = test_public_question(context, lines[i]);
        pspec_answer *plan = NULL;
        assert_int_equal(test_ask_program("plan ", lines[i]), 0);
        assert_int_equal(pspec_question_plan(&plan, question), PSPEC_OK);
        assert_int_equal(pspec_answer_write(plan, context, "plan.csv", "csv"), PSPEC_OK);
        test_assert_same_file("plan.csv", "printed");
        pspec_answer_destroy(plan);
        pspec_question_destroy(question);
    }
}

/* The limit of a context is POINTSPEC_MEMORY of the program. */
static void memory_limits(void **state) {
    (void)state;
    static const char line[] = "power sampler=white points=64 max-frequency=4 output=limited.csv";
    assert_int_equal(setenv("POINTSPEC_MEMORY", "268435456", 1), 0);
    assert_int_equal(test_ask_program("", line), 0);
    assert_int_equal(unsetenv("POINTSPEC_MEMORY"), 0);
    assert_int_equal(rename("limited.csv", "expected_limited.csv"), 0);
    pspec_context_set_memory_limit(context, (uint64_t)1 << 28);
    pspec_answer_destroy(test_public_ask(context, line, NULL, 0));
    test_assert_same_file("limited.csv", "expected_limited.csv");
}

static void the_machine_is_that_of_the_program(void **state) {
    (void)state;
    assert_int_equal(test_ask_program("", "devices"), 0);
    pspec_answer *answer = test_public_ask(context, "devices", NULL, 0);
    assert_int_equal(pspec_answer_write(answer, context, "devices.csv", NULL), PSPEC_OK);
    /* PoCL takes the bytes of the device, the eighth column from the end, from the memory that the
     * machine has, which may change between two processes. */
    assert_int_equal(system("sed -i -E 's/,[0-9]+((,[^,]*){7})$/,\\1/' devices.csv printed"), 0);
    test_assert_same_file("devices.csv", "printed");
    pspec_answer_destroy(answer);
    const int status = test_ask_program("", "doctor");
    size_t num_bytes = 0;
    size_t num_lines = 0;
    answer = test_public_ask(context, "doctor", NULL, 0);
    assert_int_equal(status, pspec_answer_verdict(answer)[0] == '\0' ? 0 : EXIT_CHECK);
    char *const printed = test_read_whole("printed", &num_bytes);
    for (size_t i = 0; i < num_bytes; i++) {
        num_lines += printed[i] == '\n';
    }
    assert_int_equal(test_public_field(answer, "sentence", PSPEC_TEXT)->num, num_lines);
    free(printed);
    pspec_answer_destroy(answer);
}

/* ---- all ------------------------------------------------------------------------------------- */

static void write_text(const char *path, const char *text) {
    FILE *const file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static void write_points(const char *path, uint64_t seed) {
    ps_text text = {0};
    uint64_t state = seed;
    for (int j = 0; j < TEST_NUM_POINTS; j++) {
        const double x = test_uniform(&state);
        ps_text_append(&text, "%.17g %.17g\n", x, test_uniform(&state));
    }
    write_text(path, ps_text_string(&text));
    ps_text_free(&text);
}

#define SCENE                                                                                      \
    "results:\n  - {result: power, name: p, samplers: [white, jittered], points: 32..64, "         \
    "max-frequency: 4}\n  - {result: pairs, name: q, samplers: white-sphere, points: 20, "         \
    "max-degree: 3}\n"

static int make_folder(void **state) {
    (void)state;
    assert_non_null(mkdtemp(folder));
    assert_int_equal(chdir(folder), 0);
    write_points("sets.txt", 1);
    write_points("more.txt", 2);
    ps_text weights = {0};
    for (int j = 0; j < TEST_NUM_POINTS; j++) {
        ps_text_append(&weights, "%d\n", 1 + j % 4);
    }
    write_text("weights.txt", ps_text_string(&weights));
    ps_text_free(&weights);
    write_text("own.txt", "0 0 1 0\n1 2 .5 .25\n-1 -2 .5 -.25\n");
    write_text("scene.yaml", "scene: 1\n" SCENE);
    write_text("other.yaml", "scene: 1\nrecord: {digests: [aa, bb, cc, dd, ee]}\n" SCENE);
    unsetenv("POINTSPEC_MEMORY");
    return setenv("POINTSPEC_CACHE_DIR", folder, 1);
}

static int remove_folder(void **state) {
    (void)state;
    char command[TEXT];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

static int make_context(void **state) {
    (void)state;
    context = test_public_context();
    return 0;
}

static int destroy_context(void **state) {
    (void)state;
    pspec_context_destroy(context);
    return 0;
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_context, destroy_context)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(files_are_those_of_the_program),
        TEST(plans_are_those_of_the_program),
        TEST(memory_limits),
        TEST(the_machine_is_that_of_the_program),
        cmocka_unit_test(test_gsl_is_left_alone),
    };
    test_watch_gsl();
    ps_device_close(test_open_device()); /* ends as skipped when there is none */
    return cmocka_run_group_tests_name("answers", tests, make_folder, remove_folder);
}
