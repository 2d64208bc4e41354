/* What makes files and what looks at the machine, from the library: points, scenes, plans, devices,
 * the doctor. They are those of the program, byte for byte. */
#include "harness_program.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { TEXT = 4096, EXIT_CHECK = 3 };

static char folder[] = "/tmp/test_commands_XXXXXX";
static pspec_context *context; /* of the test that runs */

static void assert_done(pspec_status status) {
    if (status != PSPEC_OK) {
        fail_msg("%s", pspec_context_message(context));
    }
}

static void assert_refused(pspec_status status, const char *sentence) {
    assert_int_equal(status, PSPEC_ERROR_INVALID_ARGUMENT);
    if (strstr(pspec_context_message(context), sentence) == NULL) {
        fail_msg("\"%s\" does not say \"%s\"", pspec_context_message(context), sentence);
    }
}

static void hear(const char *sentence, void *payload) {
    snprintf(payload, TEXT, "%s", sentence);
}

/* ---- points ---------------------------------------------------------------------------------- */

typedef pspec_status make(pspec_context *asked, const pspec_option *options, size_t num);

/* The file is the option "output", which is the last one. */
static void compare_points(make *of_library, const char *command, const pspec_option *options,
                           size_t num) {
    const char *const path = options[num - 1].value;
    char expected[TEXT];
    char warning[TEXT] = "";
    char line[2 * TEXT];
    size_t num_said = 0;
    assert_int_equal(test_ask_program(command, options, num), 0);
    snprintf(expected, sizeof expected, "expected_%s", path);
    assert_int_equal(rename(path, expected), 0);
    pspec_context_set_warnings(context, hear, warning);
    assert_done(of_library(context, options, num));
    test_assert_same_file(path, expected);
    /* what is lost is said by both */
    char *const said = test_read_whole("said", &num_said);
    snprintf(line, sizeof line, "pointspec %s: %s\n", command, warning);
    assert_string_equal(said, warning[0] != '\0' ? line : "");
    free(said);
    pspec_context_set_warnings(context, NULL, NULL);
}

static void points_are_those_of_the_program(void **state) {
    (void)state;
    const pspec_option text[] = {{"sampler", "jittered"}, {"points", "64"},
                                 {"realizations", "3"},   {"seed", "7"},
                                 {"homogenize", NULL},    {"output", "points.txt"}};
    compare_points(pspec_sample, "sample", text, COUNT(text));
    const pspec_option array[] = {
        {"sampler", "white-sphere"}, {"points", "20"}, {"output", "sphere.npy"}};
    compare_points(pspec_sample, "sample", array, COUNT(array));
    const pspec_option lossy[] = {
        {"sampler", "white"}, {"points", "10"}, {"format", "rps"}, {"output", "white.rps"}};
    compare_points(pspec_sample, "sample", lossy, COUNT(lossy));
}

/* Without an output a picture is all that is made, and then there may be several samplers. */
static void points_are_drawn(void **state) {
    (void)state;
    const pspec_option both[] = {
        {"sampler", "white"}, {"sampler", "zphi"}, {"points", "20"}, {"plot", "both.svg"}};
    const pspec_option one[] = {{"sampler", "white"}, {"plot", "one.svg"}, {"format", "csv"}};
    pspec_sampler *sampler = NULL;
    assert_refused(pspec_sampler_create(&sampler, context, both, COUNT(both)), "2 samplers");
    assert_refused(pspec_sample(context, one, COUNT(one)), "needs the option output");
    if (system("gnuplot --version >/dev/null 2>&1") == 0) {
        assert_done(pspec_sample(context, both, COUNT(both)));
        assert_int_equal(access("both.svg", F_OK), 0);
    }
}

static void files_are_converted(void **state) {
    (void)state;
    const pspec_option made[] = {
        {"sampler", "white"}, {"points", "32"}, {"realizations", "2"}, {"output", "sets.txt"}};
    assert_done(pspec_sample(context, made, COUNT(made)));
    const pspec_option array[] = {
        {"files", "sets.txt"}, {"files", "sets.txt"}, {"output", "sets.npy"}};
    compare_points(pspec_convert, "convert", array, COUNT(array));
    const pspec_option part[] = {
        {"files", "sets.npy"}, {"select-points", "3..9"}, {"output", "part.csv"}};
    compare_points(pspec_convert, "convert", part, COUNT(part));
    const pspec_option absent[] = {{"files", "nowhere.txt"}, {"output", "absent.npy"}};
    assert_int_equal(pspec_convert(context, absent, COUNT(absent)), PSPEC_ERROR_IO);
    assert_int_equal(access("absent.npy", F_OK), -1);
}

/* Arrays have the bits of the file. */
static void samplers_fill_arrays(void **state) {
    (void)state;
    enum { N = 16, D = 3, R = 2 };
    const pspec_option options[] = {
        {"sampler", "sobol:scramble=owen"}, {"points", "16"}, {"dimension", "3"}, {"seed", "5"}};
    const pspec_option filed[] = {{"sampler", "sobol:scramble=owen"},
                                  {"points", "16"},
                                  {"dimension", "3"},
                                  {"seed", "5"},
                                  {"realizations", "2"},
                                  {"output", "sobol.npy"}};
    pspec_sampler *sampler = NULL;
    double points[N * D];
    size_t num = 0;
    assert_done(pspec_sampler_create(&sampler, context, options, COUNT(options)));
    const pspec_sampler_shape shape = pspec_sampler_get_shape(sampler);
    assert_int_equal(shape.domain, PSPEC_DOMAIN_TORUS);
    assert_int_equal(shape.dimension, D);
    assert_int_equal(shape.num_points, N);
    assert_done(pspec_sample(context, filed, COUNT(filed)));
    char *const bytes = test_read_whole("sobol.npy", &num);
    assert_true(num > R * sizeof points);
    const char *const data = bytes + num - R * sizeof points;
    for (uint64_t r = R; r-- > 0;) { /* in any order */
        assert_done(pspec_sampler_generate(sampler, context, r, points, NULL));
        assert_memory_equal(points, data + r * sizeof points, sizeof points);
    }
    free(bytes);
    assert_refused(pspec_sampler_generate(sampler, context, 0, NULL, NULL), "no room");
    assert_refused(pspec_sampler_generate(NULL, context, 0, points, NULL), "no sampler");
    pspec_sampler_destroy(sampler);
    pspec_sampler_destroy(NULL);
}

static void shapes_are_those_of_samplers(void **state) {
    (void)state;
    static const struct {
        const char *name;
        pspec_domain domain;
        unsigned dimension;
    } cases[] = {{"white", PSPEC_DOMAIN_TORUS, 2},
                 {"white-sphere", PSPEC_DOMAIN_SPHERE, 3},
                 {"fibonacci-hemisphere", PSPEC_DOMAIN_HEMISPHERE, 3}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        const pspec_option options[] = {{"sampler", cases[i].name}, {"points", "12"}};
        pspec_sampler *sampler = NULL;
        assert_done(pspec_sampler_create(&sampler, context, options, COUNT(options)));
        assert_int_equal(pspec_sampler_get_shape(sampler).domain, cases[i].domain);
        assert_int_equal(pspec_sampler_get_shape(sampler).dimension, cases[i].dimension);
        pspec_sampler_destroy(sampler);
    }
}

static int stop(const pspec_progress_report *report, void *payload) {
    (void)payload;
    return report->done >= 2;
}

static void a_cancelled_file_is_not_there(void **state) {
    (void)state;
    const pspec_option options[] = {{"sampler", "white"},
                                    {"points", "1000"},
                                    {"realizations", "50"},
                                    {"output", "cancelled.txt"}};
    pspec_context_set_progress(context, stop, NULL);
    assert_int_equal(pspec_sample(context, options, COUNT(options)), PSPEC_ERROR_CANCELLED);
    assert_int_equal(access("cancelled.txt", F_OK), -1);
    pspec_context_set_memory_limit(context, 1000);
    assert_int_equal(pspec_sample(context, options, COUNT(options)), PSPEC_ERROR_MEMORY);
}

/* ---- scenes ---------------------------------------------------------------------------------- */

static void write_scene(const char *path, const char *digest) {
    FILE *const file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "scene: 1\n%sresults:\n", digest);
    fprintf(file, "  - {result: power, name: p, samplers: [white, jittered], points: 32..64, "
                  "max-frequency: 4}\n"
                  "  - {result: pairs, name: q, samplers: white-sphere, points: 20, "
                  "max-degree: 3}\n");
    assert_int_equal(fclose(file), 0);
}

static void scenes_are_run(void **state) {
    (void)state;
    const pspec_option of_program[] = {{"files", "scene.yaml"}, {"output", "expected_run"}};
    const pspec_option options[] = {{"files", "scene.yaml"}, {"output", "run"}};
    pspec_table *table = NULL;
    write_scene("scene.yaml", "");
    assert_int_equal(test_ask_program("run", of_program, COUNT(of_program)), 0);
    for (int again = 0; again < 2; again++) {
        assert_done(pspec_run(&table, context, options, COUNT(options)));
        assert_string_equal(pspec_table_name(table), "run");
        assert_string_equal(pspec_table_verdict(table), "");
        assert_int_equal(pspec_table_num_rows(table), 2);
        const size_t questions = pspec_table_find_column(table, "questions");
        const size_t cached = pspec_table_find_column(table, "cached");
        assert_int_equal(pspec_table_cell(table, 0, questions).integer, 4);
        assert_int_equal(pspec_table_cell(table, 0, cached).integer, again != 0 ? 4 : 0);
        if (again == 0) {
            pspec_table_destroy(table);
        }
    }
    test_assert_same_file("run/p.csv", "expected_run/p.csv");
    test_assert_same_file("run/q.csv", "expected_run/q.csv");
    pspec_table_destroy(table);
}

/* Exit status 3 of the program is a verdict here. */
static void a_record_that_is_not_repeated_is_a_verdict(void **state) {
    (void)state;
    const pspec_option options[] = {{"files", "other.yaml"}, {"output", "other"}};
    pspec_table *table = NULL;
    char expected[2 * TEXT];
    size_t num = 0;
    write_scene("other.yaml", "record: {digests: [aa, bb, cc, dd, ee]}\n");
    const int status = test_ask_program("run", options, COUNT(options));
    assert_int_equal(status, EXIT_CHECK);
    assert_done(pspec_run(&table, context, options, COUNT(options)));
    char *const said = test_read_whole("said", &num);
    snprintf(expected, sizeof expected, "pointspec run: %s\n", pspec_table_verdict(table));
    assert_string_equal(said, expected);
    free(said);
    pspec_table_destroy(table);
}

/* ---- plans ----------------------------------------------------------------------------------- */

/* The program prints the same plan, seconds and all. */
static void compare_plan(const char *command, const pspec_option *options, size_t num) {
    char line[TEXT];
    pspec_table *table = NULL;
    snprintf(line, sizeof line, "plan %s", command);
    assert_int_equal(test_ask_program(line, options, num), 0);
    assert_done(pspec_plan_table(&table, context, command, options, num));
    assert_done(pspec_table_write(table, context, "plan.csv", "csv"));
    test_assert_same_file("plan.csv", "printed");
    pspec_table_destroy(table);
}

static void plans_are_those_of_the_program(void **state) {
    (void)state;
    const pspec_option power[] = {{"sampler", "white"}, {"points", "4096"}, {"realizations", "99"}};
    compare_plan("power", power, COUNT(power));
    const pspec_option rule[] = {{"brdf", "glossy:n=8"},
                                 {"sampler", "fibonacci-hemisphere"},
                                 {"points", "64"},
                                 {"weights", "optimal"}};
    compare_plan("quadrature", rule, COUNT(rule));
    const pspec_option points[] = {{"sampler", "white"}, {"points", "100000"}};
    compare_plan("sample", points, COUNT(points));
    const pspec_option scene[] = {{"files", "scene.yaml"}, {"cache", "0"}};
    compare_plan("run", scene, COUNT(scene));
}

/* ---- the machine ----------------------------------------------------------------------------- */

static void devices_are_those_of_the_program(void **state) {
    (void)state;
    pspec_table *table = NULL;
    assert_int_equal(test_ask_program("devices", NULL, 0), 0);
    assert_done(pspec_devices(&table, context));
    assert_done(pspec_table_write(table, context, "devices.csv", NULL));
    /* PoCL takes the bytes of the device, the eighth column from the end, from the memory that the
     * machine has, which may change between two processes. */
    assert_int_equal(system("sed -i -E 's/,[0-9]+((,[^,]*){7})$/,\\1/' devices.csv printed"), 0);
    test_assert_same_file("devices.csv", "printed");
    pspec_table_destroy(table);
}

static void the_doctor_finds_the_same(void **state) {
    (void)state;
    static const char *const words[] = {"ok", "note", "WRONG"};
    pspec_table *table = NULL;
    size_t num = 0;
    size_t num_lines = 0;
    const int status = test_ask_program("doctor", NULL, 0);
    assert_done(pspec_doctor(&table, context));
    assert_int_equal(status, pspec_table_verdict(table)[0] == '\0' ? 0 : EXIT_CHECK);
    char *const printed = test_read_whole("printed", &num);
    for (size_t i = 0; i < num; i++) {
        num_lines += printed[i] == '\n';
    }
    assert_int_equal(pspec_table_num_rows(table), num_lines);
    for (size_t row = 0; row < num_lines; row++) {
        const char *const word = pspec_table_cell(table, row, 0).text;
        assert_true(strcmp(word, words[0]) == 0 || strcmp(word, words[1]) == 0 ||
                    strcmp(word, words[2]) == 0);
        assert_true(strlen(pspec_table_cell(table, row, 2).text) > 0);
    }
    free(printed);
    pspec_table_destroy(table);
}

/* ---- nonsense -------------------------------------------------------------------------------- */

static void nonsense_is_one_sentence(void **state) {
    (void)state;
    pspec_table *table = NULL;
    pspec_sampler *sampler = NULL;
    const pspec_option none[] = {{"points", "8"}, {"output", "none.txt"}};
    assert_refused(pspec_sample(context, none, COUNT(none)), "--sampler NAME is needed");
    const pspec_option unknown[] = {{"sampler", "wite"}, {"output", "none.txt"}};
    assert_refused(pspec_sample(context, unknown, COUNT(unknown)), "white");
    assert_refused(pspec_sampler_create(&sampler, context, unknown, COUNT(unknown)), "white");
    assert_null(sampler);
    const pspec_option stream[] = {{"sampler", "white"}, {"output", "-"}};
    assert_refused(pspec_sample(context, stream, COUNT(stream)), "- is none");
    const pspec_option nowhere[] = {{"sampler", "white"}};
    assert_refused(pspec_sample(context, nowhere, COUNT(nowhere)), "needs the option output");
    const pspec_option odd[] = {{"tol", "1e-3"}};
    assert_refused(pspec_sample(context, odd, COUNT(odd)), "tol");
    assert_refused(pspec_convert(context, nowhere, COUNT(nowhere)), "sampler");
    assert_refused(pspec_run(&table, context, NULL, 0), "0 files were named");
    assert_refused(pspec_run(&table, context, NULL, 2), "address NULL");
    assert_refused(pspec_plan_table(&table, context, "pwer", NULL, 0), "did you mean power?");
    assert_refused(pspec_plan_table(&table, context, NULL, NULL, 0), "no name");
    assert_refused(pspec_plan_table(&table, context, "doctor", NULL, 0), "no command \"doctor\"");
    assert_null(table);
    assert_int_equal(pspec_run(NULL, context, NULL, 0), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(pspec_run(&table, NULL, NULL, 0), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(pspec_devices(&table, NULL), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(pspec_doctor(NULL, context), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(pspec_sample(NULL, NULL, 0), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(pspec_sampler_create(&sampler, NULL, NULL, 0), PSPEC_ERROR_INVALID_ARGUMENT);
}

/* Every option that a command takes is in its table, and is taken. */
static void options_are_told(void **state) {
    (void)state;
    pspec_table *table = NULL;
    assert_done(pspec_options_table(&table, context, "sample"));
    bool has_sampler = false;
    for (size_t row = 0; row < pspec_table_num_rows(table); row++) {
        const char *const name = pspec_table_cell(table, row, 0).text;
        has_sampler = has_sampler || strcmp(name, "sampler") == 0;
        assert_string_not_equal(name, "tol");
    }
    assert_true(has_sampler);
    pspec_table_destroy(table);
}

/* ---- all ------------------------------------------------------------------------------------- */

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

static int make_folder(void **state) {
    (void)state;
    assert_non_null(mkdtemp(folder));
    assert_int_equal(chdir(folder), 0);
    unsetenv("POINTSPEC_MEMORY");
    return setenv("POINTSPEC_CACHE_DIR", folder, 1);
}

static int remove_folder(void **state) {
    (void)state;
    char command[TEXT];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_context, destroy_context)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(points_are_those_of_the_program),
        TEST(points_are_drawn),
        TEST(files_are_converted),
        TEST(samplers_fill_arrays),
        TEST(shapes_are_those_of_samplers),
        TEST(a_cancelled_file_is_not_there),
        TEST(scenes_are_run),
        TEST(a_record_that_is_not_repeated_is_a_verdict),
        TEST(plans_are_those_of_the_program),
        TEST(devices_are_those_of_the_program),
        TEST(the_doctor_finds_the_same),
        TEST(nonsense_is_one_sentence),
        TEST(options_are_told),
        cmocka_unit_test(test_gsl_is_left_alone),
    };
    test_watch_gsl();
    ps_device_close(test_open_device()); /* ends as skipped when there is none */
    return cmocka_run_group_tests_name("commands_public", tests, make_folder, remove_folder);
}
